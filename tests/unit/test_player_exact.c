/* SPDX-License-Identifier: MIT
 * test_player_exact.c - the exact law against its definition (LAWS.md section 2) in floating point, on random pages:
 * every joint is within about one servo unit of the ideal in every tick, whatever the ramps, times and turns. */
#include <math.h>
#include <stdlib.h>
#include "player.h"
#include "sparse_pages.h"
#include "unity.h"

#define ALL 0x7FFFFFFFu
#define ROUNDS 400
#define STEPS 7

static player_t player;
static player_joint_t joints[PAGE_JOINTS];
static link_t l;
static uint16_t pose[PAGE_JOINTS];

typedef struct {
    double from, to, mean, entry, exit; /* of one joint in one step */
} way_t;

static way_t ways[STEPS][SPARSE_JOINTS];
static unsigned ticks[STEPS], holds[STEPS];

void setUp(void)
{
    sparse_clear();
    player_init(&player, &sparse_source, joints);
    link_init(&l, LINK_LATCH);
}

static unsigned any(unsigned from, unsigned to)
{
    return from + (unsigned)rand() % (to - from + 1);
}

static void make_page(void)
{
    sparse_page_t *page = &sparse_pages[1];
    page->accel = (uint8_t)(any(0, 3) == 0 ? any(0, 255) : any(0, 40));
    page->speed = (uint8_t)any(16, 64);
    page->schedule = any(0, 1) != 0 ? PAGE_SCHEDULE_TIME : PAGE_SCHEDULE_SPEED;
    for (unsigned step = 0; step < STEPS; step++) {
        sparse_step(1, (uint8_t)any(1, any(0, 2) == 0 ? 12 : 255), (uint8_t)(any(0, 5) == 0 ? any(1, 20) : 0), 0);
        for (unsigned i = 0; i < SPARSE_JOINTS; i++) {
            page->step[step].pos[i] = (uint16_t)any(0, 1023);
        }
    }
    for (unsigned i = 0; i < PAGE_JOINTS; i++) {
        pose[i] = (uint16_t)any(0, 1023);
    }
}

/* Rule 1, with the fraction in 1/2048 tick as the code keeps it. */
static unsigned whole(double length, double *carry)
{
    length = floor(length * 2048) / 2048 + *carry;
    double whole_ticks = floor(length);
    *carry = length - whole_ticks;
    return (unsigned)whole_ticks;
}

static void time_steps(void)
{
    const sparse_page_t *page = &sparse_pages[1];
    double carry = 0.5;
    for (unsigned k = 0; k < STEPS; k++) {
        double longest = 0;
        for (unsigned i = 0; i < SPARSE_JOINTS; i++) {
            ways[k][i].from = k == 0 ? pose[i] : page->step[k - 1].pos[i];
            ways[k][i].to = page->step[k].pos[i];
            longest = fmax(longest, fabs(ways[k][i].to - ways[k][i].from));
        }
        bool time_base = page->schedule == PAGE_SCHEDULE_TIME;
        double time = page->step[k].time, pause = page->step[k].pause, speed = page->speed;
        ticks[k] = whole(fmax(1, time_base ? time * speed / 32 : 40 * longest * 32 / (3 * time * speed)), &carry);
        holds[k] = pause == 0 ? 0 : whole(time_base ? pause * speed / 32 : pause * 32 / speed, &carry);
    }
}

/* Rule 2. */
static void find_way_point_speeds(void)
{
    for (unsigned k = 0; k < STEPS; k++) {
        for (unsigned i = 0; i < SPARSE_JOINTS; i++) {
            way_t *way = &ways[k][i];
            way->mean = (way->to - way->from) / ticks[k];
            way->entry = k == 0 ? 0 : ways[k - 1][i].exit;
            way->exit = 0;
            if (k + 1 < STEPS && sparse_pages[1].step[k].pause == 0) {
                double next = (ways[k + 1][i].to - ways[k + 1][i].from) / ticks[k + 1];
                if (next * way->mean > 0) {
                    way->exit = fabs(next) < fabs(way->mean) ? next : way->mean;
                }
            }
        }
    }
}

static double ideal_pos(const way_t *way, unsigned n, unsigned ramp, unsigned tick)
{
    double v = ramp == 0 ? way->mean : ((way->to - way->from) - (way->entry + way->exit) * ramp / 2) / (n - ramp);
    double t = tick;
    if (tick <= ramp) {
        return way->from + way->entry * t + (v - way->entry) * t * t / (2 * ramp);
    }
    if (tick <= n - ramp) {
        return way->from + (way->entry + v) * ramp / 2 + v * (t - ramp);
    }
    double left = n - t;
    return way->to - way->exit * left - (v - way->exit) * left * left / (2 * ramp);
}

static void compare_step(unsigned k)
{
    unsigned n = ticks[k], ramp = sparse_pages[1].accel;
    ramp = ramp > n / 2 ? n / 2 : ramp;
    /* half a unit of rounding, ramps (fix.h), and two 65536ths of a unit for each tick of cruise */
    double tolerance = 1.2 + n * 2 / 65536.0;
    for (unsigned tick = 1; tick <= n; tick++) {
        TEST_ASSERT_BITS(PLAYER_EV_OUTPUT, PLAYER_EV_OUTPUT, player_tick(&player, &l));
        for (unsigned i = 0; i < SPARSE_JOINTS; i++) {
            double off = player_goal(&player, (uint8_t)i) - ideal_pos(&ways[k][i], n, ramp, tick);
            TEST_ASSERT_TRUE_MESSAGE(fabs(off) <= (tick == n ? 1e-6 : tolerance), "away from the ideal");
        }
    }
    for (unsigned tick = 0; tick < holds[k]; tick++) {
        TEST_ASSERT_BITS(PLAYER_EV_OUTPUT, 0, player_tick(&player, &l));
    }
}

static void test_player_exact_is_what_its_definition_says(void)
{
    srand(20240229);
    for (unsigned round = 0; round < ROUNDS; round++) {
        setUp();
        make_page();
        time_steps();
        find_way_point_speeds();
        TEST_ASSERT_EQUAL(PLAYER_OK, player_start(&player, &l, 1, PLAYER_LAW_EXACT, pose, ALL));
        for (unsigned k = 0; k < STEPS; k++) {
            compare_step(k);
        }
        TEST_ASSERT_FALSE(player_is_moving(&player));
    }
}
