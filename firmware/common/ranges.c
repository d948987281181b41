/* SPDX-License-Identifier: MIT */
#include "ranges.h"

#include <stddef.h>
#include <string.h>
#include "link.h"
#include "page.h"
#include "pgm.h"
#include "servo_link.h"
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
