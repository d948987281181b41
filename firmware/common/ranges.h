/* SPDX-License-Identifier: MIT
 * ranges.h - what the numbers of commands may be (shell_ranges_P), by name: for the tables of commands. */
#ifndef RANGES_H
#define RANGES_H

#include <stdbool.h>
#include <stdint.h>
#include "compiler.h"
#include "shell.h"

enum {
    RANGE_NONE = 0,   /* no number, or one that the handler looks at */
    RANGE_PAGE,       /* 0..127 */
    RANGE_PLAYED,     /* 1..127 */
    RANGE_STEP,       /* 0..6 */
    RANGE_STEP7,      /* 0..7 */
    RANGE_PERCENT,    /* 10..1000 */
    RANGE_RATE,       /* 10..400 % */
    RANGE_ROWS,       /* of a terminal */
    RANGE_X, RANGE_Y, /* a cell of the editor's table */
    RANGE_DEG_S,      /* 1..360 */
    RANGE_ID,         /* 0..30 */
    RANGE_CODE,       /* 0..254 */
    RANGE_OFFSET,     /* into a page: 0..511 */
    RANGE_PERIOD_MS,  /* 0..10000 */
    RANGE_POSITION,   /* 0..1023 */
    RANGE_BYTE,       /* 0..255 */
    RANGE_STEPS, RANGE_LINK, RANGE_SHARE,             /* of a page: 0..7, 0..127, 0..100 % */
    RANGE_BUS_ID, RANGE_ONE_ID, RANGE_ADDRESS,        /* of a servo: with 254 for all, without, in its table */
    RANGE_COUNT, RANGE_SWITCH, RANGE_BAUD, RANGE_MOVING_SPEED
};

/* The joints that the words from `first` on name: "3", "1-6". Their bits are added to *joints. false: SHELL_ERR_RANGE. */
MUST_CHECK bool ranges_take_joints(const shell_args_t *args, uint8_t first, uint32_t *joints);

#endif
