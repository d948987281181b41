/* SPDX-License-Identifier: MIT
 * player.h - plays pages: each tick (1/128 s) turns pages and links into goal positions.
 * Pure: knows neither bus nor flash; reads pages through page_source_t. Main loop only. Caller-owned state: a player_t and
 * the array of its joints (player_state.h). The laws of motion are in LAWS.md. */
#ifndef PLAYER_H
#define PLAYER_H

#include "compiler.h"
#include "link.h"
#include "player_state.h"

#define PLAYER_TICKS_PER_SECOND 128u

typedef enum {
    PLAYER_OK = 0,
    PLAYER_ERR_RANGE,        /* page 0, or not below PAGE_COUNT */
    PLAYER_ERR_PAGE,         /* the page is damaged: page_status_t in player.fault, the page in .fault_page */
    PLAYER_ERR_EMPTY,        /* the page has no steps, or PLAY_COUNT 0 and nothing playable along its link */
    PLAYER_ERR_BUSY,         /* a play is on */
    PLAYER_ERR_LAW           /* this program has no classic law (it links law_classic_none.c) */
} player_status_t;

/* Makes an idle player. The source and the array of PAGE_JOINTS joints stay the caller's. */
void player_init(player_t *player, const page_source_t *source, player_joint_t joint[PAGE_JOINTS]);

/* Starts at step 1 of `page`.
 * link     : what codes and stops do to the play, after link_call; NULL: a play without codes, which follows the next links
 * pose_pos : where the joints are, page coordinates. A joint may start outside 0..1023 by as much as its trim (-300..1323,
 *            in two's complement): its goals begin there, and its first step takes it into the range
 * present  : bit per joint that the play may move
 * Pages with PLAY_COUNT 0 are passed over: player.next.page is the page that plays first. The next player_tick makes the
 * first goals. After an error only .fault and .fault_page have changed. */
MUST_CHECK player_status_t player_start(player_t *player, link_t *link, uint8_t page, player_law_t law,
                                        const uint16_t pose_pos[PAGE_JOINTS], uint32_t present);

/* Call right after player_start: takes `joints` for being at their first positions, wherever they are, because a layer has
 * them. So they neither make the first step longer nor, given back during it, have a fast way to go. */
void player_is_there(player_t *player, uint32_t joints);

/* For player_move to the first pose of a page: fills pose_pos with the positions of step 1 of `page`, shaped, and returns
 * the bits of the joints that have one. */
uint32_t player_first_pose(const page_source_t *source, const shape_t *shape, uint8_t page, uint16_t pose_pos[PAGE_JOINTS]);

/* Moves `joints` from from_pos to player->next_pos, which the caller has set, without a page: an exact step with ramps,
 * whose length lets the longest distance keep to deg_s degrees/s (1..360), rounded up. All joints arrive together.
 * Everything else is as in a play, with NULL for the link. Returns the ticks; 0: all are within near_pos units
 * already, and nothing plays. */
uint16_t player_move(player_t *player, const uint16_t from_pos[PAGE_JOINTS], uint32_t joints, uint16_t deg_s,
                     uint8_t near_pos);

/* One tick: moves all joints. link: that of player_start. Returns PLAYER_EV_ bits; 0 when idle. */
uint8_t player_tick(player_t *player, link_t *link) NOINLINE; /* so that tools/bench can measure it */

/* Plans the coming tick: begins the next step, a section of this one, a break or a pause, or goes on after a pause, if it is
 * time for that. player_tick calls it unless the caller has. A caller that calls it as soon as the goals of a tick are on
 * their way, and after a break, pause or resume, gets the goals of every tick equally early. */
void player_plan(player_t *player, link_t *link) NOINLINE;

/* Where the play wants a joint of `present`: 0..1023, or on the way there from outside (player_start). */
uint16_t player_goal(const player_t *player, uint8_t joint);

/* Copies the goals of those joints; leaves the others. */
void player_goals(const player_t *player, uint32_t joints, uint16_t goal_pos[PAGE_JOINTS]);

/* Leaves the page at once: every joint slows down within ACCEL_TIME ticks (at least 8), without turning round; in a move
 * within its own ramp, so that one that is about to arrive arrives. */
void player_break(player_t *player);

/* Pause slows down like a break, and then waits. Resume goes on to the target of the interrupted step in the time that was
 * left, but in no less time than slowing down took; during the slowing down it takes effect at its end. */
void player_pause(player_t *player);
void player_resume(player_t *player);

bool player_is_moving(const player_t *player);   /* a play is on, also one that pauses or breaks */
bool player_is_paused(const player_t *player);   /* after player_pause, until player_resume */

/* Takes joints out of a play (torque lost, servo silent): player_goals leaves theirs as they are from now on. */
void player_drop_joints(player_t *player, uint32_t joints);

#endif
