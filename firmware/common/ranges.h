/* SPDX-License-Identifier: MIT
 * ranges.h - the ranges of the numbers in commands, for the command tables (shell.h). The ranges of requests are here.
 * Those of an image are in its ranges_own.h, numbered from RANGE_OWN on. */
#ifndef RANGES_H
#define RANGES_H

#include <stdbool.h>
#include <stdint.h>
#include "compiler.h"
#include "shell.h"

enum {
    RANGE_NONE = 0,   /* not a number, or one that the handler checks */
    RANGE_PAGE,       /* 0..PAGE_COUNT - 1 */
    RANGE_PLAYED,     /* 1..PAGE_COUNT - 1 */
    RANGE_DEG_S,      /* 1..360 */
    RANGE_ID,         /* 0..30 */
    RANGE_CODE,       /* 0..254 */
    RANGE_PERIOD_MS,  /* 0..10000 */
    RANGE_POSITION,   /* 0..1023 */
    RANGE_OWN
};

/* The image's own ranges, from RANGE_OWN on. */
extern const shell_range_t ranges_own_P[];

/* Adds the joints named by the words from `first` on ("3", "1-6", "6-1") to the mask *joints. false: return
 * SHELL_ERR_RANGE. */
MUST_CHECK bool ranges_take_joints(const shell_args_t *args, uint8_t first, uint32_t *joints);

#endif
