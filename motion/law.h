/* SPDX-License-Identifier: MIT
 * law.h - the two laws of motion, for player.c: they plan and move the joints of a step. A program without the classic law
 * links law_classic_none.c in place of law_classic.c. */
#ifndef LAW_H
#define LAW_H

#include "fix.h"
#include "player_state.h"

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

/* What begins with exact_ moves joints while player.moving_by is the exact law, classic_ while it is the classic one:
 * start         : all joints rest on target_pos, and no step plays
 * plan          : plans `now` for all joints, from where they are to target_pos; the coming tick is its first
 * begin_section : if the coming tick is the first of a section of the step (cruise, fall, hold), plans that section
 * is_over       : all ticks of the step and of its pause are done
 * tick          : moves all joints by one tick; PLAYER_EV_OUTPUT if that made goals
 * leave_step    : a break or a pause interrupts the step: sets left_ticks, and position and speed in the exact fields */
void exact_start(player_t *player);
void exact_measure_next(player_t *player);     /* after sequence_read_next: sets length and pause of `next` */
void exact_plan(player_t *player);
void exact_begin_section(player_t *player);
bool exact_is_over(const player_t *player);
uint8_t exact_tick(player_t *player);
void exact_leave_step(player_t *player);

/* For both laws.
 * brake         : plans the slowing down, after leave_step
 * brake_tick    : moves all joints by one tick of it; false: that was the last one
 * resume        : plans what is left of the step, in left_ticks, but no fewer than slowing down took; false: nothing is */
void exact_brake(player_t *player);
bool exact_brake_tick(player_t *player);
bool exact_resume(player_t *player);

bool classic_is_there(void);                   /* whether this program has the law */
void classic_start(player_t *player);
void classic_finish_step(player_t *player);    /* before the targets of the next step are set */
void classic_plan(player_t *player);
void classic_begin_section(player_t *player);
bool classic_is_over(const player_t *player);
uint8_t classic_tick(player_t *player);
uint8_t classic_last_tick(player_t *player);   /* the tick after a play; PLAYER_EV_OUTPUT if it made goals */
void classic_leave_step(player_t *player);
void classic_take_back(player_t *player);      /* what was left of the step is done, and all joints rest */

#endif
