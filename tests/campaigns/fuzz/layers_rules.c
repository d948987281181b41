/* SPDX-License-Identifier: MIT */
#include "layers_rules.h"
#include "fuzz_pages.h"
#include "trap.h"

#include <string.h>

static int distance(int from, int to)
{
    return from < to ? to - from : from - to;
}

/* Returns degrees/s in servo units per tick, rounded up. */
static int units_a_tick(unsigned deg_s)
{
    return (int)((deg_s * 1024u + 38399u) / 38400u);
}

static const code_slot_t *code_of(const layers_run_t *run, unsigned joint)
{
    for (unsigned i = 0; i < CODE_MOTION_JOINTS; i++) {
        if (run->layers.code.slot[i].joint == joint) {
            return &run->layers.code.slot[i];
        }
    }
    return NULL;
}

/* Returns how far a joint moved by code may go in a tick: 2 pi A / T. */
static int most_of_swing(const code_slot_t *slot)
{
    const int most = (int)((uint64_t)slot->amplitude_pos * slot->phase_step * 6284u / 1000u >> 32) + 2;
    return slot->amplitude_pos == 0 ? 0 : most < (int)CODE_MOTION_SPEED_MAX + 1 ? most : (int)CODE_MOTION_SPEED_MAX + 1;
}

static uint32_t of_page(const layers_run_t *run)
{
    return player_is_moving(&run->layers.play) ? run->layers.play.present : 0;
}

void must_be_sane(const layers_run_t *run)
{
    uint32_t of_code = 0;
    for (unsigned i = 0; i < CODE_MOTION_JOINTS; i++) {
        const uint8_t joint = run->layers.code.slot[i].joint;
        ASSERT(joint == CODE_MOTION_NO_JOINT || (joint < PAGE_JOINTS && !has(of_code, joint)));
        of_code |= joint == CODE_MOTION_NO_JOINT ? 0 : bit(joint);
    }
    const uint32_t seeking = run->layers.mux.seeking;
    ASSERT(of_code == run->layers.code.joints && (of_page(run) & of_code) == 0);
    ASSERT(layers_joints(&run->layers) == (of_page(run) | of_code | seeking));
    if (run->layers.main == NULL) {
        ASSERT(of_page(run) == 0 && (seeking & ~of_code) == 0);
        return;
    }
    ASSERT(((of_page(run) | seeking) & ~of_code & ~run->laid.player.present) == 0);
    /* A pause applies to both plays. */
    if (player_is_paused(&run->laid.player)) {
        ASSERT(run->layers.holds && (!player_is_moving(&run->layers.play) || player_is_paused(&run->layers.play)));
    }
}

void remember(const layers_run_t *run, before_t *before)
{
    before->seeking = run->layers.mux.seeking;
    memcpy(before->goal_pos, run->laid.goal_pos, sizeof before->goal_pos);
    for (uint8_t joint = 0; joint < PAGE_JOINTS; joint++) {
        const bool is_of_layer = has(of_page(run), joint);
        const bool is_played = is_of_layer || (run->layers.main != NULL && has(run->laid.player.present, joint));
        before->asked_pos[joint] = is_played ? player_goal(is_of_layer ? &run->layers.play : &run->laid.player, joint) : 0;
    }
}

/* Returns the limit of a seeking joint: its given speed. In the tick in which it meets its source it may be as fast
   as that source. */
static int most_while_seeking(const layers_run_t *run, uint8_t joint, const before_t *before, bool layer_ended)
{
    const code_slot_t *slot = code_of(run, joint);
    const int most = run->layers.holds ? 0 : units_a_tick(slot != NULL ? run->code_deg_s[joint] : run->hand_over_deg_s);
    if (has(run->layers.mux.seeking, joint) && !layer_ended) {
        return most;
    }
    if (slot != NULL) {
        return most > most_of_swing(slot) ? most : most_of_swing(slot);
    }
    const player_t *source = run->layers.main;
    const bool is_of_layer = has(of_page(run), joint);
    const int of_source = distance(player_goal(is_of_layer ? &run->layers.play : source, joint), before->asked_pos[joint]);
    return layer_ended ? (int)PAGE_POS_MAX : most > of_source ? most : of_source;
}

void must_move_well(const layers_run_t *run, const before_t *before, bool layer_ended)
{
    for (uint8_t joint = 0; joint < PAGE_JOINTS; joint++) {
        const code_slot_t *slot = code_of(run, joint);
        const int moved = distance(run->laid.goal_pos[joint], before->goal_pos[joint]);
        ASSERT(run->laid.goal_pos[joint] <= PAGE_POS_MAX);
        if (has(before->seeking, joint)) {
            ASSERT(moved <= most_while_seeking(run, joint, before, layer_ended));
        } else if (slot != NULL) {
            ASSERT(moved <= (run->layers.holds ? 0 : most_of_swing(slot)));
        } else if (run->layers.main == NULL || !has(run->laid.player.present, joint)) {
            ASSERT(moved == 0);
        } else if (!has(of_page(run), joint) && !layer_ended) {
            ASSERT(run->laid.goal_pos[joint] == run->alone.goal_pos[joint]);
        }
    }
}

void must_be_equal(const layers_run_t *run)
{
    const player_t *laid = &run->laid.player, *alone = &run->alone.player;
    ASSERT(laid->present == alone->present && laid->joints == alone->joints);
    ASSERT(laid->now.page == alone->now.page && laid->now.step == alone->now.step && laid->tick == alone->tick);
    for (uint8_t joint = 0; joint < PAGE_JOINTS; joint++) {
        ASSERT(!has(laid->present, joint) || player_goal(laid, joint) == player_goal(alone, joint));
    }
}
