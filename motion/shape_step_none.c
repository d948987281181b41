/* SPDX-License-Identifier: MIT
 * shape_step_none.c - for programs without room for blend and amplitude: linked in place of shape_step.c. */
#include "shape_step.h"

void shape_step(const shape_t *shape, const page_source_t *source, uint8_t page, uint8_t step, uint16_t words[PAGE_JOINTS])
{
}
