/* SPDX-License-Identifier: MIT
 * ranges_own.h - the ranges of Play's numbers beyond those of ranges.h. */
#ifndef RANGES_OWN_H
#define RANGES_OWN_H

#include "ranges.h"

enum {
    RANGE_RATE = RANGE_OWN, RANGE_AMPLITUDE, RANGE_BLEND, /* shape.h */
    RANGE_SWING_MS, RANGE_PHASE,                          /* of a swing: 125..30000 ms, 0..359 degrees */
    RANGE_ANY_CODE                                        /* 0..255 */
};

#endif
