/* SPDX-License-Identifier: MIT
 * test_page_format.c - the dump in motion/PAGE_FORMAT.md is a good page, and page.c builds the same one. */
#include <ctype.h>
#include <stdio.h>
#include <string.h>
#include "page.h"
#include "unity.h"

static uint8_t dump[PAGE_BYTES];

/* Reads rows "0A0  00 40 ..." and "*", which repeats the row before up to the next row's address. */
static void read_dump(void)
{
    FILE *file = fopen(PAGE_FORMAT_MD, "r");
    TEST_ASSERT_NOT_NULL_MESSAGE(file, PAGE_FORMAT_MD);
    char line[256];
    bool inside = false;
    unsigned at = 0;
    while (fgets(line, sizeof line, file) != NULL) {
        if (strncmp(line, "```", 3) == 0) {
            inside = !inside;
        } else if (inside && isxdigit((unsigned char)line[0])) {
            unsigned addr, byte;
            int used;
            TEST_ASSERT_EQUAL(1, sscanf(line, "%x%n", &addr, &used));
            for (; at < addr; at++) {
                dump[at] = dump[at - 16];
            }
            for (char *next = line + used; at < addr + 16; at++, next += used) {
                TEST_ASSERT_EQUAL(1, sscanf(next, "%x%n", &byte, &used));
                dump[at] = (uint8_t)byte;
            }
        }
    }
    fclose(file);
    TEST_ASSERT_EQUAL(PAGE_BYTES, at);
}

void setUp(void)
{
    read_dump();
}

static void test_page_format_dump_is_a_good_page(void)
{
    TEST_ASSERT_EQUAL(PAGE_OK, page_check(dump));
    TEST_ASSERT_TRUE(page_is_playable(dump));
}

static void test_page_format_dump_is_what_page_c_builds(void)
{
    uint8_t page[PAGE_BYTES];
    page_clear(page);
    memcpy(page, "bow", 3);
    page[PAGE_AT_PLAY_COUNT] = 2;
    page[PAGE_AT_STEPS] = 2;
    page[PAGE_AT_PLAY_CODE] = 2;
    page[PAGE_AT_ACCEL_TIME] = 16;
    page[PAGE_AT_EXIT_PAGE] = 3;
    page_set_pos(page, 0, 11, 412);
    page_set_pos(page, 0, 12, 612);
    page_set_pos(page, 1, 11, 512);
    page_set_pos(page, 1, 12, 512);
    page[PAGE_AT_STEP0 + PAGE_STEP_AT_PAUSE] = 32;
    page[PAGE_AT_STEP0 + PAGE_STEP_AT_SPEED] = 64;
    page[PAGE_AT_STEP0 + PAGE_STEP_BYTES + PAGE_STEP_AT_SPEED] = 64;
    page_seal(page);
    TEST_ASSERT_EQUAL_HEX8_ARRAY(page, dump, PAGE_BYTES);
}
