/* SPDX-License-Identifier: MIT
 * shape_step.h - shapes the position words of a step. An image without blend and amplitude links shape_step_none.c; rate and
 * limit remain.
 *
 * 31 joints are too many for the tick in which a step is looked at. So a step is shaped in shares of SHAPE_STEP_SHARE
 * joints, all with the settings at its beginning. */
#ifndef SHAPE_STEP_H
#define SHAPE_STEP_H

#include "page_source.h"
#include "shape.h"

#define SHAPE_STEP_SHARES 3u
#define SHAPE_STEP_SHARE 11u /* joints */

/* A step that is being shaped. Private to shape_step.c. */
typedef struct shape_step {
    uint8_t partner, centre;        /* pages; 0: none */
    uint8_t step;                   /* 1..7 */
    uint8_t blend_percent;          /* 0..100, toward the partner */
    uint8_t done;                   /* joints below this are shaped */
    uint8_t amplitude_percent[PAGE_JOINTS];
} shape_step_t;

/* Begins with step 1..7 of `page`, with the present settings. Returns whether blend or amplitude shape it: then it has
 * SHAPE_STEP_SHARES shares, else none. */
bool shape_step_begin(shape_step_t *shaping, const shape_t *shape, const page_source_t *source, uint8_t page, uint8_t step);

/* Blends, scales and clamps the next SHAPE_STEP_SHARE of the step's position words, in place; words that do not drive their
 * joint stay. Only for the shares that the step has. */
void shape_step_share(shape_step_t *shaping, const page_source_t *source, uint16_t words[PAGE_JOINTS]);

#endif
