/* SPDX-License-Identifier: MIT
 * cmd_cell.c - the cell under the cursor (editor-original.md section 4), and how the table is shown. */
#include "commands.h"
#include "pgm.h"
#include "text.h"

/* ---- SET ---- */

static const char *value_name_P(cell_kind_t kind, uint16_t max)
{
    if (kind == CELL_POSITION) {
        return TEXT_P("Position");
    }
    return max == PAGE_STEPS ? TEXT_P("Page Step") : max == UINT8_MAX ? TEXT_P("Value") : TEXT_P("Link");
}

/* An edit of one cell. Page 0: the trim follows. */
static void set_cell(editor_t *editor, cell_kind_t kind, uint16_t word)
{
    session_t *session = &editor->session;
    uint16_t address = cell_address(session->x, session->y);
    if (kind == CELL_BYTE) {
        session_set_byte(session, address, (uint8_t)word);
        return;
    }
    session_set_word(session, address, word);
    if (session->page == 0 && session->x >= CELL_X_STEP0 && session->x < CELL_X_OFFSET) {
        session_update_trim(session, session->y);
    }
}

COMMAND(cmd_set)
{
    editor_t *editor = context;
    session_t *session = &editor->session;
    cell_kind_t kind = cell_kind(session->page, session->x, session->y);
    uint16_t max = cell_max(kind, session->x, session->y), value;
    if (kind == CELL_OFFSET) {
        TEXT("Computed");
        return SHELL_ERR_SAID;
    }
    if (!shell_number(args, 1, value_name_P(kind, max), 0, max, &value)) {
        return SHELL_ERR_SAID;
    }
    if (session->x == CELL_X_POSE && kind == CELL_POSITION) {
        if (performer_is_idle(editor->performer)) {
            robot_move(&editor->robot, session->y, value);
        }
        return SHELL_OK;
    }
    session_begin(session);
    set_cell(editor, kind, value);
    return editor_edited(editor);
}

/* ---- keys ---- */

static void change_byte_cell(editor_t *editor, int8_t change)
{
    session_t *session = &editor->session;
    uint16_t address = cell_address(session->x, session->y);
    int16_t max = (int16_t)cell_max(CELL_BYTE, session->x, session->y);
    int16_t value = (int16_t)(session->cells[address] + change);
    if (max == (int16_t)PAGE_STEPS) {
        value = value < 0 ? 0 : value > max ? max : value;
    } else if (value < 0) {
        value = (int16_t)(value + max + 1);
    } else if (value > max) {
        value = (int16_t)(value - max - 1);
    }
    set_cell(editor, CELL_BYTE, (uint16_t)value & UINT8_MAX);
}

/* A step that would leave 0..1023 is not done at all; ---- and ???? stay. */
static bool changed_word(uint16_t word, int8_t change, uint16_t *result)
{
    int16_t value = (int16_t)((int16_t)word + change);
    if (!cell_is_position(word) || value < 0 || value > (int16_t)PAGE_POS_MAX) {
        return false;
    }
    *result = (uint16_t)value;
    return true;
}

static void change_pose(editor_t *editor, int8_t change)
{
    uint8_t joint = editor->session.y;
    uint16_t pos;
    if (robot_has(&editor->robot, joint) && performer_is_idle(editor->performer) &&
        changed_word(session_pose(&editor->session, joint), change, &pos)) {
        robot_move(&editor->robot, joint, pos);
    }
}

void cmd_cell_change(editor_t *editor, int8_t change)
{
    session_t *session = &editor->session;
    cell_kind_t kind = cell_kind(session->page, session->x, session->y);
    uint16_t address = cell_address(session->x, session->y), word;
    if (kind == CELL_POSITION && session->x == CELL_X_POSE) {
        change_pose(editor, change);
        return;
    }
    session_begin(session);
    if (kind == CELL_BYTE) {
        change_byte_cell(editor, change);
    } else if (kind == CELL_POSITION && changed_word(cell_word(session->cells, address), change, &word)) {
        set_cell(editor, CELL_POSITION, word);
    }
    (void)session_end(session);
}

static void toggle_pose(editor_t *editor)
{
    uint8_t joint = editor->session.y;
    uint16_t word = session_pose(&editor->session, joint);
    if (!robot_has(&editor->robot, joint)) {
        session_set_pose(&editor->session, joint, word ^ PAGE_POS_TORQUE_OFF);
    } else if (!performer_is_idle(editor->performer)) {
        return;
    } else if (cell_is_off(word)) {
        robot_on(&editor->robot, servo_link_bit(joint));
    } else {
        robot_off(&editor->robot, servo_link_bit(joint));
    }
}

void cmd_cell_space(editor_t *editor)
{
    session_t *session = &editor->session;
    if (cell_kind(session->page, session->x, session->y) != CELL_POSITION) {
        return;
    }
    if (session->x == CELL_X_POSE) {
        toggle_pose(editor);
        return;
    }
    uint16_t address = cell_address(session->x, session->y);
    session_begin(session);
    set_cell(editor, CELL_POSITION, cell_word(session->cells, address) ^ PAGE_POS_TORQUE_OFF);
    (void)session_end(session);
}

/* ---- cursor and display ---- */

COMMAND(cmd_goto)
{
    editor_t *editor = context;
    session_t *session = &editor->session;
    uint8_t x = (uint8_t)editor->number[0], y = (uint8_t)editor->number[1];
    (void)args;
    if (cell_kind(session->page, x, y) == CELL_NONE) {
        TEXT("There is no cell");
        return SHELL_ERR_SAID;
    }
    if (x != CELL_X_HEADER && !screen_has_row(&editor->screen, y)) {
        TEXT("That joint has no row");
        return SHELL_ERR_SAID;
    }
    session->x = x;
    session->y = y;
    return SHELL_OK;
}

static uint8_t set_schedule(editor_t *editor, uint8_t schedule)
{
    session_begin(&editor->session);
    session_set_byte(&editor->session, PAGE_AT_SCHEDULE, schedule);
    return editor_edited(editor);
}

COMMAND(cmd_time)
{
    (void)args;
    return set_schedule(context, PAGE_SCHEDULE_TIME);
}

COMMAND(cmd_speed)
{
    (void)args;
    return set_schedule(context, PAGE_SCHEDULE_SPEED);
}

COMMAND(cmd_hex)
{
    editor_t *editor = context;
    (void)args;
    editor->session.hex = true;
    return SHELL_OK;
}

COMMAND(cmd_dec)
{
    editor_t *editor = context;
    (void)args;
    editor->session.hex = false;
    return SHELL_OK;
}

COMMAND(cmd_re)
{
    editor_t *editor = context;
    (void)args;
    screen_redraw(&editor->screen);
    screen_ask_size(&editor->screen);
    return SHELL_OK;
}

COMMAND(cmd_rows)
{
    editor_t *editor = context;
    (void)args;
    screen_set_rows(&editor->screen, (uint8_t)editor->number[0]);
    return SHELL_OK;
}
