/* SPDX-License-Identifier: MIT
 * steer.h - the setting `remote drive`: L and R steer while a page with partners plays (SHAPING.md). Steering takes one
 * second to full, and one second back to straight after the button is released. Main loop only. Caller-owned. */
#ifndef STEER_H
#define STEER_H

#include <stdbool.h>
#include <stdint.h>
#include "performer.h"

#define STEER_FULL 128 /* ticks from straight to full */

typedef struct {
    int16_t at; /* -STEER_FULL left .. STEER_FULL right */
} steer_t;

/* Whether the page that plays, or to whose first pose the robot is on the way, has at least one partner. */
bool steer_is_possible(const performer_t *performer);

/* Call once per tick. direction: -1 left, 1 right, 0 neither. Sets the blend of the play while steering and while returning
 * to straight; does not change it otherwise. */
void steer_tick(steer_t *steer, performer_t *performer, int8_t direction);

#endif
