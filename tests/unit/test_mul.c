/* SPDX-License-Identifier: MIT
 * test_mul.c - the products of mul.h against plain C. On the ATmega128 this compares the assembler with gcc's
 * library. */
#include "mul.h"
#include "unity.h"

static const uint16_t words[] = {0, 1, 2, 0x7F, 0x80, 0xFF, 0x100, 0x101, 0x3FF, 0x7FFF, 0x8000, 0xABCD, 0xFF00, 0xFFFF};
static const uint32_t longs[] = {0, 1, 0xFF, 0x100, 0xFFFF, 0x10000, 0x12345678, 0x7FFFFFF, 0xFFFFFFFF};
#define COUNT(array) (sizeof(array) / sizeof((array)[0]))

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

static void test_long_and_word(void)
{
    for (uint8_t i = 0; i < COUNT(longs); i++) {
        for (uint8_t k = 0; k < COUNT(words); k++) {
            uint32_t product = (uint32_t)(((uint64_t)longs[i] * words[k]) >> 16);
            TEST_ASSERT_EQUAL_HEX32(product, mul_u32_u16_shift16(longs[i], words[k]));
        }
    }
}
