/* SPDX-License-Identifier: MIT
 * layers_rules.h - what a robot must keep to while layers lie over its play (shaping.md, "Layers"), for fuzz_layers.c, which
 * makes it play. */
#ifndef LAYERS_RULES_H
#define LAYERS_RULES_H

#include "layers.h"

/* A main play and what is its own. */
typedef struct {
    player_t player;
    player_joint_t joint[PAGE_JOINTS];
    uint16_t goal_pos[PAGE_JOINTS];
    link_t link;
    shape_step_t shaping;
} play_t;

/* The same play twice: `laid` has layers over it, `alone` has none. */
typedef struct {
    play_t laid, alone;
    layers_t layers;
    shape_t shape;
    player_law_t law;
    unsigned hand_over_deg_s, code_deg_s[PAGE_JOINTS];
    uint32_t present, touched;   /* touched: lent since the start, or not as in `alone` for another reason */
    uint32_t whole_step;         /* the main play's since its step began */
    bool undisturbed;            /* no break or pause since then */
    uint16_t asked_pos[PAGE_JOINTS]; /* see remember */
    bool keeps_time;             /* `alone` still tells how long things take: see may_differ, and pause of fuzz_layers.c */
} layers_run_t;

/* What must_move_well has to know of the tick before. What the owner asks for also of the tick before that one: a joint that
 * is planned ahead has the step's target a tick early (player_asks). */
typedef struct {
    uint16_t goal_pos[PAGE_JOINTS], asked_pos[2][PAGE_JOINTS];
    uint8_t hand_over[PAGE_JOINTS];
    bool there[PAGE_JOINTS];
} before_t;

static inline uint32_t bit(unsigned joint)
{
    return (uint32_t)1 << joint;
}

static inline bool has(uint32_t joints, unsigned joint)
{
    return (joints >> joint & 1u) != 0;
}

/* Joints that are the main play's and go its way. */
uint32_t at_home(const layers_run_t *run);

/* Whether `alone` may take another time than `laid`. Under the classic law a step that begins from a stand is as long as the
 * longest way from where the joints are: a joint that was lent is elsewhere than in `alone`. Only if lengths come from ways:
 * pages of speed base, and the top speed's limit. */
bool may_differ(const layers_run_t *run);

/* Behind each call: owners, joints and pauses of both plays fit together. */
void must_be_sane(const layers_run_t *run);

/* Around each tick: no joint goes faster than who moves it allows, and one that was never lent goes as in `alone`. */
void remember(layers_run_t *run, before_t *before);
void must_move_well(const layers_run_t *run, const before_t *before, bool layer_ended);

/* At the end of a step: a joint that was the main play's for a whole step ends it where it would have ended it without
 * layers, but for the unit within which it had caught up, if all that was left of the step was a hold. */
void must_end_step_well(const layers_run_t *run);

#endif
