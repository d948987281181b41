/* SPDX-License-Identifier: MIT
 * Small words of cm5sim's command line and scripts. */
#include <string.h>

#include "cli_text.h"
#include "unity.h"

void setUp(void)
{
}

void tearDown(void)
{
}

static uint64_t duration(const char *text)
{
    uint64_t cycles = 12345;
    TEST_ASSERT_TRUE_MESSAGE(cli_duration(text, &cycles), text);
    return cycles;
}

static void test_cli_duration_is_in_cycles_of_16_MHz(void)
{
    TEST_ASSERT_EQUAL_UINT64(16000000, duration("1s"));
    TEST_ASSERT_EQUAL_UINT64(24000000, duration("1.5s"));
    TEST_ASSERT_EQUAL_UINT64(8000000, duration("500ms"));
    TEST_ASSERT_EQUAL_UINT64(320, duration("20us"));
    TEST_ASSERT_EQUAL_UINT64(16000000, duration("128ticks")); /* 128 to a second */
    TEST_ASSERT_EQUAL_UINT64(125000, duration("1tick"));
    TEST_ASSERT_EQUAL_UINT64(1920000000, duration("2min"));
    TEST_ASSERT_EQUAL_UINT64(7, duration("7cycles"));
    TEST_ASSERT_EQUAL_UINT64(0, duration("0"));
}

static void test_cli_duration_refuses_everything_else(void)
{
    static const char *const wrong[] = {"", "s", "5", "5x", "-1s", "1s2", "nan", "inf", "1e99s", "five"};
    uint64_t cycles;
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        TEST_ASSERT_FALSE_MESSAGE(cli_duration(wrong[i], &cycles), wrong[i]);
    }
}

static void test_cli_number_keeps_to_its_range(void)
{
    long value;
    TEST_ASSERT_TRUE(cli_number("253", 0, 253, &value));
    TEST_ASSERT_EQUAL_INT(253, value);
    TEST_ASSERT_TRUE(cli_number("0x1f", 0, 253, &value));
    TEST_ASSERT_EQUAL_INT(31, value);
    TEST_ASSERT_TRUE(cli_number("010", 0, 253, &value)); /* decimal: nobody means octal */
    TEST_ASSERT_EQUAL_INT(10, value);
    TEST_ASSERT_FALSE(cli_number("254", 0, 253, &value));
    TEST_ASSERT_FALSE(cli_number("-1", 0, 253, &value));
    TEST_ASSERT_FALSE(cli_number("", 0, 253, &value));
    TEST_ASSERT_FALSE(cli_number("12a", 0, 253, &value));
}

static void test_cli_rc_keys_are_the_bits_of_the_remote(void)
{
    uint16_t word;
    TEST_ASSERT_TRUE(cli_rc_keys("U", &word));
    TEST_ASSERT_EQUAL_HEX16(1, word);
    TEST_ASSERT_TRUE(cli_rc_keys("d+L+r", &word));
    TEST_ASSERT_EQUAL_HEX16(14, word);
    TEST_ASSERT_TRUE(cli_rc_keys("1+6", &word));
    TEST_ASSERT_EQUAL_HEX16(16 + 512, word);
    TEST_ASSERT_TRUE(cli_rc_keys("0", &word));
    TEST_ASSERT_EQUAL_HEX16(0, word);
    TEST_ASSERT_FALSE(cli_rc_keys("", &word));
    TEST_ASSERT_FALSE(cli_rc_keys("7", &word));
    TEST_ASSERT_FALSE(cli_rc_keys("U+", &word));
    TEST_ASSERT_FALSE(cli_rc_keys("UD", &word));
}

static void test_cli_rc_packet_carries_each_byte_and_its_complement(void)
{
    static const uint8_t expected[] = {0xFF, 0x55, 0x41, 0xBE, 0x02, 0xFD};
    uint8_t packet[CLI_RC_BYTES];
    cli_rc_packet(0x0241, packet);
    TEST_ASSERT_EQUAL_HEX8_ARRAY(expected, packet, sizeof expected);
}

static void test_cli_split_finds_words_texts_and_comments(void)
{
    char line[] = "  send\t\"a # \\r\\n\\x41\\\"\\\\\" within 2s# rest\n";
    cli_word_t words[4];
    const char *error = NULL;
    TEST_ASSERT_EQUAL_INT(4, cli_split(line, words, 4, &error));
    TEST_ASSERT_EQUAL_STRING("send", words[0].text);
    TEST_ASSERT_FALSE(words[0].quoted);
    TEST_ASSERT_TRUE(words[1].quoted);
    TEST_ASSERT_EQUAL_STRING("a # \r\nA\"\\", words[1].text);
    TEST_ASSERT_EQUAL_INT(9, words[1].length);
    TEST_ASSERT_EQUAL_STRING("2s", words[3].text);
}

static void test_cli_split_lets_a_text_hold_zeros(void)
{
    char line[] = "\"a\\0b\\x00\"";
    cli_word_t word;
    const char *error = NULL;
    TEST_ASSERT_EQUAL_INT(1, cli_split(line, &word, 1, &error));
    TEST_ASSERT_EQUAL_INT(4, word.length);
    TEST_ASSERT_EQUAL_MEMORY("a\0b\0", word.text, 4);
}

static void test_cli_split_names_what_is_wrong(void)
{
    static const char *const wrong[] = {"\"open", "\"\\q\"", "\"\\x4\"", "\"\\", "a b c"};
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        char line[20];
        cli_word_t words[2];
        const char *error = NULL;
        strcpy(line, wrong[i]);
        TEST_ASSERT_EQUAL_INT_MESSAGE(-1, cli_split(line, words, 2, &error), wrong[i]);
        TEST_ASSERT_NOT_NULL(error);
    }
    char empty[] = "   # nothing";
    const char *error = NULL;
    TEST_ASSERT_EQUAL_INT(0, cli_split(empty, NULL, 0, &error));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_cli_duration_is_in_cycles_of_16_MHz);
    RUN_TEST(test_cli_duration_refuses_everything_else);
    RUN_TEST(test_cli_number_keeps_to_its_range);
    RUN_TEST(test_cli_rc_keys_are_the_bits_of_the_remote);
    RUN_TEST(test_cli_rc_packet_carries_each_byte_and_its_complement);
    RUN_TEST(test_cli_split_finds_words_texts_and_comments);
    RUN_TEST(test_cli_split_lets_a_text_hold_zeros);
    RUN_TEST(test_cli_split_names_what_is_wrong);
    return UNITY_END();
}
