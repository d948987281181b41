/* SPDX-License-Identifier: MIT
 * Cells: addresses and texts of edit/ORIGINAL.md sections 1 and 4. */
#include "cells.h"
#include "unity.h"

static void test_cells_addresses_are_those_of_the_original(void)
{
    TEST_ASSERT_EQUAL_UINT16(512, cell_address(0, 0));
    TEST_ASSERT_EQUAL_UINT16(572, cell_address(0, 30));
    TEST_ASSERT_EQUAL_UINT16(574, cell_address(0, 31));
    TEST_ASSERT_EQUAL_UINT16(575, cell_address(0, 32));
    TEST_ASSERT_EQUAL_UINT16(64, cell_address(1, 0));
    TEST_ASSERT_EQUAL_UINT16(64 * 7 + 60, cell_address(7, 30));
    TEST_ASSERT_EQUAL_UINT16(64 * 3 + 62, cell_address(3, 31));
    TEST_ASSERT_EQUAL_UINT16(64 * 3 + 63, cell_address(3, 32));
    TEST_ASSERT_EQUAL_UINT16(32, cell_address(8, 0));
    TEST_ASSERT_EQUAL_UINT16(62, cell_address(8, 30));
    TEST_ASSERT_EQUAL_UINT16(14, cell_address(9, 3));
    TEST_ASSERT_EQUAL_UINT16(20, cell_address(9, 9));
    TEST_ASSERT_EQUAL_UINT16(30, cell_address(9, 19));
}

static void test_cells_exist_where_the_original_has_them(void)
{
    for (uint8_t y = 0; y < 40; y++) {
        TEST_ASSERT_EQUAL(y <= 32, cell_kind(1, 0, y) != CELL_NONE);
        TEST_ASSERT_EQUAL(y <= 32, cell_kind(1, 7, y) != CELL_NONE);
        TEST_ASSERT_EQUAL(y <= 30, cell_kind(1, 8, y) != CELL_NONE);
        TEST_ASSERT_EQUAL(y >= 3 && y <= 19, cell_kind(1, 9, y) != CELL_NONE);
        TEST_ASSERT_EQUAL(CELL_NONE, cell_kind(1, 10, y));
    }
    TEST_ASSERT_EQUAL(CELL_OFFSET, cell_kind(0, 3, 5));
    TEST_ASSERT_EQUAL(CELL_POSITION, cell_kind(1, 3, 5));
    TEST_ASSERT_EQUAL(CELL_BYTE, cell_kind(0, 3, 31));
}

static void test_cells_every_shown_byte_finds_its_cell(void)
{
    for (uint16_t address = 14; address < CELLS_BYTES; address++) {
        uint8_t x = 99, y = 99;
        if (address == 31 || address == 63) {
            TEST_ASSERT_FALSE(cell_at(address, &x, &y));
            continue;
        }
        TEST_ASSERT_TRUE(cell_at(address, &x, &y));
        uint16_t back = cell_address(x, y);
        TEST_ASSERT_TRUE(back == address || (cell_kind(1, x, y) == CELL_POSITION && back + 1u == address));
    }
}

static void test_cells_words_show_as_the_original_shows_them(void)
{
    static const struct { uint16_t word; const char *text; } cases[] = {
        { 0, "0000" }, { 512, "0512" }, { 1023, "1023" }, { 0x2000, "????" }, { 0x2151, "????" }, { 0x6000, "????" },
        { 0x27FF, "????" }, { 0x4000, "----" }, { 0x4200, "----" }, { 1024, "----" }, { 0x1FFF, "----" },
        { 0x5FFF, "----" }, { 0x8000, "2768" }, { 0xFFFF, "5535" },
    };
    char text[CELLS_TEXT_BYTES];
    for (unsigned i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        cell_position_text(cases[i].word, false, text);
        TEST_ASSERT_EQUAL_STRING(cases[i].text, text);
    }
    cell_position_text(1023, true, text);
    TEST_ASSERT_EQUAL_STRING("03FF", text);
}

static void test_cells_bytes_and_offsets(void)
{
    char text[CELLS_TEXT_BYTES];
    cell_byte_text(7, false, text);
    TEST_ASSERT_EQUAL_STRING("007", text);
    cell_byte_text(0x5A, true, text);
    TEST_ASSERT_EQUAL_STRING("5A ", text);
    cell_offset_text((uint16_t)-12, text);
    TEST_ASSERT_EQUAL_STRING("-012", text);
    cell_offset_text(300, text);
    TEST_ASSERT_EQUAL_STRING("+300", text);
    cell_offset_text(0, text);
    TEST_ASSERT_EQUAL_STRING("0000", text);
    cell_offset_text(0x4000, text);
    TEST_ASSERT_EQUAL_STRING("----", text);
}

static void test_cells_limits(void)
{
    TEST_ASSERT_EQUAL_UINT16(1023, cell_max(CELL_POSITION, 1, 0));
    TEST_ASSERT_EQUAL_UINT16(7, cell_max(CELL_BYTE, 9, 9));
    TEST_ASSERT_EQUAL_UINT16(127, cell_max(CELL_BYTE, 9, 14));
    TEST_ASSERT_EQUAL_UINT16(127, cell_max(CELL_BYTE, 9, 6));   /* partners, bytes 17 and 18 */
    TEST_ASSERT_EQUAL_UINT16(127, cell_max(CELL_BYTE, 9, 7));
    TEST_ASSERT_EQUAL_UINT16(255, cell_max(CELL_BYTE, 9, 5));
    TEST_ASSERT_EQUAL_UINT16(255, cell_max(CELL_BYTE, 9, 4));
    TEST_ASSERT_EQUAL_UINT16(255, cell_max(CELL_BYTE, 8, 14));
}
