/* SPDX-License-Identifier: MIT
 * The half-duplex engine; the test plays UART, wire and clock. Times from DYNAMIXEL.md: 10 us a character at 1 Mbps,
 * return delay up to 508 us. */
#include "bus_core.h"
#include "bus_port.h"
#include "unity.h"

#include <string.h>

static bus_core_t core;
static uint16_t now;
static uint8_t sends, listens;
static uint8_t sent_count;
static bus_answer_t answer;

void bus_port_send(uint8_t count)
{
    TEST_ASSERT_EQUAL(BUS_SENDING, core.state);
    sends++;
    sent_count = count;
}

void bus_port_listen(void)
{
    listens++;
}

TARGET_BUS_TIME bus_port_margin_half_us(void)
{
    return 600u;
}

void setUp(void)
{
    bus_core_init(&core);
    now = 65000;   /* the clock wraps during the tests */
    sends = 0;
    listens = 0;
    memset(&answer, 0xEE, sizeof answer);
}

static bus_status_t poll_after_us(uint16_t us)
{
    now = (uint16_t)(now + 2u * us);
    return bus_core_poll(&core, now, &answer);
}

/* Submits a READ of two bytes and lets the packet start. */
static void ask(uint8_t id, uint8_t tries)
{
    static const uint8_t params[2] = { DXL_AT_PRESENT, 2 };
    uint8_t size = dxl_build(core.packet, id, DXL_READ, params, 2);
    TEST_ASSERT_EQUAL(BUS_PENDING, bus_core_submit(&core, size, 2, tries));
}

static void leave(void)
{
    bus_core_on_last(&core);
    bus_core_on_sent(&core, now);
}

static void hear(const uint8_t *bytes, uint8_t count)
{
    for (uint8_t i = 0; i < count; i++) {
        bus_core_on_byte(&core, bytes[i], 0);
    }
}

static const uint8_t good_answer[] = { 0xFF, 0xFF, 0x03, 0x04, 0x00, 0x00, 0x02, 0xF6 };

static void test_submit_sends_the_whole_packet_once(void)
{
    ask(3, 1);
    TEST_ASSERT_EQUAL(1, sends);
    TEST_ASSERT_EQUAL(8, sent_count);
    TEST_ASSERT_EQUAL(BUS_PENDING, poll_after_us(1));
    TEST_ASSERT_EQUAL(BUS_ERR_BUSY, bus_core_submit(&core, 6, 0, 1));
    TEST_ASSERT_EQUAL(1, sends);
}

static void test_line_is_turned_on_transmit_complete_only(void)
{
    ask(3, 1);
    bus_core_on_sent(&core, now);      /* a stale transmit complete while bytes are still to be sent */
    TEST_ASSERT_EQUAL(0, listens);
    bus_core_on_last(&core);
    TEST_ASSERT_EQUAL(BUS_TURNING, core.state);
    TEST_ASSERT_EQUAL(BUS_PENDING, poll_after_us(5));
    TEST_ASSERT_EQUAL(0, listens);
    bus_core_on_sent(&core, now);
    TEST_ASSERT_EQUAL(1, listens);
    TEST_ASSERT_EQUAL(BUS_LISTENING, core.state);
}

static void test_answer_is_delivered(void)
{
    ask(3, 1);
    leave();
    hear(good_answer, 7);
    TEST_ASSERT_EQUAL(BUS_PENDING, poll_after_us(70));
    hear(good_answer + 7, 1);
    TEST_ASSERT_EQUAL(BUS_OK, poll_after_us(10));
    TEST_ASSERT_EQUAL(3, answer.id);
    TEST_ASSERT_EQUAL(0, answer.error);
    TEST_ASSERT_EQUAL(2, answer.count);
    TEST_ASSERT_EQUAL_HEX8(0x00, answer.params[0]);
    TEST_ASSERT_EQUAL_HEX8(0x02, answer.params[1]);
    TEST_ASSERT_EQUAL(1, core.counts.answers);
    TEST_ASSERT_EQUAL(BUS_OK, poll_after_us(1));
}

static void test_no_answer_expected_ends_with_transmit_complete(void)
{
    uint8_t size = dxl_build(core.packet, DXL_BROADCAST, DXL_ACTION, NULL, 0);
    TEST_ASSERT_EQUAL(BUS_PENDING, bus_core_submit(&core, size, BUS_NO_ANSWER, 1));
    bus_core_on_last(&core);
    TEST_ASSERT_EQUAL(BUS_PENDING, poll_after_us(5));
    bus_core_on_sent(&core, now);
    TEST_ASSERT_EQUAL(BUS_OK, poll_after_us(1));
    TEST_ASSERT_EQUAL(1, listens);
    TEST_ASSERT_EQUAL(BUS_IDLE, core.state);
}

static void test_silence_is_a_timeout_after_the_longest_return_delay(void)
{
    ask(3, 1);
    leave();
    TEST_ASSERT_EQUAL(BUS_PENDING, poll_after_us(508 + 30));
    TEST_ASSERT_EQUAL(BUS_ERR_TIMEOUT, poll_after_us(400));
    TEST_ASSERT_EQUAL(1, core.counts.timeouts);
    TEST_ASSERT_EQUAL(0, core.counts.retries);
    TEST_ASSERT_EQUAL(BUS_IDLE, core.state);
}

static void test_answer_that_stops_half_way_is_a_timeout(void)
{
    ask(3, 1);
    leave();
    hear(good_answer, 4);
    TEST_ASSERT_EQUAL(BUS_PENDING, poll_after_us(500));
    TEST_ASSERT_EQUAL(BUS_PENDING, poll_after_us(500));
    TEST_ASSERT_EQUAL(BUS_ERR_TIMEOUT, poll_after_us(500));
}

static void test_retries_are_bounded(void)
{
    ask(3, 3);
    for (uint8_t i = 0; i < 3; i++) {
        leave();
        TEST_ASSERT_EQUAL(BUS_PENDING, poll_after_us(500));
        (void)poll_after_us(500);
    }
    TEST_ASSERT_EQUAL(BUS_ERR_TIMEOUT, poll_after_us(1));
    TEST_ASSERT_EQUAL(3, sends);
    TEST_ASSERT_EQUAL(3, core.counts.timeouts);
    TEST_ASSERT_EQUAL(2, core.counts.retries);
    TEST_ASSERT_EQUAL(3, core.counts.packets);
}

static void test_retry_waits_until_the_line_is_quiet(void)
{
    static const uint8_t bad[] = { 0xFF, 0xFF, 0x03, 0x02, 0x00, 0x00 };
    ask(3, 2);
    leave();
    hear(bad, sizeof bad);
    TEST_ASSERT_EQUAL(BUS_PENDING, poll_after_us(60));
    hear(good_answer, 2);
    TEST_ASSERT_EQUAL(BUS_PENDING, poll_after_us(90));   /* the line is still busy */
    TEST_ASSERT_EQUAL(1, sends);
    TEST_ASSERT_EQUAL(BUS_PENDING, poll_after_us(90));
    TEST_ASSERT_EQUAL(1, sends);
    TEST_ASSERT_EQUAL(BUS_PENDING, poll_after_us(30));
    TEST_ASSERT_EQUAL(2, sends);
    leave();
    hear(good_answer, sizeof good_answer);
    TEST_ASSERT_EQUAL(BUS_OK, poll_after_us(100));
    TEST_ASSERT_EQUAL(1, core.counts.checksums);
}

static void test_retry_after_half_an_answer_starts_afresh(void)
{
    ask(3, 2);
    leave();
    hear(good_answer, 6);
    (void)poll_after_us(60);
    (void)poll_after_us(900);
    TEST_ASSERT_EQUAL(2, sends);
    leave();
    hear(good_answer, sizeof good_answer);
    TEST_ASSERT_EQUAL(BUS_OK, poll_after_us(80));
}

/* Noise spoils the first try, the second gets no answer. Each try must report its own error. */
static void test_retry_forgets_what_spoilt_the_try_before(void)
{
    ask(3, 2);
    leave();
    bus_core_on_byte(&core, 0x00, BUS_BYTE_OVERRUN | BUS_BYTE_FRAMING);
    TEST_ASSERT_EQUAL(BUS_PENDING, poll_after_us(900));
    TEST_ASSERT_EQUAL(2, sends);
    leave();
    TEST_ASSERT_EQUAL(BUS_ERR_TIMEOUT, poll_after_us(900));
    TEST_ASSERT_EQUAL(1, core.counts.overruns);
    TEST_ASSERT_EQUAL(1, core.counts.timeouts);
}

static void test_wrong_id_and_wrong_length_are_named(void)
{
    ask(4, 1);
    leave();
    hear(good_answer, sizeof good_answer);
    TEST_ASSERT_EQUAL(BUS_PENDING, poll_after_us(80));
    TEST_ASSERT_EQUAL(BUS_ERR_WRONG_ID, poll_after_us(200));
    TEST_ASSERT_EQUAL(1, core.counts.wrong_ids);

    static const uint8_t status_only[] = { 0xFF, 0xFF, 0x03, 0x02, 0x00, 0xFA };
    ask(3, 1);
    leave();
    hear(status_only, sizeof status_only);
    TEST_ASSERT_EQUAL(BUS_PENDING, poll_after_us(60));
    TEST_ASSERT_EQUAL(BUS_ERR_LENGTH, poll_after_us(200));
    TEST_ASSERT_EQUAL(1, core.counts.lengths);
}

/* FF FF 03 02 error sum: the answer of servo 3 to a WRITE. */
static void hear_status(uint8_t error)
{
    const uint8_t status[] = { 0xFF, 0xFF, 0x03, 0x02, error, (uint8_t)~(0x03 + 0x02 + error) };
    hear(status, sizeof status);
}

static void write_goal(uint8_t tries)
{
    static const uint8_t params[3] = { DXL_AT_GOAL, 0x58, 0x02 };
    uint8_t size = dxl_build(core.packet, 3, DXL_WRITE, params, sizeof params);
    TEST_ASSERT_EQUAL(BUS_PENDING, bus_core_submit(&core, size, 0, tries));
    leave();
}

/* DYNAMIXEL.md: bits 3 range, 4 checksum, 6 instruction mean that the servo did not execute the packet. */
static void test_rejected_write_is_a_failed_try(void)
{
    const uint8_t errors[] = { 1 << 3, 1 << 4, 1 << 6, 1 << 4 | 1 << 5 };
    for (uint8_t i = 0; i < sizeof errors; i++) {
        setUp();
        write_goal(2);
        hear_status(errors[i]);
        TEST_ASSERT_EQUAL(BUS_PENDING, poll_after_us(60));
        TEST_ASSERT_EQUAL(BUS_PENDING, poll_after_us(200));
        TEST_ASSERT_EQUAL(2, sends);
        TEST_ASSERT_EQUAL(1, core.counts.rejected);
        leave();
        hear_status(errors[i]);
        TEST_ASSERT_EQUAL(BUS_PENDING, poll_after_us(60));
        TEST_ASSERT_EQUAL(BUS_ERR_REJECTED, poll_after_us(200));
        TEST_ASSERT_EQUAL_HEX8(errors[i], answer.error);
        TEST_ASSERT_EQUAL(2, core.counts.rejected);
        TEST_ASSERT_EQUAL(0, core.counts.answers);
    }
}

/* Bits 0 voltage, 1 angle limit, 2 overheating, 5 overload report the servo's state; it has executed the WRITE. */
static void test_write_to_a_servo_in_trouble_is_done(void)
{
    const uint8_t errors[] = { 0, 1 << 0, 1 << 1, 1 << 2, 1 << 5 };
    for (uint8_t i = 0; i < sizeof errors; i++) {
        setUp();
        write_goal(2);
        hear_status(errors[i]);
        TEST_ASSERT_EQUAL(BUS_OK, poll_after_us(60));
        TEST_ASSERT_EQUAL_HEX8(errors[i], answer.error);
        TEST_ASSERT_EQUAL(1, sends);
    }
}

static void test_glitch_before_the_answer_does_no_harm(void)
{
    ask(3, 1);
    leave();
    bus_core_on_byte(&core, 0x00, BUS_BYTE_FRAMING);
    hear((const uint8_t[]){ 0x7F }, 1);
    hear(good_answer, sizeof good_answer);
    TEST_ASSERT_EQUAL(BUS_OK, poll_after_us(100));
    TEST_ASSERT_EQUAL(0, core.counts.framing);
}

static void test_broken_bytes_name_framing_or_overrun(void)
{
    ask(3, 1);
    leave();
    hear(good_answer, 3);
    bus_core_on_byte(&core, 0x04, BUS_BYTE_FRAMING);
    hear(good_answer + 4, 4);
    (void)poll_after_us(80);
    TEST_ASSERT_EQUAL(BUS_ERR_FRAMING, poll_after_us(900));
    TEST_ASSERT_EQUAL(1, core.counts.framing);

    ask(3, 1);
    leave();
    hear(good_answer, 3);
    bus_core_on_byte(&core, 0x00, BUS_BYTE_OVERRUN);
    (void)poll_after_us(80);
    TEST_ASSERT_EQUAL(BUS_ERR_FRAMING, poll_after_us(900));
    TEST_ASSERT_EQUAL(1, core.counts.overruns);
}

static void test_endless_noise_ends_the_try(void)
{
    ask(3, 1);
    leave();
    for (uint16_t i = 0; i < 1000; i++) {
        bus_core_on_byte(&core, 0x55, 0);
        (void)poll_after_us(10);
    }
    TEST_ASSERT_EQUAL(BUS_ERR_TIMEOUT, poll_after_us(1));
}

static void test_bytes_when_nobody_was_asked_are_strays_or_go_to_the_tap(void)
{
    static uint8_t storage[16];
    ring_t ring;
    bus_counts_t counts;
    ring_init(&ring, storage, sizeof storage);
    hear(good_answer, 2);
    for (uint32_t i = 0; i <= UINT16_MAX; i++) {
        hear(good_answer, 1); /* whoever compares two counts sees each byte */
    }
    core.tap = &ring;
    hear(good_answer, 3);
    bus_core_counts(&core, &counts);
    TEST_ASSERT_EQUAL(2, counts.strays);
    TEST_ASSERT_EQUAL(3, ring_count(&ring));
}

static void test_news_are_what_poll_has_not_seen(void)
{
    ask(3, 1);
    TEST_ASSERT_FALSE(bus_core_has_news(&core));
    leave();
    TEST_ASSERT_TRUE(bus_core_has_news(&core));
    (void)poll_after_us(1);
    TEST_ASSERT_FALSE(bus_core_has_news(&core));
    hear(good_answer, 1);
    TEST_ASSERT_TRUE(bus_core_has_news(&core));
    hear(good_answer + 1, sizeof good_answer - 1);
    TEST_ASSERT_EQUAL(BUS_OK, poll_after_us(80));
    TEST_ASSERT_FALSE(bus_core_has_news(&core));
}

static void test_slow_rate_waits_longer(void)
{
    bus_core_set_rate(&core, BUS_RATE_57142);   /* 175 us a character */
    ask(3, 1);
    leave();
    TEST_ASSERT_EQUAL(BUS_PENDING, poll_after_us(508 + 500));
    TEST_ASSERT_EQUAL(BUS_ERR_TIMEOUT, poll_after_us(400));
}

static void test_transmit_complete_after_the_clock_was_read_is_no_timeout(void)
{
    ask(3, 1);
    bus_core_on_last(&core);
    bus_core_on_sent(&core, (uint16_t)(now + 3));
    TEST_ASSERT_EQUAL(BUS_PENDING, bus_core_poll(&core, now, NULL));
    TEST_ASSERT_EQUAL(0, core.counts.timeouts);
}

static void test_longest_answer_with_noise_before_it_fits(void)
{
    uint8_t sum = 1 + DXL_ANSWER_PARAMS + 2;
    static const uint8_t params[2] = { 0, DXL_ANSWER_PARAMS };
    uint8_t size = dxl_build(core.packet, 1, DXL_READ, params, 2);
    TEST_ASSERT_EQUAL(BUS_PENDING, bus_core_submit(&core, size, DXL_ANSWER_PARAMS, 1));
    leave();
    for (uint8_t i = 0; i < 4; i++) {
        hear((const uint8_t[]){ 0x10 }, 1);
    }
    hear((const uint8_t[]){ 0xFF, 0xFF, 1, DXL_ANSWER_PARAMS + 2, 0 }, 5);
    for (uint8_t i = 0; i < DXL_ANSWER_PARAMS; i++) {
        hear(&i, 1);
        sum = (uint8_t)(sum + i);
    }
    sum = (uint8_t)~sum;
    hear(&sum, 1);
    TEST_ASSERT_EQUAL(BUS_OK, poll_after_us(800));
    for (uint8_t i = 0; i < DXL_ANSWER_PARAMS; i++) {
        TEST_ASSERT_EQUAL(i, answer.params[i]);
    }
}
