/* SPDX-License-Identifier: MIT
 * shape_step_none.c - for images without room for blend and amplitude: linked in place of shape_step.c. */
#include "shape_step.h"

bool shape_step_begin(shape_step_t *shaping, const shape_t *shape, const page_source_t *source, uint8_t page, uint8_t step)
{
    (void)shaping;
    (void)shape;
    (void)source;
    (void)page;
    (void)step;
    return false;
}

void shape_step_share(shape_step_t *shaping, const page_source_t *source, uint16_t words[PAGE_JOINTS])
{
    (void)shaping;
    (void)source;
    (void)words;
}
