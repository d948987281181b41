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

/* What is under the cursor. */
typedef struct {
    uint16_t address;
    uint8_t kind;    /* cell_kind_t */
    bool is_pose;    /* a joint of the work pose */
} here_t;

static here_t look_here(void)
{
    here_t here = { cell_address(the_session.x, the_session.y), (uint8_t)cell_kind(the_session.page, the_session.x, the_session.y), false };
    here.is_pose = here.kind == CELL_POSITION && the_session.x == CELL_X_POSE;
    return here;
}

/* An edit of one position. Page 0: the trim follows. */
static void set_position(uint16_t address, uint16_t word)
{
    session_begin();
    session_set_word(address, word);
    if (the_session.page == 0 && the_session.x >= CELL_X_STEP0 && the_session.x < CELL_X_OFFSET) {
        session_update_trim(the_session.y);
    }
}

static void set_byte(uint16_t address, uint8_t byte)
{
    session_begin();
    session_set_byte(address, byte);
}

COMMAND(cmd_set)
{
    here_t here = look_here();
    uint16_t max = cell_max((cell_kind_t)here.kind, the_session.x, the_session.y), value;
    if (here.kind == CELL_OFFSET) {
        TEXT("Computed");
        return SHELL_ERR_SAID;
    }
    if (!shell_number(args, 1, value_name_P((cell_kind_t)here.kind, max), 0, max, &value)) {
        return SHELL_ERR_SAID;
    }
    if (here.is_pose) {
        if (performer_is_idle(&the_performer)) {
            robot_move(the_session.y, value);
        }
        return SHELL_OK;
    }
    if (here.kind == CELL_BYTE) {
        set_byte(here.address, (uint8_t)value);
    } else {
        set_position(here.address, value);
    }
    return editor_edited();
}

/* ---- keys ---- */

/* Page Step stops at its ends, all others go round: their maximum is 127 or 255. */
static uint8_t changed_byte(uint16_t address, int8_t change)
{
    uint8_t max = (uint8_t)cell_max(CELL_BYTE, the_session.x, the_session.y);
    int16_t value = (int16_t)(the_session.cells[address] + change);
    if (max == PAGE_STEPS) {
        return value < 0 ? 0 : value > (int16_t)PAGE_STEPS ? (uint8_t)PAGE_STEPS : (uint8_t)value;
    }
    return (uint8_t)value & max;
}

/* ---- and ???? stay; a step that would leave 0..1023 is not done at all: 0xFFFF. */
static uint16_t changed_word(uint16_t word, int8_t change)
{
    uint16_t value = (uint16_t)(word + (uint16_t)change);
    return cell_is_position(word) && cell_is_position(value) ? value : UINT16_MAX;
}

void cmd_cell_change(int8_t change)
{
    here_t here = look_here();
    if (here.kind == CELL_BYTE) {
        set_byte(here.address, changed_byte(here.address, change));
        (void)session_end();
    }
    if (here.kind != CELL_POSITION) {
        return;
    }
    uint16_t pos = changed_word(cell_word(the_session.cells, here.address), change);
    if (pos == UINT16_MAX) {
        return;
    }
    if (!here.is_pose) {
        set_position(here.address, pos);
        (void)session_end();
    } else if (robot_has(the_session.y) && performer_is_idle(&the_performer)) {
        robot_move(the_session.y, pos);
    }
}

static void toggle_pose(void)
{
    uint8_t joint = the_session.y;
    uint16_t word = session_pose(joint);
    if (!robot_has(joint)) {
        session_set_pose(joint, word ^ PAGE_POS_TORQUE_OFF);
    } else if (!performer_is_idle(&the_performer)) {
        return;
    } else if (cell_is_off(word)) {
        robot_on(servo_link_bit(joint));
    } else {
        robot_off(servo_link_bit(joint));
    }
}

void cmd_cell_space(void)
{
    here_t here = look_here();
    if (here.is_pose) {
        toggle_pose();
    } else if (here.kind == CELL_POSITION) {
        set_position(here.address, cell_word(the_session.cells, here.address) ^ PAGE_POS_TORQUE_OFF);
        (void)session_end();
    }
}

/* ---- cursor and display ---- */

COMMAND(cmd_goto)
{
    uint8_t x = (uint8_t)args->number[0], y = (uint8_t)args->number[1];
    if (cell_kind(the_session.page, x, y) == CELL_NONE) {
        TEXT("There is no cell");
        return SHELL_ERR_SAID;
    }
    if (x != CELL_X_HEADER && !screen_has_row(y)) {
        TEXT("That joint has no row");
        return SHELL_ERR_SAID;
    }
    the_session.x = x;
    the_session.y = y;
    return SHELL_OK;
}

static uint8_t set_schedule(uint8_t schedule)
{
    session_begin();
    session_set_byte(PAGE_AT_SCHEDULE, schedule);
    return editor_edited();
}

COMMAND(cmd_time)
{
    (void)args;
    return set_schedule(PAGE_SCHEDULE_TIME);
}

COMMAND(cmd_speed)
{
    (void)args;
    return set_schedule(PAGE_SCHEDULE_SPEED);
}

COMMAND(cmd_hex)
{
    (void)args;
    the_session.hex = true;
    return SHELL_OK;
}

COMMAND(cmd_dec)
{
    (void)args;
    the_session.hex = false;
    return SHELL_OK;
}

COMMAND(cmd_re)
{
    (void)args;
    screen_redraw();
    screen_ask_size();
    return SHELL_OK;
}

COMMAND(cmd_rows)
{
    screen_set_rows((uint8_t)args->number[0]);
    return SHELL_OK;
}
