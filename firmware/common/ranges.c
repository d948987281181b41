/* SPDX-License-Identifier: MIT */
#include "ranges.h"

#include "link.h"
#include "page.h"
#include "pgm.h"
#include "text.h"

TEXT_NAMED(name_page, "Page");
TEXT_NAMED(name_deg_s, "Degrees/s");
TEXT_NAMED(name_id, "ID");
TEXT_NAMED(name_code, "Code");
TEXT_NAMED(name_period, "Milliseconds");
TEXT_NAMED(name_position, "Position");

static const shell_range_t common_P[] PROGMEM = {
    [RANGE_PAGE - 1] = {name_page, 0, PAGE_COUNT - 1},
    [RANGE_PLAYED - 1] = {name_page, 1, PAGE_COUNT - 1},
    [RANGE_DEG_S - 1] = {name_deg_s, 1, 360},
    [RANGE_ID - 1] = {name_id, 0, PAGE_JOINTS - 1},
    [RANGE_CODE - 1] = {name_code, 0, LINK_CODE_STOP - 1},
    [RANGE_PERIOD_MS - 1] = {name_period, 0, 10000},
    [RANGE_POSITION - 1] = {name_position, 0, PAGE_POS_MAX},
};

const shell_range_t *shell_range_P(uint8_t range)
{
    STATIC_ASSERT(ARRAY_COUNT(common_P) == RANGE_OWN - 1, "every range has its place");
    return range < RANGE_OWN ? &common_P[range - 1] : &ranges_own_P[range - RANGE_OWN];
}
