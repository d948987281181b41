/* SPDX-License-Identifier: MIT
 * test_mux.c - a joint with a new source: its speed towards the source, and when it has met the source. */
#include "mux.h"
#include "unity.h"

#define JOINT 30u
#define BIT (1ul << JOINT)
#define MOST 2u

static mux_t mux;

void setUp(void)
{
    mux = (mux_t){.seeking = 0};
    mux_change(&mux, BIT);
}

static uint16_t goal(uint16_t from_pos, uint16_t asked_pos)
{
    return mux_goal(&mux, JOINT, from_pos, asked_pos, MOST, true);
}

static void test_mux_goes_at_its_speed_until_it_is_there(void)
{
    TEST_ASSERT_EQUAL_UINT16(502, goal(500, 505));
    TEST_ASSERT_EQUAL_UINT16(504, goal(502, 505));
    TEST_ASSERT_EQUAL_HEX32(BIT, mux.seeking);
    TEST_ASSERT_EQUAL_UINT16(505, goal(504, 505));
    TEST_ASSERT_EQUAL_HEX32(0, mux.seeking);
    TEST_ASSERT_EQUAL_UINT16(700, goal(505, 700)); /* follows its source from now on */
}

static void test_mux_meets_a_source_that_passes_it(void)
{
    TEST_ASSERT_EQUAL_UINT16(502, goal(500, 540));
    TEST_ASSERT_EQUAL_UINT16(470, goal(502, 470));
    TEST_ASSERT_EQUAL_HEX32(0, mux.seeking);
}

/* A new source on the other side does not count as the old source passing the joint. */
static void test_mux_does_not_meet_a_source_that_is_on_the_other_side_from_the_beginning(void)
{
    TEST_ASSERT_EQUAL_UINT16(502, goal(500, 540));
    mux_change(&mux, BIT);
    TEST_ASSERT_EQUAL_UINT16(500, goal(502, 470));
    TEST_ASSERT_EQUAL_HEX32(BIT, mux.seeking);
}

static void test_mux_waits_for_a_source_that_may_not_be_met(void)
{
    TEST_ASSERT_EQUAL_UINT16(501, mux_goal(&mux, JOINT, 500, 501, MOST, false));
    TEST_ASSERT_EQUAL_UINT16(503, mux_goal(&mux, JOINT, 501, 530, MOST, false));
    TEST_ASSERT_EQUAL_UINT16(501, mux_goal(&mux, JOINT, 503, 480, MOST, false));
    TEST_ASSERT_EQUAL_HEX32(BIT, mux.seeking);
}

static void test_mux_moves_nothing_in_a_pause(void)
{
    TEST_ASSERT_EQUAL_UINT16(500, mux_goal(&mux, JOINT, 500, 540, 0, true));
    TEST_ASSERT_EQUAL_HEX32(BIT, mux.seeking);
}

static void test_mux_leads_a_joint_back_from_outside_the_range(void)
{
    TEST_ASSERT_EQUAL_UINT16(1108, goal(1110, 900));
    mux_change(&mux, BIT);
    TEST_ASSERT_EQUAL_UINT16((uint16_t)-98, goal((uint16_t)-100, 100));
    TEST_ASSERT_EQUAL_UINT16(1, goal((uint16_t)-1, 100));
    TEST_ASSERT_EQUAL_HEX32(BIT, mux.seeking);
    TEST_ASSERT_EQUAL_UINT16(0, goal((uint16_t)-2, 0));
    TEST_ASSERT_EQUAL_HEX32(0, mux.seeking);
}

static void test_mux_forgets(void)
{
    mux_forget(&mux, BIT);
    TEST_ASSERT_EQUAL_HEX32(0, mux.seeking);
    TEST_ASSERT_EQUAL_UINT16(700, goal(500, 700));
}

/* 60 degrees/s are 1.6 units a tick: 8 in 5 ticks. */
static void test_mux_speed_keeps_the_fraction(void)
{
    mux_speed_t speed = {.speed_q8_8 = mux_units_per_tick_q8_8(60)};
    uint16_t units = 0;
    for (uint8_t tick = 0; tick < 100; tick++) {
        units = (uint16_t)(units + mux_allow(&speed));
    }
    TEST_ASSERT_UINT16_WITHIN(1, 160, units);
}
