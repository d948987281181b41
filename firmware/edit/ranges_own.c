/* SPDX-License-Identifier: MIT */
#include "ranges_own.h"

#include "page.h"
#include "pgm.h"
#include "shape.h"
#include "text.h"

TEXT_NAMED(name_step, "Step");
TEXT_NAMED(name_percent, "Percent");
TEXT_NAMED(name_rows, "Rows");
TEXT_NAMED(name_x, "X");
TEXT_NAMED(name_y, "Y");
TEXT_NAMED(name_offset, "Offset");
TEXT_NAMED(name_value, "Value");
TEXT_NAMED(name_steps, "Page Step");
TEXT_NAMED(name_link, "Link");

const shell_range_t ranges_own_P[] PROGMEM = {
    [RANGE_STEP - RANGE_OWN] = {name_step, 0, PAGE_STEPS - 1},
    [RANGE_STEP7 - RANGE_OWN] = {name_step, 0, PAGE_STEPS},
    [RANGE_RATE - RANGE_OWN] = {name_percent, SHAPE_RATE_MIN, SHAPE_RATE_MAX},
    [RANGE_ROWS - RANGE_OWN] = {name_rows, 24, 255},
    [RANGE_X - RANGE_OWN] = {name_x, 0, 9},
    [RANGE_Y - RANGE_OWN] = {name_y, 0, 32},
    [RANGE_OFFSET - RANGE_OWN] = {name_offset, 0, PAGE_BYTES - 1},
    [RANGE_BYTE - RANGE_OWN] = {name_value, 0, UINT8_MAX},
    [RANGE_STEPS - RANGE_OWN] = {name_steps, 0, PAGE_STEPS},
    [RANGE_LINK - RANGE_OWN] = {name_link, 0, PAGE_COUNT - 1},
};
