/* SPDX-License-Identifier: MIT
 * layers.h - motion over the main play on joints of its own: a second page, and motion made by code (shaping.md).
 * Each joint belongs to one of the three. The main play keeps its timing whatever joints are lent; the goals of its other
 * joints are the same as without a layer, bit by bit.
 *
 *   main play --- layers_start, aim, swing ---> page layer or code      the joint changes hands: its goal follows what the
 *             <-- the layer ends, free --------                          new owner asks for at the hand-over speed at most,
 *                                                                        from where it is, until it has caught up behind the
 *                                                                        owner's first step with it
 *
 * A page layer plays by the exact law, whatever the main play's: the original, which the classic law equals, has no layers.
 *
 * Pure; caller-owned; main loop only. */
#ifndef LAYERS_H
#define LAYERS_H

#include <stdbool.h>
#include <stdint.h>
#include "compiler.h"
#include "link.h"
#include "player.h"

#define LAYERS_CODE_JOINTS 4u          /* joints that code may move at once */
#define LAYERS_SPEED_MAX_DEG_S 360u
#define LAYERS_PERIOD_MIN_TICKS 16u    /* of a swing: 1/8 s */
#define LAYERS_SWING_SPEED_MAX 8u      /* servo units a tick; what an AX-12 can do at 11.1 V (body.md) */

typedef enum {
    LAYERS_OK = 0,
    LAYERS_ERR_RANGE,    /* a number out of its range, or page 0 or above 127 */
    LAYERS_ERR_PAGE,     /* the page is damaged: layers.play.fault, .fault_page */
    LAYERS_ERR_EMPTY,    /* the page has no action */
    LAYERS_ERR_JOINTS,   /* none of these joints is there */
    LAYERS_ERR_FULL,     /* LAYERS_CODE_JOINTS joints are moved by code already */
    LAYERS_ERR_IDLE,     /* a page layer needs a main play */
    LAYERS_ERR_BUSY      /* not now; for those above */
} layers_status_t;

/* A joint moved by code: centre + amplitude * sin(phase). An aim is a swing without amplitude. */
typedef struct {
    uint8_t joint;                          /* LAYERS_NO_JOINT: the slot is free */
    bool there;                             /* it has caught up */
    uint16_t speed_q8_8, allowance_q8_8;    /* until then: servo units a tick, and what is left over of them */
    uint16_t centre_pos, amplitude_pos;
    uint32_t phase, phase_step;             /* a turn is 2^32 */
} layers_code_t;
#define LAYERS_NO_JOINT 0xFFu

typedef struct {
    /* Private. */
    player_t *main;              /* NULL: see layers_bind */
    uint16_t *goal_pos;
    uint16_t speed_q8_8, allowance_q8_8; /* of the hand-over */
    uint16_t from_pos[PAGE_JOINTS]; /* of a joint that changes hands: its last goal */
    bool paused : 1;
    /* Read only for callers. */
    bool changing : 1;           /* a joint is on its way to a new owner */
    uint32_t code_joints;        /* moved by code */
    player_t play;               /* the page layer */
    layers_code_t code[LAYERS_CODE_JOINTS]; /* private */
    shape_step_t shaping;        /* memory for the main play's player_set_shape */
} layers_t;

/* No layer, no code-made motion. goal_pos: the goals of all joints, the same array as the main play's. */
void layers_init(layers_t *layers, uint16_t goal_pos[PAGE_JOINTS]);

/* The hand-over speed, degrees/s, 1..360 (0 counts as APPROACH_SPEED_DEFAULT). */
void layers_set_speed(layers_t *layers, uint16_t deg_s);

/* Tells which main play the layers lie over: call it between player_init and player_start, and with NULL before the main
 * play's memory becomes something else's (an approach). Ends a page layer; code-made motion goes on. */
void layers_bind(layers_t *layers, player_t *main_play);

/* A second page on `joints` (0: those that its first step uses), of which only those of the main play's `present` that code
 * does not move are taken. Plays by the exact law, as stored; follows its own links, code 0. A page layer that was on
 * ends first. The page itself has to have an action. Any error: nothing changed but play.fault and .fault_page. */
MUST_CHECK layers_status_t layers_start(layers_t *layers, uint8_t page, uint32_t joints);

/* Ends the page layer, if there is one; its joints go back to the main play. */
void layers_end(layers_t *layers);

/* Both replace what code did with that joint; a page layer loses it.
 * Joint `id` goes to pos (0..1023) at deg_s degrees/s at most (1..360; 0: the hand-over speed) and stays there. Needs no
 * main play, but goal_pos[id] has to be where the joint is. */
MUST_CHECK layers_status_t layers_aim(layers_t *layers, uint8_t id, uint16_t pos, uint16_t deg_s);

/* For callers who have to make the joint ready first: whether code may move joint `id` besides those that it moves, and
 * whether a swing stays within 0..1023, LAYERS_PERIOD_MIN_TICKS and LAYERS_SWING_SPEED_MAX. */
bool layers_have_room(layers_t *layers, uint8_t id);
bool layers_can_swing(uint16_t centre, uint16_t amplitude, uint16_t period_ticks) NOINLINE;

/* Joint `id` swings: centre + amplitude * sin, which has to be possible (layers_can_swing; else LAYERS_ERR_RANGE);
 * period_ticks LAYERS_PERIOD_MIN_TICKS..65535 (1/128 s), phase_deg 0..359 at the beginning. The sine is right to 1/800 of
 * the amplitude. */
MUST_CHECK layers_status_t layers_swing(layers_t *layers, uint8_t id, uint16_t centre, uint16_t amplitude,
                                        uint16_t period_ticks, uint16_t phase_deg);

/* Code-made motion of `joints` ends: they go back to the main play, or stay where they are when there is none. */
void layers_free(layers_t *layers, uint32_t joints);

/* One tick of everything: the main play (when bound) and the layers. Returns the main play's PLAYER_EV_ bits, those of the
 * page layer in *layer_events. goal_pos is what to send; PLAYER_EV_OUTPUT in either: send it. */
uint8_t layers_tick(layers_t *layers, link_t *main_link, uint8_t *layer_events) NOINLINE;

/* Whether a tick of the layers may still move something: a page layer plays, a joint changes hands or swings. */
bool layers_are_moving(const layers_t *layers);

/* Joints whose goals the layers make: to be sent with the main play's `joints`. */
uint32_t layers_joints(const layers_t *layers);

/* For both kinds: joints are lost (a silent servo, torque off); a stop or break of everything; pause and resume. Code-made
 * motion ends with a break where it is, and stands still in a pause. */
void layers_drop_joints(layers_t *layers, uint32_t joints);
void layers_break(layers_t *layers);
void layers_pause(layers_t *layers);
void layers_resume(layers_t *layers);

#endif
