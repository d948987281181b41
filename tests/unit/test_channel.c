/* SPDX-License-Identifier: MIT
 * The receive state of the channel. CRCs are CRC-16/IBM-3740 (PROTOCOL.md), calculated independently. */
#include "channel.h"
#include "shell.h"
#include "text.h"
#include "tick.h"
#include "unity.h"

#include <string.h>

static uint16_t now_ticks;
static char out[16];
static uint8_t out_count;

uint16_t tick_now16(void)
{
    return now_ticks;
}

const shell_range_t *shell_range_P(uint8_t range)
{
    (void)range;
    return NULL;
}

static void put(char character)
{
    if (out_count < sizeof out - 1) {
        out[out_count++] = character;
    }
}

void setUp(void)
{
    now_ticks = 0xFFF0;   /* the tick counter wraps soon */
    out_count = 0;
    memset(out, 0, sizeof out);
    text_init(put);
    channel_init();
}

/* Feeds all bytes and returns the event of the last one. */
static channel_event_t give(const char *bytes)
{
    channel_event_t event = CHANNEL_NONE;
    while (*bytes != '\0') {
        event = channel_byte((uint8_t)*bytes++);
    }
    return event;
}

/* Checks the request that has just ended. */
static void expect_taken(const char *line, uint8_t fault)
{
    uint8_t found;
    TEST_ASSERT_EQUAL_STRING(line, channel_take(&found));
    TEST_ASSERT_EQUAL_UINT8(fault, found);
    TEST_ASSERT_FALSE(channel_is_open());
}

static void test_a_persons_bytes_are_not_taken(void)
{
    for (uint16_t byte = 0; byte < 256; byte++) {
        if (byte != CHANNEL_BEGIN) {
            TEST_ASSERT_EQUAL_UINT8(CHANNEL_NONE, channel_byte((uint8_t)byte));
        }
    }
    TEST_ASSERT_FALSE(channel_is_open());
}

/* A refusal prints the request. An XOFF, an ESC or a byte above ASCII from a bad line must not reach the terminal. */
static void test_what_is_no_text_is_left_out(void)
{
    TEST_ASSERT_EQUAL_UINT8(CHANNEL_LINE, give("\x1e@v\x13""e\x1b\x80r\x7f \x1e\xff\x01""5F4A\r"));
    expect_taken("@ver ", SHELL_OK);
    TEST_ASSERT_EQUAL_UINT8(CHANNEL_LINE, give("\x1e@v\x13""e 5F4A\r"));
    expect_taken("@ve 5F4A", SHELL_ERR_LOSSY);
}

static void test_a_whole_request_is_run(void)
{
    TEST_ASSERT_EQUAL_UINT8(CHANNEL_PART, give("\x1e@ver "));
    TEST_ASSERT_TRUE(channel_is_open());
    TEST_ASSERT_EQUAL_UINT8(CHANNEL_LINE, give("5F4A\r"));
    expect_taken("@ver ", SHELL_OK);
    TEST_ASSERT_EQUAL_UINT8(CHANNEL_NONE, channel_byte('\r'));
}

static void test_a_changed_or_short_request_is_refused(void)
{
    static const char *const lines[][2] = {
        {"\x1e@vex 5F4A\r", "@vex 5F4A"}, {"\x1e@ver 123\r", "@ver 123"}, {"\x1e@ver 123G\r", "@ver 123G"},
        {"\x1e" "123\r", "123"}, {"\x1e\r", ""}, {"\x1e@ver\r", "@ver"}};
    for (uint8_t i = 0; i < sizeof lines / sizeof lines[0]; i++) {
        TEST_ASSERT_EQUAL_UINT8(CHANNEL_LINE, give(lines[i][0]));
        expect_taken(lines[i][1], SHELL_ERR_LOSSY);
    }
}

static void test_a_request_behind_one_that_has_lost_its_end_is_refused_with_it(void)
{
    TEST_ASSERT_EQUAL_UINT8(CHANNEL_LINE, give("\x1e@ver\x1e@ver 5F4A\r"));
    expect_taken("@ver@ver 5F4A", SHELL_ERR_LOSSY);
    TEST_ASSERT_EQUAL_UINT8(CHANNEL_LINE, give("\x1e@ver 5F4A\r"));
    expect_taken("@ver ", SHELL_OK);
}

static void test_a_request_without_an_end_is_cut_off_after_250_ms(void)
{
    (void)give("\x1e@v");
    now_ticks += 31;
    TEST_ASSERT_FALSE(channel_is_cut_off());
    (void)give("e");
    now_ticks += 31;
    TEST_ASSERT_FALSE(channel_is_cut_off());
    now_ticks++;
    TEST_ASSERT_TRUE(channel_is_cut_off());
    expect_taken("@ve", SHELL_ERR_LOSSY);
    TEST_ASSERT_FALSE(channel_is_cut_off());
    TEST_ASSERT_EQUAL_UINT8(CHANNEL_NONE, channel_byte('x'));
}

static void test_a_line_that_is_too_long_is_refused(void)
{
    (void)give("\x1e@ver ");
    for (uint16_t i = 0; i < 300; i++) {
        TEST_ASSERT_EQUAL_UINT8(CHANNEL_PART, channel_byte(' '));
    }
    TEST_ASSERT_EQUAL_UINT8(CHANNEL_LINE, give("5F4A\r"));
    uint8_t fault;
    TEST_ASSERT_EQUAL_STRING_LEN("@ver  ", channel_take(&fault), 6);
    TEST_ASSERT_EQUAL_UINT8(SHELL_ERR_LOSSY, fault);
}

static void test_what_is_printed_begins_with_the_byte(void)
{
    TEST_ASSERT_FALSE(channel_is_printing());
    channel_print_begin();
    TEST_ASSERT_TRUE(channel_is_printing());
    channel_print_end();
    TEST_ASSERT_FALSE(channel_is_printing());
    TEST_ASSERT_EQUAL_STRING("\x1e", out);
}
