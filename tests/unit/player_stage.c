/* SPDX-License-Identifier: MIT */
#include "player_stage.h"

#include "unity.h"

player_t player;
static player_joint_t joints[PAGE_JOINTS];
link_t l;
uint16_t pose[PAGE_JOINTS];

void setUp(void)
{
    sparse_clear();
    for (uint8_t i = 0; i < PAGE_JOINTS; i++) {
        pose[i] = 512;
    }
    player_init(&player, &sparse_source, joints);
    link_init(&l, LINK_LATCH);
}

void start_law(uint8_t page, player_law_t law)
{
    TEST_ASSERT_EQUAL(PLAYER_OK, player_start(&player, &l, page, law, pose, ALL));
}

void start(uint8_t page)
{
    start_law(page, PLAYER_LAW_EXACT);
}

uint16_t run_until(uint8_t events, uint8_t *seen)
{
    for (uint16_t tick = 1; tick < TICKS_MAX; tick++) {
        *seen = player_tick(&player, &l);
        if ((*seen & events) != 0) {
            return tick;
        }
    }
    TEST_FAIL_MESSAGE("never");
    return 0;
}

uint16_t run_to_end(void)
{
    uint8_t seen;
    return run_until(PLAYER_EV_ENDED, &seen);
}
