/* SPDX-License-Identifier: MIT
 * The session over the fake flash: opening, editing, undo, and which cells are marked. */
#include "fake_flash.h"
#include "memory_map.h"
#include "session.h"
#include "unity.h"

#include <string.h>

static uint8_t *flash_page(uint8_t page)
{
    return fake_flash_bytes() + MEM_MOTION_START + 512u * page;
}

/* Stores a page with three steps of 18 joints, in the format of edit/ORIGINAL.md. */
static void store(uint8_t page, uint8_t seed)
{
    uint8_t *bytes = flash_page(page);
    page_clear(bytes);
    bytes[PAGE_AT_NAME] = (uint8_t)('a' + seed);
    bytes[PAGE_AT_STEPS] = 3;
    for (uint8_t step = 0; step < 7; step++) {
        for (uint8_t joint = 1; joint <= 18; joint++) {
            page_set_pos(bytes, step, joint, (uint16_t)(100u * step + 10u * joint + seed));
        }
        bytes[64 + 64 * step + 63] = (uint8_t)(64 + step);
    }
    page_seal(bytes);
}

void setUp(void)
{
    fake_flash_reset();
    store(1, 1);
    store(2, 2);
    session_init();
}

static void take_marks(void)
{
    memset(the_session.marks, 0, sizeof the_session.marks);
}

static uint16_t marked(void)
{
    uint16_t count = 0;
    for (uint8_t y = 0; y < CELLS_ROWS; y++) {
        for (uint8_t x = 0; x < CELLS_COLUMNS; x++) {
            count = (uint16_t)(count + ((the_session.marks[y] & 1u << x) != 0));
        }
    }
    return count;
}

static void test_session_starts_with_page_1(void)
{
    TEST_ASSERT_EQUAL_UINT8(1, the_session.page);
    TEST_ASSERT_EQUAL_MEMORY(flash_page(1), the_session.cells, PAGE_BYTES);
    TEST_ASSERT_FALSE(the_session.is_changed);
    TEST_ASSERT_EQUAL_UINT8(0, the_session.x);
    TEST_ASSERT_EQUAL_UINT8(0, the_session.y);
}

static void test_session_erased_page_opens_as_a_new_one(void)
{
    session_open(9);
    TEST_ASSERT_EQUAL_UINT8(1, the_session.cells[15]);
    TEST_ASSERT_EQUAL_UINT8(0, the_session.cells[16]);
    TEST_ASSERT_EQUAL_UINT8(32, the_session.cells[22]);
    TEST_ASSERT_EQUAL_UINT8(32, the_session.cells[24]);
    TEST_ASSERT_EQUAL_UINT8(0x55, the_session.cells[32]);
    TEST_ASSERT_EQUAL_UINT8(0x55, the_session.cells[63]);
    TEST_ASSERT_EQUAL_UINT16(0x4000, session_word(6, 30));
    TEST_ASSERT_EQUAL_UINT8(0, the_session.cells[64 + 62]);
    TEST_ASSERT_EQUAL_UINT8(64, the_session.cells[64 + 63]);
    TEST_ASSERT_FALSE(the_session.is_changed);
    TEST_ASSERT_EQUAL(PAGE_OK, session_check());
}

static void test_session_opening_marks_only_what_differs(void)
{
    take_marks();
    session_open(2);
    /* 7 steps of 18 joints differ by one each, and name, number and address */
    TEST_ASSERT_EQUAL_UINT16(7 * 18 + 3, marked());
    take_marks();
    session_open(2);
    TEST_ASSERT_EQUAL_UINT16(2, marked());
}

static void test_session_change_is_seen_and_undone_exactly(void)
{
    session_begin();
    session_set_word(64 + 2 * 5, 700);
    TEST_ASSERT_TRUE(session_end());
    TEST_ASSERT_TRUE(the_session.is_changed);
    TEST_ASSERT_TRUE(session_undo());
    TEST_ASSERT_FALSE(the_session.is_changed);
    TEST_ASSERT_EQUAL_MEMORY(flash_page(1), the_session.cells, PAGE_BYTES);
    TEST_ASSERT_TRUE(session_redo());
    TEST_ASSERT_EQUAL_UINT16(700, session_word(0, 5));
    TEST_ASSERT_FALSE(session_redo());
}

static void test_session_turns_move_whole_steps_and_come_back(void)
{
    static const uint8_t turns[] = { UNDO_TURN(UNDO_TURN_UP, 1, 6), UNDO_TURN(UNDO_TURN_DOWN, 0, 6),
                                     UNDO_TURN(UNDO_TURN_SWAP, 2, 5), UNDO_TURN(UNDO_TURN_UP, 6, 6) };
    static const uint8_t order[][7] = { { 0, 6, 1, 2, 3, 4, 5 }, { 1, 2, 3, 4, 5, 6, 0 }, { 0, 1, 5, 3, 4, 2, 6 },
                                        { 0, 1, 2, 3, 4, 5, 6 } };
    for (uint8_t i = 0; i < 4; i++) {
        session_begin_turn(turns[i]);
        session_end();
        for (uint8_t step = 0; step < 7; step++) {
            TEST_ASSERT_EQUAL_MEMORY(flash_page(1) + 64 + 64 * order[i][step], &the_session.cells[64 + 64 * step], 64);
        }
        TEST_ASSERT_TRUE(session_undo());
        TEST_ASSERT_EQUAL_MEMORY(flash_page(1), the_session.cells, PAGE_BYTES);
        TEST_ASSERT_TRUE(session_redo());
        TEST_ASSERT_TRUE(session_undo());
        TEST_ASSERT_EQUAL_MEMORY(flash_page(1), the_session.cells, PAGE_BYTES);
    }
}

static void test_session_copy_and_new_can_be_undone(void)
{
    session_begin();
    session_load(2);
    TEST_ASSERT_TRUE(session_end());
    TEST_ASSERT_EQUAL_MEMORY(flash_page(2), the_session.cells, PAGE_BYTES);
    session_begin();
    session_clear();
    TEST_ASSERT_TRUE(session_end());
    TEST_ASSERT_EQUAL_UINT8(0, the_session.cells[20]);
    TEST_ASSERT_TRUE(session_undo());
    TEST_ASSERT_EQUAL_MEMORY(flash_page(2), the_session.cells, PAGE_BYTES);
}

/* All 31 joints in all steps do not fit into the undo memory. Contents that flash holds come back all the same. */
static void test_session_new_on_the_largest_page_is_undone_from_flash(void)
{
    uint8_t *bytes = flash_page(7);
    page_clear(bytes);
    for (uint16_t i = 64; i < 512; i++) {
        bytes[i] = (uint8_t)((i % 64 & 1u) != 0 ? 1 : i);
    }
    memset(bytes, 'n', 13);
    memset(bytes + 32, 0x33, 31);
    page_seal(bytes);
    session_open(7);
    session_begin();
    session_clear();
    TEST_ASSERT_TRUE(session_end());
    TEST_ASSERT_TRUE(the_session.is_changed);
    TEST_ASSERT_TRUE(session_undo());
    TEST_ASSERT_EQUAL_MEMORY(bytes, the_session.cells, PAGE_BYTES);
    TEST_ASSERT_FALSE(the_session.is_changed);
    TEST_ASSERT_FALSE(session_undo());
}

/* The largest page with edits that flash does not hold: only the spare page can undo and redo it. It cannot after a
 * play has overwritten the spare page, nor after an edit that changes something. */
static void test_session_new_on_the_largest_edited_page_is_undone_from_the_spare_page(void)
{
    uint8_t spare[PAGE_BYTES], before[PAGE_BYTES], after[PAGE_BYTES];
    session_begin();
    for (uint16_t i = 64; i < 512; i++) {
        session_set_byte(i, (uint8_t)((i % 64 & 1u) != 0 ? 1 : i));
    }
    session_end();
    memcpy(before, the_session.cells, PAGE_BYTES);
    the_session.spare = spare;
    session_begin();
    session_clear();
    TEST_ASSERT_TRUE(session_end());
    memcpy(after, the_session.cells, PAGE_BYTES);
    TEST_ASSERT_FALSE(session_redo());
    TEST_ASSERT_TRUE(session_undo());
    TEST_ASSERT_EQUAL_MEMORY(before, the_session.cells, PAGE_BYTES);
    TEST_ASSERT_TRUE(the_session.is_changed);
    TEST_ASSERT_FALSE(session_undo());
    TEST_ASSERT_TRUE(session_redo());
    TEST_ASSERT_EQUAL_MEMORY(after, the_session.cells, PAGE_BYTES);
    spare[100] ^= 1;
    TEST_ASSERT_FALSE(session_undo());
    TEST_ASSERT_EQUAL_MEMORY(after, the_session.cells, PAGE_BYTES);
    spare[100] ^= 1;
    session_begin();
    session_set_byte(64, the_session.cells[64]);
    session_set_byte(CELLS_POSE_AT, (uint8_t)(the_session.cells[CELLS_POSE_AT] + 1u)); /* MOVE to STP7 */
    TEST_ASSERT_TRUE(session_end());
    TEST_ASSERT_TRUE_MESSAGE(session_undo(), "an edit that changed nothing took the undo of the one before");
    session_begin();
    TEST_ASSERT_TRUE(session_end());
    TEST_ASSERT_TRUE_MESSAGE(session_redo(), "an edit that changed nothing took the redo of the one before");
    the_session.spare = NULL;
    session_begin();
    session_set_byte(64, (uint8_t)(the_session.cells[64] + 1u));
    session_end();
    the_session.spare = spare;
    TEST_ASSERT_TRUE(session_undo());  /* the one byte of the last edit */
    TEST_ASSERT_FALSE(session_undo());
    the_session.spare = NULL;
}

static void test_session_damaged_page_is_shown_and_named(void)
{
    flash_page(3)[0] = 0;
    memcpy(flash_page(3), flash_page(1), PAGE_BYTES);
    flash_page(3)[100] ^= 1;
    session_open(3);
    TEST_ASSERT_EQUAL(PAGE_ERR_CHECKSUM, session_check());
    TEST_ASSERT_EQUAL_UINT8(flash_page(3)[100], the_session.cells[100]);
    store(4, 0);
    flash_page(4)[20] = 9;
    page_seal(flash_page(4));
    session_open(4);
    TEST_ASSERT_EQUAL(PAGE_ERR_STEPS, session_check());
    TEST_ASSERT_EQUAL_UINT8(9, the_session.cells[20]);
    TEST_ASSERT_EQUAL_UINT8(7, session_steps());
}

static void test_session_empty_pages(void)
{
    TEST_ASSERT_TRUE(session_is_empty(9));
    TEST_ASSERT_FALSE(session_is_empty(1));
    page_clear(flash_page(5));
    TEST_ASSERT_TRUE(session_is_empty(5));
    flash_page(5)[100] = 7;
    TEST_ASSERT_FALSE(session_is_empty(5));
}

static void test_session_trim_follows_master_and_slave(void)
{
    session_open(0);
    session_begin();
    session_set_word(64 + 2 * 3, 512);
    session_update_trim(3);
    TEST_ASSERT_EQUAL_UINT16(0x4000, session_word(2, 3));
    session_set_word(128 + 2 * 3, 500);
    session_update_trim(3);
    session_end();
    TEST_ASSERT_EQUAL_INT16(-12, (int16_t)session_word(2, 3));
    TEST_ASSERT_EQUAL(PAGE_OK, session_check());
}

static void go(session_way_t way, uint8_t x, uint8_t y)
{
    session_move(way);
    TEST_ASSERT_EQUAL_UINT8(x, the_session.x);
    TEST_ASSERT_EQUAL_UINT8(y, the_session.y);
}

static void test_session_cursor_moves_as_in_the_original(void)
{
    go(SESSION_UP, 0, 0);
    go(SESSION_LEFT, 0, 0);
    go(SESSION_RIGHT, 1, 0);
    the_session.x = 8;
    go(SESSION_RIGHT, 8, 0);
    the_session.y = 3;
    go(SESSION_RIGHT, 9, 3);
    go(SESSION_RIGHT, 9, 3);
    go(SESSION_UP, 8, 2);
    the_session.x = 9;
    the_session.y = 19;
    go(SESSION_DOWN, 8, 20);
    the_session.y = 30;
    go(SESSION_DOWN, 7, 31);
    go(SESSION_RIGHT, 7, 31);
    go(SESSION_DOWN, 7, 32);
    go(SESSION_DOWN, 7, 32);
}
