/* SPDX-License-Identifier: MIT
 * The console of a PC (hal/host/console.c): typed-ahead input waits in the computer, and none is lost. */
#include "console.h"

#include "fake_machine.h"
#include "host.h"
#include "unity.h"

#define BEHIND_XOFF 16u   /* bytes that may still arrive, e.g. from a USB adapter; an image keeps room for them */

void setUp(void)
{
    fake_machine_reset();
    console_init();
}

void tearDown(void)
{
    fake_machine_type("");
}

static const char pasted[] = "0123456789abcdefghijklmnopqrstuvwxyz0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZ";

static void test_no_more_is_fetched_at_once_than_comes_behind_an_xoff(void)
{
    fake_machine_type(pasted);
    host_fetch_console();
    host_fetch_console();
    TEST_ASSERT_TRUE(console_waiting() > 0);
    TEST_ASSERT_TRUE(console_waiting() <= BEHIND_XOFF);
}

static void test_nothing_is_fetched_between_xoff_and_xon(void)
{
    uint8_t byte;
    fake_machine_type(pasted);
    console_xoff();
    console_xoff();
    host_fetch_console();
    console_xon();
    host_fetch_console();
    TEST_ASSERT_EQUAL(0, console_waiting());
    console_xon();
    for (const char *expected = pasted; *expected != '\0'; expected++) {
        host_fetch_console();
        TEST_ASSERT_TRUE(console_get(&byte));
        TEST_ASSERT_EQUAL_CHAR(*expected, byte);
    }
    TEST_ASSERT_FALSE(console_get(&byte));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_no_more_is_fetched_at_once_than_comes_behind_an_xoff);
    RUN_TEST(test_nothing_is_fetched_between_xoff_and_xon);
    return UNITY_END();
}
