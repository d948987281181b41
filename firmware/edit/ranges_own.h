/* SPDX-License-Identifier: MIT
 * ranges_own.h - the ranges of Edit's numbers beyond those of ranges.h. */
#ifndef RANGES_OWN_H
#define RANGES_OWN_H

#include "ranges.h"

enum {
    RANGE_STEP = RANGE_OWN,   /* 0..6 */
    RANGE_STEP7,              /* 0..7 */
    RANGE_RATE,               /* 10..400 % */
    RANGE_ROWS,               /* of a terminal */
    RANGE_X, RANGE_Y,         /* a cell of the table */
    RANGE_OFFSET,             /* into a page: 0..511 */
    RANGE_BYTE,               /* 0..255 */
    RANGE_STEPS, RANGE_LINK   /* of a page: 0..7, 0..127 */
};

#endif
