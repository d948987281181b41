/* SPDX-License-Identifier: MIT
 * The RC-100 parser: packets as in REMOTE.md, mixed with typed text and with torn and broken packets. */
#include "remote.h"

#include <stddef.h>
#include <string.h>
#include "unity.h"

static remote_t remote;
static char typed[64];
static uint8_t typed_count;
static uint8_t packets;

void setUp(void)
{
    remote_init(&remote);
    memset(typed, 0, sizeof typed);
    typed_count = 0;
    packets = 0;
}

static void take(remote_event_t event)
{
    if (event == REMOTE_PACKET) {
        packets++;
    } else if (event == REMOTE_TEXT) {
        memcpy(typed + typed_count, remote.text, remote.text_count);
        typed_count = (uint8_t)(typed_count + remote.text_count);
    }
}

static void feed(const uint8_t *bytes, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        take(remote_byte(&remote, bytes[i]));
    }
}

#define FEED(...)                                         \
    do {                                                  \
        static const uint8_t bytes[] = {__VA_ARGS__};     \
        feed(bytes, sizeof bytes);                        \
    } while (0)

/* Known answer from the RC-100 e-manual's packet format: buttons 2 + 3 are 32 + 64 = 0x60. */
static void test_remote_good_packet_gives_buttons(void)
{
    FEED(0xFF, 0x55, 0x60, 0x9F, 0x00, 0xFF);
    TEST_ASSERT_EQUAL_UINT8(1, packets);
    TEST_ASSERT_EQUAL_HEX16(REMOTE_BUTTON2 | REMOTE_BUTTON3, remote.buttons);
    TEST_ASSERT_EQUAL_UINT16(0, remote.dropped);
}

static void test_remote_high_byte_holds_buttons_5_and_6(void)
{
    FEED(0xFF, 0x55, 0x01, 0xFE, 0x02, 0xFD);
    TEST_ASSERT_EQUAL_HEX16(REMOTE_BUTTON6 | REMOTE_UP, remote.buttons);
}

static void test_remote_release_is_a_packet_of_0(void)
{
    FEED(0xFF, 0x55, 0x00, 0xFF, 0x00, 0xFF);
    TEST_ASSERT_EQUAL_UINT8(1, packets);
    TEST_ASSERT_EQUAL_HEX16(0, remote.buttons);
}

static void test_remote_text_passes(void)
{
    FEED('p', 'l', 'a', 'y', '\r');
    TEST_ASSERT_EQUAL_STRING("play\r", typed);
    TEST_ASSERT_EQUAL_UINT8(0, packets);
}

static void test_remote_packet_in_the_middle_of_a_word_splits_nothing(void)
{
    FEED('p', 'l', 0xFF, 0x55, 0x10, 0xEF, 0x00, 0xFF, 'a', 'y');
    TEST_ASSERT_EQUAL_STRING("play", typed);
    TEST_ASSERT_EQUAL_UINT8(1, packets);
}

static void test_remote_text_may_hold_0x55(void)
{
    FEED('U', 'p'); /* 'U' is 0x55 */
    TEST_ASSERT_EQUAL_STRING("Up", typed);
}

static void test_remote_wrong_complement_is_dropped(void)
{
    FEED(0xFF, 0x55, 0x10, 0xEE, 0x00, 0xFF, 'x');
    TEST_ASSERT_EQUAL_UINT8(0, packets);
    FEED(0xFF, 0x55, 0x10, 0xEF, 0x01, 0xFF, 0xFF, 0x55, 0x20, 0xDF, 0x00, 0xFF);
    TEST_ASSERT_EQUAL_UINT8(1, packets);
    TEST_ASSERT_EQUAL_HEX16(0x20, remote.buttons);
}

/* Every torn packet, 1..5 bytes long, before a good one. The FF of the good packet completes the torn one of five bytes
 * and still begins its own. */
static void test_remote_torn_packet_does_not_cost_the_next(void)
{
    static const uint8_t torn[] = {0xFF, 0x55, 0x10, 0xEF, 0x00};
    for (uint8_t length = 1; length <= sizeof torn; length++) {
        setUp();
        feed(torn, length);
        FEED(0xFF, 0x55, 0x40, 0xBF, 0x00, 0xFF);
        TEST_ASSERT_EQUAL_UINT8(length == 5 ? 2 : 1, packets);
        TEST_ASSERT_EQUAL_HEX16(0x40, remote.buttons);
        TEST_ASSERT_EQUAL_UINT16(length == 5 ? 0 : length, remote.dropped);
        TEST_ASSERT_EQUAL_STRING("", typed);
    }
}

/* Any one byte of the first packet is lost; the second packet is received. */
static void test_remote_lost_byte_does_not_cost_the_next(void)
{
    static const uint8_t packet[] = {0xFF, 0x55, 0x10, 0xEF, 0x00, 0xFF};
    for (uint8_t lost = 0; lost < sizeof packet; lost++) {
        setUp();
        feed(packet, lost);
        feed(packet + lost + 1, (size_t)(sizeof packet - lost - 1));
        FEED(0xFF, 0x55, 0x40, 0xBF, 0x00, 0xFF);
        TEST_ASSERT_EQUAL_HEX16(0x40, remote.buttons);
    }
}

static void test_remote_u_typed_right_behind_a_packet_is_text(void)
{
    FEED(0xFF, 0x55, 0x10, 0xEF, 0x00, 0xFF, 'U', 'p', ' ', '1');
    TEST_ASSERT_EQUAL_STRING("Up 1", typed);
    FEED(0xFF, 0x55, 0x10, 0xEF, 0x00, 0xFF, 'U');
    take(remote_quiet(&remote));
    TEST_ASSERT_EQUAL_STRING("Up 1U", typed);
    FEED(0xFF, 0x55, 0x10, 0xEF, 0x00, 0xFF, 'U', 'x', 0xFF, 0x55, 0x20, 0xDF, 0x00, 0xFF);
    TEST_ASSERT_EQUAL_STRING("Up 1UUx", typed);
    TEST_ASSERT_EQUAL_UINT8(4, packets);
    TEST_ASSERT_EQUAL_UINT16(0, remote.dropped);
}

/* Button 6: the last byte is not an FF that could begin a next packet. */
static void test_remote_text_behind_a_packet_that_ends_without_ff(void)
{
    FEED(0xFF, 0x55, 0x10, 0xEF, 0x02, 0xFD, 'U', 'p', 0xFF, 0x55, 0x10, 0xEF, 0x02, 0xFD, '1');
    TEST_ASSERT_EQUAL_STRING("Up1", typed);
    TEST_ASSERT_EQUAL_UINT8(2, packets);
    TEST_ASSERT_EQUAL_UINT16(0, remote.dropped);
}

/* A typed name with a non-ASCII letter must not become another name. */
static void test_remote_bytes_above_0x7f_outside_packets_are_typed_as_question_marks(void)
{
    FEED('g', 'r', 0xC3, 0xBC, 'n', 0xFF, 0x55, 0x04, 0xFB, 0x00, 0xFF, '1');
    TEST_ASSERT_EQUAL_STRING("gr??n1", typed);
    TEST_ASSERT_EQUAL_UINT8(1, packets);
    TEST_ASSERT_EQUAL_UINT16(0, remote.dropped);
}

static void test_remote_run_of_ff_before_packet(void)
{
    FEED(0xFF, 0xFF, 0xFF, 0x55, 0x04, 0xFB, 0x00, 0xFF);
    TEST_ASSERT_EQUAL_UINT8(1, packets);
    TEST_ASSERT_EQUAL_HEX16(REMOTE_LEFT, remote.buttons);
}

static void test_remote_lone_ff_costs_no_text(void)
{
    FEED(0xFF, 'o', 'k');
    TEST_ASSERT_EQUAL_STRING("ok", typed);
    TEST_ASSERT_EQUAL_UINT16(1, remote.dropped);
}

static void test_remote_quiet_gives_up_an_unfinished_packet(void)
{
    FEED(0xFF, 0x55);
    take(remote_quiet(&remote));
    FEED('h', 'i');
    TEST_ASSERT_EQUAL_STRING("hi", typed);
    TEST_ASSERT_EQUAL_UINT16(2, remote.dropped);
}

/* All 65,536 button words back to back; on the chip only one in TEST_STRIDE. */
static void test_remote_every_word_is_heard(void)
{
    for (uint32_t word = 0; word < 0x10000; word += TEST_STRIDE) {
        const uint8_t low = (uint8_t)word, high = (uint8_t)(word >> 8);
        const uint8_t bytes[] = {0xFF, 0x55, low, (uint8_t)~low, high, (uint8_t)~high};
        packets = 0;
        feed(bytes, sizeof bytes);
        TEST_ASSERT_EQUAL_UINT8(1, packets);
        TEST_ASSERT_EQUAL_HEX16(word, remote.buttons);
    }
}

static void test_remote_act_follows_the_code_table(void)
{
    static const struct {
        uint16_t buttons;
        uint8_t act, code;
    } rows[] = {
        {0, REMOTE_ACT_CODE, 0},
        {REMOTE_UP, REMOTE_ACT_CODE, 1},
        {REMOTE_DOWN | REMOTE_RIGHT, REMOTE_ACT_CODE, 10},
        {REMOTE_BUTTON1, REMOTE_ACT_CODE, 16},
        {REMOTE_BUTTON4 | REMOTE_UP, REMOTE_ACT_CODE, 129},
        {254, REMOTE_ACT_CODE, 254},
        {255, REMOTE_ACT_STOP, 255},
        {REMOTE_BUTTON5, REMOTE_ACT_PAUSE, 0},
        {REMOTE_BUTTON5 | REMOTE_UP, REMOTE_ACT_CODE, 1},
    };
    uint8_t code;
    for (uint8_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        TEST_ASSERT_EQUAL_UINT8(rows[i].act, remote_act(rows[i].buttons, &code));
        TEST_ASSERT_EQUAL_UINT8(rows[i].code, code);
    }
    for (uint16_t chord = 0; chord < 512; chord++) {
        TEST_ASSERT_EQUAL_UINT8(REMOTE_ACT_STOP, remote_act(REMOTE_BUTTON6 | chord, &code));
    }
}
