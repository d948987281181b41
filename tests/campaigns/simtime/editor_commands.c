/* SPDX-License-Identifier: MIT
 * editor_commands.c - what the commands of Edit do; see editor.h. */
#include "editor.h"

#include <stdlib.h>
#include <string.h>
#include <strings.h>

#define STEP_LAST 6
#define PAIRED 18u
#define LINKS_MOST 12u
#define COUNT_FIELD 1u
#define NEXT_FIELD 11u

/* ---- edits ---- */

static table_t old;   /* before the current edit */

void editor_edit_begins(void)
{
    old = editor.now;
}

void editor_edit_ends(void)
{
    editor.is_edited = true;
    if (!table_is_equal(&old, &editor.now)) {
        editor.before = old;
        editor.can_undo = true;
        editor.can_redo = editor.is_key_edit = false;
    } else {
        editor.can_undo = editor.can_redo = false;   /* no edit, unless a cell that is not known has changed */
    }
}

static int *steps_used(void)
{
    return &editor.now.field[FIELD_STEPS];
}

/* A step that comes into use without a time gets that of a new page (firmware/edit/DIFFERENCES.md). */
static void use_steps(int steps)
{
    const int used = *steps_used();
    for (int step = used == UNKNOWN ? 0 : used; step < steps; step++) {
        int *time = &editor.now.cell[step + 1][ROW_TIME];
        *time = used == UNKNOWN ? UNKNOWN : *time == 0 ? 64 : *time;
    }
    *steps_used() = steps;
}

/* Column 0 is the work pose, column k + 1 is step k. The stored value of a missing joint is left open. */
static void store_pose(unsigned to)
{
    for (unsigned row = 0; row < TABLE_ROWS; row++) {
        const int is = editor.now.cell[0][row];
        editor.now.cell[to][row] = row >= ROW_PAUSE || editor_is_there(row) || is == NO_VALUE ? is : UNKNOWN;
    }
}


static void copy_step(unsigned to, const table_t *from, unsigned column)
{
    memcpy(editor.now.cell[to], from->cell[column], sizeof editor.now.cell[to]);
}

static void forget_step(unsigned column)
{
    for (unsigned row = 0; row < TABLE_ROWS; row++) {
        editor.now.cell[column][row] = UNKNOWN;
    }
}

static void forget_page(void)
{
    const table_t kept = editor.now;
    table_forget(&editor.now);
    memcpy(editor.now.cell[0], kept.cell[0], sizeof kept.cell[0]);
    editor.now.page = kept.page;
    editor.now.go_step = kept.go_step;
    editor.is_edited = true;
    editor.can_undo = editor.can_redo = false;
}

bool editor_is_whole(unsigned page)
{
    const uint8_t *at = page_at(page);
    return sum_of(at) == 0xFF && at[20] <= STEPS_MOST && at[22] != 0;
}

static void load(unsigned page)
{
    if (editor_is_whole(page)) {
        table_load(&editor.now, page);
    } else {
        forget_page();
        editor.now.page = (int)page;
    }
    editor.now.go_step = UNKNOWN;
}

bool editor_differs_from_flash(void)
{
    table_t stored = editor.now;
    table_load(&stored, (unsigned)editor.now.page);
    return editor_is_whole((unsigned)editor.now.page) && !table_is_equal(&stored, &editor.now);
}

static bool has_edits(void)
{
    return !editor.now.is_saved || editor_differs_from_flash();
}

/* ---- commands ---- */

static void ask(void (*if_yes)(void))
{
    editor.if_yes = if_yes;
    editor.mode = QUESTION;
    editor.message = ANY;
}

static void open_page(void)
{
    load((unsigned)editor.number[1]);
    editor.can_undo = editor.can_redo = false;
    editor.now.is_saved = true;
    editor.is_edited = false;
}

static void run_page(void)
{
    if (editor.is_unsure) {
        editor_lose();
    } else if (has_edits()) {
        ask(open_page);
    } else if (editor.is_edited || !editor_is_whole((unsigned)editor.now.page)) {
        editor_lose();   /* the page may have edits */
    } else {
        open_page();
    }
}

static void run_neighbour(int way)
{
    editor.number[1] = editor.now.page + way;
    if (editor.number[1] < 0 || editor.number[1] >= (int)PAGES) {
        editor.message = BAD_RANGE;
    } else {
        run_page();
    }
}

static void run_next(void)
{
    run_neighbour(1);
}

static void run_before(void)
{
    run_neighbour(-1);
}

static void copy_page(void)
{
    const int page = editor.now.page;
    editor_edit_begins();
    load((unsigned)editor.number[1]);
    editor.now.page = page;
    editor_edit_ends();
    editor.can_undo = editor.can_redo = false;
    editor.message = ANY;
}

static void run_copy(void)
{
    if (editor.is_unsure) {
        editor_lose();
    } else if (has_edits()) {
        ask(copy_page);
    } else if (editor.is_edited || !editor_is_whole((unsigned)editor.now.page)) {
        editor_lose();
    } else {
        copy_page();
    }
}

static void empty_page(void)
{
    editor_edit_begins();
    for (unsigned column = 1; column < TABLE_STEPS; column++) {
        for (unsigned id = 0; id < JOINTS; id++) {
            editor.now.cell[column][id] = NO_VALUE;
        }
        editor.now.cell[column][ROW_PAUSE] = 0;
        editor.now.cell[column][ROW_TIME] = 64;
    }
    for (unsigned id = 0; id < JOINTS; id++) {
        editor.now.softness[id] = 0x55;
    }
    for (unsigned i = 0; i < TABLE_FIELDS; i++) {
        editor.now.field[i] = i == COUNT_FIELD ? 1 : i == 8 || i == 10 ? 32 : 0;
    }
    memset(editor.now.name, ' ', NAME_BYTES);
    editor.now.is_time = 0;
    editor.now.go_step = UNKNOWN;
    editor_edit_ends();
}

static void run_new(void)
{
    ask(empty_page);
}

static void run_save(void)
{
    editor.saved_as = editor.words > 1 ? editor.number[1] : editor.now.page;
    editor.mode = UNSURE;   /* it may ask */
    editor.message = ANY;
}

static void run_name(void)
{
    if (editor.words == 1) {
        editor.now.name[0] = '\0';
        editor.mode = UNSURE;
    } else if (strlen(editor.word[1]) <= NAME_BYTES) {
        editor_edit_begins();
        memset(editor.now.name, ' ', NAME_BYTES);
        memcpy(editor.now.name, editor.word[1], strlen(editor.word[1]));
        editor_edit_ends();
    } else {
        editor.message = ANY;
    }
}

static void run_step(void)
{
    editor_edit_begins();
    use_steps(editor.number[1]);
    editor_edit_ends();
}

static void go(void)
{
    const unsigned column = (unsigned)editor.number[1] + 1;
    for (unsigned id = 0; id < JOINTS; id++) {
        const int to = editor.now.cell[column][id];
        if (!editor_is_there(id) || to == NO_VALUE) {
            editor.now.cell[0][id] = UNKNOWN;
            continue;
        }
        editor.now.cell[0][id] = to;
        editor.torque[id] = to == UNKNOWN ? UNKNOWN : to != OFF;
    }
    editor.now.cell[0][ROW_PAUSE] = editor.now.cell[column][ROW_PAUSE];
    if (editor.now.cell[column][ROW_TIME] != 0) {
        editor.now.cell[0][ROW_TIME] = editor.now.cell[column][ROW_TIME];
    }
    editor.now.go_step = editor.number[1];
    editor.message = ANY;
}

static void run_go(void)
{
    if (*steps_used() == UNKNOWN) {
        editor_lose();
    } else if (editor.number[1] >= *steps_used()) {
        ask(go);
    } else {
        go();
    }
}

static void run_write(void)
{
    const int step = editor.words > 1 ? editor.number[1] : *steps_used();
    editor.message = ANY;   /* names joints that are off */
    if (*steps_used() == UNKNOWN) {
        editor_lose();
    }
    if (step == UNKNOWN || step > STEP_LAST) {
        return;
    }
    editor_edit_begins();
    store_pose((unsigned)step + 1);
    *steps_used() += editor.words > 1 ? 0 : 1;
    editor_edit_ends();
}

static void run_insert(void)
{
    const int step = editor.number[1];
    editor_edit_begins();
    for (int each = STEP_LAST; each > step; each--) {
        copy_step((unsigned)each + 1, &editor.now, (unsigned)each);
    }
    store_pose((unsigned)step + 1);
    *steps_used() += step < *steps_used() && *steps_used() < STEPS_MOST ? 1 : 0;
    editor_edit_ends();
    editor.message = ANY;
}

static void run_delete(void)
{
    const int used = *steps_used();
    editor.message = ANY;
    if (used == UNKNOWN) {
        editor_lose();
        return;
    }
    if (used == 0 || (editor.words > 1 && editor.number[1] >= used)) {
        return;   /* a message says so */
    }
    editor_edit_begins();
    for (int each = editor.words > 1 ? editor.number[1] : STEPS_MOST; each < STEP_LAST; each++) {
        copy_step((unsigned)each + 1, &editor.now, (unsigned)each + 2);
    }
    *steps_used() = used - 1;
    editor_edit_ends();
}

static void run_move(void)
{
    const unsigned from = (unsigned)(editor.number[1] + 1) % TABLE_STEPS;
    const unsigned to = (unsigned)(editor.number[2] + 1) % TABLE_STEPS;
    editor.message = ANY;
    if (to == 0) {
        forget_step(0);
        return;
    }
    editor_edit_begins();
    copy_step(to, &editor.now, from);
    editor_edit_ends();
}

static void run_swap(void)
{
    const unsigned a = (unsigned)editor.number[1] + 1, b = (unsigned)editor.number[2] + 1;
    const int used = *steps_used();
    if (a >= TABLE_STEPS || b >= TABLE_STEPS || used == UNKNOWN) {
        editor_lose();
        return;
    }
    if ((int)a > used || (int)b > used) {
        editor.message = ANY;   /* it says that such a step is not used */
        return;
    }
    editor_edit_begins();
    copy_step(a, &old, b);
    copy_step(b, &old, a);
    editor_edit_ends();
}

static void run_take(void)
{
    editor.noted = editor.now;
    editor.noted_first = editor.number[1];
    editor.noted_count = 1 + (editor.words > 2 ? editor.number[2] - editor.number[1] : 0);
    editor.message = ANY;
    if (editor.noted_count < 1 || editor.noted_first + editor.noted_count > *steps_used()) {
        editor.noted_count = 0;
    }
}

static void run_paste(void)
{
    const int used = *steps_used(), at = editor.words > 1 ? editor.number[1] : used, end = at + editor.noted_count;
    editor.message = ANY;
    if (editor.noted_count == 0 || at > used || end > STEPS_MOST || !table_is_equal(&editor.noted, &editor.now)) {
        forget_page();
        return;
    }
    editor_edit_begins();
    for (int each = 0; each < editor.noted_count; each++) {
        copy_step((unsigned)(at + each) + 1, &editor.noted, (unsigned)(editor.noted_first + each) + 1);
    }
    *steps_used() = used > end ? used : end;
    editor_edit_ends();
}

/* Mirrors about 512, in pairs 1-2 .. 17-18. */
static void run_mirror(void)
{
    const unsigned column = (unsigned)editor.number[1] + 1;
    editor.message = ANY;
    editor.now.go_step = UNKNOWN;
    editor.now.cell[0][ROW_PAUSE] = editor.now.cell[0][ROW_TIME] = UNKNOWN;
    for (unsigned id = 0; id < JOINTS; id++) {
        const unsigned partner = id % 2 == 1 ? id + 1 : id - 1;
        const int of = id >= 1 && id <= PAIRED ? editor.now.cell[column][partner] : UNKNOWN;
        if (editor_is_there(id)) {
            editor.now.cell[0][id] = of < 0 || editor.has_pairs ? UNKNOWN : 1024 - of > 1023 ? 1023 : 1024 - of;
            editor.torque[id] = of < 0 || editor.has_pairs ? UNKNOWN : 1;
        } else {
            editor.now.cell[0][id] = UNKNOWN;
        }
    }
}

/* Returns the largest value of the cell under the cursor. */
static int most_of_cell(void)
{
    const unsigned x = editor.now.x, y = editor.now.y;
    return x < 8 && y < ROW_PAUSE ? 1023 : x == 9 && y - 3 == FIELD_STEPS ? STEPS_MOST : 255;
}

int *editor_cell(void)
{
    const unsigned x = editor.now.x, y = editor.now.y;
    return x < 8 ? &editor.now.cell[x][y] : x == 8 ? &editor.now.softness[y] : &editor.now.field[y - 3];
}

void editor_put(int value)
{
    const unsigned x = editor.now.x, y = editor.now.y;
    if (x == 0 && y < ROW_PAUSE) {
        editor.now.cell[0][y] = value;
        editor.torque[y] = editor_is_there(y) ? 1 : UNKNOWN;
        return;
    }
    editor_edit_begins();
    if (x == 9 && y - 3 == FIELD_STEPS) {
        use_steps(value);
    }
    *editor_cell() = value;
    editor_edit_ends();
    if (x == 9 && y - 3 == FIELD_SCHEDULE) {
        editor_lose();
    }
}

static void run_set(void)
{
    if (!editor.has_cursor) {
        editor_lose();
    } else if (editor.number[1] > most_of_cell()) {
        editor.message = BAD_RANGE;
    } else {
        editor.message = ANY;   /* possibly a missing servo */
        editor_put(editor.number[1]);
    }
}

/* On a low terminal some rows are missing, and the cursor skips them. */
bool editor_has_all_rows(void)
{
    bool has_all = true;
    for (unsigned id = 0; id < JOINTS; id++) {
        has_all = has_all && editor.now.softness[id] != UNKNOWN;
    }
    return has_all;
}

bool editor_is_cell(int x, int y)
{
    return x >= 0 && y >= 0 && x <= 9 && y <= 32 && (x < 8 || (x == 8 && y <= 30) || (x == 9 && y >= 3 && y <= 19));
}

static void run_goto(void)
{
    editor.message = ANY;
    editor.has_cursor = editor.has_cursor && editor_is_cell(editor.number[1], editor.number[2]) && editor_has_all_rows();
    editor.now.x = (unsigned)editor.number[1];
    editor.now.y = (unsigned)editor.number[2];
}

static void run_schedule(void)
{
    editor_edit_begins();
    editor.now.is_time = editor.word[0][0] == 't' || editor.word[0][0] == 'T';
    if (editor.now.field[FIELD_SCHEDULE] != UNKNOWN) {
        editor.now.field[FIELD_SCHEDULE] = editor.now.is_time ? 10 : 0;
    }
    editor_edit_ends();
}

static void exchange(bool can, table_t *to, table_t *other, bool *can_other)
{
    if (!can) {
        forget_page();
        editor.is_unsure = true;
        editor.message = ANY;
        return;
    }
    const table_t kept = editor.now;
    editor.now = *to;
    memcpy(editor.now.cell[0], kept.cell[0], sizeof kept.cell[0]);
    editor.now.x = kept.x;
    editor.now.y = kept.y;
    editor.now.go_step = UNKNOWN;
    editor.now.page = kept.page;
    editor.now.is_hex = kept.is_hex;
    *other = kept;
    *can_other = true;
}

static void run_undo(void)
{
    exchange(editor.can_undo, &editor.before, &editor.after, &editor.can_redo);
    editor.can_undo = false;
}

static void run_redo(void)
{
    exchange(editor.can_redo, &editor.after, &editor.before, &editor.can_undo);
    editor.can_redo = false;
}

/* A trim puts this position of a joint out of its servo's reach. */
static bool is_beyond(unsigned id, int pos)
{
    return pos >= 0 && pos < 1024 && limited(pos + trim_of(id)) != pos + trim_of(id);
}

/* ON and OFF. Without IDs: all present servos. */
static void run_torque(void)
{
    const bool is_on = strcasecmp(editor.word[0], "on") == 0;
    editor.message = ANY;
    for (unsigned at = 1; at < editor.words; at++) {
        const int id = editor.number[at];
        if (id == UNKNOWN || id >= (int)JOINTS || !editor_is_there((unsigned)id)) {
            editor_lose();
            return;
        }
    }
    for (unsigned id = 0; id < JOINTS; id++) {
        bool is_meant = editor.words == 1;
        for (unsigned at = 1; at < editor.words; at++) {
            is_meant = is_meant || editor.number[at] == (int)id;
        }
        if (is_meant && !editor_is_there(id)) {
            editor.now.cell[0][id] = UNKNOWN;
        } else if (is_meant) {
            editor.now.cell[0][id] = is_on ? UNKNOWN : OFF;
            editor.torque[id] = is_on;
        } else if (editor.is_pose_copied || session.trouble_tick > session.boot_tick ||
                   is_beyond(id, editor.now.cell[0][id])) {
            editor.now.cell[0][id] = UNKNOWN;   /* the pose is read again; the last goals may be lost or limited */
        }
    }
}

/* Finds where a play ends: the targets of the steps of this page and of the pages that follow. */
static bool find_end(unsigned page)
{
    table_t of = editor.now;
    const table_t start = editor.now;
    for (unsigned id = 0; id < JOINTS; id++) {
        editor.played[id] = UNKNOWN;
    }
    for (unsigned links = 0; page != 0; links++) {
        if (links == LINKS_MOST || (page != (unsigned)editor.now.page && !editor_is_whole(page))) {
            return false;
        }
        if (page == (unsigned)editor.now.page) {
            of = editor.now;
        } else {
            table_load(&of, page);
        }
        if (of.field[FIELD_STEPS] > (int)STEPS_MOST) {
            return false;   /* a damaged page, which PLAY refuses */
        }
        for (int column = 1; column <= of.field[FIELD_STEPS] && of.field[COUNT_FIELD] > 0; column++) {
            for (unsigned id = 0; id < JOINTS; id++) {
                const int to = of.cell[column][id];
                editor.played[id] = to >= 0 && start.cell[0][id] >= 0 ? to : editor.played[id];   /* those that hold */
            }
        }
        if (of.field[NEXT_FIELD] < 0 || of.field[COUNT_FIELD] < 0 || of.field[FIELD_STEPS] <= 0) {
            return false;
        }
        page = (unsigned)of.field[NEXT_FIELD];
    }
    return true;
}

static void run_play(void)
{
    const int page = editor.words > 1 ? editor.number[1] : editor.now.page;
    /* hal/host/README.md: behind an unplugged adapter nothing is driven until `on`, though a servo may have kept its
     * torque, as its cell says. */
    const bool is_driven = session.plug_tick <= session.boot_tick;
    editor.is_play = is_driven && page > 0 && page < (int)PAGES && find_end((unsigned)page);
    editor.mode = UNSURE;
    editor.message = ANY;
    for (unsigned id = 0; id < JOINTS; id++) {
        editor.now.cell[0][id] = editor.torque[id] = UNKNOWN;
    }
    editor.can_undo = editor.can_redo = false;
}

void editor_view(void)
{
    editor.mode = UNSURE;
    editor.is_view = true;
    editor.message = ANY;
}

static void run_rows(void)
{
    editor_view();
    editor.has_cursor = false;
}

static void run_repaint(void)
{
    editor.message = ANY;
    if (strcasecmp(editor.word[0], "re") != 0) {
        editor.now.is_hex = strcasecmp(editor.word[0], "hex") == 0;
    }
}

static void run_pairs(void)
{
    editor.has_pairs = editor.has_pairs || editor.words > 1;
    editor.message = ANY;
}

static void run_unsure(void)
{
    editor_lose();
}

/* The commands, how many words may follow, and the range of the numbers among them. */
static const struct {
    const char *word, *other;
    unsigned fewest, most;
    int high;                      /* of every number; ANY_NUMBER: not a number, or range unknown */
    void (*run)(void);
} commands[] = {
#define ANY_NUMBER (-1)
    {"page", "p", 1, 1, 255, run_page},        {"next", "n", 0, 0, 0, run_next},
    {"before", "b", 0, 0, 0, run_before},      {"copy", NULL, 1, 1, 255, run_copy},
    {"new", NULL, 0, 0, 0, run_new},           {"save", "sav", 0, 1, 255, run_save},
    {"exit", NULL, 0, 0, 0, run_unsure},       {"name", NULL, 0, 1, ANY_NUMBER, run_name},
    {"step", "s", 1, 1, 7, run_step},          {"go", "g", 1, 1, 6, run_go},
    {"write", "w", 0, 1, 6, run_write},        {"insert", "i", 1, 1, 6, run_insert},
    {"delete", "d", 0, 1, 6, run_delete},      {"move", NULL, 2, 2, 7, run_move},
    {"swap", NULL, 2, 2, 7, run_swap},         {"take", NULL, 1, 2, 6, run_take},
    {"paste", NULL, 0, 1, 6, run_paste},       {"mirror", "m", 1, 1, 6, run_mirror},
    {"pairs", NULL, 0, 2, ANY_NUMBER, run_pairs}, {"set", NULL, 1, 1, 1023, run_set},
    {"goto", NULL, 2, 2, 32, run_goto},        {"on", NULL, 0, WORDS, ANY_NUMBER, run_torque},
    {"off", NULL, 0, WORDS, ANY_NUMBER, run_torque}, {"play", NULL, 0, 2, ANY_NUMBER, run_play},
    {"time", NULL, 0, 0, 0, run_schedule},     {"speed", NULL, 0, 0, 0, run_schedule},
    {"undo", "u", 0, 0, 0, run_undo},          {"redo", NULL, 0, 0, 0, run_redo},
    {"list", NULL, 0, 2, ANY_NUMBER, editor_view}, {"re", NULL, 0, 0, 0, run_repaint},
    {"rows", NULL, 1, 1, ANY_NUMBER, run_rows}, {"hex", NULL, 0, 0, 0, run_repaint},
    {"dec", NULL, 0, 0, 0, run_repaint},       {"monitor", "mon", 0, 0, 0, editor_view},
    {"help", "?", 0, 1, ANY_NUMBER, editor_view}, {"toss", NULL, 0, WORDS, ANY_NUMBER, editor_view},
};

/* ---- words ---- */

static int number_of(const char *word)
{
    char *end;
    const bool is_hex = strncasecmp(word, "0x", 2) == 0;
    const long number = strtol(word, &end, is_hex || editor.now.is_hex ? 16 : 10);
    return end != word && *end == '\0' && number >= 0 && number < 65536 ? (int)number : UNKNOWN;
}

void editor_split_line(void)
{
    static char copy[LINE_BYTES];
    memcpy(copy, editor.line, sizeof copy);
    editor.words = 0;
    for (char *word = strtok(copy, " ,.:;"); word != NULL && editor.words < WORDS; word = strtok(NULL, " ,.:;")) {
        editor.word[editor.words] = word;
        editor.number[editor.words++] = number_of(word);
    }
}

void editor_run_line(void)
{
    for (unsigned i = 0; i < sizeof commands / sizeof commands[0]; i++) {
        const char *other = commands[i].other;
        if (strcasecmp(editor.word[0], commands[i].word) != 0 && (other == NULL || strcasecmp(editor.word[0], other) != 0)) {
            continue;
        }
        const unsigned behind = editor.words - 1;
        bool is_right = true;
        for (unsigned at = 1; at <= behind && commands[i].high != ANY_NUMBER; at++) {
            is_right = is_right && editor.number[at] != UNKNOWN && editor.number[at] <= commands[i].high;
        }
        editor.message = is_right ? GOOD : BAD_RANGE;
        if (behind < commands[i].fewest || behind > commands[i].most) {
            editor.message = BAD_PARAMETER;
        }
        if (editor.message == GOOD) {
            commands[i].run();
        }
        return;
    }
    editor.message = BAD_COMMAND;
}
