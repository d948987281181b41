/* SPDX-License-Identifier: MIT
 * ring.h and debounce.h. */
#include "debounce.h"
#include "ring.h"
#include "unity.h"

#include <string.h>

static uint8_t storage[256 + 1];
static ring_t ring;

void setUp(void)
{
    memset(storage, 0xEE, sizeof storage);
}

static void test_small_ring_holds_all_its_bytes_and_refuses_the_next(void)
{
    uint8_t byte = 0x77;
    ring_init(&ring, storage, 8);
    TEST_ASSERT_EQUAL(8, ring_room(&ring));
    TEST_ASSERT_FALSE(ring_get(&ring, &byte));
    TEST_ASSERT_EQUAL_HEX8(0x77, byte);
    for (uint8_t i = 0; i < 8; i++) {
        TEST_ASSERT_TRUE(ring_put(&ring, i));
    }
    TEST_ASSERT_FALSE(ring_put(&ring, 99));
    TEST_ASSERT_EQUAL(0, ring_room(&ring));
    TEST_ASSERT_EQUAL(8, ring_count(&ring));
    for (uint8_t i = 0; i < 8; i++) {
        TEST_ASSERT_TRUE(ring_get(&ring, &byte));
        TEST_ASSERT_EQUAL(i, byte);
    }
    TEST_ASSERT_EQUAL_HEX8(0xEE, storage[8]);
}

static void test_ring_of_256_holds_255(void)
{
    ring_init(&ring, storage, 256);
    for (uint16_t i = 0; i < 255; i++) {
        TEST_ASSERT_TRUE(ring_put(&ring, (uint8_t)i));
    }
    TEST_ASSERT_FALSE(ring_put(&ring, 1));
    TEST_ASSERT_EQUAL(255, ring_count(&ring));
    TEST_ASSERT_EQUAL_HEX8(0xEE, storage[256]);
}

static void test_bytes_keep_their_order_over_many_turns(void)
{
    uint8_t in = 0, out = 0, byte;
    ring_init(&ring, storage, 16);
    for (uint16_t round = 0; round < 1000; round++) {
        for (uint8_t i = 0; i < round % 16u; i++) {
            if (ring_put(&ring, in)) {
                in++;
            }
        }
        for (uint8_t i = 0; i < round % 11u; i++) {
            if (ring_get(&ring, &byte)) {
                TEST_ASSERT_EQUAL_HEX8(out++, byte);
            }
        }
        TEST_ASSERT_EQUAL((uint8_t)(in - out), ring_count(&ring));
    }
}

static void test_clear_drops_what_waits(void)
{
    uint8_t byte;
    ring_init(&ring, storage, 4);
    (void)ring_put(&ring, 1);
    (void)ring_put(&ring, 2);
    ring_clear(&ring);
    TEST_ASSERT_FALSE(ring_get(&ring, &byte));
    TEST_ASSERT_EQUAL(4, ring_room(&ring));
}

static void test_contact_counts_after_enough_equal_samples(void)
{
    debounce_t contact;
    debounce_init(&contact, 0);
    TEST_ASSERT_EQUAL(0, debounce_sample(&contact, 1, 3));
    TEST_ASSERT_EQUAL(0, debounce_sample(&contact, 1, 3));
    TEST_ASSERT_EQUAL(1, debounce_sample(&contact, 1, 3));
    TEST_ASSERT_EQUAL(1, debounce_sample(&contact, 0, 3));
    TEST_ASSERT_EQUAL(1, debounce_sample(&contact, 1, 3));
    TEST_ASSERT_EQUAL(1, debounce_sample(&contact, 0, 3));
    TEST_ASSERT_EQUAL(1, debounce_sample(&contact, 0, 3));
    TEST_ASSERT_EQUAL(0, debounce_sample(&contact, 0, 3));
}

static void test_ring_peek_shows_the_next_byte_and_leaves_it(void)
{
    uint8_t small[4] = {0}, byte = 9;
    ring_t own;
    ring_init(&own, small, sizeof small);
    TEST_ASSERT_FALSE(ring_peek(&own, &byte));
    TEST_ASSERT_EQUAL_UINT8(9, byte);
    (void)ring_put(&own, 1);
    (void)ring_put(&own, 2);
    TEST_ASSERT_TRUE(ring_peek(&own, &byte));
    TEST_ASSERT_EQUAL_UINT8(1, byte);
    TEST_ASSERT_EQUAL_UINT8(2, ring_count(&own));
}
