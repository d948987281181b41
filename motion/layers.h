/* SPDX-License-Identifier: MIT
 * layers.h - motion over the main play, on joints that it lends: a second page, and motion made by code.
 *
 *   main play  (all joints) ---\
 *   page layer (its joints) ---- mux ---> goals: each joint follows one source, the first that has it of
 *   code       (4 joints)   ---/          code, page layer, main play
 *
 * Each source computes its goals by itself, so the main play is the same with layers and without: its timing, its links, its
 * goals. When a joint gets another source, the mux leads it there at the speed of the hand-over at most (mux.h). A page
 * layer starts from where its joints are, and the mux bounds the speed of that first step too. It plays by the exact law,
 * whatever the law of the main play. Pure; caller-owned; main loop only. */
#ifndef LAYERS_H
#define LAYERS_H

#include <stdbool.h>
#include <stdint.h>
#include "code_motion.h"
#include "compiler.h"
#include "link.h"
#include "mux.h"
#include "player.h"

#define LAYERS_SPEED_DEFAULT_DEG_S 60u

typedef enum {
    LAYERS_OK = 0,
    LAYERS_ERR_PAGE,     /* the page is damaged: layers.play.fault, .fault_page */
    LAYERS_ERR_EMPTY,    /* the page has no action */
    LAYERS_ERR_JOINTS,   /* none of these joints is there */
    LAYERS_ERR_FULL,     /* CODE_MOTION_JOINTS joints are moved by code already */
    LAYERS_ERR_IDLE,     /* a page layer needs a main play */
    LAYERS_ERR_BUSY      /* not now; for callers of layers.h */
} layers_status_t;

typedef struct {
    /* Read only for callers. */
    player_t play;               /* the page layer */
    code_motion_t code;
    mux_t mux;
    /* Private. */
    player_t *main;              /* NULL: see layers_bind */
    uint16_t *goal_pos;
    uint32_t sought;             /* joints that sought their source before this tick: one that meets it needs its goal */
    uint8_t steps_begun;         /* of the page layer: 0, 1, 2 or more */
    bool holds;                  /* paused or breaking: what the mux and code move stays where it is */
    player_joint_t joint[PAGE_JOINTS]; /* of the page layer */
} layers_t;

/* No layer, no code-made motion. goal_pos: the goals of all joints, which layers_tick makes. */
void layers_init(layers_t *layers, uint16_t goal_pos[PAGE_JOINTS]);

/* The speed of hand-overs, degrees/s, 1..360 (0: LAYERS_SPEED_DEFAULT_DEG_S). On the robot it is that of the approach. */
void layers_set_speed(layers_t *layers, uint16_t deg_s);

/* Sets the main play: call it after player_init or right after player_start, and with NULL before the memory of the main
 * play gets another use (an approach). Ends a page layer at once, without slowing down; code-made motion goes on, and a play
 * that has just started takes its joints for being at their first positions. */
void layers_bind(layers_t *layers, player_t *main_play);

/* Plays a page, 1..PAGE_COUNT - 1, on `joints` (0: those that its first step uses), as far as the main play has them and
 * code does not. Plays as stored, by the exact law; follows its pages' next links. A page layer that was on ends first. The
 * page itself must have an action. After an error only play.fault and .fault_page have changed. */
MUST_CHECK layers_status_t layers_start(layers_t *layers, uint8_t page, uint32_t joints);

/* Ends the page layer, if there is one; its joints go back to the main play. */
void layers_end(layers_t *layers);

/* Joint `id` goes to pos (0..1023) at deg_s degrees/s at most (1..360; 0: the speed of hand-overs) and stays there. Replaces
 * what code did with the joint; a page layer loses it. Needs no main play, but goal_pos[id] must be where the joint is. */
MUST_CHECK layers_status_t layers_aim(layers_t *layers, uint8_t id, uint16_t pos, uint16_t deg_s);

/* Joint `id` swings: centre + amplitude * sin, which must be possible: ask code_motion_can_swing first;
 * period_ticks up to 65535 (1/128 s), phase_deg 0..359 at the beginning. Otherwise as layers_aim. */
MUST_CHECK layers_status_t layers_swing(layers_t *layers, uint8_t id, uint16_t centre, uint16_t amplitude,
                                        uint16_t period_ticks, uint16_t phase_deg);

/* Code-made motion of `joints` ends: they go back to the main play, or stay where they are if there is none. */
void layers_free(layers_t *layers, uint32_t joints);

/* One tick of the main play (if there is one) and of the layers; makes goal_pos. Returns the PLAYER_EV_ bits of the main
 * play, those of the page layer in *layer_events. PLAYER_EV_OUTPUT in either: there are goals to send. */
uint8_t layers_tick(layers_t *layers, link_t *main_link, uint8_t *layer_events) NOINLINE;

/* player_plan of both plays. */
void layers_plan(layers_t *layers, link_t *main_link) NOINLINE;

/* Whether a tick of the layers may still move something: a page layer plays, a joint changes hands or swings. */
bool layers_are_moving(const layers_t *layers);

/* Joints of the page layer and of code, and joints that go back to the main play or have met it in this tick: to be sent
 * with the joints of that. */
uint32_t layers_joints(const layers_t *layers);

/* Joints are lost (a silent servo, torque off): their goals stay. */
void layers_drop_joints(layers_t *layers, uint32_t joints);

/* Call these with those of the main play. Code-made motion stays where it is, in a pause until it ends, after a break for
 * good. */
void layers_break(layers_t *layers);
void layers_pause(layers_t *layers);
void layers_resume(layers_t *layers);

#endif
