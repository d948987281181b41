/* SPDX-License-Identifier: MIT
 * layers_parts.h - what layers.c (page layer, joints that change hands, the tick) and layers_code.c (code-made motion) share.
 * Included by these only. */
#ifndef LAYERS_PARTS_H
#define LAYERS_PARTS_H

#include "fix.h"
#include "layers.h"

/* Servo units a tick of degrees/s: 1024 / 300 / 128, in q8.8. */
static inline uint16_t layers_units_per_tick_q8_8(uint16_t deg_s)
{
    return (uint16_t)((uint32_t)deg_s * 512u / 75u);
}

/* Loops over the joints of a mask, which is empty afterwards. */
#define FOR_JOINTS(i_, joints_)                                        \
    for (uint8_t i_ = 0; (joints_) != 0; (i_)++, (joints_) >>= 1)     \
        if (((uint8_t)(joints_) & 1u) != 0)

/* --- layers.c ----------------------------------------------------------------------------------------------------- */

/* Servo units that a joint may go in this tick; keeps the fraction that is left over. */
uint8_t layers_allow(uint16_t *allowance_q8_8, uint16_t speed_q8_8) NOINLINE;

/* `from`, one tick's way nearer to `to`. */
uint16_t layers_approach_by(uint16_t from, uint16_t to, uint8_t most) NOINLINE;

/* Joints go back to the main play, or stay where they are when that does not play or may not drive them. */
void layers_hand_back(layers_t *layers, uint32_t joints);

/* --- layers_code.c ------------------------------------------------------------------------------------------------ */

/* No joint is moved by code. */
void layers_forget_code(layers_t *layers);

/* One tick of all joints that code moves. */
void layers_move_by_code(layers_t *layers);

#endif
