/* SPDX-License-Identifier: MIT
 * Dynamixel frames. Known answers: the worked examples of the AX-12 manual, and sums made by hand. */
#include "dxl_packet.h"
#include "unity.h"

#include <string.h>

static const uint8_t *found;
static uint8_t packet[32];

void setUp(void)
{
    found = NULL;
    memset(packet, 0xEE, sizeof packet);
}

/* Feeds the bytes one by one and returns the last result. There must be none before it. */
static dxl_result_t feed(const uint8_t *bytes, uint8_t count)
{
    for (uint8_t i = 0; i < count; i++) {
        TEST_ASSERT_EQUAL(DXL_MORE, dxl_find_status(bytes, i, &found));
    }
    return dxl_find_status(bytes, count, &found);
}
static uint8_t wire[80];
#define FEED(...) (memcpy(wire, (const uint8_t[]){ __VA_ARGS__ }, sizeof((const uint8_t[]){ __VA_ARGS__ })), \
                   feed(wire, sizeof((const uint8_t[]){ __VA_ARGS__ })))

static void test_build_ping_of_id_1_is_the_manuals_example(void)
{
    static const uint8_t expected[] = { 0xFF, 0xFF, 0x01, 0x02, 0x01, 0xFB };
    TEST_ASSERT_EQUAL(6, dxl_build(packet, 1, DXL_PING, NULL, 0));
    TEST_ASSERT_EQUAL_HEX8_ARRAY(expected, packet, 6);
    TEST_ASSERT_EQUAL_HEX8(0xEE, packet[6]);
}

static void test_build_read_of_temperature_is_the_manuals_example(void)
{
    static const uint8_t expected[] = { 0xFF, 0xFF, 0x01, 0x04, 0x02, 0x2B, 0x01, 0xCC };
    static const uint8_t asked[] = { DXL_AT_TEMPERATURE, 1 };
    TEST_ASSERT_EQUAL(8, dxl_build(packet, 1, DXL_READ, asked, 2));
    TEST_ASSERT_EQUAL_HEX8_ARRAY(expected, packet, 8);
}

static void test_build_sync_write_by_hand_is_the_manuals_example(void)
{
    /* Goal and speed of four servos: LEN = (4 + 1) * 4 + 4 = 24, sum 0x12 (AX-12 manual, SYNC WRITE example). */
    static const uint8_t data[] = { 0x00, 0x10, 0x00, 0x50, 0x01, 0x01, 0x20, 0x02, 0x60, 0x03,
                                    0x02, 0x30, 0x00, 0x70, 0x01, 0x03, 0x20, 0x02, 0x80, 0x03 };
    dxl_writer_t writer;
    dxl_begin(&writer, packet, DXL_BROADCAST, DXL_SYNC_WRITE);
    dxl_put(&writer, DXL_AT_GOAL);
    dxl_put(&writer, 4);
    for (uint8_t i = 0; i < sizeof data; i++) {
        dxl_put(&writer, data[i]);
    }
    TEST_ASSERT_EQUAL(28, dxl_end(&writer));
    TEST_ASSERT_EQUAL_HEX8(0xFE, packet[2]);
    TEST_ASSERT_EQUAL_HEX8(0x18, packet[3]);
    TEST_ASSERT_EQUAL_HEX8(0x83, packet[4]);
    TEST_ASSERT_EQUAL_HEX8(0x12, packet[27]);
}

static void test_status_without_parameters_is_found(void)
{
    TEST_ASSERT_EQUAL(DXL_GOOD, FEED(0xFF, 0xFF, 0x01, 0x02, 0x00, 0xFC));
    TEST_ASSERT_EQUAL_PTR(wire, found);
}

static void test_status_with_parameters_and_error_is_found(void)
{
    TEST_ASSERT_EQUAL(DXL_GOOD, FEED(0xFF, 0xFF, 0x01, 0x03, 0x00, 0x20, 0xDB));
    TEST_ASSERT_EQUAL(DXL_GOOD, FEED(0xFF, 0xFF, 0x07, 0x04, 0x21, 0x00, 0x02, 0xD1));
    TEST_ASSERT_EQUAL_HEX8(DXL_ERR_OVERLOAD | DXL_ERR_VOLTAGE, found[4]);
}

static void test_noise_and_extra_header_bytes_are_skipped(void)
{
    TEST_ASSERT_EQUAL(DXL_GOOD, FEED(0x12, 0xFF, 0x00, 0xFF, 0xFF, 0xFF, 0xFF, 0x01, 0x02, 0x00, 0xFC));
    TEST_ASSERT_EQUAL_PTR(wire + 5, found);
}

static void test_ff_inside_a_packet_is_data(void)
{
    /* 5 + 4 + 0 + FF + FF = 0x207, ~07 = F8 */
    TEST_ASSERT_EQUAL(DXL_GOOD, FEED(0xFF, 0xFF, 0x05, 0x04, 0x00, 0xFF, 0xFF, 0xF8));
    TEST_ASSERT_EQUAL_PTR(wire, found);
}

static void test_wrong_checksum_is_named(void)
{
    TEST_ASSERT_EQUAL(DXL_BAD_CHECKSUM, FEED(0xFF, 0xFF, 0x01, 0x02, 0x00, 0xFD));
    TEST_ASSERT_NULL(found);
}

static void test_lengths_that_no_answer_has_are_refused(void)
{
    TEST_ASSERT_EQUAL(DXL_BAD_LENGTH, FEED(0xFF, 0xFF, 0x01, 0x01));
    TEST_ASSERT_EQUAL(DXL_BAD_LENGTH, FEED(0xFF, 0xFF, 0x01, DXL_ANSWER_PARAMS + 3u));
}

static void test_longest_answer_is_found(void)
{
    uint8_t count = 0, sum = 1 + DXL_ANSWER_PARAMS + 2;
    static const uint8_t head[] = { 0xFF, 0xFF, 0x01, DXL_ANSWER_PARAMS + 2u, 0x00 };
    memcpy(wire, head, sizeof head);
    for (count = 0; count < DXL_ANSWER_PARAMS; count++) {
        wire[sizeof head + count] = count;
        sum = (uint8_t)(sum + count);
    }
    wire[sizeof head + count] = (uint8_t)~sum;
    TEST_ASSERT_EQUAL(DXL_GOOD, feed(wire, DXL_ANSWER_PARAMS + 6u));
}
