/* SPDX-License-Identifier: MIT
 * test_mul.c - the products of mul.h against plain C; on the ATmega128 that is the assembler against gcc's library. */
#include "mul.h"
#include "unity.h"

static const uint16_t words[] = {0, 1, 2, 0x7F, 0x80, 0xFF, 0x100, 0x101, 0x3FF, 0x7FFF, 0x8000, 0xABCD, 0xFF00, 0xFFFF};
static const uint32_t longs[] = {0, 1, 0xFF, 0x100, 0xFFFF, 0x10000, 0x12345678, 0x7FFFFFF, 0xFFFFFFFF};
#define COUNT(array) (sizeof(array) / sizeof((array)[0]))

void setUp(void)
{
}

void tearDown(void)
{
}

static void test_two_words(void)
{
    for (uint8_t i = 0; i < COUNT(words); i++) {
        for (uint8_t k = 0; k < COUNT(words); k++) {
            uint32_t product = (uint32_t)words[i] * words[k];
            TEST_ASSERT_EQUAL_HEX32(product, mul_u16_u16(words[i], words[k]));
            TEST_ASSERT_EQUAL_HEX16(product >> 16, mul_u16_high(words[i], words[k]));
        }
    }
}

static void test_words_and_bytes(void)
{
    for (uint8_t i = 0; i < COUNT(words); i++) {
        for (uint8_t k = 0; k < COUNT(words); k++) {
            uint8_t a = (uint8_t)words[i], b = (uint8_t)words[k];
            TEST_ASSERT_EQUAL_HEX8((uint32_t)words[i] * b >> 8, mul_u16_u8_shift8(words[i], b));
            TEST_ASSERT_EQUAL_HEX8((uint32_t)a * b >> 8, mul_u8_high(a, b));
        }
    }
}

static void test_word_and_three_bytes(void)
{
    static const uint32_t threes[] = {0, 1, 0xFF, 0x100, 0xFFFF, 0x10000, 0xD55556, 0xABCDEF, 0xFFFFFF};
    for (uint8_t i = 0; i < COUNT(threes); i++) {
        for (uint8_t k = 0; k < COUNT(words); k++) {
            uint32_t product = (uint32_t)(((uint64_t)threes[i] * words[k]) >> 16);
            TEST_ASSERT_EQUAL_HEX32(product, mul_u16_u24_shift16(words[k], threes[i]));
        }
        for (uint8_t k = 0; k < COUNT(longs); k++) {
            uint16_t product = (uint16_t)(((uint64_t)threes[i] * longs[k]) >> 32);
            TEST_ASSERT_EQUAL_HEX16(product, mul_u24_u32_shift32(threes[i], longs[k]));
        }
    }
}

static void test_long_and_word(void)
{
    for (uint8_t i = 0; i < COUNT(longs); i++) {
        for (uint8_t k = 0; k < COUNT(words); k++) {
            uint32_t product = (uint32_t)(((uint64_t)longs[i] * words[k]) >> 16);
            TEST_ASSERT_EQUAL_HEX32(product, mul_u32_u16_shift16(longs[i], words[k]));
        }
        TEST_ASSERT_EQUAL_HEX32(longs[i] >> 4, shift_u32_right4(longs[i]));
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_two_words);
    RUN_TEST(test_words_and_bytes);
    RUN_TEST(test_word_and_three_bytes);
    RUN_TEST(test_long_and_word);
    return UNITY_END();
}
