/* SPDX-License-Identifier: MIT */
#include "ranges_own.h"

#include "dxl.h"
#include "pgm.h"
#include "text.h"

TEXT_NAMED(name_value, "Value");
TEXT_NAMED(name_id, "ID");
TEXT_NAMED(name_address, "Address");
TEXT_NAMED(name_count, "Count");
TEXT_NAMED(name_speed, "Speed");

const shell_range_t ranges_own_P[] PROGMEM = {
    [RANGE_BYTE - RANGE_OWN] = {name_value, 0, UINT8_MAX},
    [RANGE_BUS_ID - RANGE_OWN] = {name_id, 0, DXL_BROADCAST},
    [RANGE_ONE_ID - RANGE_OWN] = {name_id, 0, DXL_BROADCAST - 1},
    [RANGE_ADDRESS - RANGE_OWN] = {name_address, 0, 49},
    [RANGE_COUNT - RANGE_OWN] = {name_count, 1, 50},
    [RANGE_SWITCH - RANGE_OWN] = {name_value, 0, 1},
    [RANGE_MOVING_SPEED - RANGE_OWN] = {name_speed, 0, 1023},
};
