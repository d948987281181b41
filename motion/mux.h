/* SPDX-License-Identifier: MIT
 * mux.h - leads each joint to the goals of its source: the main play, a page layer, or code (layers.h knows which).
 * When a joint gets another source, it goes from where it is toward the goals of the new one, at the speed of the hand-over
 * at most, until it meets them. From then on it goes with them.
 *
 * They meet in the tick in which the joint can reach the goal of its source, or in which that goal passes the joint.
 *
 * Knows nothing of plays. Pure; caller-owned; main loop only. */
#ifndef MUX_H
#define MUX_H

#include <stdbool.h>
#include <stdint.h>
#include "page.h"

/* Movement at a limited speed, in servo units a tick; left is the fraction of a unit that has not been used yet. */
typedef struct {
    uint16_t speed_q8_8, left_q8_8;
} mux_speed_t;

typedef struct {
    mux_speed_t speed;           /* of hand-overs */
    uint32_t seeking;            /* bit per joint: has not met its source. Read only for callers */
    uint8_t state[PAGE_JOINTS];  /* of each joint; mux.c */
} mux_t;

/* Servo units a tick of degrees/s, q8.8. */
uint16_t mux_units_per_tick_q8_8(uint16_t deg_s);

/* The joints get another source. */
void mux_change(mux_t *mux, uint32_t joints);

/* The joints seek no more: they stay, or nobody moves them. */
void mux_forget(mux_t *mux, uint32_t joints);

/* How far a joint may go in this tick. */
uint8_t mux_allow(mux_speed_t *speed);

/* The goal in this tick of a joint that was at from_pos and whose source asks for asked_pos. Both may be outside 0..1023, as
 * in player_start. most_pos: movement while it seeks. may_meet: false while the source itself still moves to its first
 * position. */
uint16_t mux_goal(mux_t *mux, uint8_t joint, uint16_t from_pos, uint16_t asked_pos, uint8_t most_pos, bool may_meet);

#endif
