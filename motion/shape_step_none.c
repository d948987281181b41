/* SPDX-License-Identifier: MIT
 * shape_step_none.c - linked in place of shape_step.c by an image that has no room for blend and amplitude. */
#include "shape_step.h"

void shape_step(const shape_t *shape, const page_source_t *source, uint8_t page, uint8_t step,
                uint8_t bytes[PAGE_STEP_BYTES])
{
    (void)shape;
    (void)source;
    (void)page;
    (void)step;
    (void)bytes;
}
