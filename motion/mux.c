/* SPDX-License-Identifier: MIT */
#include "mux.h"
#include "fix.h"

/* 1024 units / 300 degrees / 128 ticks. */
uint16_t mux_units_per_tick_q8_8(uint16_t deg_s)
{
    return (uint16_t)((uint32_t)deg_s * 512u / 75u);
}

/* SOURCE_BELOW, SOURCE_ABOVE: in the last tick the source's goal was below the joint, or above it. */
enum { MET, SEEKING, SOURCE_BELOW, SOURCE_ABOVE };

static void set_state(mux_t *mux, uint32_t joints, uint8_t state)
{
    for (uint8_t i = 0; joints != 0; i++, joints >>= 1) {
        if (((uint8_t)joints & 1u) != 0) {
            mux->state[i] = state;
        }
    }
}

void mux_change(mux_t *mux, uint32_t joints)
{
    mux->seeking |= joints;
    set_state(mux, joints, SEEKING);
}

void mux_forget(mux_t *mux, uint32_t joints)
{
    set_state(mux, joints & mux->seeking, MET);
    mux->seeking &= ~joints;
}

uint8_t mux_allow(mux_speed_t *speed)
{
    const uint16_t sum = (uint16_t)(speed->left_q8_8 + speed->speed_q8_8);
    speed->left_q8_8 = sum & 0xFFu;
    return (uint8_t)(sum >> 8);
}

uint16_t mux_goal(mux_t *mux, uint8_t joint, uint16_t from_pos, uint16_t asked_pos, uint8_t most_pos, bool may_meet)
{
    const uint8_t state = mux->state[joint];
    if (state == MET) {
        return asked_pos;
    }
    const bool is_below = fix_is_below(asked_pos, from_pos);
    const uint16_t distance = fix_distance(from_pos, asked_pos);
    const bool is_near = distance <= most_pos, has_passed = state == (is_below ? SOURCE_ABOVE : SOURCE_BELOW);
    if (may_meet && (is_near || has_passed)) {
        mux_forget(mux, (uint32_t)1 << joint);
        return asked_pos;
    }
    mux->state[joint] = is_below ? SOURCE_BELOW : SOURCE_ABOVE;
    if (is_near) {
        return asked_pos;
    }
    return (uint16_t)(is_below ? from_pos - most_pos : from_pos + most_pos);
}
