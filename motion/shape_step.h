/* SPDX-License-Identifier: MIT
 * shape_step.h - the seam between the sequence of steps and their shaping. An image without blend and amplitude links
 * shape_step_none.c: rate and limit remain. */
#ifndef SHAPE_STEP_H
#define SHAPE_STEP_H

#include "page_source.h"
#include "shape.h"

/* Blends, scales and clamps the position words of step 1..7 of `page`, whose stored 64 bytes `bytes` holds. */
void shape_step(const shape_t *shape, const page_source_t *source, uint8_t page, uint8_t step,
                uint8_t bytes[PAGE_STEP_BYTES]);

#endif
