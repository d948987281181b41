/* SPDX-License-Identifier: MIT */
#include "ranges.h"

#include <stddef.h>
#include <string.h>
#include "dxl.h"
#include "link.h"
#include "page.h"
#include "pgm.h"
#include "servo_link.h"
#include "shape.h"
#include "text.h"

TEXT_NAMED(name_page, "Page");
TEXT_NAMED(name_step, "Step");
TEXT_NAMED(name_percent, "Percent");
TEXT_NAMED(name_rows, "Rows");
TEXT_NAMED(name_x, "X");
TEXT_NAMED(name_y, "Y");
TEXT_NAMED(name_deg_s, "Degrees/s");
TEXT_NAMED(name_id, "ID");
TEXT_NAMED(name_code, "Code");
TEXT_NAMED(name_offset, "Offset");
TEXT_NAMED(name_period, "Milliseconds");
TEXT_NAMED(name_position, "Position");
TEXT_NAMED(name_value, "Value");
TEXT_NAMED(name_steps, "Page Step");
TEXT_NAMED(name_link, "Link");
TEXT_NAMED(name_address, "Address");
TEXT_NAMED(name_count, "Count");
TEXT_NAMED(name_speed, "Speed");

const shell_range_t shell_ranges_P[] PROGMEM = {
    [RANGE_PAGE] = {name_page, 0, PAGE_COUNT - 1},
    [RANGE_PLAYED] = {name_page, 1, PAGE_COUNT - 1},
    [RANGE_STEP] = {name_step, 0, PAGE_STEPS - 1},
    [RANGE_STEP7] = {name_step, 0, PAGE_STEPS},
    [RANGE_PERCENT] = {name_percent, 10, 1000},
    [RANGE_RATE] = {name_percent, SHAPE_RATE_MIN, SHAPE_RATE_MAX},
    [RANGE_ROWS] = {name_rows, 24, 255},
    [RANGE_X] = {name_x, 0, 9},
    [RANGE_Y] = {name_y, 0, 32},
    [RANGE_DEG_S] = {name_deg_s, 1, 360},
    [RANGE_ID] = {name_id, 0, PAGE_JOINTS - 1},
    [RANGE_CODE] = {name_code, 0, LINK_CODE_STOP - 1},
    [RANGE_OFFSET] = {name_offset, 0, PAGE_BYTES - 1},
    [RANGE_PERIOD_MS] = {name_period, 0, 10000},
    [RANGE_POSITION] = {name_position, 0, PAGE_POS_MAX},
    [RANGE_BYTE] = {name_value, 0, UINT8_MAX},
    [RANGE_STEPS] = {name_steps, 0, PAGE_STEPS},
    [RANGE_LINK] = {name_link, 0, PAGE_COUNT - 1},
    [RANGE_SHARE] = {name_percent, 0, 100},
    [RANGE_BUS_ID] = {name_id, 0, DXL_BROADCAST},
    [RANGE_ONE_ID] = {name_id, 0, DXL_BROADCAST - 1},
    [RANGE_ADDRESS] = {name_address, 0, 49},
    [RANGE_COUNT] = {name_count, 1, 50},
    [RANGE_SWITCH] = {name_value, 0, 1},
    [RANGE_BAUD] = {name_value, 0, 254},
    [RANGE_MOVING_SPEED] = {name_speed, 0, 1023},
};

bool ranges_take_joints(const shell_args_t *args, uint8_t first, uint32_t *joints)
{
    for (uint8_t i = first; i < args->count; i++) {
        char *dash = strchr(shell_word(args, i), '-');   /* in the caller's line */
        uint16_t from, to;
        if (dash != NULL) {
            *dash = '\0';
        }
        if (!shell_take(args, i, RANGE_ID, &from)) {
            return false;
        }
        to = from;
        if (dash != NULL) {
            const shell_args_t last = {.words = dash + 1, .count = 1, .hex = args->hex};
            if (!shell_take(&last, 0, RANGE_ID, &to)) {
                return false;
            }
            *dash = '-';   /* a word fewer: those behind it are counted by their ends */
        }
        for (; from <= to; from++) {
            servo_link_put(joints, (uint8_t)from, true);
        }
    }
    return true;
}
