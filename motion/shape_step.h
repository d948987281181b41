/* SPDX-License-Identifier: MIT
 * shape_step.h - blend and amplitude of the positions of a step (shape.h). A program without them links shape_step_none.c;
 * rate and limit remain. Pure; main loop only. */
#ifndef SHAPE_STEP_H
#define SHAPE_STEP_H

#include "shape.h"

/* The number of steps of `page`; 0: there is no such page, or it is damaged. A page without steps has no centre pose and is
 * nobody's partner. */
uint8_t shape_steps_of(const page_source_t *source, uint8_t page);

/* Blends, scales and limits the position words of step 1..7 of `page`, in place, with the present settings. Words that
 * do not drive their joint stay. */
void shape_step(const shape_t *shape, const page_source_t *source, uint8_t page, uint8_t step, uint16_t words[PAGE_JOINTS]);

#endif
