/* SPDX-License-Identifier: MIT
 * test_player_golden.c - the classic law reproduces every sample of every joint of the original's recordings
 * (tests/models/golden). */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "image_source.h"
#include "unity.h"

#define JOINTS 12 /* IDs 1..12 */
#define JOINTS_PRESENT 0x1FFEu
#define TICKS_MAX 20000L

static image_t image;
static player_t player;
static player_joint_t joints[PAGE_JOINTS];
static link_t l;

static FILE *open_set(const char *name)
{
    char path[512];
    snprintf(path, sizeof path, "%s/%s.bin", GOLDEN_DIR, name);
    TEST_ASSERT_TRUE_MESSAGE(image_load(&image, path, 0), path);
    snprintf(path, sizeof path, "%s/%s.csv", GOLDEN_DIR, name);
    FILE *csv = fopen(path, "r");
    TEST_ASSERT_NOT_NULL_MESSAGE(csv, path);
    char heading[256];
    TEST_ASSERT_NOT_NULL(fgets(heading, sizeof heading, csv));
    return csv;
}

/* Reads the next line: its goals. Returns its tick, -1 at the end. */
static long read_line(FILE *csv, uint16_t goals[JOINTS])
{
    char line[256];
    if (fgets(line, sizeof line, csv) == NULL) {
        return -1;
    }
    char *at = line;
    long tick = strtol(at, &at, 10);
    for (unsigned i = 0; i < JOINTS; i++) {
        goals[i] = (uint16_t)strtol(at + 1, &at, 10);
    }
    return tick;
}

static void play_set(const char *name)
{
    FILE *csv = open_set(name);
    page_source_t source = image_source(&image);
    uint16_t pose[PAGE_JOINTS], goals[JOINTS];
    for (unsigned i = 0; i < PAGE_JOINTS; i++) {
        pose[i] = 512;
    }
    player_init(&player, &source, joints);
    link_init(&l, LINK_LATCH);
    TEST_ASSERT_EQUAL(PLAYER_OK, player_start(&player, &l, 1, PLAYER_LAW_CLASSIC, pose, JOINTS_PRESENT));
    long first = -1, expected = read_line(csv, goals), compared = 0;
    for (long tick = 0; player_is_moving(&player) && tick < TICKS_MAX; tick++) {
        if ((player_tick(&player, &l) & PLAYER_EV_OUTPUT) == 0) {
            continue;
        }
        first = first < 0 ? tick : first;
        char where[128];
        for (unsigned i = 0; i < JOINTS; i++) {
            snprintf(where, sizeof where, "%s: tick %ld, ID %u", name, tick - first, i + 1);
            TEST_ASSERT_EQUAL_INT_MESSAGE(expected, tick - first, where);
            TEST_ASSERT_EQUAL_UINT16_MESSAGE(goals[i], player_goal(&player, (uint8_t)(i + 1)), where);
        }
        expected = read_line(csv, goals);
        compared++;
    }
    TEST_ASSERT_FALSE_MESSAGE(player_is_moving(&player), name);
    TEST_ASSERT_EQUAL_INT_MESSAGE(-1, expected, name);
    TEST_ASSERT_GREATER_THAN_MESSAGE(10, compared, name);
    fclose(csv);
}

static void test_player_classic_equals_every_recording(void)
{
    static const char *const names[] = {
        "speed_base_distances", "time_base_through_joins", "reversals_and_pauses", "very_short_steps",
        "accel_zero_then_ramps", "repeats_and_chain", "clamped_speed", "walk_like",
        "pauses_behind_ramps", "pauses_speed_base", "end_in_a_pause", "corners"};
    for (unsigned i = 0; i < sizeof names / sizeof names[0]; i++) {
        play_set(names[i]);
    }
}
