/* SPDX-License-Identifier: MIT
 * The line shell: keys, recall, words, numbers, dispatch. */
#include "shell.h"

#include <string.h>
#include "text.h"
#include "unity.h"

#define LINE_BYTES 21u
#define HISTORY_BYTES 24u

static shell_t shell;
static char line[LINE_BYTES], history[HISTORY_BYTES];
static char out[256];
static uint16_t out_count;

static void capture(char character)
{
    if (out_count < sizeof out - 1) {
        out[out_count++] = character;
        out[out_count] = '\0';
    }
}

static void clear_out(void)
{
    memset(out, 0, sizeof out);
    out_count = 0;
}

void setUp(void)
{
    text_init(capture);
    shell_init(&shell, line, sizeof line, history, sizeof history);
    clear_out();
}

void tearDown(void) {}

/* Returns what the last byte completed. */
static shell_event_t keys(const char *bytes)
{
    shell_event_t event = SHELL_TYPING;
    while (*bytes != '\0') {
        event = shell_byte(&shell, (uint8_t)*bytes++);
    }
    return event;
}

static shell_args_t enter(const char *text)
{
    TEST_ASSERT_EQUAL_UINT8(SHELL_TYPING, keys(text));
    TEST_ASSERT_EQUAL_UINT8(SHELL_LINE, keys("\r"));
    shell_args_t args;
    shell_split(&shell, false, &args);
    return args;
}

static void enter_and_clear(const char *text)
{
    (void)enter(text);
    shell_clear(&shell);
}

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
    TEST_ASSERT_EQUAL_UINT8(SHELL_TOO_LONG, keys("\r"));
    shell_clear(&shell);
    TEST_ASSERT_EQUAL_UINT8(SHELL_LINE, keys("ok\r"));
}

static void test_shell_ctrl_u_empties_the_line(void)
{
    keys("123456789012345678901\x15ok");
    TEST_ASSERT_EQUAL_UINT8(SHELL_LINE, keys("\r"));
    TEST_ASSERT_EQUAL_STRING("ok", line);
}

static void test_shell_escape_sequences_leave_no_trace(void)
{
    keys("a\x1B[C\x1B[1;5D\x1BOP\x1Bx\x1B[3~b");
    TEST_ASSERT_EQUAL_STRING("ab", out);
}

static void test_shell_line_end_breaks_off_an_escape_sequence(void)
{
    TEST_ASSERT_EQUAL_UINT8(SHELL_LINE, keys("stop\x1B[\r"));
}

static void test_shell_other_controls_and_8_bit_are_ignored(void)
{
    keys("a\tb\x03\x80\xE4\xFE" "c");
    TEST_ASSERT_EQUAL_STRING("abc", out);
}

/* ---- recall ---- */

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

/* ---- words and numbers ---- */

static void test_shell_words_are_separated_by_any_of_five(void)
{
    const shell_args_t args = enter(" ,play.1:;2 , 3 ");
    TEST_ASSERT_EQUAL_UINT8(4, args.count);
    TEST_ASSERT_EQUAL_STRING("play", shell_word(&args, 0));
    TEST_ASSERT_EQUAL_STRING("2", shell_word(&args, 2));
    TEST_ASSERT_EQUAL_STRING("3", shell_word(&args, 3));
    TEST_ASSERT_EQUAL_STRING("", shell_word(&args, 4));
}

static void test_shell_line_of_separators_has_no_word(void)
{
    const shell_args_t args = enter(" ., ;");
    TEST_ASSERT_EQUAL_UINT8(0, args.count);
    TEST_ASSERT_EQUAL_STRING("", shell_word(&args, 0));
}

static void test_shell_word_is_ignores_case(void)
{
    const shell_args_t args = enter("Remote HOLD");
    TEST_ASSERT_TRUE(shell_word_is(&args, 1, PSTR("hold")));
    TEST_ASSERT_FALSE(shell_word_is(&args, 1, PSTR("hol")));
}

static void test_shell_parse_takes_whole_words_only(void)
{
    static const struct {
        const char *word;
        bool hex, good;
        uint16_t value;
    } rows[] = {
        {"0", false, true, 0},          {"127", false, true, 127},    {"007", false, true, 7},
        {"65535", false, true, 65535},  {"65536", false, false, 0},   {"99999999999", false, false, 0},
        {"0x7F", false, true, 127},     {"0Xff", false, true, 255},   {"0x", false, false, 0},
        {"12a", false, false, 0},       {"a", false, false, 0},       {"-5", false, false, 0},
        {"", false, false, 0},          {"0b1", false, false, 0},     {"x", false, false, 0},
        {"7f", true, true, 127},        {"10", true, true, 16},       {"0x10", true, true, 16},
        {"g", true, false, 0},          {"10000", true, false, 0},    {"1 2", false, false, 0},
    };
    for (uint8_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        uint16_t value = 4711;
        TEST_ASSERT_EQUAL_MESSAGE(rows[i].good, shell_parse(rows[i].word, rows[i].hex, &value), rows[i].word);
        TEST_ASSERT_EQUAL_UINT16_MESSAGE(rows[i].good ? rows[i].value : 4711, value, rows[i].word);
    }
}

/* ---- dispatch ---- */

static uint8_t seen;

static uint8_t do_play(void *context, const shell_args_t *args)
{
    seen = (uint8_t)(args->count + *(uint8_t *)context);
    return SHELL_OK;
}

static uint8_t do_fail(void *context, const shell_args_t *args)
{
    (void)context;
    (void)args;
    return SHELL_ERR_REPORTED;
}

static uint8_t do_go(void *context, const shell_args_t *args)
{
    (void)context;
    (void)args;
    return 7;
}

TEXT_NAMED(name_page, "Page");
TEXT_NAMED(name_rate, "Rate");
TEXT_NAMED(name_blend, "Blend");
static const shell_range_t ranges_P[] PROGMEM = {{name_page, 1, 127}, {name_rate, 10, 400}, {name_blend, -100, 100}};

const shell_range_t *shell_range_P(uint8_t range)
{
    return &ranges_P[range - 1];
}

TEXT_NAMED(word_go, "go  page rate  goes");
TEXT_NAMED(word_play, "play pl n  plays a page");
TEXT_NAMED(word_fail, "fail  fails");
static const shell_command_t table[] PROGMEM = {
    {word_play, do_play, SHELL_ARGS(1, 2), 0},
    {word_fail, do_fail, SHELL_ARGS(0, SHELL_ANY_ARGS), 0},
    {word_go, do_go, SHELL_ARGS(1, 2) | SHELL_STILL, SHELL_BOTH(1, 2)},
};
static bool moving;
static uint16_t taken[2];

static uint8_t run(const char *text)
{
    static uint8_t context = 40;
    shell_args_t args = enter(text);
    const uint8_t result = shell_run(table, ARRAY_COUNT(table), &context, &args, moving);
    taken[0] = args.number[0];
    taken[1] = args.number[1];
    shell_clear(&shell);
    return result;
}

static void test_shell_run_finds_word_and_abbreviation_in_any_case(void)
{
    TEST_ASSERT_EQUAL_UINT8(SHELL_OK, run("PLAY 1"));
    TEST_ASSERT_EQUAL_UINT8(42, seen);
    TEST_ASSERT_EQUAL_UINT8(SHELL_OK, run("Pl 1 2"));
    TEST_ASSERT_EQUAL_UINT8(43, seen);
    TEST_ASSERT_EQUAL_UINT8(SHELL_ERR_REPORTED, run("fail"));
}

static void test_shell_run_wants_the_whole_word(void)
{
    TEST_ASSERT_EQUAL_UINT8(SHELL_ERR_UNKNOWN, run("pla 1"));
    TEST_ASSERT_EQUAL_UINT8(SHELL_ERR_UNKNOWN, run("playe 1"));
    TEST_ASSERT_EQUAL_UINT8(SHELL_ERR_UNKNOWN, run("p 1"));
    TEST_ASSERT_EQUAL_UINT8(SHELL_ERR_UNKNOWN, run("plays")); /* of the help */
    TEST_ASSERT_EQUAL_UINT8(SHELL_ERR_UNKNOWN, run("fails"));
}

static void test_shell_run_counts_the_arguments(void)
{
    seen = 0;
    TEST_ASSERT_EQUAL_UINT8(SHELL_ERR_COUNT, run("play"));
    TEST_ASSERT_EQUAL_UINT8(SHELL_ERR_COUNT, run("play 1 2 3"));
    TEST_ASSERT_EQUAL_UINT8(0, seen);
    TEST_ASSERT_EQUAL_UINT8(SHELL_ERR_REPORTED, run("fail 1 2 3 4 5 6"));
}

static void test_shell_run_of_an_empty_line_is_ok(void)
{
    TEST_ASSERT_EQUAL_UINT8(SHELL_OK, run("  "));
}

static void test_shell_run_takes_the_numbers_that_the_table_names(void)
{
    TEST_ASSERT_EQUAL_UINT8(7, run("go 127 0x10"));
    TEST_ASSERT_EQUAL_UINT16(127, taken[0]);
    TEST_ASSERT_EQUAL_UINT16(16, taken[1]);
    TEST_ASSERT_EQUAL_UINT8(7, run("go 1"));
    TEST_ASSERT_EQUAL_UINT16(0, taken[1]);
    static const char *const wrong[] = {"go 0", "go 128", "go x", "go 5 9", "go 5 401", "go 5 1x"};
    for (uint8_t i = 0; i < ARRAY_COUNT(wrong); i++) {
        TEST_ASSERT_EQUAL_UINT8_MESSAGE(SHELL_ERR_RANGE, run(wrong[i]), wrong[i]);
    }
    clear_out();
    shell_print_range_error();
    TEST_ASSERT_EQUAL_STRING("Rate must be 10..400", out);
}

static void test_shell_take_of_a_word_out_of_range_leaves_the_value_and_names_the_range(void)
{
    static const struct {
        const char *line;
        bool good;
        int16_t value;
        const char *said;
    } rows[] = {
        {"x 127", true, 127, ""},   {"x 0", false, 5, "Page must be 1..127"},  {"x 128", false, 5, "Page must be 1..127"},
        {"x -1", false, 5, "Page must be 1..127"}, {"x", false, 5, "Page must be 1..127"},
        {"x 32768", false, 5, "Page must be 1..127"}, {"x -", false, 5, "Page must be 1..127"},
    };
    for (uint8_t i = 0; i < ARRAY_COUNT(rows); i++) {
        const shell_args_t args = enter(rows[i].line);
        uint16_t value = 5;
        TEST_ASSERT_EQUAL_MESSAGE(rows[i].good, shell_take(&args, 1, 1, &value), rows[i].line);
        TEST_ASSERT_EQUAL_INT16_MESSAGE(rows[i].value, (int16_t)value, rows[i].line);
        clear_out();
        if (!rows[i].good) {
            shell_print_range_error();
        }
        TEST_ASSERT_EQUAL_STRING(rows[i].said, out);
        shell_clear(&shell);
    }
}

static void test_shell_take_of_a_range_below_zero(void)
{
    static const char *const wrong[] = {"x -101", "x 101", "x --5", "x -0x", "x 5-", "x -65535", "x 65436"};
    uint16_t value = 0;
    shell_args_t args = enter("x -100");
    TEST_ASSERT_TRUE(shell_take(&args, 1, 3, &value));
    TEST_ASSERT_EQUAL_INT16(-100, (int16_t)value);
    for (uint8_t i = 0; i < ARRAY_COUNT(wrong); i++) {
        shell_clear(&shell);
        args = enter(wrong[i]);
        TEST_ASSERT_FALSE_MESSAGE(shell_take(&args, 1, 3, &value), wrong[i]);
    }
    clear_out();
    shell_print_range_error();
    TEST_ASSERT_EQUAL_STRING("Blend must be -100..100", out);
}

static void test_shell_take_in_hex_mode_names_the_range_so(void)
{
    keys("page 80\r");
    shell_args_t args;
    shell_split(&shell, true, &args);
    uint16_t page = 5;
    TEST_ASSERT_FALSE(shell_take(&args, 1, 1, &page));
    clear_out();
    shell_print_range_error();
    TEST_ASSERT_EQUAL_STRING("Page must be 0x01..0x7F", out);
}

static void test_shell_run_keeps_back_what_must_not_be_while_something_moves(void)
{
    moving = true;
    TEST_ASSERT_EQUAL_UINT8(SHELL_ERR_MOVING, run("go 5"));
    TEST_ASSERT_EQUAL_UINT8(SHELL_OK, run("play 1"));
    moving = false;
    TEST_ASSERT_EQUAL_UINT8(7, run("go 5"));
}

static void test_shell_help_prints_one_line(void)
{
    const shell_args_t args = enter("help pl");
    clear_out();
    const shell_command_t *found = shell_find(table, 2, &args, 1);
    TEST_ASSERT_NOT_NULL(found);
    shell_print_help(found);
    TEST_ASSERT_EQUAL_STRING("play      pl   n  plays a page\r\n", out);
}

/* ---- text ---- */

static void test_text_prints_numbers(void)
{
    text_number(0);
    text_put(' ');
    text_number(65535);
    text_put(' ');
    text_number32(4294967295UL);
    text_put(' ');
    text_padded(7, 3, '0');
    text_padded(1023, 3, '0');
    text_padded(12, 4, ' ');
    text_put(' ');
    text_hex(0xBEEF, 4);
    text_hex(0x0A, 2);
    text_line_end();
    TEST_ASSERT_EQUAL_STRING("0 65535 4294967295 0071023  12 BEEF0A\r\n", out);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_shell_echoes_what_is_typed);
    RUN_TEST(test_shell_cr_lf_and_crlf_each_end_a_line_once);
    RUN_TEST(test_shell_bs_and_del_delete);
    RUN_TEST(test_shell_delete_at_the_start_does_nothing);
    RUN_TEST(test_shell_line_of_full_length_is_taken);
    RUN_TEST(test_shell_too_long_line_is_refused_not_cut);
    RUN_TEST(test_shell_ctrl_u_empties_the_line);
    RUN_TEST(test_shell_escape_sequences_leave_no_trace);
    RUN_TEST(test_shell_line_end_breaks_off_an_escape_sequence);
    RUN_TEST(test_shell_other_controls_and_8_bit_are_ignored);
    RUN_TEST(test_shell_ctrl_a_recalls_several_lines);
    RUN_TEST(test_shell_arrows_walk_through_the_history);
    RUN_TEST(test_shell_recall_stops_at_the_oldest);
    RUN_TEST(test_shell_recall_without_history_does_nothing);
    RUN_TEST(test_shell_history_drops_whole_oldest_lines_when_full);
    RUN_TEST(test_shell_recall_stops_at_the_oldest_of_a_full_history);
    RUN_TEST(test_shell_history_keeps_words_whole_and_repeats_once);
    RUN_TEST(test_shell_words_are_separated_by_any_of_five);
    RUN_TEST(test_shell_line_of_separators_has_no_word);
    RUN_TEST(test_shell_word_is_ignores_case);
    RUN_TEST(test_shell_parse_takes_whole_words_only);
    RUN_TEST(test_shell_run_finds_word_and_abbreviation_in_any_case);
    RUN_TEST(test_shell_run_wants_the_whole_word);
    RUN_TEST(test_shell_run_counts_the_arguments);
    RUN_TEST(test_shell_run_of_an_empty_line_is_ok);
    RUN_TEST(test_shell_run_takes_the_numbers_that_the_table_names);
    RUN_TEST(test_shell_take_of_a_word_out_of_range_leaves_the_value_and_names_the_range);
    RUN_TEST(test_shell_take_of_a_range_below_zero);
    RUN_TEST(test_shell_take_in_hex_mode_names_the_range_so);
    RUN_TEST(test_shell_run_keeps_back_what_must_not_be_while_something_moves);
    RUN_TEST(test_shell_help_prints_one_line);
    RUN_TEST(test_text_prints_numbers);
    return UNITY_END();
}
