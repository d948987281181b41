/* SPDX-License-Identifier: MIT
 * Frames of the block protocol (firmware/boot/BLOCK_PROTOCOL.md), byte by byte. */
#include "firmware/boot/frame.h"
#include "crc16.h"
#include "unity.h"

#include <string.h>

static uint8_t bytes[FRAME_BYTES_MAX];
static frame_t frame;

void setUp(void)
{
    memset(bytes, 0, sizeof bytes);
    frame_init(&frame, bytes);
}

/* Feeds `count` bytes and returns the last status. All earlier ones must ask for more. */
static frame_status_t feed(const uint8_t *from, unsigned count)
{
    for (unsigned i = 0; i + 1 < count; i++) {
        TEST_ASSERT_EQUAL(FRAME_MORE, frame_feed(&frame, from[i]));
    }
    return frame_feed(&frame, from[count - 1]);
}

/* Builds a frame with `words` body words in `to`. Returns its length. */
static unsigned make(uint8_t *to, uint8_t command, uint8_t words)
{
    unsigned body = 2u * words;
    to[0] = FRAME_REQUEST;
    to[1] = command;
    to[2] = 7;
    to[3] = words;
    for (unsigned i = 0; i < body; i++) {
        to[4 + i] = (uint8_t)(i * 31 + command);
    }
    uint16_t crc = crc16_bytes(CRC16_START, to + 1, (uint16_t)(3 + body));
    to[4 + body] = (uint8_t)(crc >> 8);
    to[5 + body] = (uint8_t)crc;
    return 6 + body;
}

/* From BLOCK_PROTOCOL.md; the CRC is that of Python's binascii.crc_hqx(data, 0xFFFF). */
static void test_hello_of_the_manual(void)
{
    const uint8_t hello[] = {0xA5, 0x01, 0x01, 0x00, 0xC8, 0x9D};
    TEST_ASSERT_EQUAL(FRAME_GOOD, feed(hello, sizeof hello));
    TEST_ASSERT_EQUAL_UINT8(1, bytes[FRAME_AT_COMMAND]);
    TEST_ASSERT_EQUAL_UINT8(0, bytes[FRAME_AT_COUNT]);
    TEST_ASSERT_FALSE(frame_is_open(&frame));
}

static void test_every_length_up_to_the_largest(void)
{
    uint8_t raw[300];
    for (unsigned words = 0; words <= FRAME_BODY_MAX / 2; words++) {
        unsigned count = make(raw, 4, (uint8_t)words);
        TEST_ASSERT_EQUAL(FRAME_GOOD, feed(raw, count));
        TEST_ASSERT_EQUAL_MEMORY(raw + 1, bytes, count - 1);
    }
}

static void test_longer_counts_are_bad_at_once(void)
{
    for (unsigned words = FRAME_BODY_MAX / 2 + 1; words < 256; words++) {
        const uint8_t raw[] = {0xA5, 4, 1, (uint8_t)words};
        TEST_ASSERT_EQUAL(FRAME_BAD, feed(raw, 4));
        TEST_ASSERT_FALSE(frame_is_open(&frame));
    }
}

static void test_every_single_bit_error_is_found(void)
{
    uint8_t raw[300];
    unsigned count = make(raw, 4, 10);
    for (unsigned bit = 8 * 4; bit < 8 * count; bit++) { /* starts after the count, which would change the length */
        raw[bit / 8] ^= (uint8_t)(1u << bit % 8);
        TEST_ASSERT_EQUAL(FRAME_BAD, feed(raw, count));
        raw[bit / 8] ^= (uint8_t)(1u << bit % 8);
    }
    TEST_ASSERT_EQUAL(FRAME_GOOD, feed(raw, count));
}

static void test_bytes_before_a_frame_are_skipped(void)
{
    uint8_t raw[300];
    for (unsigned byte = 0; byte < 256; byte++) {
        if (byte != FRAME_REQUEST) {
            TEST_ASSERT_EQUAL(FRAME_MORE, frame_feed(&frame, (uint8_t)byte));
            TEST_ASSERT_FALSE(frame_is_open(&frame));
        }
    }
    TEST_ASSERT_EQUAL(FRAME_GOOD, feed(raw, make(raw, 1, 0)));
}

static void test_a_lost_byte_costs_at_most_the_frames_it_swallows(void)
{
    uint8_t raw[300];
    unsigned count = make(raw, 4, 129), good = 0;
    for (unsigned i = 0; i < count - 1; i++) { /* the last byte is lost */
        (void)frame_feed(&frame, raw[i]);
    }
    for (unsigned repeat = 0; repeat < 4; repeat++) {
        for (unsigned i = 0; i < count; i++) {
            good += frame_feed(&frame, raw[i]) == FRAME_GOOD;
        }
    }
    TEST_ASSERT_GREATER_OR_EQUAL_UINT(2, good);
}
