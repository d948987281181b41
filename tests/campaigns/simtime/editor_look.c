/* SPDX-License-Identifier: MIT
 * editor_look.c - compares the model of Edit with its screen; see editor.h. */
#include "editor.h"

#include <math.h>
#include <string.h>

#define QUIET 96u                  /* ticks without a key and without output: everything is painted */
#define READ_BY 16u                /* ticks: a pushed joint is shown so much later */
#define SLOWER 100u                 /* half microseconds of latency per additional tick: all servos are asked twice */
#define AT_REST (3u * SECOND)      /* a joint has arrived this long after its last goal */

static void look_at_flash(const table_t *shown)
{
    if (shown->page != UNKNOWN && shown->address != UNKNOWN && shown->page != shown->address / (int)PAGE_BYTES % 256) {
        session_fail("the number of the page and its address belong together", "page %d, %x", shown->page,
                     (unsigned)shown->address);
    }
    if (!shown->is_saved || shown->page <= 0 || !editor_is_whole((unsigned)shown->page)) {
        return;
    }
    table_t stored = *shown;
    table_load(&stored, (unsigned)shown->page);
    reached("table of Edit as flash holds it");
    table_compare("without `* unsaved` the table shows what flash holds", shown, &stored);
}

/* Page 0 has positions: goals include the robot's trim. */
static bool has_trim(void)
{
    for (unsigned id = 0; id < JOINTS; id++) {
        if (trim_of(id) != 0) {
            return true;
        }
    }
    return false;
}

/* The work pose must be what the servos hold. */
static void look_at_servos(const table_t *shown)
{
    const uint32_t since = session.tick - AT_REST;
    const bool is_vague = editor.is_pose_copied || session.trouble_tick > session.boot_tick || has_trim();
    if (is_vague || session.tick < AT_REST || session.goals_tick > since || session.pushed_tick > since ||
        session.boot_tick > since) {
        return;
    }
    for (unsigned id = 0; id < JOINTS; id++) {
        const int is = shown->cell[0][id];
        if (!editor_is_there(id) || is == UNKNOWN || session.joint[id].fault_tick > session.boot_tick) {
            continue;   /* a failed servo may not have received everything */
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

/* Checks the message after the line. */
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
            *is = *is == OFF ? UNKNOWN : *is;   /* it is saved as unused */
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
        if (editor_is_there(id) && editor.played[id] != UNKNOWN && !session.has_deaf &&
            shown->cell[0][id] != editor.played[id]) {
            session_fail("a play in Edit ends in the pose of its page", "servo %u at %d, %d is right", id,
                         shown->cell[0][id], editor.played[id]);
        }
    }
    reached("play in Edit ended where its page says");
}

static void look_at_repaint(void)
{
    editor.is_repainted = editor.is_repainted && session.pushed_tick + READ_BY < editor.kept_tick;
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
    if (editor.saved_as == UNKNOWN && shown->is_saved && editor_differs_from_flash()) {
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
    if (editor.is_known && editor.now.page > 0 && !editor.is_play) {
        editor_undo_look(&shown);
    } else {
        editor_undo_lose();
    }
    if ((editor.mode == UNSURE || editor.mode == LOST) && is_over && editor.key == '\r') {
        editor.mode = TABLE;
    }
    editor.is_known = editor.mode != LOST && shown.page > 0;
    editor.now = shown;
    editor.has_cursor = true;
    editor.saved_as = UNKNOWN;
    editor.is_edited = editor.is_unsure = false;
    look_at_repaint();
    editor.lines = 0;
}

void editor_tick(void)
{
    const uint32_t last = session.typed_tick > session.printed_tick ? session.typed_tick : session.printed_tick;
    const bool is_quiet = session.tick - last > QUIET + session.latency / SLOWER && simtime_has_typed();
    if (!session.is_edit || last == editor.look_tick || !is_quiet) {
        return;
    }
    editor.look_tick = last;
    if (rules_is_well()) {
        look();
    } else {
        editor_lose();
    }
}
