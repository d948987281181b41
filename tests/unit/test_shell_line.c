/* SPDX-License-Identifier: MIT
 * The line of the shell: keys and recall. */
#include <string.h>
#include "shell_stage.h"
#include "unity.h"

/* ---- keys ---- */

static void test_shell_echoes_what_is_typed(void)
{
    TEST_ASSERT_EQUAL_UINT8(SHELL_TYPING, keys("list"));
    TEST_ASSERT_EQUAL_STRING("list", out);
}

static void test_shell_cr_lf_and_crlf_each_end_a_line_once(void)
{
    TEST_ASSERT_EQUAL_UINT8(SHELL_LINE, keys("a\r"));
    shell_clear(&shell);
    TEST_ASSERT_EQUAL_UINT8(SHELL_TYPING, keys("\n"));
    TEST_ASSERT_EQUAL_UINT8(SHELL_LINE, keys("\n"));
    shell_clear(&shell);
    TEST_ASSERT_EQUAL_UINT8(SHELL_LINE, keys("b\n"));
    shell_clear(&shell);
    TEST_ASSERT_EQUAL_UINT8(SHELL_LINE, keys("\r"));
    shell_clear(&shell);
    TEST_ASSERT_EQUAL_UINT8(SHELL_LINE, keys("\r"));
}

static void test_shell_bs_and_del_delete(void)
{
    keys("lisk\bx\x7Ft");
    TEST_ASSERT_EQUAL_STRING("lisk\b \bx\b \bt", out);
    keys("\r");
    TEST_ASSERT_EQUAL_STRING("list", line);
}

static void test_shell_delete_at_the_start_does_nothing(void)
{
    keys("\b\x7F");
    TEST_ASSERT_EQUAL_STRING("", out);
}

static void test_shell_line_of_full_length_is_taken(void)
{
    keys("12345678901234567890");
    TEST_ASSERT_EQUAL_UINT8(SHELL_LINE, keys("\r"));
    TEST_ASSERT_EQUAL_STRING("12345678901234567890", line);
}

static void test_shell_too_long_line_is_refused_not_cut(void)
{
    keys("123456789012345678901");
    TEST_ASSERT_EQUAL_STRING("12345678901234567890\a", out);
    TEST_ASSERT_EQUAL_UINT8(SHELL_REFUSED, keys("\r"));
    shell_clear(&shell);
    TEST_ASSERT_EQUAL_UINT8(SHELL_LINE, keys("ok\r"));
}

static void test_shell_ctrl_c_and_ctrl_u_empty_the_line(void)
{
    keys("123456789012345678901\x15no\x03ok");
    TEST_ASSERT_EQUAL_UINT8(SHELL_LINE, keys("\r"));
    TEST_ASSERT_EQUAL_STRING("ok", line);
}

static void test_shell_escape_sequences_leave_no_trace(void)
{
    keys("a\x1B[C\x1B[1;5D\x1BOP\x1B\x1B[3~b");
    TEST_ASSERT_EQUAL_STRING("ab", out);
}

/* A terminal sends ESC alone for the Escape key; the next key is not part of a sequence then. */
static void test_shell_a_lone_escape_takes_no_key_with_it(void)
{
    keys("abc\x1Bxyz\x1B\x08");
    TEST_ASSERT_EQUAL_UINT8(SHELL_LINE, keys("\x1B\r"));
    TEST_ASSERT_EQUAL_STRING("abcxy", line);
}

static void test_shell_a_bracket_typed_after_a_lone_escape_is_a_character(void)
{
    keys("a\x1B");
    shell_quiet(&shell);
    keys("[b\x1B[");
    shell_quiet(&shell);
    TEST_ASSERT_EQUAL_UINT8(SHELL_LINE, keys("Oc\r"));
    TEST_ASSERT_EQUAL_STRING("a[bOc", line);
}

static void test_shell_line_end_breaks_off_an_escape_sequence(void)
{
    TEST_ASSERT_EQUAL_UINT8(SHELL_LINE, keys("stop\x1B[\r"));
}

static void test_shell_other_controls_and_8_bit_are_ignored(void)
{
    keys("a\tb\x04\x80\xE4\xFE" "c");
    TEST_ASSERT_EQUAL_STRING("abc", out);
}

/* ---- recall ---- */

static void enter_and_clear(const char *text)
{
    (void)enter(text);
    shell_clear(&shell);
}

static void test_shell_ctrl_a_recalls_several_lines(void)
{
    enter_and_clear("list");
    enter_and_clear("status");
    keys("x\x01");
    keys("\x01\r");
    TEST_ASSERT_EQUAL_STRING("list", line);
}

static void test_shell_arrows_walk_through_the_history(void)
{
    enter_and_clear("list");
    enter_and_clear("status");
    keys("\x1B[A\x1B[A\x1B[B\r");
    TEST_ASSERT_EQUAL_STRING("status", line);
}

static void test_shell_recall_stops_at_the_oldest(void)
{
    enter_and_clear("list");
    keys("\x01\x01\x01\r");
    TEST_ASSERT_EQUAL_STRING("list", line);
}

static void test_shell_recall_without_history_does_nothing(void)
{
    keys("ab\x01\x1B[A");
    TEST_ASSERT_EQUAL_STRING("ab", out);
    shell_init(&shell, line, sizeof line, NULL, 0);
    enter_and_clear("list");
    keys("\x01\r");
    TEST_ASSERT_EQUAL_STRING("", line);
}

static void test_shell_history_drops_whole_oldest_lines_when_full(void)
{
    enter_and_clear("oldest line");      /* 12 bytes with its NUL */
    enter_and_clear("second");           /* 7 */
    enter_and_clear("third");            /* 6: the oldest no longer fits into 24 */
    keys("\x01\x01\x01\r");
    TEST_ASSERT_EQUAL_STRING("second", line);
}

static void test_shell_recall_stops_at_the_oldest_of_a_full_history(void)
{
    enter_and_clear("eleven byte");      /* 12 with its NUL: two of these fill all 24 */
    enter_and_clear("also twelve");
    keys("\x01\x01\x01\r");
    TEST_ASSERT_EQUAL_STRING("also twelve", line);
}

static void test_shell_history_keeps_words_whole_and_repeats_once(void)
{
    enter_and_clear("play 1");
    enter_and_clear("play 1");
    enter_and_clear("off 1,2");
    keys("\x01\x01\r");
    TEST_ASSERT_EQUAL_STRING("play 1", line);
    shell_clear(&shell);
    keys("\x01\r");
    TEST_ASSERT_EQUAL_STRING("off 1,2", line);
}

static void test_shell_an_empty_line_leaves_the_history(void)
{
    enter_and_clear("list");
    enter_and_clear("");
    keys("\x01\r");
    TEST_ASSERT_EQUAL_STRING("list", line);
}

/* Play's and Edit's lines are longer than their history. The list of lines ends with two NULs. */
static void test_shell_a_line_longer_than_the_history_is_not_kept(void)
{
    char small[1 + 10 + 1];
    for (uint8_t length = 7; length <= 12; length++) {
        const char *text = &"123456789012"[12 - length];
        memset(small, 'x', sizeof small);
        shell_init(&shell, line, sizeof line, small + 1, 10);
        enter_and_clear("ab");
        enter_and_clear(text);
        keys("\x01\r");
        TEST_ASSERT_EQUAL_STRING(length + 2u <= 10 ? text : "ab", line);
        TEST_ASSERT_EQUAL_CHAR('x', small[0]);
        TEST_ASSERT_EQUAL_CHAR('x', small[11]);
    }
}
