/* SPDX-License-Identifier: MIT
 * How the shell parses a line: words, numbers, dispatch; and how it prints text. */
#include "shell_stage.h"
#include "unity.h"

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

static uint8_t do_play(const shell_args_t *args)
{
    seen = args->count;
    return SHELL_OK;
}

static uint8_t do_fail(const shell_args_t *args)
{
    (void)args;
    return SHELL_ERR_REPORTED;
}

static uint8_t do_go(const shell_args_t *args)
{
    (void)args;
    return 7;
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
    shell_args_t args = enter(text);
    const uint8_t result = shell_run(table, ARRAY_COUNT(table), &args, moving);
    taken[0] = args.number[0];
    taken[1] = args.number[1];
    shell_clear(&shell);
    return result;
}

static void test_shell_run_finds_word_and_abbreviation_in_any_case(void)
{
    TEST_ASSERT_EQUAL_UINT8(SHELL_OK, run("PLAY 1"));
    TEST_ASSERT_EQUAL_UINT8(2, seen);
    TEST_ASSERT_EQUAL_UINT8(SHELL_OK, run("Pl 1 2"));
    TEST_ASSERT_EQUAL_UINT8(3, seen);
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
