/* SPDX-License-Identifier: MIT
 * steer.h - the setting `remote drive`: L and R, held while a page with partners plays, steer it (shaping.md).
 * Full in one second, back to straight in one second after they are let go. Main loop only. Caller-owned; RAM: 2 bytes. */
#ifndef STEER_H
#define STEER_H

#include <stdbool.h>
#include <stdint.h>
#include "performer.h"

#define STEER_FULL 128 /* ticks from straight to full */

typedef struct {
    int16_t at; /* -STEER_FULL left .. STEER_FULL right */
} steer_t;

/* true: a page plays that has a partner to one side at least. */
bool steer_is_possible(const performer_t *performer);

/* Once a tick. direction: -1 left, 1 right, 0 neither. Sets the play's blend while it steers and on the way back to
 * straight; otherwise the blend is left alone. */
void steer_tick(steer_t *steer, performer_t *performer, int8_t direction);

#endif
