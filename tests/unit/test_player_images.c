/* SPDX-License-Identifier: MIT
 * test_player_images.c - plays the motion set of tests/samples, and real sets of others if they exist (../shared/data),
 * under both laws. Prints the figures that LAWS.md section 2 requires of the exact law:
 *
 *     build/host/tests/unit/test_player_images
 *
 * Each valid page starts from its own first pose, as after an approach. It runs for a while along its next links and is
 * then stopped through its exit links. All checks use only the goals and the page's bytes. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "image_source.h"
#include "unity.h"

#define STOP_AFTER 1500      /* ticks until a soft stop is requested */
#define TICKS_MAX 200000L
#define ALL_JOINTS 0x7FFFFFFFu

typedef struct {
    const char *name, *file;
    int first;               /* page of the file that becomes page 0 */
    int speed_change_max;    /* exact, servo units per tick; LAWS.md */
} set_t;

static const set_t our_set = {"samples", "robot_128p.bin", 0, 1 << 20}; /* random poses jump by any amount */

static const set_t sets[] = {
    {"bio_gp", "bio_gp_humanoid_kr_128p.bin", 0, 62},
    {"hros1", "hros1_10bit_256p.bin", 0, 4},
    {"hros1, 128..", "hros1_10bit_256p.bin", 128, 4},
    {"op3 derived", "op3_derived_10bit_256p.bin", 0, 69},
    {"op3 derived, 128..", "op3_derived_10bit_256p.bin", 128, 69},
    {"synthetic edges", "synthetic_edge_128p.bin", 0, 1 << 20},
};

typedef struct {
    unsigned plays, refused, ticks, idle, overshoots, missed_targets, long_pages, leaps;
    double speed_change, worst_duration;
} figures_t;

/* The state of the observer of one play. */
typedef struct {
    figures_t *figures;
    uint16_t pos[2][PAGE_JOINTS];            /* the last two outputs */
    uint16_t from[PAGE_JOINTS], to[PAGE_JOINTS]; /* of the current step */
    unsigned page, step, outputs;
    double ideal_ticks;                      /* of the current page so far */
    unsigned page_ticks;
    bool in_pause;
} watch_t;

static image_t image;
static page_source_t source;
static player_t player;
static player_joint_t joints[PAGE_JOINTS];
static link_t l;
static const char *data_dir;

void setUp(void)
{
    source = image_source(&image);
    player_init(&player, &source, joints);
    link_init(&l, LINK_LATCH);
}

/* --- the ideal, from the page's bytes ---------------------------------------------------------------------------- */

static double ideal_step_ticks(const uint8_t *page, unsigned step, unsigned longest_way)
{
    const uint8_t *bytes = &page[64 * step];
    double ticks = page[16] == 0x0A ? bytes[63] * page[22] / 32.0
                                    : 40.0 * longest_way * 32.0 / (3.0 * (bytes[63] == 0 ? 1 : bytes[63]) * page[22]);
    return ticks < 1 ? 1 : ticks;
}

static double ideal_pause_ticks(const uint8_t *page, unsigned step)
{
    double pause = page[64 * step + 62];
    return page[16] == 0x0A ? pause * page[22] / 32.0 : pause * 32.0 / page[22];
}

/* --- the observer ------------------------------------------------------------------------------------------------ */

static void watch_step_end(watch_t *watch)
{
    if (watch->page == 0) {
        return;
    }
    for (unsigned i = 0; i < PAGE_JOINTS; i++) {
        watch->figures->missed_targets += watch->pos[0][i] != watch->to[i];
    }
}

static void watch_page_end(watch_t *watch)
{
    double off = fabs(watch->page_ticks - watch->ideal_ticks);
    if (off > watch->figures->worst_duration) {
        watch->figures->worst_duration = off;
    }
    watch->figures->long_pages += off > 1.0;
    watch->ideal_ticks = 0;
    watch->page_ticks = 0;
}

static void watch_step_begin(watch_t *watch, uint8_t events)
{
    watch_step_end(watch);
    if ((events & PLAYER_EV_PAGE) != 0 && watch->page != 0) {
        watch_page_end(watch);
    }
    watch->page = player.now.page;
    watch->step = player.now.step;
    watch->in_pause = false;
    unsigned longest = 0;
    const uint8_t *page = image.bytes[player.now.page];
    for (unsigned i = 0; i < PAGE_JOINTS; i++) {
        uint16_t word = page_pos(page, (uint8_t)(player.now.step - 1), (uint8_t)i);
        watch->from[i] = watch->to[i];
        if ((word & 0x6000) == 0) {
            watch->to[i] = word;
        }
        unsigned way = (unsigned)abs(watch->to[i] - watch->from[i]);
        longest = way > longest ? way : longest;
    }
    watch->ideal_ticks += ideal_step_ticks(page, player.now.step, longest) + ideal_pause_ticks(page, player.now.step);
}

static void watch_output(watch_t *watch)
{
    for (unsigned i = 0; i < PAGE_JOINTS; i++) {
        int pos = player_goal(&player, (uint8_t)i), from = watch->from[i], to = watch->to[i];
        watch->figures->overshoots += (from <= to && (pos < from || pos > to)) || (from > to && (pos > from || pos < to));
        double change = abs(pos - 2 * watch->pos[0][i] + watch->pos[1][i]);
        if (watch->outputs >= 1 && change > watch->figures->speed_change) {
            watch->figures->speed_change = change;
        }
        watch->pos[1][i] = watch->pos[0][i];
        watch->pos[0][i] = (uint16_t)pos;
    }
    watch->outputs++;
}

static void watch_tick(watch_t *watch, uint8_t events)
{
    if ((events & PLAYER_EV_STEP) != 0) {
        watch_step_begin(watch, events);
    }
    watch->page_ticks++;
    if ((events & PLAYER_EV_OUTPUT) != 0) {
        watch->figures->idle += watch->in_pause; /* output during a pause */
        watch_output(watch);
    } else {
        watch->in_pause = true;
        watch->figures->idle += image.bytes[watch->page][64 * watch->step + 62] == 0;
        memcpy(watch->pos[1], watch->pos[0], sizeof watch->pos[1]);
    }
}

/* --- plays ------------------------------------------------------------------------------------------------------- */

static void play_page(unsigned page, player_law_t law, figures_t *figures)
{
    uint16_t pose[PAGE_JOINTS];
    for (unsigned i = 0; i < PAGE_JOINTS; i++) {
        pose[i] = 512;
    }
    link_call(&l, 0);
    (void)player_first_pose(&source, NULL, (uint8_t)page, pose);
    player_status_t status = player_start(&player, &l, (uint8_t)page, law, pose, ALL_JOINTS);
    if (!page_is_playable(image.bytes[page])) {
        return;
    }
    TEST_ASSERT_EQUAL(PLAYER_OK, status);
    watch_t watch = {.figures = figures};
    memcpy(watch.to, pose, sizeof pose);
    memcpy(watch.pos[0], pose, sizeof pose);
    memcpy(watch.pos[1], pose, sizeof pose);
    figures->plays++;
    long tick = 0;
    for (; player_is_moving(&player) && tick < TICKS_MAX; tick++) {
        if (tick == STOP_AFTER) {
            link_stop(&l);
        }
        uint8_t events = player_tick(&player, &l);
        for (unsigned i = 0; i < PAGE_JOINTS; i++) {
            figures->leaps += player_goal(&player, (uint8_t)i) > PAGE_POS_MAX;
        }
        watch_tick(&watch, events);
    }
    TEST_ASSERT_FALSE_MESSAGE(player_is_moving(&player), "play without end");
    watch_step_end(&watch);
    watch_page_end(&watch);
    figures->ticks += (unsigned)tick;
}

/* Loads one half of a file of 256 pages. Links use the numbers of the file and are wrong for the upper half, so its
 * pages play without links. */
static bool load_set(const set_t *set)
{
    char path[600];
    snprintf(path, sizeof path, "%s/%s", data_dir, set->file);
    if (!image_load(&image, path, (unsigned)set->first)) {
        return false;
    }
    for (unsigned page = 0; set->first != 0 && page < PAGE_COUNT; page++) {
        if (page_sum(0, image.bytes[page], PAGE_BYTES) == PAGE_CHECKSUM_SUM) {
            memset(&image.bytes[page][PAGE_AT_NEXT_PAGE], 0, 6);
            page_seal(image.bytes[page]);
        }
    }
    return true;
}

static figures_t play_set(player_law_t law)
{
    figures_t figures = {0};
    for (unsigned page = 1; page < PAGE_COUNT; page++) {
        page_status_t status = page_check(image.bytes[page]);
        if (status == PAGE_OK) {
            play_page(page, law, &figures);
        } else {
            uint16_t pose[PAGE_JOINTS] = {0};
            TEST_ASSERT_EQUAL(PLAYER_ERR_PAGE, player_start(&player, &l, (uint8_t)page, law, pose, ALL_JOINTS));
            TEST_ASSERT_EQUAL(status, player.fault);
            TEST_ASSERT_EQUAL(page, player.fault_page);
            figures.refused++;
        }
    }
    return figures;
}

static void print_figures(const set_t *set, const char *law, const figures_t *f)
{
    printf("%-20s %-8s %5u %8u %8u %6u %10u %8u %9.2f %8.0f\n", set->name, law, f->plays, f->refused, f->ticks, f->idle,
           f->overshoots, f->missed_targets, f->worst_duration, f->speed_change);
}

static void play_by_both_laws(const set_t *set)
{
    figures_t classic = play_set(PLAYER_LAW_CLASSIC), exact = play_set(PLAYER_LAW_EXACT);
    print_figures(set, "classic", &classic);
    print_figures(set, "exact", &exact);
    TEST_ASSERT_EQUAL(0, classic.leaps);
    TEST_ASSERT_EQUAL(0, exact.idle);
    TEST_ASSERT_EQUAL(0, exact.overshoots);
    TEST_ASSERT_EQUAL(0, exact.missed_targets);
    TEST_ASSERT_EQUAL(0, exact.long_pages);
    TEST_ASSERT_TRUE(exact.speed_change <= set->speed_change_max);
}

static void test_player_plays_every_valid_page_of_our_set_by_both_laws(void)
{
    data_dir = SOURCE_DIR "/tests/samples";
    TEST_ASSERT_TRUE_MESSAGE(load_set(&our_set), SOURCE_DIR "/tests/samples is not whole");
    printf("%-20s %-8s %5s %8s %8s %6s %10s %8s %9s %8s\n", "set", "law", "plays", "refused", "ticks", "idle", "overshoot",
           "off goal", "duration", "change");
    play_by_both_laws(&our_set);
}

static void test_player_plays_every_valid_page_of_real_sets_by_both_laws(void)
{
    static char shared_data[512];
    const char *shared = getenv("M512_SHARED");
    snprintf(shared_data, sizeof shared_data, "%s/data", shared != NULL ? shared : SOURCE_DIR "/../shared");
    data_dir = shared_data;
    unsigned found = 0;
    for (unsigned i = 0; i < sizeof sets / sizeof sets[0]; i++) {
        if (load_set(&sets[i])) {
            found++;
            play_by_both_laws(&sets[i]);
        }
    }
    if (found == 0) {
        TEST_IGNORE_MESSAGE("no motion sets of others: M512_SHARED names the folder that has them in data");
    }
}
