/* SPDX-License-Identifier: MIT
 * test_classic_math.c - the arithmetic of the classic law against the expressions of LAWS.md section 1, over its whole
 * input range. */
#include <stdlib.h>
#include "classic_math.h"
#include "unity.h"

#define SPEED_MAX 1023
#define DISTANCE_MAX 5916

/* ((speed * c * 144 / 15) >> 9), the inner quotient toward zero, the shift down */
static int32_t plain_ramp_distance(int32_t speed, int32_t c)
{
    return (speed * c * 144 / 15) >> 9;
}

static void test_distance_of_a_ramp_for_every_speed_and_tick(void)
{
    for (int16_t speed = -SPEED_MAX; speed <= SPEED_MAX; speed++) {
        for (int32_t c = 1; c <= 255; c++) {
            TEST_ASSERT_EQUAL_INT32(plain_ramp_distance(speed, c), ramp_distance(speed, ramp_share((uint8_t)c)));
        }
    }
}

static void check_share(int16_t x, uint16_t c, uint16_t num)
{
    TEST_ASSERT_EQUAL_INT32((int32_t)x * c / num, share_of(x, part_of(c, num)));
}

static void test_share_of_every_distance_over_few_ticks(void)
{
    for (uint16_t num = 1; num <= 9; num++) {
        for (uint16_t c = 1; c <= num; c++) {
            for (int16_t x = -DISTANCE_MAX; x <= DISTANCE_MAX; x++) {
                check_share(x, c, num);
            }
        }
    }
}

static void test_share_over_many_ticks(void)
{
    static const uint16_t nums[] = {10, 16, 63, 64, 255, 256, 1023, 13640, 32767};
    for (size_t i = 0; i < sizeof nums / sizeof nums[0]; i++) {
        for (uint16_t c = 1; c <= nums[i]; c = (uint16_t)(c + 1 + nums[i] / 500)) {
            for (int16_t x = -DISTANCE_MAX; x <= DISTANCE_MAX; x = (int16_t)(x + 493)) {
                check_share(x, c, nums[i]);
            }
            check_share(32767, c, nums[i]);
            check_share(-32767, c, nums[i]);
        }
    }
}

/* K = M * 2560 / 12 */
static void test_speed_units_of_every_distance(void)
{
    for (uint16_t distance = 0; distance <= 1023; distance++) {
        TEST_ASSERT_EQUAL_UINT32((uint32_t)distance * 2560 / 12, speed_units_of(distance));
    }
}

static void check_speed(uint32_t size, uint16_t divisor)
{
    TEST_ASSERT_EQUAL_UINT16((uint16_t)(size / divisor), divide_speed(size, divisor, fix_recip32(divisor)));
}

/* |K - 2 w A| <= 218240 + 2046 A, divided by 4 (A + 1) and more, or by 1 or 4 without a ramp. */
static void test_speed_for_every_kind_of_divisor(void)
{
    for (uint32_t divisor = 8; divisor <= 65535; divisor += 1 + divisor / 50) {
        for (uint32_t size = 0; size < 218240 + 512 * divisor && size < 1u << 20; size += 1 + size / 200) {
            check_speed(size, (uint16_t)divisor);
        }
    }
    for (uint32_t size = 0; size <= 218240; size++) {
        check_speed(size, 4);
        check_speed(size, 1);
    }
}
