/* SPDX-License-Identifier: MIT
 * ranges.h - what the numbers of commands may be, by name: for the tables of commands (shell.h). Those of requests stand
 * here, those of an image in its ranges_own.h, counted from RANGE_OWN on. */
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
    RANGE_DEG_S,      /* 1..360 */
    RANGE_ID,         /* 0..30 */
    RANGE_CODE,       /* 0..254 */
    RANGE_PERIOD_MS,  /* 0..10000 */
    RANGE_POSITION,   /* 0..1023 */
    RANGE_OWN
};

/* The image's. */
extern const shell_range_t ranges_own_P[];

/* The joints that the words from `first` on name: "3", "1-6", and "6-1" as well. Their bits are added to *joints. false: SHELL_ERR_RANGE. */
MUST_CHECK bool ranges_take_joints(const shell_args_t *args, uint8_t first, uint32_t *joints);

#endif
