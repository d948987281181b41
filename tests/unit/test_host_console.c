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
    fake_machine_block(false);
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

static bool has_rested(void)
{
    host_fetch_console();
    host_console_rest();
    return host_console_has_rested();
}

static void test_a_program_rests_once_its_input_is_taken_and_until_more_comes(void)
{
    uint8_t byte;
    fake_machine_type("a");
    TEST_ASSERT_FALSE(has_rested());
    TEST_ASSERT_TRUE(console_get(&byte));
    TEST_ASSERT_FALSE(host_console_has_rested());
    TEST_ASSERT_TRUE(has_rested());
    fake_machine_type("b");
    host_fetch_console();
    TEST_ASSERT_FALSE(host_console_has_rested());
}

/* Even if all of it leaves just before it sleeps: it wakes up to print more. */
static void test_a_program_does_not_rest_while_its_output_waits(void)
{
    fake_machine_block(true);
    TEST_ASSERT_TRUE(console_put('a'));
    TEST_ASSERT_FALSE(has_rested());
    host_fetch_console();
    fake_machine_block(false);
    TEST_ASSERT_FALSE(has_rested());
    TEST_ASSERT_TRUE(has_rested());
}
