/* SPDX-License-Identifier: MIT
 * code_motion.h - motion made by code: joints that aim at a position, or swing on a sine, until they are freed. Only says
 * where each joint is to be; the mux takes it there (layers.h). Pure; caller-owned; main loop only. */
#ifndef CODE_MOTION_H
#define CODE_MOTION_H

#include <stdbool.h>
#include <stdint.h>
#include "mux.h"

#define CODE_MOTION_JOINTS 4u            /* at once */
#define CODE_MOTION_PERIOD_MIN_TICKS 16u /* of a swing: 1/8 s */
#define CODE_MOTION_SPEED_MAX 8u         /* of a swing, servo units a tick; an unloaded AX-12 does 8.7 at 11.1 V */

/* A joint that code moves: centre + amplitude * sin(phase). An aim is a swing without amplitude. */
typedef struct {
    uint8_t joint;                       /* CODE_MOTION_NO_JOINT: the slot is free */
    mux_speed_t speed;                   /* until the joint is where it is to be */
    uint16_t centre_pos, amplitude_pos;
    uint32_t phase, phase_step;          /* a turn is 2^32 */
} code_slot_t;
#define CODE_MOTION_NO_JOINT 0xFFu

typedef struct {
    uint32_t joints;                     /* read only for callers */
    code_slot_t slot[CODE_MOTION_JOINTS];
} code_motion_t;

/* No joint. */
void code_motion_init(code_motion_t *code);

/* The slot of a joint, or else a free one; NULL: there is none. */
code_slot_t *code_motion_slot(code_motion_t *code, uint8_t joint);

/* The joint has that slot from now on, and rests at 0 until the slot is filled in. */
void code_motion_take(code_motion_t *code, code_slot_t *slot, uint8_t joint, uint16_t speed_q8_8);

void code_motion_free(code_motion_t *code, uint32_t joints);

/* Whether a swing stays within 0..1023, the shortest period and the highest speed. */
bool code_motion_can_swing(uint16_t centre, uint16_t amplitude, uint16_t period_ticks);

/* Makes the joint of a slot swing, from phase_deg 0..359 on. */
void code_motion_swing(code_slot_t *slot, uint16_t centre, uint16_t amplitude, uint16_t period_ticks, uint16_t phase_deg);

/* Whether a joint swings. */
bool code_motion_swings(const code_motion_t *code);

/* Where a slot's joint is to be in this tick. Right to 1/800 of the amplitude. */
uint16_t code_motion_tick(code_slot_t *slot);

#endif
