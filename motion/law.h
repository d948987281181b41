/* SPDX-License-Identifier: MIT
 * law.h - the seam between the player (pages, links, states: player.c) and its two laws (law_exact.c, law_classic.c).
 * Included by these only. A law sees `now` and `coming`, keeps what it needs in player_joint_t, and asks the player for
 * the next step with player_next_step. */
#ifndef LAW_H
#define LAW_H

#include "player.h"

/* Kept out of line, so that each loop over the joints has the registers for itself, and an ordinary tick does not save
 * registers for what happens once a step. */
#define RARE __attribute__((noinline))

/* Sections of a step.
 *
 *  speed          ________
 *                /        \
 *      ---------/          \___________
 *      RISE        CRUISE    FALL  HOLD        ramp_ticks, ..., ramp_ticks, hold_ticks
 */
enum { SECTION_RISE, SECTION_CRUISE, SECTION_FALL, SECTION_HOLD };

/* Looks at the next step: `now` becomes the coming step, and the one after it is found; at the last step of a page that
 * means deciding the link. The step's events are held until it begins (player_announce). A law does this one or two ticks
 * before the running step ends, so that the ticks in which a step ends and the next one begins have less to do: the link
 * is decided with the code that is in force two or three ticks (20 ms) before the page's last step begins.
 * step: receives the 64 bytes of the step to look at for joints that run through (classic: of the page that the link
 * names; exact: of the step that will really be played), those from byte `from` on: 0, or PAGE_STEP_AT_PAUSE where the words
 * have been looked at before. Valid when player_looks_ahead.
 * Call only while player->coming.page is not 0. */
void player_next_step(player_t *player, link_t *link, uint8_t step[PAGE_STEP_BYTES], uint8_t from);

/* The 64 bytes of the coming step once more. */
void player_read_coming(const player_t *player, uint8_t step[PAGE_STEP_BYTES]);

/* The primed step begins: makes `now` public and returns the held events; 0 when no step is primed. */
uint8_t player_announce(player_t *player);

bool player_looks_ahead(const player_t *player);

/* The play ends here, on target. Returns PLAYER_EV_ENDED. */
uint8_t player_end(player_t *player);

/* false while the rest of an interrupted step is played. */
bool player_is_in_law(const player_t *player);

/* The longest way that a present joint has to go in the coming step, from its coming_pos, which is still that of the
 * step before. */
uint16_t law_longest_way(const player_t *player, const uint8_t step[PAGE_STEP_BYTES]);

/* Both laws. start: every joint stands on target_pos = coming_pos = goal_pos (`step`: the bytes of the first step).
 * tick: one tick, PLAYER_EV_ bits. freeze: leaves pos and speed of every joint in the words of the exact law, and the
 * ticks that the step still had in player->step_ticks - player->tick. */
void exact_start(player_t *player, link_t *link, const uint8_t step[PAGE_STEP_BYTES]);
uint8_t exact_tick(player_t *player, link_t *link);
uint8_t exact_go_on(player_t *player, link_t *link); /* the second half of a tick: looks ahead, primes, ends */
void exact_freeze(player_t *player);
bool classic_is_here(void);
void classic_start(player_t *player, link_t *link);
uint8_t classic_tick(player_t *player, link_t *link);
void classic_freeze(player_t *player);

/* Slows down from pos and speed in law_brake_ticks: as long as the step's ramp, at least 8 ticks, so that no joint leaves
 * the way that its page would have taken it. brake_tick returns false with the last tick. */
#define BRAKE_TICKS_MIN 8u
static inline uint8_t law_brake_ticks(const player_t *player)
{
    return player->ramp_ticks < BRAKE_TICKS_MIN ? BRAKE_TICKS_MIN : player->ramp_ticks;
}
void brake_start(player_t *player);
bool brake_tick(player_t *player);

/* One tick's way at the present speed and acceleration of every joint. */
void exact_move(player_t *player);

/* The rest of an interrupted step, from a stand to target_pos, by the exact law whatever the play's, in the ticks that the
 * step still had, but at least in those that slowing down took. Start returns false
 * when there is nothing left to do; a tick false when it was the last, on target. */
bool exact_rest_start(player_t *player);
bool exact_rest_tick(player_t *player);

/* The classic law's work ahead (classic_ahead.c). prepare: a share of the coming step: a look at it, then up to `count`
 * joints; all: what is left of it. pace: how large the shares are in a step of `ticks`. work_ahead: the share of this tick,
 * in which perhaps a section changed or the step began; returns whether it looked at the step. */
void classic_prepare(player_t *player, uint8_t count);
void classic_prepare_all(player_t *player);
bool classic_knows_behind(const player_t *player);
uint8_t classic_pace(uint16_t ticks);
bool classic_work_ahead(player_t *player, bool change, bool begins);

/* Classic while and after that: makes the coming step ready; takes over again behind the finished step. */
void classic_prepare_at_rest(player_t *player);
void classic_thaw(player_t *player);

#endif
