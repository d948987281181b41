/* SPDX-License-Identifier: MIT
 * test_link.c - one test for each sentence of "What a code does" in REMOTE.md. */
#include "link.h"
#include "unity.h"

enum { NEXT = 10, EXIT = 20, LEFT = 30, RIGHT = 40, CODE_U = 1, CODE_L = 4, CODE_R = 8 };

static link_t l;
static link_taken_t taken;
static uint8_t header[PAGE_STEP_BYTES];

void setUp(void)
{
    for (uint8_t i = 0; i < sizeof header; i++) {
        header[i] = 0;
    }
    header[PAGE_AT_NEXT_PAGE] = NEXT;
    header[PAGE_AT_EXIT_PAGE] = EXIT;
    header[PAGE_AT_LINKED1_PAGE] = LEFT;
    header[PAGE_AT_LINKED1_CODE] = CODE_L;
    header[PAGE_AT_LINKED2_PAGE] = RIGHT;
    header[PAGE_AT_LINKED2_CODE] = CODE_R;
    link_init(&l, LINK_LATCH);
    link_call(&l, CODE_U);
}

static void expect(uint8_t page, link_taken_t how)
{
    TEST_ASSERT_EQUAL_UINT8(page, link_decide(&l, 1, header, &taken));
    TEST_ASSERT_EQUAL(how, taken);
}

static void test_link_own_code_follows_next(void)
{
    expect(NEXT, LINK_NEXT);
}

static void test_link_called_by_number_follows_next(void)
{
    link_call(&l, LINK_CODE_NONE);
    expect(NEXT, LINK_NEXT);
}

static void test_link_other_code_without_link_follows_next(void)
{
    link_code(&l, 2);
    expect(NEXT, LINK_NEXT);
}

static void test_link_code_of_linked_page_1_is_followed(void)
{
    link_code(&l, CODE_L);
    expect(LEFT, LINK_LINKED1);
}

static void test_link_code_of_linked_page_2_is_followed(void)
{
    link_code(&l, CODE_R);
    expect(RIGHT, LINK_LINKED2);
}

static void test_link_page_1_wins_over_page_2_and_over_next(void)
{
    header[PAGE_AT_LINKED1_CODE] = header[PAGE_AT_LINKED2_CODE] = CODE_U;
    expect(LEFT, LINK_LINKED1);
}

static void test_link_code_0_in_a_page_is_an_unused_link(void)
{
    header[PAGE_AT_LINKED1_CODE] = header[PAGE_AT_LINKED2_CODE] = 0;
    link_call(&l, LINK_CODE_NONE);
    expect(NEXT, LINK_NEXT);
}

static void test_link_stop_wins_over_everything(void)
{
    header[PAGE_AT_LINKED1_CODE] = LINK_CODE_STOP;
    link_code(&l, CODE_R);
    link_code(&l, LINK_CODE_STOP);
    TEST_ASSERT_TRUE(link_is_stopping(&l));
    expect(EXIT, LINK_EXIT);
}

static void test_link_0_ends_the_play(void)
{
    header[PAGE_AT_NEXT_PAGE] = header[PAGE_AT_EXIT_PAGE] = 0;
    expect(0, LINK_NEXT);
    link_stop(&l);
    expect(0, LINK_EXIT);
}

static void test_link_latch_keeps_the_last_code_after_release(void)
{
    link_code(&l, CODE_L);
    link_code(&l, LINK_CODE_NONE);
    expect(LEFT, LINK_LINKED1);
}

static void test_link_latch_keeps_a_code_until_another_one_comes(void)
{
    link_code(&l, CODE_L);
    link_code(&l, CODE_R);
    expect(RIGHT, LINK_LINKED2);
}

static void test_link_hold_release_is_stop(void)
{
    link_init(&l, LINK_HOLD);
    link_call(&l, CODE_U);
    link_code(&l, CODE_U);
    TEST_ASSERT_FALSE(link_is_stopping(&l));
    link_code(&l, LINK_CODE_NONE);
    TEST_ASSERT_TRUE(link_is_stopping(&l));
    expect(EXIT, LINK_EXIT);
}

static void test_link_hold_played_by_number_goes_on_without_any_remote(void)
{
    link_init(&l, LINK_HOLD);
    link_call(&l, LINK_CODE_NONE);
    expect(NEXT, LINK_NEXT);
}

static void test_link_stop_stays_in_force_on_the_exit_page(void)
{
    link_code(&l, LINK_CODE_STOP);
    expect(EXIT, LINK_EXIT);
    header[PAGE_AT_EXIT_PAGE] = 21;
    TEST_ASSERT_EQUAL_UINT8(21, link_decide(&l, EXIT, header, &taken));
    TEST_ASSERT_EQUAL(LINK_EXIT, taken);
}

static void test_link_exit_chain_that_comes_back_ends(void)
{
    link_stop(&l);
    expect(EXIT, LINK_EXIT); /* 1 -> 20 */
    header[PAGE_AT_EXIT_PAGE] = 21;
    TEST_ASSERT_EQUAL_UINT8(21, link_decide(&l, EXIT, header, &taken)); /* 20 -> 21 */
    header[PAGE_AT_EXIT_PAGE] = EXIT;
    TEST_ASSERT_EQUAL_UINT8(0, link_decide(&l, 21, header, &taken)); /* 21 -> 20: already visited */
    TEST_ASSERT_EQUAL(LINK_END_OF_EXIT_LOOP, taken);
}

static void test_link_exit_to_itself_ends(void)
{
    header[PAGE_AT_EXIT_PAGE] = 1;
    link_stop(&l);
    expect(0, LINK_END_OF_EXIT_LOOP);
}

static void test_link_exit_chain_of_127_pages_is_followed_to_its_end(void)
{
    link_stop(&l);
    for (uint8_t page = 1; page < 127; page++) {
        header[PAGE_AT_EXIT_PAGE] = (uint8_t)(page + 1);
        TEST_ASSERT_EQUAL_UINT8(page + 1, link_decide(&l, page, header, &taken));
    }
    header[PAGE_AT_EXIT_PAGE] = 0;
    TEST_ASSERT_EQUAL_UINT8(0, link_decide(&l, 127, header, &taken));
    TEST_ASSERT_EQUAL(LINK_EXIT, taken);
}

static void test_link_another_code_replaces_a_stop(void)
{
    link_code(&l, LINK_CODE_STOP);
    link_code(&l, CODE_L);
    TEST_ASSERT_FALSE(link_is_stopping(&l));
    expect(LEFT, LINK_LINKED1);
}

static void test_link_repeated_packets_of_a_held_button_do_not_undo_a_stop(void)
{
    link_code(&l, CODE_U);
    link_code(&l, LINK_CODE_STOP); /* the Start button on the robot */
    link_code(&l, CODE_U);         /* the remote repeats itself */
    TEST_ASSERT_TRUE(link_is_stopping(&l));
    link_code(&l, LINK_CODE_NONE);
    link_code(&l, CODE_U); /* a new press counts */
    TEST_ASSERT_FALSE(link_is_stopping(&l));
}

static void test_link_serial_stop_stays_until_a_new_call(void)
{
    link_stop(&l);
    link_code(&l, CODE_L);
    TEST_ASSERT_TRUE(link_is_stopping(&l));
    expect(EXIT, LINK_EXIT);
    link_call(&l, CODE_U);
    TEST_ASSERT_FALSE(link_is_stopping(&l));
    expect(NEXT, LINK_NEXT);
}

static void test_link_second_stop_starts_with_fresh_exits(void)
{
    link_code(&l, LINK_CODE_STOP);
    expect(EXIT, LINK_EXIT);
    link_code(&l, CODE_L);
    link_code(&l, LINK_CODE_STOP);
    expect(EXIT, LINK_EXIT);
}

static void test_link_end_follows_no_link_until_a_new_call(void)
{
    link_end(&l);
    TEST_ASSERT_TRUE(link_is_stopping(&l));
    expect(0, LINK_ENDED);
    link_code(&l, CODE_L);
    expect(0, LINK_ENDED);
    link_call(&l, CODE_U);
    expect(NEXT, LINK_NEXT);
}

static void test_link_of_stop_and_end_the_last_one_counts(void)
{
    link_end(&l);
    link_stop(&l);
    expect(EXIT, LINK_EXIT);
    link_end(&l);
    expect(0, LINK_ENDED);
}

static void test_link_button_that_called_does_not_undo_a_stop_that_comes_at_once(void)
{
    link_code(&l, LINK_CODE_STOP);
    link_code(&l, CODE_U);   /* the second packet of the press */
    expect(EXIT, LINK_EXIT);
}
