/* SPDX-License-Identifier: MIT
 * test_fix.c - the divisions of fix.h against the plain expressions in wider integers. */
#include <stdlib.h>
#include "fix.h"
#include "unity.h"

static void test_reciprocal_of_every_number_of_ticks(void)
{
    for (uint32_t ticks = 1; ticks <= UINT16_MAX; ticks++) {
        TEST_ASSERT_EQUAL_UINT32(UINT64_C(0xFFFFFFFF) / ticks, fix_recip32((uint16_t)ticks));
    }
}

static void check_ratio(uint16_t part, uint16_t whole)
{
    const uint64_t plain = part >= whole ? 65535u : ((uint64_t)part << 16) / whole;
    TEST_ASSERT_EQUAL_UINT16(plain, fix_ratio(part, whole));
}

static void test_ratio_of_every_small_pair(void)
{
    for (uint16_t whole = 1; whole <= 700; whole++) {
        for (uint16_t part = 0; part <= whole; part++) {
            check_ratio(part, whole);
        }
    }
}

/* Both ends of the range, which use a 17th bit. */
static void test_ratio_of_large_pairs(void)
{
    for (uint32_t whole = 65000; whole <= UINT16_MAX; whole++) {
        for (uint32_t near = 0; near <= 300; near++) {
            check_ratio((uint16_t)near, (uint16_t)whole);
            check_ratio((uint16_t)(whole - near), (uint16_t)whole);
            check_ratio((uint16_t)(whole / 2 + near), (uint16_t)whole);
        }
    }
}

static void test_ratio_by_chance(void)
{
    srand(512);
    for (uint32_t i = 0; i < 300000; i++) {
        const uint16_t part = (uint16_t)rand(), whole = (uint16_t)rand();
        if (whole != 0) {
            check_ratio(part, whole);
        }
    }
}
