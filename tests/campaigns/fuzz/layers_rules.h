/* SPDX-License-Identifier: MIT
 * layers_rules.h - rules for layers over a play (SHAPING.md, "Layers"), for fuzz_layers.c, which makes it play. */
#ifndef LAYERS_RULES_H
#define LAYERS_RULES_H

#include "layers.h"

/* A main play with its own state. */
typedef struct {
    player_t player;
    player_joint_t joint[PAGE_JOINTS];
    uint16_t goal_pos[PAGE_JOINTS];
    link_t link;
} play_t;

/* The same play twice: `laid` has layers over it, `alone` has none. */
typedef struct {
    play_t laid, alone;
    layers_t layers;
    shape_t shape;
    player_law_t law;
    unsigned hand_over_deg_s, code_deg_s[PAGE_JOINTS];
    uint32_t present;
} layers_run_t;

/* The state before a tick, for must_move_well: the goals, what the joints' sources asked for, and which joints had
 * not met their source. */
typedef struct {
    uint16_t goal_pos[PAGE_JOINTS], asked_pos[PAGE_JOINTS];
    uint32_t seeking;
} before_t;

static inline uint32_t bit(unsigned joint)
{
    return (uint32_t)1 << joint;
}

static inline bool has(uint32_t joints, unsigned joint)
{
    return (joints >> joint & 1u) != 0;
}

/* After each call: owners, joints and pauses of both plays are consistent. */
void must_be_sane(const layers_run_t *run);

/* Around each tick: no joint is faster than its source and the hand-over allow. A joint of the main play moves as in
 * `alone`. */
void remember(const layers_run_t *run, before_t *before);
void must_move_well(const layers_run_t *run, const before_t *before, bool layer_ended);

/* After each tick: the main play is the same with and without layers. */
void must_be_equal(const layers_run_t *run);

#endif
