/* SPDX-License-Identifier: MIT
 * Lines typed at the loader's prompt: words, separators, numbers (boot/ORIGINAL.md, section 2, and
 * firmware/boot/DIFFERENCES.md). */
#include "firmware/boot/parse.h"
#include "unity.h"

#include <string.h>

static char line[80];
static parse_t parsed;

static parse_status_t parse(const char *text)
{
    strcpy(line, text);
    return parse_line(line, &parsed);
}

void tearDown(void) {}

static void test_word_alone_in_upper_case(void)
{
    TEST_ASSERT_EQUAL(PARSE_OK, parse("eep_Up"));
    TEST_ASSERT_EQUAL_STRING("EEP_UP", parsed.word);
    TEST_ASSERT_EQUAL_UINT8(0, parsed.count);
}

static void test_arguments_are_hexadecimal_with_or_without_0x(void)
{
    TEST_ASSERT_EQUAL(PARSE_OK, parse("up 1Fff0 0x1a"));
    TEST_ASSERT_EQUAL_STRING("UP", parsed.word);
    TEST_ASSERT_EQUAL_UINT8(2, parsed.count);
    TEST_ASSERT_EQUAL_HEX32(0x1FFF0, parsed.arg[0]);
    TEST_ASSERT_EQUAL_HEX32(0x1A, parsed.arg[1]);
}

static void test_a_missing_address_is_0_and_a_missing_length_1(void)
{
    TEST_ASSERT_EQUAL(PARSE_OK, parse("up 12 34"));
    TEST_ASSERT_EQUAL(PARSE_OK, parse("load"));
    TEST_ASSERT_EQUAL_HEX32(0, parsed.arg[0]);
    TEST_ASSERT_EQUAL_HEX32(1, parsed.arg[1]);
}

static void test_every_character_from_space_to_slash_and_tab_separates(void)
{
    const char *lines[] = {"f e000", "f,e000", "f , e000", "f\te000", "f/e000", "f-e000", "f.e000 ",
                           "  f  e000  ", "f#e000"};
    for (unsigned i = 0; i < sizeof lines / sizeof lines[0]; i++) {
        TEST_ASSERT_EQUAL_MESSAGE(PARSE_OK, parse(lines[i]), lines[i]);
        TEST_ASSERT_EQUAL_STRING("F", parsed.word);
        TEST_ASSERT_EQUAL_UINT8(1, parsed.count);
        TEST_ASSERT_EQUAL_HEX32(0xE000, parsed.arg[0]);
    }
}

/* A user who holds # at the start may leave some of them in front of the first word. */
static void test_hashes_before_a_word_are_blanks(void)
{
    const char *lines[] = {"#check", "#####check", " # check", "# #\tcheck"};
    for (unsigned i = 0; i < sizeof lines / sizeof lines[0]; i++) {
        TEST_ASSERT_EQUAL(PARSE_OK, parse(lines[i]));
        TEST_ASSERT_EQUAL_STRING("CHECK", parsed.word);
    }
}

static void test_a_leading_sign_makes_the_line_empty(void)
{
    const char *lines[] = {"", "   ", "\t", "#", "####", " # ", "/x", "*", "#-x"};
    for (unsigned i = 0; i < sizeof lines / sizeof lines[0]; i++) {
        TEST_ASSERT_EQUAL(PARSE_OK, parse(lines[i]));
        TEST_ASSERT_EQUAL_STRING("", parsed.word);
        TEST_ASSERT_EQUAL_UINT8(0, parsed.count);
    }
}

static void test_what_is_not_hexadecimal_is_refused(void)
{
    const char *lines[] = {"f g", "f 1g", "f 0x", "f x", "f 0x0x1", "f :", "f @", "f ~", "f 1 z", "f \x01", "f 1\xFF"};
    for (unsigned i = 0; i < sizeof lines / sizeof lines[0]; i++) {
        TEST_ASSERT_EQUAL_MESSAGE(PARSE_ERR_NUMBER, parse(lines[i]), lines[i]);
        TEST_ASSERT_EQUAL_STRING("F", parsed.word);
    }
}

static void test_numbers_above_20_bits_are_refused_leading_zeros_are_not(void)
{
    TEST_ASSERT_EQUAL(PARSE_OK, parse("f fffff"));
    TEST_ASSERT_EQUAL_HEX32(0xFFFFF, parsed.arg[0]);
    TEST_ASSERT_EQUAL(PARSE_OK, parse("f 0000000000001e000"));
    TEST_ASSERT_EQUAL_HEX32(0x1E000, parsed.arg[0]);
    TEST_ASSERT_EQUAL(PARSE_ERR_NUMBER, parse("f 100000"));
    TEST_ASSERT_EQUAL(PARSE_ERR_NUMBER, parse("f 21e0000"));
    TEST_ASSERT_EQUAL(PARSE_ERR_NUMBER, parse("f 10000000000000000000000000000000000e000"));
}

static void test_a_third_argument_is_too_many(void)
{
    TEST_ASSERT_EQUAL(PARSE_ERR_COUNT, parse("up 1 2 3"));
    TEST_ASSERT_EQUAL(PARSE_ERR_COUNT, parse("up 1 2 ggg"));
}

static void test_the_longest_line(void)
{
    memset(line, 'z', 79);
    line[79] = 0;
    TEST_ASSERT_EQUAL(PARSE_OK, parse_line(line, &parsed));
    TEST_ASSERT_EQUAL_UINT(79, strlen(parsed.word));
    TEST_ASSERT_EQUAL_CHAR('Z', parsed.word[78]);
}
