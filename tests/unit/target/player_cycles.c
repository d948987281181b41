/* SPDX-License-Identifier: MIT
 * player_cycles.c - cycles of a player tick on the ATmega128 with all 31 joints moving, by its own timer. For each law
 * and kind of page, it prints the longest tick that begins a step and the longest other tick on UART1. Fails if a tick
 * takes more than half of its period, also with a layer, code-made motion and shaping. */
#include <avr/io.h>
#include <stdio.h>
#include "flash.h"
#include "layers.h"
#include "pgm.h"
#include "player.h"
#include "unity.h"

#define TICK_BUDGET 62500u /* cycles; a tick has 125,000 */

#define WORD(p) (uint8_t)(p), (uint8_t)((p) >> 8)
#define WORDS5(p) WORD(p), WORD((p) + 3), WORD((p) + 1), WORD((p) + 7), WORD((p) + 2)
#define WORDS31(p) WORDS5(p), WORDS5(p), WORDS5(p), WORDS5(p), WORDS5(p), WORDS5(p), WORD(p)
#define STEP(p, time) WORDS31(p), 0, time
/* seven steps one way, then seven steps back */
#define HEADER(schedule, accel, next, compliance)                                                                      \
    'b', 'e', 'n', 'c', 'h', 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, schedule, 0, 0, 0, 7, 0, 32, 0, accel, next, 0, 0, 0, 0, 0,  \
        0, compliance, compliance, compliance, compliance, compliance, compliance, compliance, compliance, compliance, \
        compliance, compliance, compliance, compliance, compliance, compliance, compliance, compliance, compliance,    \
        compliance, compliance, compliance, compliance, compliance, compliance, compliance, compliance, compliance,    \
        compliance, compliance, compliance, compliance, 0
#define UP(schedule, accel, time)                                                                                      \
    {HEADER(schedule, accel, 2, 0x55), STEP(200, time), STEP(290, time), STEP(395, time), STEP(500, time),             \
     STEP(620, time), STEP(745, time), STEP(860, time)}
#define ON(schedule, accel, time)                                                                                      \
    {HEADER(schedule, accel, 0, 0x66), STEP(900, time), STEP(960, time), STEP(860, time), STEP(710, time),             \
     STEP(500, time), STEP(300, time), STEP(150, time)}

typedef struct {
    char name[12];
    uint8_t pages[2][PAGE_BYTES];
} kind_t;

#define KIND(label, schedule, accel, time) {label, {UP(schedule, accel, time), ON(schedule, accel, time)}}
static const kind_t kinds[] PROGMEM = {
    KIND("64 ticks", 0x0A, 16, 64),   KIND("20 ticks", 0x0A, 32, 20), KIND("8 ticks", 0x0A, 32, 8),
    KIND("speed base", 0x00, 32, 20), KIND("no ramp", 0x0A, 0, 20),   KIND("5 ticks", 0x0A, 32, 5),
    KIND("4 ticks", 0x0A, 32, 4),     KIND("3 ticks", 0x0A, 32, 3),     KIND("2 ticks", 0x0A, 32, 2),
    KIND("1 tick", 0x0A, 32, 1),
};

#define KINDS (sizeof kinds / sizeof kinds[0])
static uint8_t kind;
static player_t player;
static player_joint_t joints[PAGE_JOINTS];
static uint16_t goals_of_all[PAGE_JOINTS]; /* output of the layers */
static link_t l;

void setUp(void)
{
    TCCR1B = _BV(CS10);
}

void tearDown(void)
{
}

static void read_page(void *context, uint8_t page, uint16_t offset, void *to, uint8_t count)
{
    (void)context;
    flash_read((uint16_t)&kinds[kind].pages[page - 1][offset], to, count);
}

static uint8_t check_page(void *context, uint8_t page)
{
    (void)context;
    return page <= 2 ? PAGE_OK : PAGE_ERR_CHECKSUM;
}

static const page_source_t source = {0, read_page, check_page};

typedef struct {
    uint16_t begin, other; /* cycles of the longest tick that begins a step, and of the longest other tick */
} longest_t;

static void print(const char *name, player_law_t law, const longest_t *longest)
{
    char line[100];
    snprintf(line, sizeof line, "%-11s %-8s step begins %6u   other %6u\n", name,
             law == PLAYER_LAW_EXACT ? "exact" : "classic", longest->begin, longest->other);
    for (const char *c = line; *c != 0; c++) {
        UNITY_OUTPUT_CHAR(*c);
    }
}

static void keep_longest(uint16_t *longest, uint16_t cycles)
{
    *longest = cycles > *longest ? cycles : *longest;
}

static longest_t play(player_law_t law)
{
    uint16_t pose[PAGE_JOINTS];
    longest_t longest = {0, 0};
    for (uint8_t i = 0; i < PAGE_JOINTS; i++) {
        pose[i] = 150;
    }
    player_init(&player, &source, joints);
    link_init(&l, LINK_LATCH);
    if (player_start(&player, &l, 1, law, pose, 0x7FFFFFFF) != PLAYER_OK) {
        return (longest_t){UINT16_MAX, UINT16_MAX};
    }
    while (player_is_moving(&player)) {
        uint16_t from = TCNT1;
        uint8_t events = player_tick(&player, &l);
        uint16_t cycles = (uint16_t)(TCNT1 - from);
        if ((events & PLAYER_EV_STEP) != 0) {
            keep_longest(&longest.begin, cycles);
        } else {
            keep_longest(&longest.other, cycles);
        }
    }
    return longest;
}

static void measure(player_law_t law)
{
    longest_t worst = {0, 0};
    for (kind = 0; kind < KINDS; kind++) {
        char name[12];
        longest_t longest = play(law);
        memcpy_P(name, kinds[kind].name, sizeof name);
        print(name, law, &longest);
        keep_longest(&worst.begin, longest.begin);
        keep_longest(&worst.other, longest.other);
    }
    TEST_ASSERT_LESS_OR_EQUAL_UINT16(TICK_BUDGET, worst.begin);
    TEST_ASSERT_LESS_OR_EQUAL_UINT16(TICK_BUDGET, worst.other);
}

static void test_player_tick_of_exact_keeps_its_budget(void)
{
    measure(PLAYER_LAW_EXACT);
}

static void test_player_tick_of_classic_keeps_its_budget(void)
{
    measure(PLAYER_LAW_CLASSIC);
}

/* Rate, amplitude and blend set, a page layer on 15 joints, code-made swings on others. */
static void measure_all_in_force(player_law_t law)
{
    static layers_t layers;
    static shape_t shape;
    uint16_t pose[PAGE_JOINTS], longest = 0;
    uint8_t layer_events;
    kind = 1; /* steps of 20 ticks */
    for (uint8_t i = 0; i < PAGE_JOINTS; i++) {
        pose[i] = goals_of_all[i] = 150;
    }
    shape_init(&shape);
    shape_set_voltage(&shape, 111);
    shape.rate_percent = 90;
    shape_set_amplitude(&shape, 80, 0x7FFFFFFF);
    player_init(&player, &source, joints);
    player.shape = &shape;
    layers_init(&layers, goals_of_all);
    layers_bind(&layers, &player);
    link_init(&l, LINK_LATCH);
    TEST_ASSERT_EQUAL(PLAYER_OK, player_start(&player, &l, 1, law, pose, 0x7FFFFFFF));
    for (uint8_t i = 0; i < CODE_MOTION_JOINTS; i++) {
        TEST_ASSERT_EQUAL(LAYERS_OK, layers_swing(&layers, i, 512, 100, 128, 0));
    }
    TEST_ASSERT_EQUAL(LAYERS_OK, layers_start(&layers, 2, 0x7FFF0000));
    while (player_is_moving(&player)) {
        uint16_t from = TCNT1;
        (void)layers_tick(&layers, &l, &layer_events);
        keep_longest(&longest, (uint16_t)(TCNT1 - from));
    }
    longest_t all = {0, longest};
    print("all in force", law, &all);
    TEST_ASSERT_LESS_OR_EQUAL_UINT16(TICK_BUDGET, longest);
}

static void test_player_tick_with_all_of_shaping_in_force_keeps_its_budget(void)
{
    measure_all_in_force(PLAYER_LAW_EXACT);
    measure_all_in_force(PLAYER_LAW_CLASSIC);
}

STATIC_ASSERT(sizeof(player_t) + sizeof joints + sizeof(link_t) <= 900, "player.h says so");

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_player_tick_of_exact_keeps_its_budget);
    RUN_TEST(test_player_tick_of_classic_keeps_its_budget);
    RUN_TEST(test_player_tick_with_all_of_shaping_in_force_keeps_its_budget);
    return UNITY_END();
}
