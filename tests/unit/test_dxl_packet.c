/* SPDX-License-Identifier: MIT
 * Dynamixel frames. Known answers are the worked examples of the AX-12 manual and sums made by hand. */
#include "dxl_packet.h"
#include "unity.h"

#include <string.h>

static dxl_parser_t parser;
static uint8_t params[DXL_ANSWER_PARAMS];
static uint8_t packet[32];

void setUp(void)
{
    dxl_parser_init(&parser, params);
    memset(packet, 0xEE, sizeof packet);
}

void tearDown(void)
{
}

/* Feeds all bytes; the last result. Every byte before the last must lead to DXL_MORE. */
static dxl_result_t feed(const uint8_t *bytes, uint8_t count)
{
    for (uint8_t i = 0; i + 1u < count; i++) {
        TEST_ASSERT_EQUAL(DXL_MORE, dxl_parser_byte(&parser, bytes[i]));
    }
    return dxl_parser_byte(&parser, bytes[count - 1]);
}
#define FEED(...) feed((const uint8_t[]){ __VA_ARGS__ }, sizeof((const uint8_t[]){ __VA_ARGS__ }))

static void test_build_ping_of_id_1_is_the_manuals_example(void)
{
    static const uint8_t expected[] = { 0xFF, 0xFF, 0x01, 0x02, 0x01, 0xFB };
    TEST_ASSERT_EQUAL(6, dxl_build(packet, 1, DXL_PING, NULL, 0));
    TEST_ASSERT_EQUAL_HEX8_ARRAY(expected, packet, 6);
    TEST_ASSERT_EQUAL_HEX8(0xEE, packet[6]);
}

static void test_parser_may_store_parameters_over_what_it_has_read(void)
{
    uint8_t bytes[] = { 0xFF, 0xFF, 0x07, 0x04, 0x21, 0x34, 0x02, 0x9D };
    dxl_parser_init(&parser, bytes);
    TEST_ASSERT_EQUAL(DXL_GOOD, feed(bytes, sizeof bytes));
    TEST_ASSERT_EQUAL_HEX8(0x34, bytes[0]);
    TEST_ASSERT_EQUAL_HEX8(0x02, bytes[1]);
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

static void test_parser_takes_a_status_without_parameters(void)
{
    TEST_ASSERT_EQUAL(DXL_GOOD, FEED(0xFF, 0xFF, 0x01, 0x02, 0x00, 0xFC));
    TEST_ASSERT_EQUAL(1, parser.id);
    TEST_ASSERT_EQUAL(0, parser.error);
    TEST_ASSERT_EQUAL(0, parser.count);
}

static void test_parser_takes_parameters_and_error(void)
{
    TEST_ASSERT_EQUAL(DXL_GOOD, FEED(0xFF, 0xFF, 0x01, 0x03, 0x00, 0x20, 0xDB));
    TEST_ASSERT_EQUAL(1, parser.count);
    TEST_ASSERT_EQUAL_HEX8(0x20, parser.params[0]);
    TEST_ASSERT_EQUAL(DXL_GOOD, FEED(0xFF, 0xFF, 0x07, 0x04, 0x21, 0x00, 0x02, 0xD1));
    TEST_ASSERT_EQUAL_HEX8(DXL_ERR_OVERLOAD | DXL_ERR_VOLTAGE, parser.error);
    TEST_ASSERT_EQUAL(2, parser.count);
}

static void test_parser_skips_noise_and_extra_header_bytes(void)
{
    TEST_ASSERT_EQUAL(DXL_GOOD, FEED(0x12, 0xFF, 0x00, 0xFF, 0xFF, 0xFF, 0xFF, 0x01, 0x02, 0x00, 0xFC));
    TEST_ASSERT_EQUAL(1, parser.id);
}

static void test_parser_takes_ff_inside_a_packet_as_data(void)
{
    /* 5 + 4 + 0 + FF + FF = 0x207, ~07 = F8 */
    TEST_ASSERT_EQUAL(DXL_GOOD, FEED(0xFF, 0xFF, 0x05, 0x04, 0x00, 0xFF, 0xFF, 0xF8));
    TEST_ASSERT_EQUAL_HEX8(0xFF, parser.params[1]);
}

static void test_parser_names_a_wrong_checksum_and_goes_on(void)
{
    TEST_ASSERT_EQUAL(DXL_BAD_CHECKSUM, FEED(0xFF, 0xFF, 0x01, 0x02, 0x00, 0xFD));
    TEST_ASSERT_TRUE(dxl_parser_is_empty(&parser));
    TEST_ASSERT_EQUAL(DXL_GOOD, FEED(0xFF, 0xFF, 0x01, 0x02, 0x00, 0xFC));
}

static void test_parser_refuses_lengths_that_no_answer_has(void)
{
    TEST_ASSERT_EQUAL(DXL_BAD_LENGTH, FEED(0xFF, 0xFF, 0x01, 0x01));
    TEST_ASSERT_EQUAL(DXL_BAD_LENGTH, FEED(0xFF, 0xFF, 0x01, DXL_ANSWER_PARAMS + 3u));
    TEST_ASSERT_EQUAL(DXL_GOOD, FEED(0xFF, 0xFF, 0x01, 0x02, 0x00, 0xFC));
}

static void test_parser_takes_the_longest_answer(void)
{
    uint8_t sum = 1 + DXL_ANSWER_PARAMS + 2;
    FEED(0xFF, 0xFF, 0x01, DXL_ANSWER_PARAMS + 2u, 0x00);
    for (uint8_t i = 0; i < DXL_ANSWER_PARAMS; i++) {
        TEST_ASSERT_EQUAL(DXL_MORE, dxl_parser_byte(&parser, i));
        sum = (uint8_t)(sum + i);
    }
    TEST_ASSERT_EQUAL(DXL_GOOD, dxl_parser_byte(&parser, (uint8_t)~sum));
    TEST_ASSERT_EQUAL(DXL_ANSWER_PARAMS, parser.count);
    TEST_ASSERT_EQUAL(DXL_ANSWER_PARAMS - 1, parser.params[DXL_ANSWER_PARAMS - 1]);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_build_ping_of_id_1_is_the_manuals_example);
    RUN_TEST(test_parser_may_store_parameters_over_what_it_has_read);
    RUN_TEST(test_build_read_of_temperature_is_the_manuals_example);
    RUN_TEST(test_build_sync_write_by_hand_is_the_manuals_example);
    RUN_TEST(test_parser_takes_a_status_without_parameters);
    RUN_TEST(test_parser_takes_parameters_and_error);
    RUN_TEST(test_parser_skips_noise_and_extra_header_bytes);
    RUN_TEST(test_parser_takes_ff_inside_a_packet_as_data);
    RUN_TEST(test_parser_names_a_wrong_checksum_and_goes_on);
    RUN_TEST(test_parser_refuses_lengths_that_no_answer_has);
    RUN_TEST(test_parser_takes_the_longest_answer);
    return UNITY_END();
}
