/* SPDX-License-Identifier: MIT
 * cmd_step.c - commands for whole steps: count, write, insert, delete, copy, swap, take, paste. */
#include "commands.h"

#include "crc16.h"
#include "pgm.h"
#include "report.h"
#include "text.h"

#define LAST_STEP (PAGE_STEPS - 1u)
#define POSE_STEP PAGE_STEPS       /* 7 in MOVE: the work pose */

/* For steps that are written in the same command, with their times. NOINLINE: saves 20 bytes of Edit. */
static NOINLINE void set_count(uint8_t steps)
{
    session_set_byte(PAGE_AT_STEPS, steps);
}

static uint8_t refuse_unused(void)
{
    return dialog_refuse(TEXT_P("That step is not used"));
}

static uint8_t refuse_full(void)
{
    return dialog_refuse(TEXT_P("No room: 7 steps at most"));
}

/* Byte `at` of a page: from RAM while it is open. */
static uint8_t byte_of(uint8_t page, uint16_t at)
{
    return page == the_session.page ? the_session.cells[at] : page_store_byte(page, at);
}

static void copy_step_of(uint8_t page, uint8_t from, uint8_t to)
{
    for (uint8_t i = 0; i < PAGE_STEP_BYTES; i++) {
        session_set_byte(session_step_at(to) + i, byte_of(page, session_step_at(from) + i));
    }
}

static void copy_step(uint8_t from, uint8_t to)
{
    copy_step_of(the_session.page, from, to);
}

bool cmd_step_is_trim(uint8_t step)
{
    const bool is_trim = the_session.page == 0 && step == CELL_X_OFFSET - CELL_X_STEP0;
    if (is_trim) {
        TEXT("That column is the trim");
    }
    return is_trim;
}

/* Refuses to shift or swap the steps of page 0: a pose in the trim's column would shift every goal. */
static bool is_trim_page(void)
{
    if (the_session.page == 0) {
        TEXT("Page 0 is the trim: its columns stay");
    }
    return the_session.page == 0;
}

/* Page 0: computes the trim from the master pose and this robot's pose. */
static void update_trim(uint8_t step)
{
    if (the_session.page != 0 || step > 1) {
        return;
    }
    for (uint8_t joint = 0; joint < PAGE_JOINTS; joint++) {
        session_update_trim(joint);
    }
    if (!the_session.is_begun) {
        the_screen.lead = true;
        TEXT("Offset Updated");
    }
}

/* Writes the work pose to a step. Joints without torque are written as ????, with a message, because it is rarely intended.
 * Absent joints become unused, unless SET or MOVE has put a position there. */
static void write_pose(uint8_t step)
{
    uint32_t off = 0;
    uint16_t at = session_step_at(step);
    for (uint8_t joint = 0; joint < PAGE_JOINTS; joint++, at += 2u) {
        uint16_t word = session_pose(joint);
        if (cell_is_off(word)) {
            if (robot_has(joint)) {
                servo_link_put(&off, joint, true);
            } else {
                word = PAGE_POS_UNUSED;
            }
        }
        session_set_word(at, word);
    }
    session_set_word(at, cell_word(the_session.cells, CELLS_POSE_AT + PAGE_STEP_AT_PAUSE));   /* pause and speed */
    the_robot.failed |= the_servos.silent;   /* their last known positions are written */
    if (off != 0) {
        the_screen.lead = true;
        TEXT("Off: ");
        report_joints(off);
    }
}

COMMAND(cmd_step)
{
    session_begin();
    session_set_steps((uint8_t)args->number[0]);
    return dialog_edited();
}

COMMAND(cmd_write)
{
    uint8_t step = the_session.cells[PAGE_AT_STEPS];
    if (args->count > 1) {
        step = (uint8_t)args->number[0];
    } else if (step >= PAGE_STEPS) {
        return refuse_full();
    }
    if (cmd_step_is_trim(step)) {
        return SHELL_ERR_REPORTED;
    }
    session_begin();
    if (args->count == 1) {
        set_count(step + 1u);
    }
    write_pose(step);
    update_trim(step);
    return dialog_edited();
}

COMMAND(cmd_insert)
{
    uint8_t step = (uint8_t)args->number[0];
    uint8_t steps = the_session.cells[PAGE_AT_STEPS];
    if (is_trim_page()) {
        return SHELL_ERR_REPORTED;
    }
    session_begin_turn(UNDO_TURN(UNDO_TURN_UP, step, LAST_STEP));
    if (step < steps && steps < PAGE_STEPS) {
        set_count(steps + 1u);
    }
    write_pose(step);
    if (steps >= PAGE_STEPS && !the_session.is_begun) {
        the_screen.lead = true;
        TEXT("Step 6 fell out: UNDO");
    }
    return dialog_edited();
}

/* The steps after it move down. The last step also keeps a copy in its old place (ORIGINAL.md section 6). */
static uint8_t delete_step(uint8_t step)
{
    uint8_t steps = the_session.cells[PAGE_AT_STEPS];
    if (step >= steps) {
        return refuse_unused();
    }
    session_begin_turn(UNDO_TURN(UNDO_TURN_DOWN, step, LAST_STEP));
    set_count((uint8_t)(steps - 1u));
    if (step < LAST_STEP) {
        copy_step(LAST_STEP - 1u, LAST_STEP);
    }
    return dialog_edited();
}

COMMAND(cmd_delete)
{
    if (is_trim_page()) {
        return SHELL_ERR_REPORTED;
    }
    if (args->count > 1) {
        return delete_step((uint8_t)args->number[0]);
    }
    uint8_t steps = the_session.cells[PAGE_AT_STEPS];
    if (steps == 0) {
        return dialog_refuse(TEXT_P("There is no step"));
    }
    session_begin();
    set_count((uint8_t)(steps - 1u));
    return dialog_edited();
}

static void print_pair(uint8_t from, uint8_t to)
{
    TEXT(":");
    text_padded(from, 3, '0');
    TEXT("->");
    text_padded(to, 3, '0');
}

COMMAND(cmd_move)
{
    uint8_t from = (uint8_t)args->number[0], to = (uint8_t)args->number[1];
    if (cmd_step_is_trim(to)) {
        return SHELL_ERR_REPORTED;
    }
    the_screen.lead = false;
    print_pair(from, to);
    if (to == POSE_STEP) {   /* no edit of the page */
        copy_step(from, to);
        TEXT(" (shown only)");
        session_mark_labels();
        return SHELL_OK;
    }
    session_begin();
    copy_step(from, to);
    update_trim(to);
    return dialog_edited();
}

COMMAND(cmd_swap)
{
    if (is_trim_page()) {
        return SHELL_ERR_REPORTED;
    }
    const uint8_t a = (uint8_t)args->number[0], b = (uint8_t)args->number[1], steps = the_session.cells[PAGE_AT_STEPS];
    if (a >= steps || b >= steps) {
        return refuse_unused();
    }
    session_begin_turn(UNDO_TURN(UNDO_TURN_SWAP, a, b));
    return dialog_edited();
}

/* ---- TAKE, PASTE ---- */

/* There is no room for a copy of the noted steps. Their CRC tells whether they are still the same. */
static uint16_t crc_of_noted(void)
{
    uint16_t crc = CRC16_START;
    const uint16_t end = session_step_at(the_dialog.take_first + the_dialog.take_count);
    for (uint16_t at = session_step_at(the_dialog.take_first); at != end; at++) {
        crc = crc16_byte(crc, byte_of(the_dialog.take_page, at));
    }
    return crc;
}

COMMAND(cmd_take)
{
    uint8_t first = (uint8_t)args->number[0];
    uint8_t last = args->count > 2 ? (uint8_t)args->number[1] : first;
    if (last < first) {
        return cmd_refuse_backwards();
    }
    if (last >= the_session.cells[PAGE_AT_STEPS]) {
        return refuse_unused();
    }
    the_dialog.take_page = the_session.page;
    the_dialog.take_first = first;
    the_dialog.take_count = (uint8_t)(last - first + 1u);
    the_dialog.take_crc = crc_of_noted();
    TEXT("Noted for PASTE");
    if (the_session.is_changed) {
        TEXT(" (save it first)");
    }
    return SHELL_OK;
}

COMMAND(cmd_paste)
{
    const uint8_t steps = session_steps();
    if (is_trim_page()) {
        return SHELL_ERR_REPORTED;
    }
    uint8_t count = the_dialog.take_count;
    if (the_dialog.take_crc != crc_of_noted()) {   /* also if nothing was ever noted */
        return dialog_refuse(TEXT_P("Nothing noted, or changed: TAKE first"));
    }
    const uint8_t to = args->count > 1 ? (uint8_t)args->number[0] : steps;
    const uint8_t end = (uint8_t)(to + count);
    if (end > PAGE_STEPS) {
        return refuse_full();
    }
    if (to > steps) {   /* the empty steps between would be played, too */
        return refuse_unused();
    }
    session_begin();
    if (end > steps) {
        set_count(end);
    }
    /* Copies upwards or downwards, so that overlapping steps of a page are read before they are overwritten. */
    for (uint8_t i = 0; i < count; i++) {
        uint8_t k = to > the_dialog.take_first ? (uint8_t)(count - 1u - i) : i;
        copy_step_of(the_dialog.take_page, the_dialog.take_first + k, to + k);
    }
    return dialog_edited();
}
