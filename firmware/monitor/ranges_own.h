/* SPDX-License-Identifier: MIT
 * ranges_own.h - the ranges of the monitor's numbers beyond those of ranges.h. */
#ifndef RANGES_OWN_H
#define RANGES_OWN_H

#include "ranges.h"

enum {
    RANGE_BYTE = RANGE_OWN,                      /* 0..255 */
    RANGE_BUS_ID, RANGE_ONE_ID, RANGE_ADDRESS,   /* ID with 254 for all; ID of one servo; address in its table */
    RANGE_COUNT, RANGE_SWITCH, RANGE_MOVING_SPEED
};

#endif
