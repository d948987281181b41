/* SPDX-License-Identifier: MIT
 * editor.c - a second model of Edit, from edit/ORIGINAL.md, edit/DIFFERENCES.md and the words of `help`: what lines and
 * keys do to the table, and to the servos. It is read off the screen while nothing happens, changed by what is typed, and
 * compared with the screen when nothing happens again. What those pages leave open is UNKNOWN until then. */
#include "session.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#define QUIET 96u                  /* ticks without a key and without a byte: all is painted */
#define AT_REST (3u * SECOND)      /* after the last goal a joint has come there */
#define LATER 16u                  /* ticks: a key so long after a question answers it */
#define STEPS_MOST 7
#define STEP_LAST 6
#define WORDS 8u
#define LONG_LINE 40u              /* a message behind a longer one may need the row */
#define PAIRED 18u
#define TABLE_LOWEST 34u           /* rows above the command line */
#define LINKS_MOST 12u
#define COUNT_FIELD 1u
#define NEXT_FIELD 11u

typedef enum { ANY, GOOD, BAD_COMMAND, BAD_PARAMETER, BAD_RANGE } message_t;

static struct {
    table_t now;                   /* what the table must show */
    table_t before, after;         /* the pages that UNDO and REDO bring */
    bool is_known, can_undo, can_redo, has_cursor;
    enum { LOST, TABLE, ESCAPE, LINE, QUESTION, UNSURE } mode;
    bool is_view;                  /* UNSURE: a list or help, and only keys that leave it are typed */
    bool is_request;               /* a line for programs: the next key has its meaning for the table */
    bool is_key_edit;              /* the newest edit was a key's, and several may be one for UNDO */
    uint8_t key;                   /* the newest */
    uint32_t look_tick, line_tick;
    char line[LINE_BYTES];
    unsigned count;
    char sequence[8];
    unsigned sequence_count;
    char *word[WORDS];
    int number[WORDS];             /* UNKNOWN: it is none */
    unsigned words;
    void (*if_yes)(void);
    message_t message;
    unsigned lines;                /* since the last look */
    int torque[JOINTS];            /* must be so: 0, 1, UNKNOWN */
    int saved_as;                  /* a save of the page; UNKNOWN: there was none */
    table_t noted;                 /* by TAKE */
    int noted_first, noted_count;
    int played[JOINTS];            /* where a play must end */
    bool is_play;
    bool is_repainted;             /* the screen was as it is kept, and nothing but RE has been typed since */
    uint32_t kept_tick;
    char kept[TABLE_LOWEST][SCREEN_COLUMNS + 1];
    bool is_pose_copied, is_play_line;
    bool has_pairs;                /* PAIRS may have been changed */
} editor;

static void lose(void)
{
    editor.is_known = editor.can_undo = editor.can_redo = editor.is_play = editor.is_repainted = false;
    editor.mode = LOST;
    editor.saved_as = UNKNOWN;
    editor.noted_count = 0;
    for (unsigned id = 0; id < JOINTS; id++) {
        editor.torque[id] = UNKNOWN;
    }
}

static bool is_there(unsigned id)
{
    return session.joint[id].servo != NULL && session.joint[id].is_known;
}

/* ---- edits ---- */

static table_t old;   /* before the edit that is under way */

static void edit_begins(void)
{
    old = editor.now;
}

static void edit_ends(void)
{
    if (!table_is_equal(&old, &editor.now)) {
        editor.before = old;
        editor.can_undo = true;
        editor.can_redo = editor.is_key_edit = false;
    } else {
        editor.can_undo = editor.can_redo = false;   /* whether that counts is left open */
    }
}

static int *steps_used(void)
{
    return &editor.now.field[FIELD_STEPS];
}

/* Columns: 0 is the work pose, k + 1 step k. What is stored of a joint that is not there is left open. */
static void store_pose(unsigned to)
{
    for (unsigned row = 0; row < TABLE_ROWS; row++) {
        const int is = editor.now.cell[0][row];
        editor.now.cell[to][row] = row >= ROW_PAUSE || is_there(row) || is == NO_VALUE ? is : UNKNOWN;
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
    editor.can_undo = editor.can_redo = false;
}

static bool is_whole(unsigned page)
{
    const uint8_t *at = page_at(page);
    return sum_of(at) == 0xFF && at[20] <= STEPS_MOST && at[22] != 0;
}

static void load(unsigned page)
{
    if (is_whole(page)) {
        table_load(&editor.now, page);
    } else {
        forget_page();
        editor.now.page = (int)page;
    }
    editor.now.go_step = UNKNOWN;
}

static bool differs_from_flash(void)
{
    table_t stored = editor.now;
    table_load(&stored, (unsigned)editor.now.page);
    return is_whole((unsigned)editor.now.page) && !table_is_equal(&stored, &editor.now);
}

static bool has_edits(void)
{
    return !editor.now.is_saved || differs_from_flash();
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
}

static void run_page(void)
{
    if (has_edits()) {
        ask(open_page);
    } else if (!is_whole((unsigned)editor.now.page)) {
        lose();   /* the page may have edits */
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
    edit_begins();
    load((unsigned)editor.number[1]);
    editor.now.page = page;
    edit_ends();
    editor.can_undo = editor.can_redo = false;
    editor.message = ANY;
}

static void run_copy(void)
{
    if (has_edits()) {
        ask(copy_page);
    } else if (!is_whole((unsigned)editor.now.page)) {
        lose();
    } else {
        copy_page();
    }
}

static void empty_page(void)
{
    edit_begins();
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
    edit_ends();
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
        edit_begins();
        memset(editor.now.name, ' ', NAME_BYTES);
        memcpy(editor.now.name, editor.word[1], strlen(editor.word[1]));
        edit_ends();
    } else {
        editor.message = ANY;
    }
}

static void run_step(void)
{
    edit_begins();
    *steps_used() = editor.number[1];
    edit_ends();
}

static void go(void)
{
    const unsigned column = (unsigned)editor.number[1] + 1;
    for (unsigned id = 0; id < JOINTS; id++) {
        const int to = editor.now.cell[column][id];
        if (!is_there(id) || to == NO_VALUE) {
            editor.now.cell[0][id] = UNKNOWN;
            continue;
        }
        editor.now.cell[0][id] = to;
        editor.torque[id] = to == UNKNOWN ? UNKNOWN : to != OFF;
    }
    editor.now.cell[0][ROW_PAUSE] = editor.now.cell[column][ROW_PAUSE];
    editor.now.cell[0][ROW_TIME] = editor.now.cell[column][ROW_TIME];
    editor.now.go_step = editor.number[1];
    editor.message = ANY;
}

static void run_go(void)
{
    if (editor.number[1] >= *steps_used()) {
        ask(go);
    } else {
        go();
    }
}

static void run_write(void)
{
    const int step = editor.words > 1 ? editor.number[1] : *steps_used();
    editor.message = ANY;   /* who is off */
    if (step == UNKNOWN || step > STEP_LAST) {
        return;
    }
    edit_begins();
    store_pose((unsigned)step + 1);
    *steps_used() += editor.words > 1 ? 0 : 1;
    edit_ends();
}

static void run_insert(void)
{
    const int step = editor.number[1];
    edit_begins();
    for (int each = STEP_LAST; each > step; each--) {
        copy_step((unsigned)each + 1, &editor.now, (unsigned)each);
    }
    store_pose((unsigned)step + 1);
    *steps_used() += step < *steps_used() && *steps_used() < STEPS_MOST ? 1 : 0;
    edit_ends();
    editor.message = ANY;
}

static void run_delete(void)
{
    const int used = *steps_used();
    editor.message = ANY;
    if (used == 0 || (editor.words > 1 && editor.number[1] >= used)) {
        return;   /* it says so */
    }
    edit_begins();
    for (int each = editor.words > 1 ? editor.number[1] : STEPS_MOST; each < STEP_LAST; each++) {
        copy_step((unsigned)each + 1, &editor.now, (unsigned)each + 2);
    }
    *steps_used() = used - 1;
    edit_ends();
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
    edit_begins();
    copy_step(to, &editor.now, from);
    edit_ends();
}

static void run_swap(void)
{
    const unsigned a = (unsigned)editor.number[1] + 1, b = (unsigned)editor.number[2] + 1;
    if (a >= TABLE_STEPS || b >= TABLE_STEPS) {
        lose();
        return;
    }
    edit_begins();
    copy_step(a, &old, b);
    copy_step(b, &old, a);
    edit_ends();
}

/* The nearest whole number; between two of them nobody has said which. */
static int nearest(double number)
{
    const double part = number - floor(number);
    return fabs(part - 0.5) < 0.01 ? UNKNOWN : (int)floor(number + 0.5);
}

/* A new step between two that follow each other, at so many percent of the way and of the time. */
static void run_int(void)
{
    const int a = editor.number[1], b = editor.number[2], percent = editor.words > 3 ? editor.number[3] : 50;
    editor.message = ANY;
    if (b != a + 1 || b >= *steps_used() || *steps_used() >= STEPS_MOST || editor.now.is_time != 1 || percent == 0 ||
        percent == 100) {
        forget_page();
        return;
    }
    edit_begins();
    for (int each = STEP_LAST; each > b; each--) {
        copy_step((unsigned)each + 1, &editor.now, (unsigned)each);
    }
    for (unsigned id = 0; id < JOINTS; id++) {
        const int from = old.cell[a + 1][id], to = old.cell[b + 1][id];
        editor.now.cell[b + 1][id] = from >= 0 && to >= 0 ? nearest(from + (to - from) * percent / 100.0) : UNKNOWN;
    }
    editor.now.cell[b + 1][ROW_PAUSE] = UNKNOWN;
    const int time = old.cell[b + 1][ROW_TIME], part = time < 0 ? UNKNOWN : nearest(time * percent / 100.0);
    editor.now.cell[b + 1][ROW_TIME] = part > 0 ? part : UNKNOWN;
    editor.now.cell[b + 2][ROW_TIME] = part > 0 && time > part ? time - part : UNKNOWN;
    *steps_used() += 1;
    edit_ends();
}

static void run_scale(void)
{
    edit_begins();
    for (int column = 1; column < (int)TABLE_STEPS; column++) {
        for (unsigned row = ROW_PAUSE; row < TABLE_ROWS; row++) {
            const int is = editor.now.cell[column][row], scaled = nearest(is * editor.number[1] / 100.0);
            const bool is_sure = is >= 0 && column <= *steps_used() && scaled > 0 && scaled < 256 && editor.now.is_time == 1;
            editor.now.cell[column][row] = is_sure ? scaled : UNKNOWN;
        }
    }
    editor.can_undo = editor.can_redo = false;
    editor.message = ANY;
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
    edit_begins();
    for (int each = 0; each < editor.noted_count; each++) {
        copy_step((unsigned)(at + each) + 1, &editor.noted, (unsigned)(editor.noted_first + each) + 1);
    }
    *steps_used() = used > end ? used : end;
    edit_ends();
}

/* About 512, in pairs 1-2 .. 17-18. */
static void run_mirror(void)
{
    const unsigned column = (unsigned)editor.number[1] + 1;
    editor.message = ANY;
    editor.now.go_step = UNKNOWN;
    editor.now.cell[0][ROW_PAUSE] = editor.now.cell[0][ROW_TIME] = UNKNOWN;
    for (unsigned id = 0; id < JOINTS; id++) {
        const unsigned partner = id % 2 == 1 ? id + 1 : id - 1;
        const int of = id >= 1 && id <= PAIRED ? editor.now.cell[column][partner] : UNKNOWN;
        if (is_there(id)) {
            editor.now.cell[0][id] = of < 0 || editor.has_pairs ? UNKNOWN : 1024 - of > 1023 ? 1023 : 1024 - of;
            editor.torque[id] = of < 0 || editor.has_pairs ? UNKNOWN : 1;
        } else {
            editor.now.cell[0][id] = UNKNOWN;
        }
    }
}

/* What the cell under the cursor takes; -1: it is not there. */
static int most_of_cell(void)
{
    const unsigned x = editor.now.x, y = editor.now.y;
    return x < 8 && y < ROW_PAUSE ? 1023 : x == 9 && y - 3 == FIELD_STEPS ? STEPS_MOST : 255;
}

static int *cell(void)
{
    const unsigned x = editor.now.x, y = editor.now.y;
    return x < 8 ? &editor.now.cell[x][y] : x == 8 ? &editor.now.softness[y] : &editor.now.field[y - 3];
}

static void put(int value)
{
    const unsigned x = editor.now.x, y = editor.now.y;
    if (x == 0 && y < ROW_PAUSE) {
        editor.now.cell[0][y] = value;
        editor.torque[y] = is_there(y) ? 1 : UNKNOWN;
        return;
    }
    edit_begins();
    *cell() = value;
    edit_ends();
    if (x == 9 && y - 3 == FIELD_SCHEDULE) {
        lose();
    }
}

static void run_set(void)
{
    if (!editor.has_cursor) {
        lose();
    } else if (editor.number[1] > most_of_cell()) {
        editor.message = BAD_RANGE;
    } else {
        editor.message = ANY;   /* a servo that is not there */
        put(editor.number[1]);
    }
}

/* A low terminal leaves rows out, which the cursor passes over. */
static bool has_all_rows(void)
{
    bool has_all = true;
    for (unsigned id = 0; id < JOINTS; id++) {
        has_all = has_all && editor.now.softness[id] != UNKNOWN;
    }
    return has_all;
}

static bool is_cell(int x, int y)
{
    return x >= 0 && y >= 0 && x <= 9 && y <= 32 && (x < 8 || (x == 8 && y <= 30) || (x == 9 && y >= 3 && y <= 19));
}

static void run_goto(void)
{
    editor.message = ANY;
    editor.has_cursor = editor.has_cursor && is_cell(editor.number[1], editor.number[2]) && has_all_rows();
    editor.now.x = (unsigned)editor.number[1];
    editor.now.y = (unsigned)editor.number[2];
}

static void run_schedule(void)
{
    edit_begins();
    editor.now.is_time = editor.word[0][0] == 't' || editor.word[0][0] == 'T';
    if (editor.now.field[FIELD_SCHEDULE] != UNKNOWN) {
        editor.now.field[FIELD_SCHEDULE] = editor.now.is_time ? 10 : 0;
    }
    edit_ends();
}

static void exchange(bool can, table_t *to, table_t *other, bool *can_other)
{
    if (!can) {
        forget_page();
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

/* ON and OFF. Without IDs: all that are there. */
static void run_torque(void)
{
    const bool is_on = strcasecmp(editor.word[0], "on") == 0;
    editor.message = ANY;
    for (unsigned at = 1; at < editor.words; at++) {
        if (editor.number[at] == UNKNOWN || editor.number[at] >= (int)JOINTS || !is_there((unsigned)editor.number[at])) {
            lose();
            return;
        }
    }
    for (unsigned id = 0; id < JOINTS; id++) {
        bool is_meant = editor.words == 1;
        for (unsigned at = 1; at < editor.words; at++) {
            is_meant = is_meant || editor.number[at] == (int)id;
        }
        if (is_meant && !is_there(id)) {
            editor.now.cell[0][id] = UNKNOWN;
        } else if (is_meant) {
            editor.now.cell[0][id] = is_on ? UNKNOWN : OFF;
            editor.torque[id] = is_on;
        }
    }
}

/* Where a play ends: at the targets of the steps of the page and of those that follow it. */
static bool find_end(unsigned page)
{
    table_t of = editor.now;
    const table_t start = editor.now;
    for (unsigned id = 0; id < JOINTS; id++) {
        editor.played[id] = UNKNOWN;
    }
    for (unsigned links = 0; page != 0; links++) {
        if (links == LINKS_MOST || (page != (unsigned)editor.now.page && !is_whole(page))) {
            return false;
        }
        if (page == (unsigned)editor.now.page) {
            of = editor.now;
        } else {
            table_load(&of, page);
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
    editor.is_play = page > 0 && page < (int)PAGES && find_end((unsigned)page);
    editor.mode = UNSURE;
    editor.message = ANY;
    for (unsigned id = 0; id < JOINTS; id++) {
        editor.now.cell[0][id] = editor.torque[id] = UNKNOWN;
    }
    editor.can_undo = editor.can_redo = false;
}

static void run_view(void)
{
    editor.mode = UNSURE;
    editor.is_view = true;
    editor.message = ANY;
}

static void run_rows(void)
{
    run_view();
    editor.has_cursor = false;
}

static void run_repaint(void)
{
    editor.message = ANY;
    if (editor.word[0][0] != 'r') {
        editor.now.is_hex = editor.word[0][0] == 'h';
    }
}

static void run_pairs(void)
{
    editor.has_pairs = editor.has_pairs || editor.words > 1;
    editor.message = ANY;
}

static void run_unsure(void)
{
    lose();
}

/* The words, how many follow them, and the range of each number that does. */
static const struct {
    const char *word, *other;
    unsigned fewest, most;
    int high;                      /* of every number; ANY_NUMBER: it is no number, or its range is not known */
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
    {"swap", NULL, 2, 2, 7, run_swap},         {"int", NULL, 2, 3, ANY_NUMBER, run_int},
    {"scale", NULL, 1, 1, ANY_NUMBER, run_scale}, {"take", NULL, 1, 2, 6, run_take},
    {"paste", NULL, 0, 1, 6, run_paste},       {"mirror", "m", 1, 1, 6, run_mirror},
    {"pairs", NULL, 0, 2, ANY_NUMBER, run_pairs}, {"set", NULL, 1, 1, 1023, run_set},
    {"goto", NULL, 2, 2, 32, run_goto},        {"on", NULL, 0, WORDS, ANY_NUMBER, run_torque},
    {"off", NULL, 0, WORDS, ANY_NUMBER, run_torque}, {"play", NULL, 0, 2, ANY_NUMBER, run_play},
    {"time", NULL, 0, 0, 0, run_schedule},     {"speed", NULL, 0, 0, 0, run_schedule},
    {"undo", "u", 0, 0, 0, run_undo},          {"redo", NULL, 0, 0, 0, run_redo},
    {"list", NULL, 0, 2, ANY_NUMBER, run_view}, {"find", NULL, 1, WORDS, ANY_NUMBER, run_view},
    {"check", NULL, 0, 1, ANY_NUMBER, run_view}, {"re", NULL, 0, 0, 0, run_repaint},
    {"rows", NULL, 1, 1, ANY_NUMBER, run_rows}, {"hex", NULL, 0, 0, 0, run_repaint},
    {"dec", NULL, 0, 0, 0, run_repaint},       {"monitor", "mon", 0, 0, 0, run_view},
    {"help", "?", 0, 1, ANY_NUMBER, run_view}, {"toss", NULL, 0, WORDS, ANY_NUMBER, run_view},
};

/* ---- lines ---- */

static int number_of(const char *word)
{
    char *end;
    const bool is_hex = strncasecmp(word, "0x", 2) == 0;
    const long number = strtol(word, &end, is_hex || editor.now.is_hex ? 16 : 10);
    return end != word && *end == '\0' && number >= 0 && number < 65536 ? (int)number : UNKNOWN;
}

static void split(void)
{
    static char copy[LINE_BYTES];
    memcpy(copy, editor.line, sizeof copy);
    editor.words = 0;
    for (char *word = strtok(copy, " ,.:;"); word != NULL && editor.words < WORDS; word = strtok(NULL, " ,.:;")) {
        editor.word[editor.words] = word;
        editor.number[editor.words++] = number_of(word);
    }
}

static void run_command(void)
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

static void line_ends(void)
{
    editor.line[editor.count] = '\0';
    editor.mode = TABLE;
    editor.is_view = editor.is_request = false;
    editor.line_tick = session.tick;
    editor.lines++;
    if (editor.is_known && editor.line[0] == '@') {
        static const char *const asks[] = {"@where", "@pose", "@ver", "@list", "@page", "@dense", "@crcs"};
        bool is_asking = false;
        for (unsigned i = 0; i < sizeof asks / sizeof asks[0]; i++) {
            is_asking = is_asking || strncmp(editor.line, asks[i], strlen(asks[i])) == 0;
        }
        if (is_asking) {
            run_view();
            editor.is_request = true;
        } else {
            lose();
        }
        return;
    }
    split();
    editor.is_repainted = editor.is_repainted && editor.words == 1 && strcasecmp(editor.word[0], "re") == 0;
    if (!editor.is_known) {
        lose();
    } else if (editor.words > 0) {
        run_command();
    } else {
        editor.message = ANY;
    }
}

static void line_key(uint8_t key)
{
    if (key == '\r') {
        line_ends();
    } else if (key == '\b' || key == 0x7F) {
        editor.count -= editor.count > 0 ? 1 : 0;
    } else if (key == 0x15) {
        editor.count = 0;
    } else if (key >= ' ' && key < 0x7F && editor.count < LONG_LINE) {
        editor.line[editor.count++] = (char)key;
    } else {
        lose();
    }
}

/* ---- keys ---- */

static void add(int much)
{
    const unsigned x = editor.now.x, y = editor.now.y;
    if (!editor.has_cursor) {
        lose();
        return;
    }
    const int is = *cell();
    if (is < 0 || (x == 0 && y < ROW_PAUSE && !is_there(y))) {
        if (is == UNKNOWN) {
            lose();
        }
        return;
    }
    const bool is_position = x < 8 && y < ROW_PAUSE, is_steps = x == 9 && y - 3 == FIELD_STEPS;
    int to = is + much;
    if (is_position || is_steps) {
        const int most = is_steps ? STEPS_MOST : 1023;
        if (is_steps && abs(much) > 1 && (to < 0 || to > most)) {
            lose();
            return;
        }
        to = to < 0 || to > most ? is : to;
    } else {
        to = to & 255;
    }
    const bool was_key = editor.is_key_edit;
    put(to);
    if (x > 0 || y >= ROW_PAUSE) {
        editor.can_undo = editor.can_undo && !was_key;
        editor.is_key_edit = true;
    }
}

static void mark_off(void)
{
    const unsigned x = editor.now.x, y = editor.now.y;
    if (!editor.has_cursor || x == 0) {
        lose();
    } else if (x < 8 && y < ROW_PAUSE) {
        edit_begins();
        *cell() = *cell() >= 0 || *cell() == NO_VALUE ? OFF : UNKNOWN;
        edit_ends();
        editor.can_undo = false;
    }
}

static void put_cursor(int x, int y)
{
    y = y < 0 ? 0 : y > 32 ? 32 : y;
    x = x < 0 ? 0 : x;
    while (!is_cell(x, y)) {
        x--;
    }
    editor.now.x = (unsigned)x;
    editor.now.y = (unsigned)y;
}

static void escape_ends(void)
{
    const int x = (int)editor.now.x, y = (int)editor.now.y;
    const char *sequence = editor.sequence;
    editor.has_cursor = editor.has_cursor && has_all_rows();
    if (strcmp(sequence, "A") == 0) {
        put_cursor(x, y - 1);
    } else if (strcmp(sequence, "B") == 0) {
        put_cursor(x, y + 1);
    } else if (strcmp(sequence, "C") == 0) {
        put_cursor(x + 1, y);
    } else if (strcmp(sequence, "D") == 0) {
        put_cursor(x - 1, y);
    } else if (strcmp(sequence, "H") == 0) {
        put_cursor(0, y);
    } else if (strcmp(sequence, "F") == 0) {
        put_cursor(9, y);
    } else if (strcmp(sequence, "5~") == 0) {
        put_cursor(x, y - 8);
    } else if (strcmp(sequence, "6~") == 0) {
        put_cursor(x, y + 8);
    }
    editor.mode = TABLE;
}

static void escape_key(uint8_t key)
{
    if (editor.sequence_count == 0 && key == '[') {
        editor.sequence_count = 1;
        return;
    }
    const unsigned at = editor.sequence_count - 1;
    if (editor.sequence_count == 0 || at + 1 >= sizeof editor.sequence || key < ' ' || key > '~') {
        lose();
        return;
    }
    editor.sequence[at] = (char)key;
    editor.sequence[at + 1] = '\0';
    editor.sequence_count++;
    if (key >= '@') {
        escape_ends();
    }
}

static void table_key(uint8_t key)
{
    editor.is_repainted = editor.is_repainted && key >= '0' && key != '[' && key != ']' && key < '{';
    if (key == 0x1B) {
        editor.mode = ESCAPE;
        editor.sequence_count = 0;
    } else if (key == ']' || key == '[') {
        add(key == ']' ? 1 : -1);
    } else if (key == '}' || key == '{') {
        add(key == '}' ? 10 : -10);
    } else if (key == ' ') {
        mark_off();
    } else if (key == '\r') {
        editor.mode = LINE;
        editor.count = 0;
    } else if (key >= '0' && key <= 'z') {
        editor.mode = LINE;
        editor.line[0] = (char)key;
        editor.count = 1;
    } else if (key == '@') {
        editor.mode = LINE;
        editor.line[0] = (char)key;
        editor.count = 1;
    } else {
        lose();
    }
}

static void answer_key(uint8_t key)
{
    const bool is_yes = key == 'y' || key == 'Y', is_no = key == 'n' || key == 'N';
    if (session.tick - editor.line_tick < LATER || (!is_yes && !is_no)) {
        lose();
        return;
    }
    editor.mode = TABLE;
    editor.is_repainted = false;
    if (is_yes) {
        editor.if_yes();
    }
}

/* The program has read a key. */
void editor_typed(uint8_t key)
{
    editor.key = key;
    editor.is_repainted = editor.is_repainted && (editor.mode == TABLE || editor.mode == LINE);
    if (editor.mode == TABLE) {
        table_key(key);
    } else if (editor.mode == ESCAPE) {
        escape_key(key);
    } else if (editor.mode == LINE) {
        line_key(key);
    } else if (editor.mode == QUESTION) {
        answer_key(key);
    } else if (editor.mode == UNSURE && !(editor.is_view && (key == '\r' || (key == ' ' && !editor.is_request)))) {
        lose();
    }
}

/* ---- what is seen ---- */

static void look_at_flash(const table_t *shown)
{
    if (shown->page != UNKNOWN && shown->address != UNKNOWN && shown->page != shown->address / (int)PAGE_BYTES % 256) {
        session_fail("the number of the page and its address belong together", "page %d, %x", shown->page,
                     (unsigned)shown->address);
    }
    if (!shown->is_saved || shown->page <= 0 || !is_whole((unsigned)shown->page)) {
        return;
    }
    table_t stored = *shown;
    table_load(&stored, (unsigned)shown->page);
    reached("table of Edit as flash holds it");
    table_compare("without `* unsaved` the table shows what flash holds", shown, &stored);
}

/* A line has been typed, perhaps by somebody of whom the model knows nothing. */
void editor_line(const char *line)
{
    if (strchr(line, '@') != NULL) {
        screen_put_away();
    }
    editor.is_pose_copied = editor.is_pose_copied || strcasestr(line, "move") != NULL;   /* no servo is told of a copy */
    editor.is_play_line = strcasestr(line, "play") != NULL;
}

/* The work pose is what the servos hold. */
static void look_at_servos(const table_t *shown)
{
    const uint32_t since = session.tick - AT_REST;
    if (editor.is_pose_copied || session.tick < AT_REST || session.goals_tick > since || session.pushed_tick > since ||
        session.boot_tick > since) {
        return;
    }
    for (unsigned id = 0; id < JOINTS; id++) {
        const int is = shown->cell[0][id];
        if (!is_there(id) || is == UNKNOWN) {
            continue;
        }
        const servo_t *servo = session.joint[id].servo;
        const bool has_torque = servo->table[TORQUE_AT] != 0;
        const int goal = servo->table[GOAL_AT] | servo->table[GOAL_AT + 1] << 8;
        if (is == NO_VALUE || (is == OFF) == has_torque || (is >= 0 && is != goal)) {
            session_fail("Edit's work pose is what the servos hold", "servo %u: torque %d, goal %d, shown is %d", id,
                         has_torque, goal, is);
        }
        if (editor.torque[id] != UNKNOWN && (editor.torque[id] != 0) != has_torque) {
            session_fail("servos hold or not as Edit was asked", "servo %u: torque %d", id, has_torque);
        }
        if (!has_torque && (shown->live[id] == UNKNOWN || fabs(shown->live[id] - servo->position) > 3)) {
            session_fail("a joint without torque shows where it is", "servo %u at %.0f, shown is %d", id, servo->position,
                         shown->live[id]);
        }
        reached(has_torque ? "work pose of Edit as servos hold it" : "live position in Edit");
    }
}

/* What stands behind the line. */
static void look_at_message(const table_t *shown)
{
    const size_t length = strlen(editor.line);
    const char *said = shown->command + 2 + length;
    static const char *const must[] = {"", "", " Bad Command", " Invalid Parameter", " must be "};
    if (editor.lines != 1 || editor.mode != TABLE || length > LONG_LINE || editor.message == ANY) {
        return;
    }
    bool is_right = strncmp(shown->command, "] ", 2) == 0 && strncmp(shown->command + 2, editor.line, length) == 0;
    if (editor.message == GOOD) {
        for (unsigned i = BAD_COMMAND; i <= BAD_RANGE; i++) {
            is_right = is_right && strstr(said, must[i]) == NULL;
        }
    } else {
        is_right = is_right && strstr(said, must[editor.message]) != NULL;
        reached("line refused by Edit");
    }
    if (!is_right) {
        session_fail("Edit answers a line as its pages say", "\"%s\": \"%.80s\", it should end in \"%s\"", editor.line,
                     shown->command, must[editor.message]);
    }
}

static void look_at_save(const table_t *shown)
{
    if (editor.saved_as < 1 || editor.lines != 1 || strstr(shown->command, "OK") == NULL) {
        return;
    }
    table_t stored = editor.now;
    table_load(&stored, (unsigned)editor.saved_as);
    for (unsigned column = 1; column < TABLE_STEPS; column++) {
        for (unsigned id = 0; id < JOINTS; id++) {
            int *is = &editor.now.cell[column][id];
            *is = *is == OFF ? UNKNOWN : *is;   /* it is saved as not used */
        }
    }
    stored.page = editor.now.page;
    reached("page saved as Edit shows it");
    table_compare("SAVE stores what the table shows", &stored, &editor.now);
}

static void look_at_play(const table_t *shown)
{
    const char *row = shown->command, *ok = strstr(row, " OK");
    if (!editor.is_play || strncmp(row, "] Page ", 7) != 0 || ok == NULL) {
        return;
    }
    editor.is_play = false;
    for (unsigned id = 0; id < JOINTS; id++) {
        if (is_there(id) && editor.played[id] != UNKNOWN && shown->cell[0][id] != editor.played[id]) {
            session_fail("a play in Edit ends in the pose of its page", "servo %u at %d, %d is right", id,
                         shown->cell[0][id], editor.played[id]);
        }
    }
    reached("play in Edit ended where its page says");
}

static void look_at_repaint(void)
{
    editor.is_repainted = editor.is_repainted && session.pushed_tick < editor.kept_tick;
    for (unsigned row = 0; row < TABLE_LOWEST && editor.is_repainted; row++) {
        if (strncmp(screen_row(row), "] ", 2) != 0 && strcmp(editor.kept[row], screen_row(row)) != 0) {
            session_fail("RE draws the screen that was there", "row %u: \"%s\", before it was \"%s\"", row + 1,
                         screen_row(row), editor.kept[row]);
        }
    }
    if (editor.is_repainted && editor.lines > 0) {
        reached("screen drawn again");
    }
    for (unsigned row = 0; row < TABLE_LOWEST; row++) {
        memcpy(editor.kept[row], screen_row(row), SCREEN_COLUMNS + 1);
    }
    editor.is_repainted = true;
    editor.kept_tick = session.tick;
}

static void look_at_model(const table_t *shown)
{
    look_at_save(shown);
    if (editor.saved_as == UNKNOWN) {
        table_compare("lines and keys do to Edit's table what its pages say", shown, &editor.now);
        if (editor.has_cursor && (shown->x != editor.now.x || shown->y != editor.now.y)) {
            session_fail("the cursor of Edit goes where its pages say", "X%u Y%u, and X%u Y%u is right", shown->x, shown->y,
                         editor.now.x, editor.now.y);
        }
        reached("table of Edit after lines and keys");
    }
    look_at_message(shown);
    if (shown->is_saved && differs_from_flash()) {
        session_fail("`* unsaved` is there while the page differs from flash", "page %d", shown->page);
    }
}

static void look(void)
{
    table_t shown;
    if (!screen_read(&shown)) {
        editor.is_repainted = false;
        return;
    }
    const char *row = shown.command;
    const bool is_asking = strstr(row, "[y/N]") != NULL || strstr(row, "name:") != NULL || strncmp(row, "] Page ", 7) == 0;
    const bool is_over = strncmp(row, "] ", 2) == 0 && row[2] != ' ' && row[2] != '_' && 
                         (strstr(row, " OK") != NULL || (!is_asking && !editor.is_play_line));
    look_at_flash(&shown);
    look_at_servos(&shown);
    look_at_play(&shown);
    if (editor.is_known && editor.now.page > 0 && !editor.is_play) {
        look_at_model(&shown);
    }
    if ((editor.mode == UNSURE || editor.mode == LOST) && is_over && editor.key == '\r') {
        editor.mode = TABLE;
    }
    editor.is_known = editor.mode != LOST && shown.page > 0;
    editor.now = shown;
    editor.has_cursor = true;
    editor.saved_as = UNKNOWN;
    look_at_repaint();
    editor.lines = 0;
}

void editor_tick(void)
{
    const uint32_t last = session.typed_tick > session.printed_tick ? session.typed_tick : session.printed_tick;
    if (!session.is_edit || last == editor.look_tick || session.tick - last <= QUIET || !simtime_has_typed()) {
        return;
    }
    editor.look_tick = last;
    if (rules_is_well()) {
        look();
    } else {
        lose();
    }
}

void editor_boot(void)
{
    lose();
    editor.is_pose_copied = false;
    editor.lines = 0;
    editor.look_tick = NEVER_TICK;
}
