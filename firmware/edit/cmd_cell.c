/* SPDX-License-Identifier: MIT
 * cmd_cell.c - the cell under the cursor (ORIGINAL.md section 4), and the display of the table. */
#include "commands.h"
#include "pgm.h"
#include "ranges_own.h"
#include "text.h"

/* ---- SET ---- */

/* The range of the number that SET puts into a cell. */
static uint8_t value_range(uint8_t kind, uint16_t max)
{
    if (kind == CELL_POSITION) {
        return RANGE_POSITION;
    }
    return max == PAGE_STEPS ? RANGE_STEPS : max == UINT8_MAX ? RANGE_BYTE : RANGE_LINK;
}

/* The cell under the cursor. */
typedef struct {
    uint16_t address;
    uint16_t max;    /* highest value */
    uint8_t kind;    /* cell_kind_t */
    bool is_pose;    /* a joint of the work pose */
} here_t;

static here_t look_here(void)
{
    here_t here;
    cell_kind_t kind = cell_kind(the_session.page, the_session.x, the_session.y);
    here.address = cell_address(the_session.x, the_session.y);
    here.max = cell_max(kind, the_session.x, the_session.y);
    here.kind = kind;
    here.is_pose = kind == CELL_POSITION && the_session.x == CELL_X_POSE;
    return here;
}

/* Edits the cell. A joint of the work pose moves; on page 0 the trim is recomputed. */
static void put(const here_t *here, uint16_t value)
{
    if (here->is_pose) {
        robot_move(the_session.y, value);
        return;
    }
    session_begin();
    if (here->address == PAGE_AT_STEPS) {
        session_set_steps((uint8_t)value);
    }
    session_set_byte(here->address, (uint8_t)value);
    if (here->kind == CELL_POSITION) {
        session_set_byte(here->address + 1u, (uint8_t)(value >> 8));
        if (the_session.page == 0 && the_session.x < CELL_X_OFFSET) {
            session_update_trim(the_session.y);
        }
    }
    (void)dialog_edited();
}

COMMAND(cmd_set)
{
    here_t here = look_here();
    uint16_t value;
    if (here.kind == CELL_OFFSET) {
        return dialog_refuse(TEXT_P("This cell is computed"));
    }
    if (!shell_take(args, 1, value_range(here.kind, here.max), &value)) {
        return SHELL_ERR_RANGE;
    }
    put(&here, value);
    return SHELL_OK;
}

/* ---- keys ---- */

/* The value of the cell after the key. Page Step stops at its limits; other bytes wrap (their maximum is 127 or 255). ----,
 * ???? and a position that would leave 0..1023 keep their value. */
static uint16_t changed(const here_t *here, uint16_t word, int8_t change)
{
    uint16_t value = word + (uint16_t)change;
    if (here->kind == CELL_BYTE && here->max != PAGE_STEPS) {
        return value & here->max;
    }
    if (here->kind == CELL_BYTE && value > here->max) {
        return change < 0 ? 0 : here->max;
    }
    return word <= here->max && value <= here->max ? value : word;
}

void cmd_cell_change(int8_t change)
{
    here_t here = look_here();
    uint16_t word = here.kind == CELL_BYTE ? the_session.cells[here.address] : cell_word(the_session.cells, here.address);
    uint16_t value = changed(&here, word, change);
    if (here.kind == CELL_OFFSET || value == word || (here.is_pose && !robot_has(the_session.y))) {
        return;
    }
    put(&here, value);
}

static void toggle_pose(void)
{
    uint8_t joint = the_session.y;
    uint16_t word = session_pose(joint);
    if (!robot_has(joint)) {
        session_set_pose(joint, word ^ PAGE_POS_TORQUE_OFF);
    } else {
        robot_switch(servo_link_bit(joint), cell_is_off(word));
    }
}

void cmd_cell_space(void)
{
    here_t here = look_here();
    if (here.is_pose) {
        toggle_pose();
    } else if (here.kind == CELL_POSITION) {
        put(&here, cell_word(the_session.cells, here.address) ^ PAGE_POS_TORQUE_OFF);
    }
}

/* ---- cursor and display ---- */

COMMAND(cmd_goto)
{
    uint8_t x = (uint8_t)args->number[0], y = (uint8_t)args->number[1];
    if (cell_kind(the_session.page, x, y) == CELL_NONE) {
        return dialog_refuse(TEXT_P("There is no cell"));
    }
    if (x != CELL_X_HEADER && !screen_has_row(y)) {
        return dialog_refuse(TEXT_P("That joint has no row"));
    }
    the_session.x = x;
    the_session.y = y;
    return SHELL_OK;
}

static uint8_t set_schedule(uint8_t schedule)
{
    session_begin();
    session_set_byte(PAGE_AT_SCHEDULE, schedule);
    return dialog_edited();
}

COMMAND(cmd_time)
{
    return set_schedule(PAGE_SCHEDULE_TIME);
}

COMMAND(cmd_speed)
{
    return set_schedule(PAGE_SCHEDULE_SPEED);
}

COMMAND(cmd_hex)
{
    the_session.hex = true;
    return SHELL_OK;
}

COMMAND(cmd_dec)
{
    the_session.hex = false;
    return SHELL_OK;
}

COMMAND(cmd_re)
{
    screen_redraw();
    screen_ask_size();
    return SHELL_OK;
}

COMMAND(cmd_rows)
{
    screen_set_rows((uint8_t)args->number[0]);
    return SHELL_OK;
}
