/* SPDX-License-Identifier: MIT
 * layers_hand.c - joints change hands: each goes from where it is to its new owner's way, at the hand-over speed at most. */
#include "layers_parts.h"

/* hand_over of a joint. WAITS: its owner is about to begin a step that was planned without it. FRESH: the owner has not
 * begun a step with it. FIRST_STEP: the owner plays its first step with it. CATCHES_UP: that step is over; the joint only
 * has to catch up. ASKED_BELOW, ASKED_ABOVE: the same, and the position that the owner asked for last was below or above
 * the joint. */
enum { HAND_OVER_DONE, HAND_OVER_WAITS, HAND_OVER_FRESH, HAND_OVER_FIRST_STEP, HAND_OVER_CATCHES_UP,
       HAND_OVER_ASKED_BELOW, HAND_OVER_ASKED_ABOVE };

/* --- hand-over ---------------------------------------------------------------------------------------------------- */

uint8_t layers_allow(uint16_t *allowance_q8_8, uint16_t speed_q8_8)
{
    uint16_t sum = (uint16_t)(*allowance_q8_8 + speed_q8_8);
    *allowance_q8_8 = sum & 0xFFu;
    return (uint8_t)(sum >> 8);
}

void layers_follow_from_here(layers_t *layers, uint8_t joint, bool too_late)
{
    layers->main->joint[joint].hand_over = too_late ? HAND_OVER_WAITS : HAND_OVER_FRESH;
    layers->from_pos[joint] = layers->goal_pos[joint];
    layers->changing = true;
}

void layers_hand_back(layers_t *layers, uint32_t joints)
{
    player_t *main_play = layers->main;
    if (main_play == NULL) {
        return;
    }
    main_play->lent &= ~joints;
    FOR_JOINTS(i, joints) {
        player_give_joint(main_play, i, layers->goal_pos[i]);
        layers_follow_from_here(layers, i, main_play->arrived);
    }
}

/* --- a tick ------------------------------------------------------------------------------------------------------- */

/* A joint this near to what its owner asks for has caught up: one that is slower than the owner's page might never meet it
 * exactly. Nor might it ever be that near at a tick; so it has also caught up when what is asked for passes it. */
#define CAUGHT_UP_POS 1u

/* A play, for the joints that change hands to it. events: of this tick. */
typedef struct {
    const player_t *play;
    bool moves;
    uint8_t events;
} owner_t;

/* Where a joint that changes hands goes from `from` in this tick, by `most` at most, on its way to what its owner asks
 * for: goal, if the owner has made goals in this tick. */
ALWAYS_INLINE uint16_t follow_owner(const owner_t *owner, player_joint_t *joint, uint16_t from, uint16_t goal, uint8_t most)
{
    uint8_t hand_over = joint->hand_over;
    if (!owner->moves) { /* the joint stays */
        joint->hand_over = HAND_OVER_DONE;
        return from;
    }
    const uint8_t events = owner->events;
    if ((events & PLAYER_EV_STEP) != 0 && hand_over < HAND_OVER_CATCHES_UP) {
        hand_over++;
    }
    const uint16_t asked = (events & PLAYER_EV_OUTPUT) != 0 ? goal : player_asks(owner->play, joint);
    uint16_t at = asked;
    uint8_t next = HAND_OVER_DONE; /* it is there, or what it is asked for has passed it: they meet */
    if (asked < from) {
        const uint16_t way = (uint16_t)(from - asked);
        if (way > most && hand_over != HAND_OVER_ASKED_ABOVE) {
            at = (uint16_t)(from - most);
            next = way <= most + CAUGHT_UP_POS ? HAND_OVER_DONE : HAND_OVER_ASKED_BELOW;
        }
    } else {
        const uint16_t way = (uint16_t)(asked - from);
        if (way > most && hand_over != HAND_OVER_ASKED_BELOW) {
            at = (uint16_t)(from + most);
            next = way <= most + CAUGHT_UP_POS ? HAND_OVER_DONE : HAND_OVER_ASKED_ABOVE;
        }
    }
    joint->hand_over = (hand_over < HAND_OVER_CATCHES_UP ? hand_over : next) & 7u;
    return at;
}

void layers_follow_plays(layers_t *layers, uint8_t main_events, uint8_t layer_events)
{
    const owner_t main_play = {layers->main, player_is_moving(layers->main), main_events};
    const owner_t layer = {&layers->play, player_is_moving(&layers->play), layer_events};
    const uint8_t most = layers->paused ? 0 : layers_allow(&layers->allowance_q8_8, layers->speed_q8_8);
    player_joint_t *joint = layers->main->joint;
    uint16_t *goal = layers->goal_pos, *from = layers->from_pos;
    uint8_t changing = 0;
    for (uint8_t left = PAGE_JOINTS; left != 0; left--, joint++, goal++, from++) {
        if (joint->hand_over == HAND_OVER_DONE || joint->owner == PLAYER_OWNER_CODE) {
            continue;
        }
        *goal = *from = follow_owner(joint->owner == PLAYER_OWNER_MAIN ? &main_play : &layer, joint, *from, *goal, most);
        changing |= joint->hand_over;
    }
    layers->changing = changing != 0;
}
