/* SPDX-License-Identifier: MIT
 * Undo: random editing against a plain list of old contents. */
#include "undo.h"
#include "unity.h"

#include <string.h>

static uint8_t bytes[UNDO_SPACE_BYTES];
static undo_t undo;

static void flip(uint16_t address, uint8_t bits)
{
    TEST_ASSERT_LESS_THAN_UINT16(UNDO_SPACE_BYTES, address);
    bytes[address] ^= bits;
}

/* SWAP exchanges two 64-byte steps after the 64-byte header. The session tests cover the other kinds. */
static void turn(uint8_t turn_code, bool back)
{
    (void)back;
    if (turn_code == UNDO_TURN_NONE) {
        return;
    }
    uint8_t a = (turn_code >> 3) & 7u, b = turn_code & 7u;
    for (uint8_t i = 0; i < 64; i++) {
        uint8_t byte = bytes[64 + 64 * a + i];
        bytes[64 + 64 * a + i] = bytes[64 + 64 * b + i];
        bytes[64 + 64 * b + i] = byte;
    }
}

static const undo_target_t target = { flip, turn };

static void set(uint16_t address, uint8_t byte)
{
    undo_note(&undo, address, bytes[address] ^ byte);
    bytes[address] = byte;
}

void setUp(void)
{
    memset(bytes, 0, sizeof bytes);
    undo_clear(&undo);
}

static void test_undo_nothing_to_undo_or_redo_at_first(void)
{
    TEST_ASSERT_FALSE(undo_back(&undo, &target));
    TEST_ASSERT_FALSE(undo_forth(&undo, &target));
}

static void test_undo_takes_one_command_back_and_forth(void)
{
    undo_begin(&undo, UNDO_TURN_NONE);
    set(5, 1);
    set(6, 2);
    set(8, 3);
    set(300, 4);
    TEST_ASSERT_TRUE(undo_end(&undo));
    TEST_ASSERT_TRUE(undo_back(&undo, &target));
    for (uint16_t i = 0; i < UNDO_SPACE_BYTES; i++) {
        TEST_ASSERT_EQUAL_UINT8(0, bytes[i]);
    }
    TEST_ASSERT_TRUE(undo_forth(&undo, &target));
    TEST_ASSERT_EQUAL_UINT8(1, bytes[5]);
    TEST_ASSERT_EQUAL_UINT8(2, bytes[6]);
    TEST_ASSERT_EQUAL_UINT8(0, bytes[7]);
    TEST_ASSERT_EQUAL_UINT8(3, bytes[8]);
    TEST_ASSERT_EQUAL_UINT8(4, bytes[300]);
    TEST_ASSERT_FALSE(undo_forth(&undo, &target));
}

static void test_undo_command_without_change_keeps_what_can_be_redone(void)
{
    undo_begin(&undo, UNDO_TURN_NONE);
    set(5, 1);
    undo_end(&undo);
    undo_back(&undo, &target);
    undo_begin(&undo, UNDO_TURN_NONE);
    undo_note(&undo, 9, 0);
    undo_end(&undo);
    TEST_ASSERT_TRUE(undo_forth(&undo, &target));
    TEST_ASSERT_EQUAL_UINT8(1, bytes[5]);
}

static void test_undo_new_command_ends_redo(void)
{
    undo_begin(&undo, UNDO_TURN_NONE);
    set(5, 1);
    undo_end(&undo);
    undo_back(&undo, &target);
    undo_begin(&undo, UNDO_TURN_NONE);
    set(6, 7);
    undo_end(&undo);
    TEST_ASSERT_FALSE(undo_forth(&undo, &target));
    TEST_ASSERT_TRUE(undo_back(&undo, &target));
    TEST_ASSERT_EQUAL_UINT8(0, bytes[6]);
    TEST_ASSERT_FALSE(undo_back(&undo, &target));
}

static void test_undo_a_byte_changed_twice_comes_back(void)
{
    undo_begin(&undo, UNDO_TURN_NONE);
    set(64, 3);
    set(70, 4);
    set(64, 5);
    undo_end(&undo);
    TEST_ASSERT_TRUE(undo_back(&undo, &target));
    TEST_ASSERT_EQUAL_UINT8(0, bytes[64]);
    TEST_ASSERT_EQUAL_UINT8(0, bytes[70]);
    TEST_ASSERT_TRUE(undo_forth(&undo, &target));
    TEST_ASSERT_EQUAL_UINT8(5, bytes[64]);
    TEST_ASSERT_EQUAL_UINT8(4, bytes[70]);
}

static void test_undo_turn_alone_is_a_command(void)
{
    bytes[64] = 11;
    bytes[128] = 22;
    turn(UNDO_TURN(UNDO_TURN_SWAP, 0, 1), false);
    undo_begin(&undo, UNDO_TURN(UNDO_TURN_SWAP, 0, 1));
    set(70, 9);
    undo_end(&undo);
    TEST_ASSERT_EQUAL_UINT8(22, bytes[64]);
    undo_back(&undo, &target);
    TEST_ASSERT_EQUAL_UINT8(11, bytes[64]);
    TEST_ASSERT_EQUAL_UINT8(0, bytes[70]);
    undo_forth(&undo, &target);
    TEST_ASSERT_EQUAL_UINT8(22, bytes[64]);
    TEST_ASSERT_EQUAL_UINT8(9, bytes[70]);
}

/* A command that does not fit is not kept in part: the history becomes empty and reports it. */
static void test_undo_too_large_a_command_ends_the_history(void)
{
    undo_begin(&undo, UNDO_TURN_NONE);
    set(3, 1);
    undo_end(&undo);
    undo_begin(&undo, UNDO_TURN_NONE);
    for (uint16_t i = 0; i < UNDO_SPACE_BYTES; i++) {
        set(i, 0xA5);
    }
    TEST_ASSERT_FALSE(undo_end(&undo));
    TEST_ASSERT_FALSE(undo_back(&undo, &target));
    TEST_ASSERT_FALSE(undo_forth(&undo, &target));
    undo_begin(&undo, UNDO_TURN_NONE);
    set(3, 1);
    TEST_ASSERT_TRUE(undo_end(&undo));
    TEST_ASSERT_TRUE(undo_back(&undo, &target));
    TEST_ASSERT_EQUAL_UINT8(0xA5, bytes[3]);
}

/* A full page: seven steps of 18 joints from unused to a position, plus name and header. */
static void test_undo_full_page_of_18_joints_fits(void)
{
    undo_begin(&undo, UNDO_TURN_NONE);
    for (uint8_t i = 0; i < 13; i++) {
        set(i, 'x');
    }
    for (uint8_t i = 15; i < 31; i++) {
        set(i, 1);
    }
    for (uint8_t step = 0; step < 7; step++) {
        for (uint8_t i = 2; i < 38; i++) {
            set((uint16_t)(64 + 64 * step + i), 0x5A);
        }
        set((uint16_t)(64 + 64 * step + 62), 1);
        set((uint16_t)(64 + 64 * step + 63), 2);
    }
    TEST_ASSERT_TRUE(undo_end(&undo));
    TEST_ASSERT_TRUE(undo_back(&undo, &target));
    for (uint16_t i = 0; i < UNDO_SPACE_BYTES; i++) {
        TEST_ASSERT_EQUAL_UINT8(0, bytes[i]);
    }
}

/* A run header counts up to 128 bytes. */
static void test_undo_long_run_of_neighbours_comes_back(void)
{
    undo_begin(&undo, UNDO_TURN_NONE);
    for (uint16_t i = 64; i < 64 + 200; i++) {
        set(i, 0x5A);
    }
    TEST_ASSERT_TRUE(undo_end(&undo));
    TEST_ASSERT_TRUE(undo_back(&undo, &target));
    for (uint16_t i = 0; i < UNDO_SPACE_BYTES; i++) {
        TEST_ASSERT_EQUAL_UINT8(0, bytes[i]);
    }
}

/* The worst case for run headers: every fifth byte, each a run of its own. */
static void test_undo_scattered_bytes_fit(void)
{
    undo_begin(&undo, UNDO_TURN_NONE);
    for (uint16_t i = 0; i < UNDO_SPACE_BYTES; i = (uint16_t)(i + 5)) {
        set(i, 0xA5);
    }
    TEST_ASSERT_TRUE(undo_end(&undo));
    TEST_ASSERT_TRUE(undo_back(&undo, &target));
    for (uint16_t i = 0; i < UNDO_SPACE_BYTES; i++) {
        TEST_ASSERT_EQUAL_UINT8(0, bytes[i]);
    }
}

static uint32_t random_state = 1;

static uint16_t random_below(uint16_t limit)
{
    random_state = random_state * 1103515245u + 12345u;
    return (uint16_t)((random_state >> 16) % limit);
}

/* Eight WRITEs of 18 joints at random poses, the largest command of such a robot. */
static void test_undo_eight_steps_of_18_joints_are_kept(void)
{
    for (uint8_t command = 0; command < 8; command++) {
        undo_begin(&undo, UNDO_TURN_NONE);
        for (uint8_t i = 2; i < 38; i++) {
            uint8_t value = (i & 1u) != 0 ? (uint8_t)random_below(4) : (uint8_t)random_below(256);
            set((uint16_t)(64 + 64 * (command % 7) + i), value);
        }
        set(64 + 63, command);
        set(20, command);
        TEST_ASSERT_TRUE(undo_end(&undo));
    }
    for (uint8_t command = 0; command < 8; command++) {
        TEST_ASSERT_TRUE(undo_back(&undo, &target));
    }
    for (uint16_t i = 0; i < UNDO_SPACE_BYTES; i++) {
        TEST_ASSERT_EQUAL_UINT8(0, bytes[i]);
    }
}

#define KEPT 64

static void random_command(void)
{
    undo_begin(&undo, UNDO_TURN_NONE);
    uint16_t count = (uint16_t)(1u + random_below(60));
    uint16_t address = random_below(UNDO_SPACE_BYTES);
    for (uint16_t i = 0; i < count; i++) {
        set(address, (uint8_t)(bytes[address] ^ (1u + random_below(255))));
        address = random_below(8) != 0 ? (uint16_t)((address + 1u + random_below(3)) % UNDO_SPACE_BYTES)
                                       : random_below(UNDO_SPACE_BYTES);
    }
    TEST_ASSERT_TRUE(undo_end(&undo));
}

static uint16_t sum(void)
{
    uint16_t total = 0;
    for (uint16_t i = 0; i < UNDO_SPACE_BYTES; i++) {
        total = (uint16_t)(total * 31u + bytes[i]);
    }
    return total;
}

static void test_undo_random_commands_come_back_in_order(void)
{
    static uint16_t sums[KEPT];
    for (uint8_t round = 0; round < 20; round++) {
        undo_clear(&undo);
        for (uint8_t i = 0; i < KEPT; i++) {
            sums[i] = sum();
            random_command();
        }
        uint16_t last = sum();
        uint8_t at = KEPT, back = 0;
        while (undo_back(&undo, &target)) {
            at--;
            back++;
            TEST_ASSERT_EQUAL_UINT16(sums[at], sum());
        }
        TEST_ASSERT_GREATER_OR_EQUAL_UINT8(1, back);
        while (undo_forth(&undo, &target)) {
            back--;
        }
        TEST_ASSERT_EQUAL_UINT8(0, back);
        TEST_ASSERT_EQUAL_UINT16(last, sum());
    }
}
