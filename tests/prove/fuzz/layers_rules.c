/* SPDX-License-Identifier: MIT */
#include "layers_rules.h"
#include "fuzz_pages.h"
#include "trap.h"

#include <string.h>

static int distance(int from, int to)
{
    return from < to ? to - from : from - to;
}

/* Servo units a tick of degrees/s, rounded up. */
static int units_a_tick(unsigned deg_s)
{
    return (int)((deg_s * 1024u + 38399u) / 38400u);
}

static const layers_code_t *code_of(const layers_run_t *run, unsigned joint)
{
    for (unsigned i = 0; i < LAYERS_CODE_JOINTS; i++) {
        if (run->layers.code[i].joint == joint) {
            return &run->layers.code[i];
        }
    }
    return NULL;
}

/* How far joint, which code moves, may go in a tick: towards its place at the speed it was given; then 2 pi A / T. */
static int most_of_code(const layers_run_t *run, const layers_code_t *code, bool was_there)
{
    if (run->layers.paused) {
        return 0;
    }
    if (!was_there) {
        return units_a_tick(run->code_deg_s[code->joint]);
    }
    const int most = (int)((uint64_t)code->amplitude_pos * code->phase_step * 6284u / 1000u >> 32) + 2;
    return code->amplitude_pos == 0 ? 0 : most < (int)LAYERS_SWING_SPEED_MAX + 1 ? most : (int)LAYERS_SWING_SPEED_MAX + 1;
}

/* A joint that changes hands goes no faster than the hand-over speed; in the tick in which it meets its owner's way, as
 * fast as that. */
static int most_of_hand_over(const layers_run_t *run, uint8_t joint, const before_t *before, bool layer_ended)
{
    const player_t *owner = run->laid.joint[joint].owner == PLAYER_OWNER_LAYER ? &run->layers.play : &run->laid.player;
    const int most = run->layers.paused ? 0 : units_a_tick(run->hand_over_deg_s);
    if (run->laid.joint[joint].hand_over != 0 && !layer_ended) {
        return most;
    }
    const int asked = player_asks(owner, &run->laid.joint[joint]);
    const int way = distance(asked, before->asked_pos[0][joint]), way_of_two = distance(asked, before->asked_pos[1][joint]);
    const int own_way = way > way_of_two ? way : way_of_two;
    return most > own_way ? most : own_way;
}

uint32_t at_home(const layers_run_t *run)
{
    uint32_t joints = 0;
    for (uint8_t joint = 0; joint < PAGE_JOINTS; joint++) {
        const player_joint_t *of_joint = &run->laid.joint[joint];
        joints |= of_joint->owner == PLAYER_OWNER_MAIN && of_joint->hand_over == 0 ? bit(joint) : 0;
    }
    return joints;
}

bool may_differ(const layers_run_t *run)
{
    bool by_way = run->shape.top_speed_q4_4 != 0;
    for (unsigned page = 1; page <= FUZZ_PAGES; page++) {
        by_way |= fuzz_pages[page][PAGE_AT_SCHEDULE] != PAGE_SCHEDULE_TIME;
    }
    return run->law == PLAYER_LAW_CLASSIC && by_way && (run->touched & run->present) != 0;
}

void must_be_sane(const layers_run_t *run)
{
    const uint32_t of_page = player_is_moving(&run->layers.play) ? run->layers.play.present : 0;
    uint32_t of_code = 0;
    for (unsigned i = 0; i < LAYERS_CODE_JOINTS; i++) {
        const uint8_t joint = run->layers.code[i].joint;
        ASSERT(joint == LAYERS_NO_JOINT || (joint < PAGE_JOINTS && !has(of_code, joint)));
        of_code |= joint == LAYERS_NO_JOINT ? 0 : bit(joint);
    }
    ASSERT(of_code == run->layers.code_joints && (of_page & of_code) == 0);
    ASSERT(layers_joints(&run->layers) == (of_page | of_code));
    if (run->layers.main == NULL) {
        ASSERT(of_page == 0);
        return;
    }
    for (uint8_t joint = 0; joint < PAGE_JOINTS; joint++) {
        const uint8_t owner = has(of_code, joint)   ? PLAYER_OWNER_CODE
                              : has(of_page, joint) ? PLAYER_OWNER_LAYER
                                                    : PLAYER_OWNER_MAIN;
        if (has(run->laid.player.present, joint)) {
            ASSERT(run->laid.joint[joint].owner == owner);
            ASSERT(has(run->laid.player.lent, joint) == (owner == PLAYER_OWNER_CODE));
        }
    }
    /* Pause holds for both, and so does going on. */
    if (player_is_moving(&run->laid.player) && !run->laid.player.breaking) {
        const bool paused = player_is_paused(&run->laid.player);
        ASSERT(run->layers.paused == paused);
        const player_t *layer = &run->layers.play;
        ASSERT(!player_is_moving(layer) || layer->breaking || player_is_paused(layer) == paused);
    }
}

void remember(layers_run_t *run, before_t *before)
{
    memcpy(before->asked_pos[1], run->asked_pos, sizeof run->asked_pos);
    for (uint8_t joint = 0; joint < PAGE_JOINTS; joint++) {
        const layers_code_t *code = code_of(run, joint);
        const bool of_layer = run->layers.main != NULL && run->laid.joint[joint].owner == PLAYER_OWNER_LAYER;
        before->goal_pos[joint] = run->laid.goal_pos[joint];
        const player_t *owner = of_layer ? &run->layers.play : &run->laid.player;
        run->asked_pos[joint] = run->layers.main != NULL ? player_asks(owner, &run->laid.joint[joint]) : 0;
        before->hand_over[joint] = run->layers.main != NULL ? run->laid.joint[joint].hand_over : 0;
        before->there[joint] = code != NULL && code->there;
    }
    memcpy(before->asked_pos[0], run->asked_pos, sizeof run->asked_pos);
}

void must_move_well(const layers_run_t *run, const before_t *before, bool layer_ended)
{
    for (uint8_t joint = 0; joint < PAGE_JOINTS; joint++) {
        const layers_code_t *code = code_of(run, joint);
        const int way = distance(run->laid.goal_pos[joint], before->goal_pos[joint]);
        ASSERT(run->laid.goal_pos[joint] <= PAGE_POS_MAX);
        if (code != NULL) {
            ASSERT(way <= most_of_code(run, code, before->there[joint]));
        } else if (run->layers.main == NULL || !has(run->laid.player.present, joint)) {
            ASSERT(way == 0);
        } else if (before->hand_over[joint] != 0) {
            ASSERT(way <= most_of_hand_over(run, joint, before, layer_ended));
        }
        if (run->layers.main != NULL && run->keeps_time && !has(run->touched, joint)) {
            ASSERT(run->laid.goal_pos[joint] == run->alone.goal_pos[joint]);
        }
    }
}

void must_end_step_well(const layers_run_t *run)
{
    const bool must = run->undisturbed && run->keeps_time && run->law == PLAYER_LAW_EXACT;
    for (uint8_t joint = 0; must && joint < PAGE_JOINTS; joint++) {
        const int apart = distance(run->laid.goal_pos[joint], run->alone.goal_pos[joint]);
        ASSERT(!has(run->whole_step & run->laid.player.present, joint) || apart <= 1);
    }
}
