/* SPDX-License-Identifier: MIT
 * test_layers.c - a second page and code-made motion over a walk: who moves a joint, how fast a joint changes its
 * source, and that other joints are not disturbed (SHAPING.md, "Layers"). */
#include <string.h>
#include "layers_stage.h"
#include "unity.h"

#define WALK 1u  /* page 1: four steps of 12 ticks with all four joints, in a loop */
#define WAVE 2u  /* page 2: two steps of 30 ticks with joints 2 and 3, in a loop */
#define SHORT 3u /* page 3: one step of 20 ticks, then it ends */
#define CYCLE 48u
#define RECORDED 24u
#define MARKED 5u /* ticks */
#define RUN (5u * CYCLE)
#define LAYER_JOINTS 0xCul
/* 60 degrees/s are 1.6 units a tick. */
#define HAND_OVER_MOST 2

static uint8_t layer_events;

static bool seeks(uint8_t joint)
{
    return (layers.mux.seeking >> joint & 1u) != 0;
}
static uint16_t alone[RUN / MARKED]; /* mark() of the walk without a layer, every MARKED ticks to save RAM */
static uint16_t marked;        /* mark() at the current tick */
static int fastest;            /* largest change of a goal per tick in the walk alone */

static void make_pages(uint8_t schedule)
{
    static const uint16_t walk[4][4] = {{480, 560, 440, 600}, {512, 500, 512, 470},
                                         {560, 470, 590, 420}, {520, 520, 500, 540}};
    sparse_clear();
    for (uint8_t step = 0; step < 4; step++) {
        sparse_step(WALK, schedule == PAGE_SCHEDULE_TIME ? 12 : 100, 0, 512);
        for (uint8_t i = 0; i < 4; i++) {
            sparse_pages[WALK].step[step].pos[i] = walk[step][i];
        }
    }
    sparse_pages[WALK].schedule = schedule;
    sparse_pages[WALK].next = WALK;
    sparse_pages[WALK].accel = 4;
    sparse_step(WAVE, 30, 0, 800);
    sparse_step(WAVE, 30, 5, 700);
    sparse_pages[WAVE].next = WAVE;
    sparse_step(SHORT, 20, 0, 640);
}

void setUp(void)
{
    make_pages(PAGE_SCHEDULE_TIME);
    layers_stage_reset();
}

static void start(player_law_t law)
{
    marked = 0;
    layers_stage_start(WALK, law);
}

/* Adds joints 0 and 1, which no layer moves, to a hash. One wrong unit changes all later values. Returns the tick's
 * index in `alone` if it has one, else RUN. */
static uint16_t mark(uint16_t tick)
{
    marked = (uint16_t)(31u * marked + goal_pos[0]);
    marked = (uint16_t)(31u * marked + goal_pos[1]);
    return tick % MARKED == MARKED - 1u ? tick / MARKED : RUN;
}

static void expect_undisturbed(uint16_t tick)
{
    const uint16_t at = mark(tick);
    if (at != RUN) {
        TEST_ASSERT_EQUAL_UINT16_MESSAGE(alone[at], marked, "the walk is disturbed");
    }
}

static int size(int way)
{
    return way < 0 ? -way : way;
}

/* Runs one tick and returns the main play's events. Joints that change their source stay within the hand-over speed.
 * All others stay within 1.5 times the highest speed of the walk, because a joint that has caught up enters its next
 * step at another speed than without the layer. */
static uint8_t tick(void)
{
    uint16_t before[4];
    bool was_seeking[4];
    for (uint8_t i = 0; i < 4; i++) {
        before[i] = goal_pos[i];
        was_seeking[i] = seeks(i);
    }
    uint8_t events = layers_tick(&layers, &l, &layer_events);
    for (uint8_t i = 0; i < 4; i++) {
        int way = size((int)goal_pos[i] - (int)before[i]);
        TEST_ASSERT_LESS_OR_EQUAL(PAGE_POS_MAX, goal_pos[i]);
        /* A joint that meets its source follows it in the same tick. */
        const int most = was_seeking[i] && seeks(i) ? HAND_OVER_MOST : fastest + fastest / 2;
        TEST_ASSERT_LESS_OR_EQUAL_MESSAGE(most, way, "a joint leaps");
    }
    return events;
}

/* Records the walk alone, and its highest speed. */
static void play_alone(player_law_t law)
{
    fastest = 1023;
    layers_init(&layers, goal_pos);
    start(law);
    int found = 0;
    for (uint16_t t = 0; t < RUN; t++) {
        uint16_t before[4];
        memcpy(before, goal_pos, sizeof before);
        (void)tick();
        for (uint8_t i = 0; i < 4; i++) {
            int way = size((int)goal_pos[i] - (int)before[i]);
            found = way > found ? way : found;
        }
        const uint16_t at = mark(t);
        if (at != RUN) {
            alone[at] = marked;
        }
    }
    fastest = found;
}

/* Starts the layer at tick `on` and ends it 60 ticks later. */
static void layer_from(player_law_t law, uint16_t on)
{
    layers_init(&layers, goal_pos);
    start(law);
    for (uint16_t t = 0; t < RUN; t++) {
        if (t == on) {
            TEST_ASSERT_EQUAL(LAYERS_OK, layers_start(&layers, WAVE, LAYER_JOINTS));
        } else if (t == on + 60u) {
            TEST_ASSERT_GREATER_THAN(530, goal_pos[2]); /* on its way up */
            layers_end(&layers);
        }
        (void)tick();
        expect_undisturbed(t);
    }
    TEST_ASSERT_EQUAL_HEX32(0, layers_joints(&layers));
    TEST_ASSERT_FALSE(layers_are_moving(&layers)); /* all joints have caught up */
}

static void at_every_tick(player_law_t law, uint8_t schedule)
{
    make_pages(schedule);
    play_alone(law);
    for (uint16_t on = 0; on < CYCLE; on = (uint16_t)(on + TEST_STRIDE)) {
        layer_from(law, on);
    }
}

static void test_layers_exact_at_every_tick_of_a_walk(void)
{
    at_every_tick(PLAYER_LAW_EXACT, PAGE_SCHEDULE_TIME);
}

static void test_layers_classic_at_every_tick_of_a_walk(void)
{
    at_every_tick(PLAYER_LAW_CLASSIC, PAGE_SCHEDULE_TIME);
}

/* Records what a layer requests of joint 2 when it starts with the walk. */
static void record_layer(player_law_t law, uint16_t asked[RECORDED])
{
    fastest = 1023;
    layers_init(&layers, goal_pos);
    start(law);
    TEST_ASSERT_EQUAL(LAYERS_OK, layers_start(&layers, WAVE, LAYER_JOINTS));
    for (uint8_t t = 0; t < RECORDED; t++) {
        (void)tick();
        asked[t] = player_goal(&layers.play, 2);
    }
}

static void test_layers_play_by_the_exact_law_over_both(void)
{
    uint16_t over_exact[RECORDED], over_classic[RECORDED];
    record_layer(PLAYER_LAW_EXACT, over_exact);
    record_layer(PLAYER_LAW_CLASSIC, over_classic);
    TEST_ASSERT_EQUAL_UINT16_ARRAY(over_exact, over_classic, RECORDED);
    TEST_ASSERT_NOT_EQUAL_UINT16(over_exact[0], over_exact[RECORDED - 1]);
}

/* In speed base the longest move of a step may be that of a joint that a layer has. */
static void test_layers_in_speed_base_keep_the_timing(void)
{
    at_every_tick(PLAYER_LAW_EXACT, PAGE_SCHEDULE_SPEED);
    at_every_tick(PLAYER_LAW_CLASSIC, PAGE_SCHEDULE_SPEED);
}

/* Plays the walk with a pause from tick `at` on. Returns the ticks until its sixth step begins. */
static uint16_t ticks_with_a_pause(uint16_t at, bool with_layers)
{
    uint16_t ticks = 0;
    uint8_t steps = 0;
    layers_init(&layers, goal_pos);
    start(PLAYER_LAW_CLASSIC);
    if (with_layers) {
        TEST_ASSERT_EQUAL(LAYERS_OK, layers_aim(&layers, 2, 1000, 360));
        TEST_ASSERT_EQUAL(LAYERS_OK, layers_start(&layers, WAVE, 1ul << 3));
    }
    while (steps < 6) {
        if (ticks == at) {
            player_pause(&player);
            layers_pause(&layers);
        } else if (ticks == at + 20u) {
            player_resume(&player);
            layers_resume(&layers);
        }
        steps = (uint8_t)(steps + ((layers_tick(&layers, &l, &layer_events) & PLAYER_EV_STEP) != 0));
        (void)mark(ticks);
        TEST_ASSERT_LESS_THAN(1000, ++ticks);
    }
    return ticks;
}

/* In speed base a step after a pause takes as long as the joints that are not at their target need. A joint that a
 * layer has counts by where the walk would have it, not by where it is. */
static void test_layers_in_speed_base_keep_the_timing_through_a_pause(void)
{
    make_pages(PAGE_SCHEDULE_SPEED);
    for (uint16_t at = 1; at < 2u * CYCLE; at = (uint16_t)(at + TEST_STRIDE)) {
        const uint16_t ticks = ticks_with_a_pause(at, false), marked_alone = marked;
        TEST_ASSERT_EQUAL_UINT16(ticks, ticks_with_a_pause(at, true));
        TEST_ASSERT_EQUAL_UINT16(marked_alone, marked);
    }
}

static void test_layers_page_ends_by_itself_and_gives_its_joints_back(void)
{
    play_alone(PLAYER_LAW_EXACT);
    start(PLAYER_LAW_EXACT);
    TEST_ASSERT_EQUAL(LAYERS_OK, layers_start(&layers, SHORT, LAYER_JOINTS));
    TEST_ASSERT_EQUAL_HEX32(LAYER_JOINTS, layers_joints(&layers));
    for (uint16_t t = 0; t < 20; t++) {
        TEST_ASSERT_TRUE(player_is_moving(&layers.play));
        (void)tick();
    }
    TEST_ASSERT_BITS_HIGH(PLAYER_EV_ENDED, layer_events);
    TEST_ASSERT_EQUAL_HEX32(LAYER_JOINTS, layers_joints(&layers)); /* on their way back */
    for (uint16_t t = 0; t < RUN; t++) {
        (void)tick();
    }
    TEST_ASSERT_EQUAL_HEX32(0, layers_joints(&layers));
    TEST_ASSERT_FALSE(layers_are_moving(&layers));
}

/* A joint that changes its source is never faster than the approach speed (SHAPING.md). The wave requests 288 units in
 * its first 30 ticks, 9.6 a tick. Only 1.6 are allowed, and the joints start at once. */
static void given_joint_keeps_the_approach_speed(player_law_t law)
{
    layers_init(&layers, goal_pos);
    start(law);
    TEST_ASSERT_EQUAL(LAYERS_OK, layers_start(&layers, WAVE, LAYER_JOINTS));
    for (uint16_t t = 0; t < 100; t++) {
        uint16_t before[2] = {goal_pos[2], goal_pos[3]};
        (void)layers_tick(&layers, &l, &layer_events);
        TEST_ASSERT_LESS_OR_EQUAL(HAND_OVER_MOST, size((int)goal_pos[2] - (int)before[0]));
        TEST_ASSERT_LESS_OR_EQUAL(HAND_OVER_MOST, size((int)goal_pos[3] - (int)before[1]));
        if (t == 29) {
            TEST_ASSERT_GREATER_THAN(512 + 30, goal_pos[2]);
        }
    }
}

static void test_layers_joint_given_to_a_layer_keeps_the_approach_speed(void)
{
    given_joint_keeps_the_approach_speed(PLAYER_LAW_EXACT);
    given_joint_keeps_the_approach_speed(PLAYER_LAW_CLASSIC);
}

/* The page swings between 300 and 700 at 40 units a tick. At 10 degrees/s the joint makes 0.27 units a tick and is
 * never near the requested position at a tick. It joins the page when the page passes it in a later step than the
 * page's first: it moves no farther in that tick than the page does, and joins within two more steps. */
static void test_layers_slow_joint_goes_on_with_a_page_that_passes_it(void)
{
    enum { FAST = 4 };
    sparse_step(FAST, 10, 0, 300);
    sparse_step(FAST, 10, 0, 700);
    sparse_pages[FAST].next = FAST;
    start(PLAYER_LAW_EXACT);
    layers_set_speed(&layers, 10);
    TEST_ASSERT_EQUAL(LAYERS_OK, layers_start(&layers, FAST, 1ul << 2));
    for (uint8_t t = 1; t <= 60; t++) {
        const int was_pos = goal_pos[2], was_asked = player_goal(&layers.play, 2);
        (void)layers_tick(&layers, &l, &layer_events);
        const int asked = player_goal(&layers.play, 2), way = size(goal_pos[2] - was_pos);
        if (seeks(2)) {
            TEST_ASSERT_LESS_OR_EQUAL(30, t);
            TEST_ASSERT_LESS_OR_EQUAL(1, way);
        } else {
            TEST_ASSERT_GREATER_THAN(10, t);
            TEST_ASSERT_EQUAL_INT(asked, goal_pos[2]);
            TEST_ASSERT_LESS_OR_EQUAL(size(asked - was_asked), way);
        }
    }
}

static void test_layers_default_joints_are_those_of_the_first_step(void)
{
    sparse_pages[SHORT].step[0].pos[0] = PAGE_POS_UNUSED;
    sparse_pages[SHORT].step[0].pos[3] = PAGE_POS_UNUSED;
    start(PLAYER_LAW_EXACT);
    TEST_ASSERT_EQUAL(LAYERS_OK, layers_start(&layers, SHORT, 0));
    TEST_ASSERT_EQUAL_HEX32(0x6, layers_joints(&layers));
}

static void test_layers_refuse_and_change_nothing(void)
{
    TEST_ASSERT_EQUAL(LAYERS_ERR_IDLE, layers_start(&layers, WAVE, LAYER_JOINTS));
    start(PLAYER_LAW_EXACT);
    TEST_ASSERT_EQUAL(LAYERS_OK, layers_start(&layers, WAVE, LAYER_JOINTS));
    sparse_pages[4].damaged = true;
    TEST_ASSERT_EQUAL(LAYERS_ERR_PAGE, layers_start(&layers, 4, LAYER_JOINTS));
    TEST_ASSERT_EQUAL_UINT8(4, layers.play.fault_page);
    sparse_pages[4].damaged = false;
    TEST_ASSERT_EQUAL(LAYERS_ERR_EMPTY, layers_start(&layers, 4, LAYER_JOINTS));
    TEST_ASSERT_EQUAL(LAYERS_ERR_JOINTS, layers_start(&layers, SHORT, 0x80000000ul));
    TEST_ASSERT_TRUE(code_motion_can_swing(100, 100, 256));
    TEST_ASSERT_FALSE(code_motion_can_swing(100, 101, 256));
    TEST_ASSERT_FALSE(code_motion_can_swing(1000, 24, 256));
    TEST_ASSERT_FALSE(code_motion_can_swing(512, 10, 15));
    TEST_ASSERT_FALSE(code_motion_can_swing(512, 100, 64)); /* 9.8 units a tick */
    TEST_ASSERT_EQUAL_HEX32(LAYER_JOINTS, layers_joints(&layers));
    TEST_ASSERT_TRUE(player_is_moving(&layers.play));
    for (uint8_t id = 4; id < 8; id++) {
        TEST_ASSERT_EQUAL(LAYERS_OK, layers_aim(&layers, id, 500, 0));
    }
    TEST_ASSERT_EQUAL(LAYERS_ERR_FULL, layers_aim(&layers, 8, 500, 0));
    TEST_ASSERT_EQUAL(LAYERS_OK, layers_aim(&layers, 7, 520, 0)); /* replaces the aim of the same joint */
}

/* The layer goes on with its other joint. */
static void test_layers_free_ends_in_the_main_play(void)
{
    play_alone(PLAYER_LAW_EXACT);
    layers_init(&layers, goal_pos);
    start(PLAYER_LAW_EXACT);
    TEST_ASSERT_EQUAL(LAYERS_OK, layers_start(&layers, WAVE, LAYER_JOINTS));
    TEST_ASSERT_EQUAL(LAYERS_OK, layers_aim(&layers, 2, 560, 0));
    layers_free(&layers, 1ul << 2);
    for (uint16_t t = 0; t < RUN; t++) {
        (void)tick();
        expect_undisturbed(t);
    }
    TEST_ASSERT_EQUAL_HEX32(1ul << 3, layers_joints(&layers));
    for (uint8_t t = 0; t < CYCLE; t++) {
        (void)tick();
        TEST_ASSERT_EQUAL_UINT16(player_goal(&player, 2), goal_pos[2]);
    }
}

static void test_layers_aim_works_while_nothing_plays(void)
{
    for (uint8_t i = 0; i < PAGE_JOINTS; i++) {
        goal_pos[i] = 512;
    }
    TEST_ASSERT_EQUAL(LAYERS_OK, layers_aim(&layers, 19, 592, 30)); /* 0.8 units a tick: 100 ticks */
    for (uint16_t t = 1; t <= 110; t++) {
        uint16_t before = goal_pos[19];
        TEST_ASSERT_EQUAL_HEX8(0, layers_tick(&layers, &l, &layer_events));
        TEST_ASSERT_LESS_OR_EQUAL(1, goal_pos[19] - before);
        TEST_ASSERT_EQUAL(t >= 101, goal_pos[19] == 592);
        TEST_ASSERT_EQUAL_UINT16(512, goal_pos[18]);
    }
    TEST_ASSERT_FALSE(layers_are_moving(&layers));
    TEST_ASSERT_EQUAL_HEX32(1ul << 19, layers_joints(&layers));
    layers_free(&layers, ALL);
    TEST_ASSERT_EQUAL_HEX32(0, layers_joints(&layers));
    TEST_ASSERT_EQUAL_UINT16(592, goal_pos[19]);
}

/* Code had the joint far from the page's first pose when the play began: the play must not lead it there in one step. */
static void test_layers_joint_freed_in_the_first_step_of_a_play_is_slow(void)
{
    for (uint8_t law = PLAYER_LAW_EXACT; law <= PLAYER_LAW_CLASSIC; law++) {
        for (uint16_t freed = 0; freed < 20; freed++) {
            layers_stage_reset();
            sparse_pages[SHORT].accel = 10;   /* a slow beginning: the play's goal takes the joint along */
            goal_pos[2] = 560;                /* the only pose has 640 */
            TEST_ASSERT_EQUAL(LAYERS_OK, layers_aim(&layers, 2, 560, 0));
            layers_stage_start(SHORT, (player_law_t)law);
            for (uint16_t t = 0; t < 20; t++) {
                const uint16_t before = goal_pos[2];
                if (t == freed) {
                    layers_free(&layers, 4);
                }
                (void)tick();
                TEST_ASSERT_LESS_OR_EQUAL(HAND_OVER_MOST, size((int)goal_pos[2] - (int)before));
            }
        }
    }
}

/* 512 + 200 sin: known values at every twelfth of a turn. */
static void test_layers_swing_is_a_sine(void)
{
    static const int known[12] = {0, 100, 173, 200, 173, 100, 0, -100, -173, -200, -173, -100};
    goal_pos[5] = 512;
    TEST_ASSERT_EQUAL(LAYERS_OK, layers_swing(&layers, 5, 512, 200, 240, 0));
    for (uint16_t t = 0; t < 480; t++) {
        (void)layers_tick(&layers, &l, &layer_events);
        if (t >= 240 && t % 20 == 0) { /* caught up by then */
            TEST_ASSERT_INT_WITHIN(1, 512 + known[t / 20 % 12], goal_pos[5]);
        }
    }
}

static void test_layers_swing_over_a_walk_and_free(void)
{
    play_alone(PLAYER_LAW_EXACT);
    fastest = fastest < 8 ? 8 : fastest;
    layers_init(&layers, goal_pos);
    start(PLAYER_LAW_EXACT);
    for (uint16_t t = 0; t < RUN; t++) {
        if (t == 30) {
            TEST_ASSERT_EQUAL(LAYERS_OK, layers_swing(&layers, 2, 600, 60, 64, 90));
        } else if (t == 200) {
            layers_free(&layers, 1ul << 2);
        }
        (void)tick();
        expect_undisturbed(t);
    }
    TEST_ASSERT_FALSE(layers_are_moving(&layers));
}

/* Runs both for 100 ticks, then pauses. */
static void pause_a_wave_over_the_walk(void)
{
    play_alone(PLAYER_LAW_EXACT);
    start(PLAYER_LAW_EXACT);
    TEST_ASSERT_EQUAL(LAYERS_OK, layers_start(&layers, WAVE, LAYER_JOINTS));
    for (uint16_t t = 0; t < 100; t++) {
        (void)tick();
    }
    player_pause(&player);
    layers_pause(&layers);
}

static void test_layers_break_and_pause_hold_for_both(void)
{
    pause_a_wave_over_the_walk();
    for (uint16_t t = 0; t < 20; t++) {
        (void)tick();
    }
    uint16_t stood[4];
    memcpy(stood, goal_pos, sizeof stood);
    (void)tick();
    TEST_ASSERT_EQUAL_MEMORY(stood, goal_pos, sizeof stood);
    player_resume(&player);
    layers_resume(&layers);
    for (uint16_t t = 0; t < 50; t++) {
        (void)tick();
    }
    TEST_ASSERT_TRUE(memcmp(stood, goal_pos, sizeof stood) != 0);
    player_break(&player);
    layers_break(&layers);
    for (uint16_t t = 0; t < 40; t++) {
        (void)tick();
    }
    TEST_ASSERT_FALSE(player_is_moving(&player) || layers_are_moving(&layers));
}

static void test_layers_pause_holds_what_code_moves(void)
{
    start(PLAYER_LAW_EXACT);
    TEST_ASSERT_EQUAL(LAYERS_OK, layers_aim(&layers, 2, 1000, 30));
    (void)tick();
    player_pause(&player);
    layers_pause(&layers);
    const uint16_t stood = goal_pos[2];
    for (uint16_t t = 0; t < 20; t++) {
        (void)tick();
    }
    TEST_ASSERT_EQUAL_UINT16(stood, goal_pos[2]);
    player_resume(&player);
    layers_resume(&layers);
    for (uint16_t t = 0; t < 20; t++) {
        (void)tick();
    }
    TEST_ASSERT_GREATER_THAN(stood, goal_pos[2]);
}

/* The layer needs 60 ticks to stop, the walk 8. A resume in between applies to both. */
static void test_layers_that_stand_later_than_the_walk_resume_too(void)
{
    sparse_pages[WAVE].accel = 60;
    pause_a_wave_over_the_walk();
    while ((tick() & PLAYER_EV_STOPPED) == 0) {
    }
    TEST_ASSERT_TRUE(player_is_paused(&layers.play));
    layers_resume(&layers);
    player_resume(&player);
    for (uint16_t t = 0; t < 100; t++) {
        (void)tick();
    }
    const uint16_t was_pos = goal_pos[2];
    for (uint16_t t = 0; t < 20; t++) {
        (void)tick();
    }
    TEST_ASSERT_TRUE(goal_pos[2] != was_pos && !player_is_paused(&layers.play));
}

static void test_layers_dropped_joint_stands(void)
{
    play_alone(PLAYER_LAW_EXACT);
    start(PLAYER_LAW_EXACT);
    TEST_ASSERT_EQUAL(LAYERS_OK, layers_start(&layers, WAVE, LAYER_JOINTS));
    TEST_ASSERT_EQUAL(LAYERS_OK, layers_aim(&layers, 1, 700, 0));
    for (uint16_t t = 0; t < 50; t++) {
        (void)tick();
    }
    uint16_t at[2] = {goal_pos[1], goal_pos[3]};
    player_drop_joints(&player, 0xA);
    layers_drop_joints(&layers, 0xA);
    for (uint16_t t = 0; t < 100; t++) {
        (void)tick();
        TEST_ASSERT_EQUAL_UINT16(at[0], goal_pos[1]);
        TEST_ASSERT_EQUAL_UINT16(at[1], goal_pos[3]);
        TEST_ASSERT_EQUAL_HEX32(0, (layers_joints(&layers) | player.joints) & 0xA);
    }
}

/* Without a main play there are no play joints to check. Code-made motion ends all the same. */
static void test_layers_dropped_without_a_main_play(void)
{
    goal_pos[7] = 512;
    TEST_ASSERT_EQUAL(LAYERS_OK, layers_aim(&layers, 7, 700, 0));
    layers_drop_joints(&layers, 0xFF);
    TEST_ASSERT_EQUAL_HEX32(0, layers_joints(&layers));
    TEST_ASSERT_FALSE(layers_are_moving(&layers));
}
