/* SPDX-License-Identifier: MIT
 * brake.c - break and pause: slows each joint from its present speed to a stand, at a constant deceleration. */
#include "fix.h"
#include "law.h"

/* Toward zero. By hand: -Os calls a division of 32 bits for value / 2, 650 cycles a joint. */
static NOINLINE int32_t half(int32_t value)
{
    uint32_t size = (uint32_t)(value < 0 ? -value : value) >> 1;
    return value < 0 ? -(int32_t)size : (int32_t)size;
}

static void set_speed(player_exact_t *exact, int32_t speed)
{
    exact->pos_q16_16 = fix_from_pos(fix_pos(exact->pos_q16_16)) + (speed < 0 ? FIX_ROUND_DOWN : FIX_ROUND_UP);
    exact->speed_q16_16 = speed;
    exact->accel_q16_16 = 0;
}

void exact_freeze(player_t *player)
{
    bool holds = !player->arrived && player->tick >= player->step_ticks;
    const player_joint_t *planned = &player->joint[player->planned];
    FOR_OWN_JOINTS(player, joint) {
        player_exact_t *exact = &joint->exact;
        if (holds) {
            set_speed(exact, 0);
        } else if (player->arrived && joint >= planned) { /* between two steps */
            int32_t speed = (int32_t)exact->exit_q16_16;
            set_speed(exact, joint->down ? -speed : speed);
        } else { /* speed is that of the coming tick: half an acceleration further on */
            exact->speed_q16_16 -= half(exact->accel_q16_16);
        }
        exact->exit_q16_16 = 0; /* what is planned next begins from a stand */
    }
}

void brake_start(player_t *player)
{
    player->brake_ticks = law_brake_ticks(player);
    uint16_t recip = fix_ramp_recip(player->brake_ticks);
    FOR_OWN_JOINTS(player, joint) {
        int32_t speed = joint->exact.speed_q16_16;
        bool down = speed < 0;
        int32_t accel = -(int32_t)fix_by_ramp((uint32_t)(down ? -speed : speed), recip, player->brake_ticks);
        if (down) {
            accel = -accel;
        }
        joint->exact.accel_q16_16 = accel;
        joint->exact.speed_q16_16 = speed + half(accel);
    }
}

/* A joint that reaches an end of its range while slowing down stops there. */
static void keep_in_range(player_exact_t *exact)
{
    int32_t pos = exact->pos_q16_16 + exact->speed_q16_16;
    if (pos < 0 || pos >= (int32_t)(PAGE_POS_MAX + 1) << FIX_POS_BITS) {
        exact->speed_q16_16 = exact->accel_q16_16 = 0;
        exact->pos_q16_16 = pos < 0 ? 0 : (int32_t)PAGE_POS_MAX << FIX_POS_BITS;
    }
}

bool brake_tick(player_t *player)
{
    FOR_OWN_JOINTS(player, joint) {
        keep_in_range(&joint->exact);
    }
    exact_move(player);
    return --player->brake_ticks != 0;
}
