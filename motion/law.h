/* SPDX-License-Identifier: MIT
 * law.h - the seams inside the player: states (player.c), the sequence of pages and steps (sequence*.c), the two laws
 * (law_exact.c with exact_plan.c, law_classic.c with classic_plan.c and classic_pause.c), slowing down (brake.c). Included
 * by these, and by layers.c for what its own work counts.
 *
 * The work between two steps is spread over several ticks, so that none takes too long with 31 joints. A tick moves the
 * joints of both plays first; then it prepares their coming steps, as far as it has time (LAW_WORK_):
 *
 *   move     begin    in the first tick of a step: plans the joints that are not planned yet
 *            take     in the last tick: the joints are at their targets; the coming step becomes `now`; plans more joints
 *   prepare  look     decides the link at a page's last step; finds the step behind the coming one. In the last tick but
 *                     one, so that a code or a stop counts as long as it can; earlier if the play is shaped (shape.h) or a
 *                     page layer. When a main play looks depends on itself alone, not on a layer
 *            read     that step's words; with the look, if the play is not shaped
 *            shape    a share of its joints (shape_step.h), three times, if the play is shaped
 *            measure  lengths that only depend on the joints' targets
 *            plan     exact: a third of the joints, in the last tick but one; classic: as many as there is time for
 *
 * What is not prepared when the last tick comes is done by `take`.
 *
 * Functions that run once a step are NOINLINE: inlined, they would make every tick save registers. */
#ifndef LAW_H
#define LAW_H

#include <stddef.h>
#include "player.h"

/* States of a play; player.c has the diagram. */
enum { STATE_IDLE, STATE_PLAYING, STATE_BRAKING, STATE_STANDING, STATE_RESTING };

/* Ends the play. Returns PLAYER_EV_ENDED. */
static inline uint8_t law_end_play(player_t *player)
{
    player->state = STATE_IDLE;
    return PLAYER_EV_ENDED;
}

/* Sections of a step.
 *
 *  speed          ________
 *                /        \
 *      ---------/          \___________
 *      RISE        CRUISE    FALL  HOLD        ramp_ticks, ..., ramp_ticks, hold_ticks
 */
enum { SECTION_RISE, SECTION_CRUISE, SECTION_FALL, SECTION_HOLD };

/* Whether `joint` is moved by the play `self`. */
static inline bool law_owns(uint8_t self, const player_joint_t *joint)
{
    return !PLAYER_LAYERS || joint->owner == self;
}

/* Loops over the joints that this play owns; the same with their goals.
 * NOLINTBEGIN(bugprone-macro-parentheses): what a declaration names takes no parentheses */
#define FOR_OWN_JOINTS(player, joint_)                                                                               \
    const uint8_t self_ = (player)->self;                                                                            \
    player_joint_t *joint_ = (player)->joint;                                                                        \
    for (uint8_t left_ = PAGE_JOINTS; left_ != 0; left_--, joint_++)                                                 \
        if (law_owns(self_, joint_))
#define FOR_OWN_GOALS(player, joint_, goal_)                                                                         \
    const uint8_t self_ = (player)->self;                                                                            \
    uint16_t *goal_ = (player)->goal_pos;                                                                            \
    player_joint_t *joint_ = (player)->joint;                                                                        \
    for (uint8_t left_ = PAGE_JOINTS; left_ != 0; left_--, joint_++, goal_++)                                        \
        if (law_owns(self_, joint_))
/* NOLINTEND(bugprone-macro-parentheses) */

/* --- sequence.c, sequence_read.c, sequence_work.c ----------------------------------------------------------------- */

/* Finds the page that plays first and takes its first step as `coming`. false: none; only .fault and .fault_page have
 * changed. */
bool sequence_start(player_t *player, link_t *link, uint8_t page);

/* Looks at the first step. */
void sequence_look_first(player_t *player);

/* Finds and reads the step behind the coming one; decides the link at the last step of a page. Then `now` is the coming step
 * and `coming` the one behind it (page 0: the play ends behind `now`). looked_at has its words; under the classic law those
 * of the page that the link names, even if another page will be played.
 * Call only while player->coming.page is not 0. */
void sequence_look(player_t *player, link_t *link) NOINLINE;

/* Whether the play follows the classic law. In a program without that law the constant false removes all its code. */
#define LAW_IS_CLASSIC(player) (PLAYER_CLASSIC && (player)->law == PLAYER_LAW_CLASSIC)

/* How much of this work a tick has done, in units of 256 cycles on the ATmega128, roughly. Both plays count together. The
 * figures are tuned as a whole: with others, work moves to ticks that are full already. tools/bench shows it. */
#define LAW_WORK_LOOK 8u
#define LAW_WORK_READ 6u
#define LAW_WORK_SHARE 12u
#define LAW_WORK_MEASURE(player) (LAW_IS_CLASSIC(player) ? 13u : 17u)
#define LAW_WORK_TAKE 5u
#define LAW_WORK_PLAN_JOINT 2u
#define LAW_WORK_FOLLOW 8u /* joints change hands (layers.h) */
#define LAW_WORK_MOST 38u  /* with the tick itself, below 15,000 cycles */
#define LAW_WORK_AHEAD 37u /* planning ahead leaves some of it: what it does not plan has two more ticks */

static inline void law_work(player_t *player, uint8_t work)
{
    if (PLAYER_LAYERS) {
        player->work = (uint8_t)(player->work + work);
    }
}

/* Notes how many ticks the step still has behind this one. */
static inline void law_left(player_t *player, uint16_t ticks)
{
    player->left = ticks > UINT8_MAX ? UINT8_MAX : (uint8_t)ticks;
}

/* The pieces of the work for the coming step, up to its lengths, that are done at the end of a tick `left` ticks before it
 * begins (0 to SEQUENCE_AHEAD). begins: this tick has begun a step. Returns whether the law has to measure the lengths
 * now. */
bool sequence_prepare(player_t *player, link_t *link, uint8_t left, bool begins) NOINLINE;
#define SEQUENCE_AHEAD 16u        /* of a page layer, which gets neither codes nor stops */
#define SEQUENCE_AHEAD_SHAPED 6u  /* of a main play that is shaped */

/* Whether looked_at has the words of the page that the link names although another page, or none, will be played: the
 * original does so when that page is passed over or ends the play. */
bool sequence_looks_elsewhere(const player_t *player);

/* Shapes what is left of the coming step and measures its longest ways, from coming_pos to looked_at (0 where no length
 * depends on them). Then looked_at has the words of the step that will be played. */
void sequence_measure(player_t *player);

/* coming_pos to target_pos, looked_at to coming_pos, with coming_joints. Without a coming step no joint is used. Returns the
 * number of joints that the play owns. */
uint8_t sequence_take(player_t *player);

/* Begins `now`: makes it public and returns its events. 0 if no step is about to begin. */
uint8_t sequence_announce(player_t *player);

/* --- the laws ----------------------------------------------------------------------------------------------------- */

/* start: every joint stands on target_pos = coming_pos, `coming` is the first step.
 * tick: moves the joints by one tick, takes the coming step with the last one; PLAYER_EV_ bits.
 * freeze: leaves pos and speed of every joint in .exact, and the ticks that the step still had in step_ticks - tick.
 * step_over: at the end of a tick: if it was the step's last one, takes the coming step, or ends the play: exact with this
 * tick, classic with the next one.
 * prepare: behind the tick, if it was not the step's last one: the pieces of work for which there is time. */
void exact_start(player_t *player, link_t *link);
uint8_t exact_tick(player_t *player, link_t *link);
uint8_t exact_step_over(player_t *player, link_t *link);
void exact_prepare(player_t *player, link_t *link);
void exact_freeze(player_t *player);

/* The lengths that depend on the joints' targets only, in any tick after sequence_look. The classic law leaves them to take
 * if they depend on the joints' last output, or on the page that a link has named. */
void exact_measure(player_t *player) NOINLINE;
void classic_measure(player_t *player) NOINLINE;

/* A joint that stands on its target and has just become the play's: plans it if it is too late for plan ahead. */
void exact_plan_given(player_t *player, uint8_t joint);

void classic_start(player_t *player, link_t *link);
uint8_t classic_tick(player_t *player, link_t *link);
void classic_step_over(player_t *player, link_t *link);
void classic_prepare(player_t *player, link_t *link);
void classic_freeze(player_t *player);
void classic_thaw(player_t *player); /* back to the classic law after a pause, or after the rest of a step */

/* The rest of an interrupted step, from a stand to target_pos, always by the exact law. It takes as many ticks as the step
 * still had, and at least as many as slowing down took. start returns false if there is nothing left to do, tick with the
 * last tick, which is on target. */
bool exact_rest_start(player_t *player);
bool exact_rest_tick(player_t *player);

/* Moves every joint by one tick at its present speed and acceleration. */
void exact_move(player_t *player);

/* --- brake.c ------------------------------------------------------------------------------------------------------ */

/* Slows down from pos and speed in law_brake_ticks: as many as the step's ramp, at least 8. So no joint leaves the way of
 * its page. brake_tick returns false with the last tick. */
#define BRAKE_TICKS_MIN 8u
static inline uint8_t law_brake_ticks(const player_t *player)
{
    return player->ramp_ticks < BRAKE_TICKS_MIN ? BRAKE_TICKS_MIN : player->ramp_ticks;
}
void brake_start(player_t *player);
bool brake_tick(player_t *player);

#endif
