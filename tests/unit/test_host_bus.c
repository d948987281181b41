/* SPDX-License-Identifier: MIT
 * The bus through an adapter (hal/host/bus.c): late answers, echoes, an unplugged adapter. Packets as in
 * hal/DYNAMIXEL.md. */
#include "bus.h"

#include <string.h>
#include "bus_call.h"
#include "dxl_packet.h"
#include "fake_machine.h"
#include "host.h"
#include "tick.h"
#include "unity.h"

#define MS 2000u

static uint32_t random_state = 1;

static uint32_t random_below(uint32_t limit)
{
    random_state = random_state * 1103515245u + 12345u;
    return (uint32_t)(((uint64_t)(random_state >> 8) * limit) >> 24);
}

static uint8_t error_bits;   /* of the servo's status packets */
static bool is_silent;

/* Servo 3: answers PING, and READ with ascending bytes. */
static uint16_t servo(const uint8_t *packet, uint16_t size, uint8_t *answer)
{
    (void)size;
    if (packet[2] != 3 || is_silent) {
        return 0;
    }
    const uint8_t count = packet[4] == DXL_READ ? packet[6] : 0;
    uint8_t table[64];
    for (uint8_t i = 0; i < count; i++) {
        table[i] = (uint8_t)(packet[5] + i);
    }
    return dxl_build(answer, 3, error_bits, table, count);   /* the error takes the place of the instruction */
}

void setUp(void)
{
    fake_machine_reset();
    fake_machine_set_servo(servo);
    error_bits = 0;
    is_silent = false;
}

static void start(uint32_t latency, bool echoes)
{
    fake_machine_set_latency(latency);
    fake_machine_set_echo(echoes);
    bus_init();
}

static void test_answers_are_waited_for_however_late_they_come(void)
{
    static const uint8_t latencies_ms[] = {1, 4, 16, 32, 48};
    for (uint8_t i = 0; i < sizeof latencies_ms; i++) {
        uint8_t read[2];
        bus_counts_t counts;
        setUp();
        start(latencies_ms[i] * MS, false);
        for (uint8_t time = 0; time < 20; time++) {
            TEST_ASSERT_EQUAL(BUS_OK, bus_call_read(3, DXL_AT_PRESENT, read, 2, NULL));
            TEST_ASSERT_EQUAL(DXL_AT_PRESENT, read[0]);
            fake_machine_set_latency((latencies_ms[i] + time % 5u) * MS);   /* plus jitter */
        }
        bus_counts(&counts);
        TEST_ASSERT_EQUAL(0, counts.timeouts);
        TEST_ASSERT_EQUAL(20, counts.answers);
    }
}

static void test_silent_servo_costs_what_the_port_has_been_seen_to_take(void)
{
    uint8_t read[2];
    start(1 * MS, false);
    TEST_ASSERT_EQUAL(BUS_OK, bus_call_read(3, DXL_AT_PRESENT, read, 2, NULL));
    const uint64_t before = host_next_tick();
    TEST_ASSERT_EQUAL(BUS_ERR_TIMEOUT, bus_call_ping(4, 1, NULL));
    const uint64_t fast = host_next_tick() - before;
    TEST_ASSERT_TRUE(fast < 140 * MS);   /* a packet without a retry waits 0.1 s, plus 20 ms */
    TEST_ASSERT_EQUAL(BUS_ERR_TIMEOUT, bus_call_ping(4, 2, NULL));
    TEST_ASSERT_TRUE(host_next_tick() - before - fast < 60 * MS);
}

/* After a limit that was too short, the late answer raises the limit. */
static void test_answer_after_the_limit_makes_the_limit_longer(void)
{
    uint8_t read[2];
    start(1 * MS, false);
    TEST_ASSERT_EQUAL(BUS_OK, bus_call_read(3, DXL_AT_PRESENT, read, 2, NULL));
    fake_machine_set_latency(70 * MS);
    TEST_ASSERT_EQUAL(BUS_ERR_TIMEOUT, bus_call_ping(3, 2, NULL));
    fake_machine_pass(100 * MS);
    host_fetch();
    fake_machine_pass(100 * MS);
    TEST_ASSERT_EQUAL(BUS_OK, bus_call_ping(3, 2, NULL));
}

/* A web page is held up for longer than a native program. */
static void test_computer_may_look_as_late_as_it_says_however_fast_answers_were(void)
{
    uint8_t read[2];
    bus_counts_t counts;
    fake_machine_set_least_patience(60 * MS);
    start(1 * MS, false);
    TEST_ASSERT_EQUAL(BUS_OK, bus_call_read(3, DXL_AT_PRESENT, read, 2, NULL));
    fake_machine_set_latency(55 * MS);
    TEST_ASSERT_EQUAL(BUS_OK, bus_call_ping(3, 2, NULL));
    bus_counts(&counts);
    TEST_ASSERT_EQUAL(0, counts.timeouts);
}

static void test_goals_leave_while_an_answer_is_awaited(void)
{
    bus_answer_t answer;
    start(30 * MS, false);
    TEST_ASSERT_EQUAL(BUS_PENDING, bus_start_read(3, DXL_AT_PRESENT, 2, 1));
    TEST_ASSERT_FALSE(bus_is_free());   /* the answer may be on the line now */
    bus_wait_free();
    TEST_ASSERT_EQUAL(BUS_PENDING, bus_poll(&answer));
    for (uint8_t i = 0; i < 3; i++) {
        const uint8_t params[] = {DXL_AT_GOAL, 2, 3, 0, 2};
        const uint16_t before = fake_machine_packets();
        const uint8_t size = dxl_build(bus_packet(), DXL_BROADCAST, DXL_SYNC_WRITE, params, sizeof params);
        TEST_ASSERT_EQUAL(BUS_OK, bus_submit(size, BUS_NO_ANSWER, 1));
        TEST_ASSERT_EQUAL(before + 1, fake_machine_packets());
        fake_machine_pass(8 * MS);
    }
    TEST_ASSERT_TRUE(host_is_moving());
    TEST_ASSERT_EQUAL(BUS_OK, bus_wait(&answer));
    TEST_ASSERT_EQUAL(3, answer.id);
    TEST_ASSERT_EQUAL(2, answer.count);
    TEST_ASSERT_EQUAL(DXL_AT_PRESENT, answer.params[0]);
}

/* The answer arrives while the program asks whether the line is free. The goals sent next must not discard it. */
static void test_answer_that_nobody_has_fetched_outlives_the_goals(void)
{
    const uint8_t goals[] = {DXL_AT_GOAL, 2, 3, 0, 2};
    bus_answer_t answer;
    start(4 * MS, false);
    TEST_ASSERT_EQUAL(BUS_PENDING, bus_start_read(3, DXL_AT_PRESENT, 2, 1));
    fake_machine_pass(20 * MS);
    TEST_ASSERT_TRUE(bus_is_free());
    const uint8_t size = dxl_build(bus_packet(), DXL_BROADCAST, DXL_SYNC_WRITE, goals, sizeof goals);
    TEST_ASSERT_EQUAL(BUS_OK, bus_submit(size, BUS_NO_ANSWER, 1));
    memset(&answer, 0xA5, sizeof answer);
    TEST_ASSERT_EQUAL(BUS_OK, bus_poll(&answer));
    TEST_ASSERT_EQUAL(3, answer.id);
    TEST_ASSERT_EQUAL(2, answer.count);
    TEST_ASSERT_EQUAL(DXL_AT_PRESENT, answer.params[0]);
}

/* A PING and the status "voltage error" of the same servo have the same bytes. */
static void test_voltage_error_is_no_echo(void)
{
    uint8_t error = 0;
    error_bits = DXL_ERR_VOLTAGE;
    start(1 * MS, false);
    TEST_ASSERT_EQUAL(BUS_OK, bus_call_ping(3, 1, &error));
    TEST_ASSERT_EQUAL(DXL_ERR_VOLTAGE, error);
}

static void test_echo_is_found_out_and_dropped(void)
{
    static const uint8_t latencies_ms[] = {0, 4, 16};
    for (uint8_t i = 0; i < sizeof latencies_ms; i++) {
        uint8_t error = 0, read[20];
        bus_counts_t counts;
        setUp();
        error_bits = DXL_ERR_VOLTAGE;
        start(latencies_ms[i] * MS, true);
        for (uint8_t time = 0; time < 10; time++) {
            TEST_ASSERT_EQUAL(BUS_OK, bus_call_ping(3, 1, &error));
            TEST_ASSERT_EQUAL(DXL_ERR_VOLTAGE, error);
            TEST_ASSERT_EQUAL(BUS_OK, bus_call_read(3, DXL_AT_TORQUE_ENABLE, read, sizeof read, NULL));
        }
        is_silent = true;
        TEST_ASSERT_EQUAL(BUS_ERR_TIMEOUT, bus_call_ping(3, 1, &error));   /* its own echo is no answer */
        bus_counts(&counts);
        TEST_ASSERT_EQUAL(20, counts.answers);
        TEST_ASSERT_EQUAL(1, counts.timeouts);
    }
}

/* The engine counts in 32 bits: 2,147 s, half of it into the past. */
static void test_silent_servo_is_given_up_at_once_after_a_sleep_of_the_computer(void)
{
    bus_answer_t answer;
    start(1 * MS, false);
    TEST_ASSERT_EQUAL(BUS_PENDING, bus_start_read(4, DXL_AT_PRESENT, 2, 1));
    fake_machine_pass(1200u * 1000u * MS);
    const uint64_t before = host_next_tick();
    TEST_ASSERT_EQUAL(BUS_ERR_TIMEOUT, bus_wait(&answer));
    TEST_ASSERT_TRUE(host_next_tick() - before < 300 * MS);
}

static void test_tick_is_as_late_as_the_computer_slept(void)
{
    static const uint16_t seconds[] = {1, 511, 512, 513, 1024};
    for (uint8_t i = 0; i < sizeof seconds / sizeof seconds[0]; i++) {
        tick_init();
        fake_machine_pass(seconds[i] * 1000u * MS);
        TEST_ASSERT_TRUE(tick_take());
        TEST_ASSERT_EQUAL(seconds[i] >= 512 ? 65535 : seconds[i] * TICK_HZ - 1u, tick_late());
        TEST_ASSERT_EQUAL(tick_late(), tick_missed());
        TEST_ASSERT_FALSE(tick_take());
    }
}

static void test_port_that_goes_fails_at_once_and_says_so_once(void)
{
    start(16 * MS, false);
    TEST_ASSERT_FALSE(bus_was_lost());
    TEST_ASSERT_EQUAL(BUS_PENDING, bus_start_read(3, DXL_AT_PRESENT, 2, 1));
    fake_machine_plug(false);
    const uint64_t before = host_next_tick();
    TEST_ASSERT_EQUAL(BUS_ERR_TIMEOUT, bus_wait(NULL));
    TEST_ASSERT_EQUAL(BUS_ERR_TIMEOUT, bus_call_ping(3, 3, NULL));
    TEST_ASSERT_TRUE(host_next_tick() - before < 20 * MS);
    TEST_ASSERT_TRUE(bus_was_lost());
    TEST_ASSERT_FALSE(bus_was_lost());
    fake_machine_plug(true);
    TEST_ASSERT_EQUAL(BUS_OK, bus_call_ping(3, 3, NULL));
    TEST_ASSERT_FALSE(bus_was_lost());
}

static void test_rates_are_those_of_the_divisors(void)
{
    start(0, false);
    TEST_ASSERT_EQUAL(1000000, fake_machine_rate());
    bus_set_rate(BUS_RATE_57142);
    TEST_ASSERT_EQUAL(57142, fake_machine_rate());
    TEST_ASSERT_EQUAL(BUS_RATE_57142, bus_rate());
}

static void test_packet_is_news_when_it_has_left(void)
{
    static const uint8_t goal[] = {DXL_AT_GOAL, 2, 3, 0, 2};
    start(1 * MS, false);
    (void)bus_submit(dxl_build(bus_packet(), DXL_BROADCAST, DXL_SYNC_WRITE, goal, sizeof goal), BUS_NO_ANSWER, 1);
    TEST_ASSERT_FALSE(bus_has_news());      /* the program may sleep until then */
    TEST_ASSERT_FALSE(bus_is_free());
    fake_machine_pass(11 * 20);             /* eleven bytes of 10 us each */
    TEST_ASSERT_TRUE(bus_has_news());
    TEST_ASSERT_TRUE(bus_is_free());
}

/* Reads and goals in the order in which the servo link sends them, on a computer with random delays. Every answer that
 * the bus returns must be the servo's. */
static void test_no_answer_is_false_however_late_the_computer_is(void)
{
    static const uint8_t goals[] = {DXL_AT_GOAL, 2, 3, 0, 2};
    uint32_t answers = 0;
    for (uint16_t round = 0; round < 200; round++) {
        setUp();
        start(random_below(20) * MS, random_below(2) != 0);
        bool waits = false;
        for (uint16_t i = 0; i < 400; i++) {
            bus_answer_t answer;
            memset(&answer, 0xA5, sizeof answer);
            if (waits && random_below(3) == 0) {
                const bus_status_t status = bus_poll(&answer);
                waits = status == BUS_PENDING;
                if (status == BUS_OK) {
                    TEST_ASSERT_EQUAL(3, answer.id);
                    TEST_ASSERT_EQUAL(0, answer.error);
                    TEST_ASSERT_EQUAL(20, answer.count);
                    TEST_ASSERT_EQUAL(DXL_AT_TORQUE_ENABLE, answer.params[0]);
                    answers++;
                }
            }
            switch (random_below(4)) {
            case 0:
                if (!bus_is_busy()) {
                    waits = bus_start_read(3, DXL_AT_TORQUE_ENABLE, 20, 1) == BUS_PENDING;
                }
                break;
            case 1:
                if (bus_is_free()) {
                    (void)bus_submit(dxl_build(bus_packet(), DXL_BROADCAST, DXL_SYNC_WRITE, goals, sizeof goals),
                                     BUS_NO_ANSWER, 1);
                }
                break;
            case 2:
                fake_machine_pass(random_below(random_below(20) == 0 ? 300 * MS : 9 * MS));
                fake_machine_set_latency(random_below(20) * MS);
                break;
            default:
                host_fetch();
                break;
            }
        }
    }
    TEST_ASSERT_GREATER_THAN(1000, answers);
}
