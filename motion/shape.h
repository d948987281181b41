/* SPDX-License-Identifier: MIT
 * shape.h - the settings that shape a motion while it plays: rate, amplitude, blend, limit (SHAPING.md has their formulas).
 * A step is shaped once, when the player reads it. So a change takes effect in the first step that has not been read, two
 * steps ahead at most. Only the main play is shaped; layers play as stored. With nothing set (shape_is_neutral) every goal
 * is as without this module, from the second step on. Pure; caller-owned; main loop only. */
#ifndef SHAPE_H
#define SHAPE_H

#include <stdbool.h>
#include <stdint.h>
#include "page.h"

#define SHAPE_RATE_MIN 10u
#define SHAPE_RATE_MAX 400u
#define SHAPE_AMPLITUDE_MAX 150u
#define SHAPE_BLEND_MAX 100        /* right; left is -SHAPE_BLEND_MAX */
#define SHAPE_NORMAL 100u          /* percent: rate and amplitude as stored */
#define SHAPE_CENTRE_DEFAULT 1u    /* page whose step 1 is the centre pose */

/* Nothing here checks a range: the caller does. */
typedef struct {
    /* Write at any time. */
    uint16_t rate_percent;                       /* 10..400 */
    int8_t blend_percent;                        /* -100..100 */
    uint8_t centre_page;                         /* 0, or a page that is not there: no centre pose, no joint is scaled */
    /* Read only for callers. */
    uint8_t top_speed_q4_4;                      /* servo units a tick; 0: no limit */
    bool scales;                                 /* some amplitude is not 100 */
    uint8_t amplitude_percent[PAGE_JOINTS];      /* 0..150 */
} shape_t;

/* Sets rate, amplitude and blend to 100, 100, 0; keeps the centre page and the voltage. */
void shape_reset(shape_t *shape);

/* Rate, amplitude and blend 100, 100, 0; centre page 1; no limit until the voltage is known. */
void shape_init(shape_t *shape);

/* percent: 0..150. joints: bit per joint. */
void shape_set_amplitude(shape_t *shape, uint8_t percent, uint32_t joints);

/* Sets the limit from the battery's present voltage, 0.1 V (a servo's register 42): 90 % of the top speed of an AX-12, which
 * is 8.7 units a tick at 11.1 V, in proportion to the voltage (SHAPING.md). 0: not known, no limit. */
void shape_set_voltage(shape_t *shape, uint8_t decivolts);

/* true when rate, amplitude and blend are 100, 100, 0: then only the step after a shaped one is limited. */
static inline bool shape_is_neutral(const shape_t *shape)
{
    return shape->rate_percent == SHAPE_NORMAL && shape->blend_percent == 0 && !shape->scales;
}

#endif
