/* SPDX-License-Identifier: MIT */
#include "layers_stage.h"

#include <string.h>
#include "unity.h"

player_t player;
player_joint_t joints[PAGE_JOINTS];
uint16_t goal_pos[PAGE_JOINTS];
link_t l;
layers_t layers;

void layers_stage_reset(void)
{
    memset(joints, 0, sizeof joints);
    layers_init(&layers, goal_pos);
}

void layers_stage_start(uint8_t page, player_law_t law)
{
    uint16_t pose[PAGE_JOINTS];
    for (uint8_t i = 0; i < PAGE_JOINTS; i++) {
        goal_pos[i] = (layers.code.joints >> i & 1u) != 0 ? goal_pos[i] : 512;
        pose[i] = goal_pos[i];
    }
    player_init(&player, &sparse_source, joints);
    link_init(&l, LINK_LATCH);
    TEST_ASSERT_EQUAL(PLAYER_OK, player_start(&player, &l, page, law, pose, ALL));
    layers_bind(&layers, &player);
}
