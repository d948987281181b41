/* SPDX-License-Identifier: MIT
 * Echoes from an adapter (hal/host/echo.c). */
#include "echo.h"

#include <string.h>
#include "unity.h"

static echo_t echo;
static uint8_t passed[512];
static uint16_t count;
static const uint8_t ping[] = {0xFF, 0xFF, 3, 2, 1, 0xF9}, goals[] = {0xFF, 0xFF, 0xFE, 7, 0x83, 30, 2, 3, 0, 2, 0x40};
static const uint8_t answer[] = {0xFF, 0xFF, 3, 2, 0, 0xFA};

void setUp(void)
{
    echo_clear(&echo);
    count = 0;
}

static void hear(const uint8_t *bytes, uint16_t size)
{
    for (uint16_t i = 0; i < size; i++) {
        count = (uint16_t)(count + echo_byte(&echo, bytes[i], passed + count));
    }
}

static void test_echo_is_dropped_and_the_answer_passes(void)
{
    echo_sent(&echo, ping, sizeof ping);
    hear(ping, sizeof ping);
    hear(answer, sizeof answer);
    TEST_ASSERT_EQUAL(sizeof answer, count);
    TEST_ASSERT_EQUAL_HEX8_ARRAY(answer, passed, sizeof answer);
    TEST_ASSERT_EQUAL(1, echo.dropped);
}

/* The answer to a request comes before the echo of the packet sent after it. */
static void test_answer_between_two_echoes_passes(void)
{
    echo_sent(&echo, ping, sizeof ping);
    echo_sent(&echo, goals, sizeof goals);
    hear(ping, sizeof ping);
    hear(answer, sizeof answer);
    hear(goals, sizeof goals);
    TEST_ASSERT_EQUAL(sizeof answer, count);
    TEST_ASSERT_EQUAL_HEX8_ARRAY(answer, passed, sizeof answer);
    TEST_ASSERT_EQUAL(2, echo.dropped);
}

static void test_damaged_echo_is_noise_and_hides_nothing(void)
{
    uint8_t damaged[sizeof ping];
    memcpy(damaged, ping, sizeof ping);
    damaged[4] ^= 0x10;
    echo_sent(&echo, ping, sizeof ping);
    echo_sent(&echo, goals, sizeof goals);
    hear(damaged, sizeof damaged);
    hear(answer, sizeof answer);
    hear(goals, sizeof goals);
    TEST_ASSERT_EQUAL(sizeof damaged + sizeof answer, count);
    TEST_ASSERT_EQUAL_HEX8_ARRAY(answer, passed + sizeof damaged, sizeof answer);
    TEST_ASSERT_EQUAL(0, echo.count);
}

static void test_begun_echo_is_given_up_when_the_line_is_quiet(void)
{
    echo_sent(&echo, ping, sizeof ping);
    hear(ping, 4);
    TEST_ASSERT_EQUAL(0, count);
    TEST_ASSERT_EQUAL(4, echo_quiet(&echo, passed));
    TEST_ASSERT_EQUAL_HEX8_ARRAY(ping, passed, 4);
}

static void test_packets_that_never_come_back_are_forgotten(void)
{
    for (uint8_t i = 0; i < 100; i++) {
        echo_sent(&echo, goals, sizeof goals);
    }
    TEST_ASSERT_EQUAL(ECHO_PACKETS, echo.count);
    echo_sent(&echo, ping, sizeof ping);
    hear(ping, sizeof ping);
    TEST_ASSERT_EQUAL(0, count);
    TEST_ASSERT_EQUAL(0, echo.count);
}
