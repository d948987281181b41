/* SPDX-License-Identifier: MIT
 * shape_of.h - a shape of numbers that come from the page, for motion_api.c and trial_api.c. */
#ifndef SHAPE_OF_H
#define SHAPE_OF_H

#include "shape.h"

/* Rate, amplitude of all joints and blend, in percent; the rest as in shape_init. false: one is out of its range. */
static inline bool shape_of(shape_t *shape, int rate, int amplitude, int blend)
{
    if (rate < (int)SHAPE_RATE_MIN || rate > (int)SHAPE_RATE_MAX || amplitude < 0 ||
        amplitude > (int)SHAPE_AMPLITUDE_MAX || blend < -SHAPE_BLEND_MAX || blend > SHAPE_BLEND_MAX) {
        return false;
    }
    shape_init(shape);
    shape->rate_percent = (uint16_t)rate;
    shape_set_amplitude(shape, (uint8_t)amplitude, UINT32_MAX);
    shape->blend_percent = (int8_t)blend;
    return true;
}

#endif
