/* SPDX-License-Identifier: MIT
 * layers_parts.h - what the layers' files share: layers.c (page layer, the tick) uses layers_code.c (code-made motion) and
 * layers_hand.c (joints that change hands). Included by these only. */
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

/* --- layers_hand.c ------------------------------------------------------------------------------------------------ */

/* Servo units that a joint may go in this tick; keeps the fraction that is left over. */
uint8_t layers_allow(uint16_t *allowance_q8_8, uint16_t speed_q8_8) NOINLINE;

/* Joints go back to the main play, or stay where they are when that does not play or may not drive them. */
void layers_hand_back(layers_t *layers, uint32_t joints);

/* The joint begins to follow its new owner from where it is. too_late: for the step that begins with the next tick. */
void layers_follow_from_here(layers_t *layers, uint8_t joint, bool too_late);

/* One tick of all joints that change hands, after both plays' ticks with these events. */
void layers_follow_plays(layers_t *layers, uint8_t main_events, uint8_t layer_events) NOINLINE;

/* --- layers_code.c ------------------------------------------------------------------------------------------------ */

/* No joint is moved by code. */
void layers_forget_code(layers_t *layers);

/* One tick of all joints that code moves. */
void layers_move_by_code(layers_t *layers);

#endif
