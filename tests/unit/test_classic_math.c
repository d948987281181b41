/* SPDX-License-Identifier: MIT
 * test_classic_math.c - the arithmetic of the classic law against the expressions of player.md section 1, over all that
 * it may be given. */
#include <stdlib.h>
#include "classic_math.h"
#include "unity.h"

#define SPEED_MAX 1023
#define WAY_MAX 5916

void setUp(void)
{
}

void tearDown(void)
{
}

/* ((speed * c * 144 / 15) >> 9), the inner quotient toward zero, the shift down */
static int32_t plain_ramp_way(int32_t speed, int32_t c)
{
    return (speed * c * 144 / 15) >> 9;
}

static void test_way_of_a_ramp_for_every_speed_and_tick(void)
{
    for (int16_t speed = -SPEED_MAX; speed <= SPEED_MAX; speed++) {
        for (int32_t c = 1; c <= 255; c++) {
            TEST_ASSERT_EQUAL_INT32(plain_ramp_way(speed, c), ramp_way(speed, ramp_share((uint8_t)c)));
        }
        TEST_ASSERT_EQUAL_INT32(plain_ramp_way(speed, 1), first_ramp_way(speed));
    }
}

static void test_way_of_a_fall_for_every_speed_and_length(void)
{
    for (int16_t speed = -SPEED_MAX; speed <= SPEED_MAX; speed++) {
        for (int32_t ramp = 0; ramp <= 255; ramp++) {
            TEST_ASSERT_EQUAL_INT32(((int32_t)speed * ramp * 12 / 5) >> 8, fall_way(speed, (uint8_t)ramp));
        }
    }
}

/* x * c / num for every c */
static void check_shares(int16_t x, uint16_t num)
{
    player_joint_t joint;
    spread_t over = spread_over(num);
    TEST_ASSERT_EQUAL_INT32(x / num, first_share(&joint, x, over));
    for (int32_t c = 2; c <= num; c++) {
        TEST_ASSERT_EQUAL_INT32(x * c / num, next_share(&joint, num));
    }
}

static void test_shares_of_every_way_over_few_ticks(void)
{
    for (int16_t x = -WAY_MAX; x <= WAY_MAX; x++) {
        for (uint16_t num = 1; num <= 9; num++) {
            check_shares(x, num);
        }
    }
}

static void test_shares_over_many_ticks(void)
{
    static const uint16_t nums[] = {10, 16, 63, 64, 255, 256, 1023, 13640, 32767};
    for (int16_t x = -WAY_MAX; x <= WAY_MAX; x = (int16_t)(x + 493)) {
        for (size_t i = 0; i < sizeof nums / sizeof nums[0]; i++) {
            check_shares(x, nums[i]);
        }
    }
}

/* way * part / whole, part = whole - A, as at the end of RISE */
static void test_share_of_the_way_that_cruise_makes(void)
{
    for (uint16_t whole = 2; whole < 600; whole = (uint16_t)(whole + 1 + whole / 16)) {
        for (uint16_t part = 1; part < whole; part = (uint16_t)(part + 1 + part / 8)) {
            for (int16_t way = -WAY_MAX; way <= WAY_MAX; way = (int16_t)(way + 91)) {
                TEST_ASSERT_EQUAL_INT32((int32_t)way * part / whole, share_of(way, part, whole, fix_ratio(part, whole)));
            }
        }
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_way_of_a_ramp_for_every_speed_and_tick);
    RUN_TEST(test_way_of_a_fall_for_every_speed_and_length);
    RUN_TEST(test_shares_of_every_way_over_few_ticks);
    RUN_TEST(test_shares_over_many_ticks);
    RUN_TEST(test_share_of_the_way_that_cruise_makes);
    return UNITY_END();
}
