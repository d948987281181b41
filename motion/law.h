/* SPDX-License-Identifier: MIT
 * law.h - what the player's files know of each other:
 *
 *   player.c            states, ticks, break and pause
 *     sequence.c        which page and step follows; reads it
 *     law_exact.c       plans and moves the joints of a step: the law that robots run; slows joints down
 *     law_classic.c     the same by the law of the original. Programs without it link law_classic_none.c
 *
 * Each uses only files below it, and the laws do not know each other. */
#ifndef LAW_H
#define LAW_H

#include "fix.h"
#include "player.h"

/* Loops over the joints of a mask: i_ is the index, joint_ points to the joint.
 * NOLINTBEGIN(bugprone-macro-parentheses): the name of a declaration takes no parentheses */
#define FOR_JOINTS(player, joints_, i_, joint_)                                                          \
    player_joint_t *joint_ = (player)->joint;                                                            \
    uint32_t left_ = (joints_);                                                                          \
    for (uint8_t i_ = 0; left_ != 0; left_ >>= 1, (i_)++, joint_++)                                      \
        if (((uint8_t)left_ & 1u) != 0)

/* Loops over all joints, also over those that the play does not have: nobody asks for their goals. Shorter, and faster for a
 * robot with all joints. */
#define FOR_ALL_JOINTS(player, joint_) \
    for (player_joint_t *joint_ = (player)->joint; joint_ != &(player)->joint[PAGE_JOINTS]; joint_++)
/* NOLINTEND(bugprone-macro-parentheses) */

/* --- sequence.c --------------------------------------------------------------------------------------------------- */

/* Finds the page that plays first; `next` is its first step. false: there is none; only .fault and .fault_page have
 * changed. */
bool sequence_start(player_t *player, link_t *link, uint8_t page);

/* `next` becomes `now`; the step after it becomes `next`. At the last step of a page this decides the link. Returns
 * PLAYER_EV_ bits. Call it only if next.page is not 0. */
uint8_t sequence_advance(player_t *player, link_t *link);

/* Reads the positions of `next` into next_pos and next_joints, and shapes them. A joint that it does not use stays on its
 * target. */
void sequence_look(player_t *player);

/* The same with the first step of the page that the link names. Only the classic law looks at it, and only if the play
 * passes over that page or ends there (sequence_looks_elsewhere). */
bool sequence_looks_elsewhere(const player_t *player);
void sequence_look_at_named(player_t *player);

/* --- the laws ----------------------------------------------------------------------------------------------------- */

/* measure_next : sets length and pause of `next`, after sequence_look
 * plan         : plans `now` for all joints, from where they are to target_pos; the coming tick is its first
 * plan_tick    : begins the section of the step that the coming tick is the first of, if any
 * is_over      : all ticks of the step and of its pause are done
 * tick         : moves all joints by one tick; PLAYER_EV_OUTPUT if that made goals */
void exact_stand(player_joint_t *joint, uint16_t pos);
void exact_measure_next(player_t *player);
void exact_plan(player_t *player);
void exact_plan_tick(player_t *player);
bool exact_is_over(const player_t *player);
uint8_t exact_tick(player_t *player);

/* Slowing down, from position and speed in the joints' exact fields. brake_tick returns false with the last tick. */
void exact_stop_steps(player_t *player);      /* a step of the exact law ends here */
void exact_brake(player_t *player);
bool exact_brake_tick(player_t *player);

/* From a stop to target_pos: plans the rest of an interrupted step, which takes the ticks it still had, but no fewer than
 * slowing down took. false: nothing of it was left. */
bool exact_plan_rest(player_t *player);

/* used: joints that `now` uses. */
bool classic_is_there(void);                  /* whether this program has the law */
void classic_stand(player_joint_t *joint, uint16_t pos);
void classic_start(player_t *player);
void classic_finish_step(player_t *player);   /* before sequence_advance: puts the joints on their targets */
void classic_plan(player_t *player, uint32_t used);
void classic_plan_tick(player_t *player);
bool classic_is_over(const player_t *player);
uint8_t classic_tick(player_t *player);
uint8_t classic_last_sample(player_t *player); /* the tick after a play; PLAYER_EV_OUTPUT if it made goals */

/* To the joints' exact fields when the play slows down; back when the rest of the step is done. */
void classic_freeze(player_t *player);
void classic_thaw(player_t *player);

#endif
