/* SPDX-License-Identifier: MIT
 * screen_layout.c - which row of the table stands in which row of the screen. */
#include "screen_parts.h"

screen_t the_screen;

enum { FIXED_ROWS = 4 };   /* below the table: labels, pause, speed, command */

bool screen_is_full(void)
{
    return the_screen.rows >= SCREEN_ROWS_FULL;
}

uint8_t screen_table_rows(void)
{
    return (uint8_t)(the_screen.rows - FIXED_ROWS);
}

uint8_t screen_command_row(void)
{
    return the_screen.rows;
}

bool screen_has_row(uint8_t joint)
{
    return screen_is_full() || the_screen.present == 0 || joint >= PAGE_JOINTS || (the_screen.present >> joint & 1u) != 0;
}

uint8_t screen_rows_before(uint8_t joint)
{
    uint8_t count = 0;
    for (uint8_t i = 0; i < joint; i++) {
        count = (uint8_t)(count + screen_has_row(i));
    }
    return count;
}

uint8_t screen_row_of(uint8_t y)
{
    if (y >= PAGE_JOINTS) {
        return (uint8_t)(screen_table_rows() + 1u + (y - PAGE_JOINTS));
    }
    if (!screen_has_row(y)) {
        return 0;
    }
    uint8_t before = screen_rows_before(y);
    if (before < the_screen.top || before >= the_screen.top + screen_table_rows()) {
        return 0;
    }
    return (uint8_t)(before - the_screen.top + 1u);
}

uint8_t screen_joint_in_row(uint8_t row)
{
    uint8_t joint = 0;
    for (uint8_t i = 0; i < PAGE_JOINTS; i++) {
        uint8_t at = screen_row_of(i);
        if (at != 0 && at <= row) {
            joint = i;
        }
    }
    return joint;
}
