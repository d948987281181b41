/* SPDX-License-Identifier: MIT */
#include "keys.h"
#include "unity.h"

static keys_t keys;

void setUp(void)
{
    keys_init(&keys);
}

/* Returns the key that the last byte of `text` completes. Earlier bytes must complete none. */
static uint8_t type(const char *text)
{
    uint8_t key = KEY_NONE;
    for (; *text != '\0'; text++) {
        TEST_ASSERT_EQUAL_UINT8(KEY_NONE, key);
        key = keys_byte(&keys, (uint8_t)*text);
    }
    return key;
}

static void test_keys_plain_bytes_pass(void)
{
    TEST_ASSERT_EQUAL_UINT8('p', type("p"));
    TEST_ASSERT_EQUAL_UINT8('\r', type("\r"));
    TEST_ASSERT_EQUAL_UINT8(3, type("\003"));
    TEST_ASSERT_EQUAL_UINT8(KEY_NONE, keys_byte(&keys, 0));
    TEST_ASSERT_EQUAL_UINT8(KEY_NONE, keys_byte(&keys, 0xC3));
}

static void test_keys_arrows_in_both_forms(void)
{
    TEST_ASSERT_EQUAL_UINT8(KEY_UP, type("\033[A"));
    TEST_ASSERT_EQUAL_UINT8(KEY_DOWN, type("\033[B"));
    TEST_ASSERT_EQUAL_UINT8(KEY_RIGHT, type("\033OC"));
    TEST_ASSERT_EQUAL_UINT8(KEY_LEFT, type("\033[D"));
}

static void test_keys_size_report(void)
{
    TEST_ASSERT_EQUAL_UINT8(KEY_SIZE, type("\033[24;80R"));
    TEST_ASSERT_EQUAL_UINT8(24, keys.rows);
    TEST_ASSERT_EQUAL_UINT8(KEY_SIZE, type("\033[9999;80R"));
    TEST_ASSERT_EQUAL_UINT8(255, keys.rows);
}

static void test_keys_unknown_sequences_vanish_whole(void)
{
    TEST_ASSERT_EQUAL_UINT8(KEY_NONE, type("\033[15~"));
    TEST_ASSERT_EQUAL_UINT8(KEY_NONE, type("\033[1;5G"));
    TEST_ASSERT_EQUAL_UINT8(KEY_NONE, type("\033x"));
    TEST_ASSERT_EQUAL_UINT8('p', type("p"));
}

static void test_keys_home_end_and_pages_as_terminals_send_them(void)
{
    static const struct {
        const char *sequence;
        uint8_t key;
    } sent[] = {{"\033[H", KEY_HOME}, {"\033OH", KEY_HOME}, {"\033[1~", KEY_HOME}, {"\033[7~", KEY_HOME},
                {"\033[F", KEY_END}, {"\033OF", KEY_END}, {"\033[4~", KEY_END}, {"\033[8~", KEY_END},
                {"\033[5~", KEY_PAGE_UP}, {"\033[6~", KEY_PAGE_DOWN}, {"\033[3~", KEY_NONE}};
    for (uint8_t i = 0; i < sizeof sent / sizeof sent[0]; i++) {
        TEST_ASSERT_EQUAL_UINT8_MESSAGE(sent[i].key, type(sent[i].sequence), sent[i].sequence + 1);
    }
}

static void test_keys_lone_escape_shows_when_quiet(void)
{
    TEST_ASSERT_EQUAL_UINT8(KEY_NONE, type("\033"));
    TEST_ASSERT_TRUE(keys_is_open(&keys));
    TEST_ASSERT_EQUAL_UINT8(KEY_ESCAPE, keys_quiet(&keys));
    TEST_ASSERT_FALSE(keys_is_open(&keys));
    TEST_ASSERT_EQUAL_UINT8(KEY_NONE, type("\033["));
    TEST_ASSERT_EQUAL_UINT8(KEY_NONE, keys_quiet(&keys));
    TEST_ASSERT_EQUAL_UINT8('A', type("A"));
}
