/* SPDX-License-Identifier: MIT */
#include "ranges_own.h"

#include "shape.h"
#include "pgm.h"
#include "text.h"

TEXT_NAMED(name_rate, "Rate");
TEXT_NAMED(name_amplitude, "Amplitude");
TEXT_NAMED(name_blend, "Blend");
TEXT_NAMED(name_period, "Milliseconds");
TEXT_NAMED(name_phase, "Phase");
TEXT_NAMED(name_code, "Code");

const shell_range_t ranges_own_P[] PROGMEM = {
    [RANGE_RATE - RANGE_OWN] = {name_rate, SHAPE_RATE_MIN, SHAPE_RATE_MAX},
    [RANGE_AMPLITUDE - RANGE_OWN] = {name_amplitude, 0, SHAPE_AMPLITUDE_MAX},
    [RANGE_BLEND - RANGE_OWN] = {name_blend, -SHAPE_BLEND_MAX, SHAPE_BLEND_MAX},
    [RANGE_SWING_MS - RANGE_OWN] = {name_period, 125, 30000},
    [RANGE_PHASE - RANGE_OWN] = {name_phase, 0, 359},
    [RANGE_ANY_CODE - RANGE_OWN] = {name_code, 0, 255},
};
