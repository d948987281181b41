/* SPDX-License-Identifier: MIT
 * cmd_shape.c - commands that the original lacked: interpolate a step, scale a page's time, copy steps between pages. */
#include "commands.h"
#include "page_edit.h"
#include "pgm.h"
#include "ranges_own.h"
#include "text.h"

#define LAST_STEP (PAGE_STEPS - 1u)
enum { PERCENT_DEFAULT = 50, PERCENT_WHOLE = 100 };

static void set_between(uint8_t a, uint8_t b, uint8_t to, uint8_t percent)
{
    for (uint8_t joint = 0; joint < PAGE_JOINTS; joint++) {
        uint16_t first = session_word(a, joint);
        uint16_t second = session_word(b, joint);
        bool both = cell_is_position(first) && cell_is_position(second);
        session_set_word((uint16_t)(session_step_at(to) + 2u * joint),
                         both ? page_edit_between(first, second, percent) : PAGE_POS_UNUSED);
    }
}

/* value * mul / div, rounded and limited to 1..255 (0 stays 0); sets *cut if limited. */
static uint8_t scaled(uint8_t value, uint16_t mul, uint16_t div, bool *cut)
{
    uint16_t result = page_edit_part(value, mul, div);
    uint16_t kept = result > UINT8_MAX ? UINT8_MAX : result == 0 && value != 0 ? 1u : result;
    *cut = *cut || kept != result;
    return (uint8_t)kept;
}

/* With times, the inserted step takes its share of the time of the next step, so that the page keeps its duration. With
 * speeds, or if step `b` is not the next one, it gets the value of `b`. */
static void share_time(uint8_t to, uint8_t b, uint8_t percent)
{
    uint16_t at = session_step_at(b) + PAGE_STEP_AT_SPEED;
    uint8_t time = the_session.cells[at];
    if (b == to + 1u && the_session.cells[PAGE_AT_SCHEDULE] == PAGE_SCHEDULE_TIME) {
        uint8_t rest = time;
        time = page_edit_time_split(&rest, percent);
        session_set_byte(at, rest);
    }
    session_set_byte(session_step_at(to) + PAGE_STEP_AT_SPEED, time);
}

COMMAND(cmd_int)
{
    uint8_t a = (uint8_t)args->number[0], b = (uint8_t)args->number[1], steps = the_session.cells[PAGE_AT_STEPS];
    uint16_t percent = PERCENT_DEFAULT;
    if (cmd_step_is_trim_page()) {
        return SHELL_ERR_REPORTED;
    }
    if (args->count > 3 && !shell_take(args, 3, RANGE_SHARE, &percent)) {
        return SHELL_ERR_RANGE;
    }
    if (steps >= PAGE_STEPS || a >= steps || b >= steps) {
        return dialog_refuse(steps >= PAGE_STEPS ? TEXT_P("All 7 steps are used") : TEXT_P("That step is not used"));
    }
    uint8_t to = a + 1u;
    session_begin_turn(UNDO_TURN(UNDO_TURN_UP, to, LAST_STEP));
    b = b >= to ? b + 1u : b;
    set_between(a, b, to, (uint8_t)percent);
    session_set_byte(session_step_at(to) + PAGE_STEP_AT_PAUSE, 0);
    share_time(to, b, (uint8_t)percent);
    session_set_byte(PAGE_AT_STEPS, steps + 1u);
    return dialog_edited();
}

COMMAND(cmd_scale)
{
    uint16_t percent = args->number[0];
    bool cut = false;
    bool is_time = the_session.cells[PAGE_AT_SCHEDULE] == PAGE_SCHEDULE_TIME;
    session_begin();
    for (uint8_t step = 0; step < session_steps(); step++) {
        uint16_t at = session_step_at(step) + PAGE_STEP_AT_PAUSE;
        session_set_byte(at, scaled(the_session.cells[at], percent, PERCENT_WHOLE, &cut));
        at++;
        session_set_byte(at, is_time ? scaled(the_session.cells[at], percent, PERCENT_WHOLE, &cut)
                                              : scaled(the_session.cells[at], PERCENT_WHOLE, percent, &cut));
    }
    if (cut) {
        TEXT("Some were cut to 1 or 255");
    }
    return dialog_edited();
}

/* ---- copying steps between pages ---- */

COMMAND(cmd_take)
{
    uint8_t first = (uint8_t)args->number[0];
    uint8_t last = args->count > 2 ? (uint8_t)args->number[1] : first;
    if (last < first) {
        return cmd_refuse_backwards();
    }
    the_dialog.take_page = the_session.page;
    the_dialog.take_first = first;
    the_dialog.take_count = (uint8_t)(last - first + 1u);
    TEXT("Noted for PASTE");
    if (the_session.is_changed) {
        TEXT(" (save it first)");
    }
    return SHELL_OK;
}

static void paste_step(uint8_t from, uint8_t to)
{
    uint8_t chunk[PAGE_STEP_BYTES];
    if (the_dialog.take_page == the_session.page) {
        memcpy(chunk, &the_session.cells[session_step_at(from)], PAGE_STEP_BYTES);
    } else {
        page_store_read(the_dialog.take_page, session_step_at(from), chunk, PAGE_STEP_BYTES);
    }
    session_set_bytes(session_step_at(to), chunk, PAGE_STEP_BYTES);
}

COMMAND(cmd_paste)
{
    uint8_t to = session_steps();
    if (cmd_step_is_trim_page()) {
        return SHELL_ERR_REPORTED;
    }
    uint8_t count = the_dialog.take_count;
    if (count == 0) {
        return dialog_refuse(TEXT_P("Nothing noted: TAKE first"));
    }
    if (args->count > 1) {
        to = (uint8_t)args->number[0];
    }
    if (to + count > PAGE_STEPS) {
        return dialog_refuse(TEXT_P("No room: 7 steps at most"));
    }
    session_begin();
    if (to + count > the_session.cells[PAGE_AT_STEPS]) {
        session_set_byte(PAGE_AT_STEPS, to + count);
    }
    /* Copies upwards or downwards, so that overlapping steps of a page are read before they are overwritten. */
    for (uint8_t i = 0; i < count; i++) {
        uint8_t k = to > the_dialog.take_first ? (uint8_t)(count - 1u - i) : i;
        paste_step(the_dialog.take_first + k, to + k);
    }
    return dialog_edited();
}
