/* SPDX-License-Identifier: MIT
 * test_shape.c - shaping during a play: ranges, neutral values, and effect on steps. Values by hand from SHAPING.md;
 * tests/models/mixed.py compares any values with a model. */
#include <string.h>
#include "player.h"
#include "shape.h"
#include "shape_step.h"
#include "unity.h"

#define CENTRE 1u
#define PAGE 2u
#define RIGHT 3u
#define OTHER_LENGTH 4u

static shape_t shape;
static uint16_t pages[5][4];  /* step 1: joints 0..3 */
static uint8_t damaged;

/* Pages of one step of 40 ticks (OTHER_LENGTH has two) in time base, ramps of 8 ticks; no links. */
static uint8_t byte_of(uint8_t page, uint16_t at)
{
    uint8_t steps = page == OTHER_LENGTH ? 2 : 1;
    switch (at) {
    case PAGE_AT_PLAY_COUNT:
        return 1;
    case PAGE_AT_SCHEDULE:
        return PAGE_SCHEDULE_TIME;
    case PAGE_AT_BLEND_RIGHT:
        return page == PAGE ? RIGHT : 0;
    case PAGE_AT_BLEND_LEFT:
        return page == PAGE ? OTHER_LENGTH : 0;
    case PAGE_AT_STEPS:
        return steps;
    case PAGE_AT_SPEED:
        return PAGE_SPEED_NOMINAL;
    case PAGE_AT_ACCEL_TIME:
        return 8;
    case PAGE_AT_STEP0 + PAGE_STEP_AT_SPEED:
        return 40;
    default:
        break;
    }
    if (at < PAGE_AT_STEP0) {
        return 0;
    }
    uint16_t joint = (uint16_t)(at - PAGE_AT_STEP0) / 2;
    uint16_t word = joint < 4 ? pages[page][joint] : PAGE_POS_UNUSED;
    return (uint8_t)(at % 2 != 0 ? word >> 8 : word);
}

static void read_page(void *context, uint8_t page, uint16_t offset, void *to, uint8_t count)
{
    (void)context;
    for (uint8_t *bytes = to; count != 0; count--) {
        *bytes++ = byte_of(page, offset++);
    }
}

static uint8_t check_page(void *context, uint8_t page)
{
    (void)context;
    return page == damaged ? PAGE_ERR_CHECKSUM : PAGE_OK;
}

static const page_source_t source = {0, read_page, check_page};

void setUp(void)
{
    static const uint16_t positions[5][4] = {{0}, {512, 512, 100, PAGE_POS_UNUSED}, {612, 413, 50, 700},
                                             {712, PAGE_POS_UNUSED, 150, 801}, {0, 0, 0, 0}};
    memcpy(pages, positions, sizeof pages);
    damaged = 0;
    shape_init(&shape);
}

/* Joint 0..3 of the shaped step. */
static uint16_t shaped(uint8_t joint)
{
    uint16_t words[PAGE_JOINTS];
    read_page(NULL, PAGE, PAGE_AT_STEP0, words, sizeof words);
    shape_step(&shape, &source, PAGE, 1, words);
    return words[joint];
}

static void expect(uint16_t a, uint16_t b, uint16_t c, uint16_t d)
{
    const uint16_t expected[4] = {a, b, c, d};
    for (uint8_t i = 0; i < 4; i++) {
        TEST_ASSERT_EQUAL_UINT16(expected[i], shaped(i));
    }
}

static void test_shape_neutral_changes_nothing(void)
{
    TEST_ASSERT_TRUE(shape_is_neutral(&shape));
    expect(612, 413, 50, 700);
    shape.rate_percent = 50;
    TEST_ASSERT_FALSE(shape_is_neutral(&shape));
    expect(612, 413, 50, 700);
}

static void test_shape_amplitude_scales_about_the_centre_pose(void)
{
    shape_set_amplitude(&shape, 50, 0x7FFFFFFF);
    expect(562, 462, 75, 700);
    shape_set_amplitude(&shape, 150, 0x1);
    expect(662, 462, 75, 700);
    shape_set_amplitude(&shape, 0, 0x7FFFFFFF);
    expect(512, 512, 100, 700);
}

/* 25 % of the way to 712, -, 150, 801: 637, 413 (the partner does not use joint 1), 75, 725.25. */
static void test_shape_blend_goes_to_the_partner(void)
{
    shape.blend_percent = 25;
    expect(637, 413, 75, 725);
    shape.blend_percent = 100;
    expect(712, 413, 150, 801);
}

/* Joint 3 has no centre: it is blended, and not scaled. By hand: 512 + (637 - 512) / 2, 512 - 99 / 2, 100 - 25 / 2, 700
 * + 101 / 4. */
static void test_shape_blend_and_amplitude_together(void)
{
    shape.blend_percent = 25;
    shape_set_amplitude(&shape, 50, 0x7FFFFFFF);
    expect(575, 462, 87, 725);
}

static void test_shape_partner_of_another_length_or_damaged_is_not_blended(void)
{
    shape.blend_percent = -100;
    expect(612, 413, 50, 700);
    damaged = RIGHT;
    shape.blend_percent = 100;
    expect(612, 413, 50, 700);
}

static void test_shape_without_a_centre_nothing_is_scaled(void)
{
    shape_set_amplitude(&shape, 50, 0x7FFFFFFF);
    shape.centre_page = 0;
    expect(612, 413, 50, 700);
    shape.centre_page = CENTRE;
    damaged = CENTRE;
    expect(612, 413, 50, 700);
}

static void test_shape_clamps_to_the_servos_range(void)
{
    pages[PAGE][0] = 1000;
    pages[PAGE][1] = 20;
    shape_set_amplitude(&shape, 150, 0x7FFFFFFF);
    TEST_ASSERT_EQUAL_UINT16(1023, shaped(0));
    TEST_ASSERT_EQUAL_UINT16(0, shaped(1));
}

static void test_shape_mirrored_motions_stay_mirrored(void)
{
    for (uint16_t way = 0; way <= 340; way = (uint16_t)(way + 7)) {
        for (uint16_t percent = 0; percent <= 150; percent = (uint16_t)(percent + 13)) {
            pages[PAGE][0] = (uint16_t)(512 + way);
            pages[PAGE][1] = (uint16_t)(512 - way);
            shape_set_amplitude(&shape, (uint8_t)percent, 0x7FFFFFFF);
            TEST_ASSERT_EQUAL_UINT16(1024, shaped(0) + shaped(1));
        }
    }
}

static void test_shape_reset_keeps_centre_and_voltage(void)
{
    shape_set_voltage(&shape, 111);
    shape.centre_page = 7;
    shape.rate_percent = 200;
    shape_set_amplitude(&shape, 10, 4);
    shape.blend_percent = 40;
    shape_reset(&shape);
    TEST_ASSERT_TRUE(shape_is_neutral(&shape));
    TEST_ASSERT_EQUAL_UINT8(7, shape.centre_page);
    TEST_ASSERT_EQUAL_UINT8(125, shape.top_speed_q4_4); /* 0.9 * 8.7 = 7.83 units a tick */
}

/* --- while a page plays: 40 ticks a step --------------------------------------------------------------------------- */

static player_t player;
static player_joint_t joints[PAGE_JOINTS];
static link_t l;

static void start(player_law_t law)
{
    uint16_t pose[PAGE_JOINTS];
    for (uint8_t i = 0; i < PAGE_JOINTS; i++) {
        pose[i] = 512;
    }
    player_init(&player, &source, joints);
    player.shape = &shape;
    link_init(&l, LINK_LATCH);
    TEST_ASSERT_EQUAL(PLAYER_OK, player_start(&player, &l, PAGE, law, pose, 0xF));
}

static uint16_t ticks_of_a_play(player_law_t law)
{
    uint16_t ticks = 0;
    start(law);
    while (player_is_moving(&player)) {
        (void)player_tick(&player, &l);
        TEST_ASSERT_LESS_THAN(1000, ++ticks);
    }
    return ticks;
}

/* The classic law needs one more call to find out that no page follows. */
static void test_shape_rate_is_that_of_both_laws(void)
{
    static const uint16_t rates[] = {100, 50, 200, 400, 10, 75};
    static const uint16_t ticks[] = {40, 80, 20, 10, 400, 53};
    pages[PAGE][2] = pages[PAGE][3] = 520; /* no joint needs to be fast */
    pages[PAGE][0] = 560;
    pages[PAGE][1] = 470;
    for (uint8_t i = 0; i < sizeof rates / sizeof rates[0]; i++) {
        shape.rate_percent = rates[i];
        TEST_ASSERT_UINT16_WITHIN(1, ticks[i], ticks_of_a_play(PLAYER_LAW_EXACT));
        TEST_ASSERT_UINT16_WITHIN(1, ticks[i] + 1, ticks_of_a_play(PLAYER_LAW_CLASSIC));
    }
}

/* Joint 2 goes from 512 to 50 in 40 ticks, 11.55 a tick. At 11.1 V 7.83 are allowed: 59 ticks (59.1 with
 * 7.8125 in sixteenths). */
static void test_shape_limit_stretches_a_step_that_is_too_fast(void)
{
    shape_set_voltage(&shape, 111);
    TEST_ASSERT_EQUAL_UINT16(40, ticks_of_a_play(PLAYER_LAW_EXACT)); /* no limit while no shaping is set */
    shape.rate_percent = 101;
    TEST_ASSERT_UINT16_WITHIN(1, 59, ticks_of_a_play(PLAYER_LAW_EXACT));
    TEST_ASSERT_UINT16_WITHIN(1, 60, ticks_of_a_play(PLAYER_LAW_CLASSIC));
}

/* The rate never shortens a classic step so far that the law skips it. */
static void test_shape_rate_never_makes_classic_skip_a_step(void)
{
    pages[PAGE][2] = 520;
    pages[PAGE][3] = 520;
    shape.rate_percent = 400;
    start(PLAYER_LAW_CLASSIC);
    bool moved = false;
    while (player_is_moving(&player)) {
        moved |= (player_tick(&player, &l) & PLAYER_EV_OUTPUT) != 0;
    }
    TEST_ASSERT_TRUE(moved);
    TEST_ASSERT_UINT16_WITHIN(8, 612, player_goal(&player, 0));
}

/* --- a step is shaped once, all of it by one shape ----------------------------------------------------------------- */

#define MANY 5u       /* centre page: all joints at 512 */
static uint8_t many_ticks;

/* Page MANY + 1: seven steps of many_ticks with all joints, to 612 and 412 in turn, in a loop. */
static void read_many(void *context, uint8_t page, uint16_t offset, void *to, uint8_t count)
{
    (void)context;
    for (uint8_t *bytes = to; count != 0; count--, offset++) {
        uint8_t step = (uint8_t)(offset / PAGE_STEP_BYTES), at = (uint8_t)(offset % PAGE_STEP_BYTES);
        uint16_t word = page == MANY ? 512 : step % 2 != 0 ? 612 : 412;
        uint8_t of_header = offset == PAGE_AT_STEPS ? 7 : offset == PAGE_AT_NEXT_PAGE ? page : byte_of(PAGE, offset);
        *bytes++ = (uint8_t)(step == 0 ? of_header
                             : at == PAGE_STEP_AT_SPEED ? many_ticks
                             : at == PAGE_STEP_AT_PAUSE ? 0
                             : at % 2 != 0              ? word >> 8
                                                        : word);
    }
}

static const page_source_t many_source = {0, read_many, check_page};

/* The amplitude changes after every tick. All joints of a step must still agree, and the step must have one of those
 * amplitudes about 512. Under the exact law every tick has output. */
static void expect_one_shape_a_step(player_law_t law, uint8_t ticks, uint8_t tolerance)
{
    uint16_t pose[PAGE_JOINTS];
    uint8_t percent = 10;
    uint16_t steps = 0;
    for (uint8_t i = 0; i < PAGE_JOINTS; i++) {
        pose[i] = 512;
    }
    many_ticks = ticks;
    shape_init(&shape);
    shape.centre_page = MANY;
    shape_set_amplitude(&shape, percent, 0x7FFFFFFF);
    player_init(&player, &many_source, joints);
    player.shape = &shape;
    link_init(&l, LINK_LATCH);
    TEST_ASSERT_EQUAL(PLAYER_OK, player_start(&player, &l, MANY + 1, law, pose, 0x7FFFFFFF));
    for (uint16_t tick = 0; tick < 400; tick++) {
        const uint16_t before_pos = player_goal(&player, 0);
        uint8_t events = player_tick(&player, &l);
        TEST_ASSERT_TRUE((events & PLAYER_EV_OUTPUT) != 0 || law == PLAYER_LAW_CLASSIC);
        for (uint8_t i = 1; i < PAGE_JOINTS; i++) {
            TEST_ASSERT_EQUAL_UINT16(player_goal(&player, 0), player_goal(&player, i));
        }
        if ((events & PLAYER_EV_STEP) != 0) { /* the last goal was the way-point 512 +- A, with A a multiple of ten */
            uint16_t way = (uint16_t)(before_pos > 512 ? before_pos - 512 : 512 - before_pos);
            TEST_ASSERT_UINT16_WITHIN(tolerance, (way + 5) / 10 * 10, way);
            steps++;
        }
        percent = percent == 150 ? 10 : (uint8_t)(percent + 10);
        shape_set_amplitude(&shape, percent, 0x7FFFFFFF);
    }
    TEST_ASSERT_GREATER_THAN(400 / (ticks + 1) / 2, steps);
}

/* Steps of 26 ticks between 412 and 612, 7.7 units a tick; 7.83 are allowed at 11.1 V. At 150 % they are 300 units, and take
 * 39 ticks. The first step as stored begins at 362 or 662: 250 units take 32 ticks, and not 26. */
static void expect_no_haste_after_a_reset(player_law_t law)
{
    uint16_t pose[PAGE_JOINTS], lengths[4] = {0};
    for (uint8_t i = 0; i < PAGE_JOINTS; i++) {
        pose[i] = 512;
    }
    many_ticks = 26;
    shape_init(&shape);
    shape_set_voltage(&shape, 111);
    shape.centre_page = MANY;
    shape_set_amplitude(&shape, 150, 0x7FFFFFFF);
    player_init(&player, &many_source, joints);
    player.shape = &shape;
    link_init(&l, LINK_LATCH);
    TEST_ASSERT_EQUAL(PLAYER_OK, player_start(&player, &l, MANY + 1, law, pose, 0x7FFFFFFF));
    uint8_t step = 0;
    while (step < 6) {
        step = (uint8_t)(step + ((player_tick(&player, &l) & PLAYER_EV_STEP) != 0));
        if (step == 2) { /* step 3 has been read */
            shape_reset(&shape);
        }
        if (step >= 2 && step <= 5) {
            lengths[step - 2]++;
        }
    }
    TEST_ASSERT_UINT16_WITHIN(1, 39, lengths[0]);
    TEST_ASSERT_UINT16_WITHIN(1, 39, lengths[1]);
    TEST_ASSERT_UINT16_WITHIN(1, 32, lengths[2]);
    TEST_ASSERT_UINT16_WITHIN(1, 26, lengths[3]);
}

static void test_shape_first_step_after_a_reset_is_not_too_fast(void)
{
    expect_no_haste_after_a_reset(PLAYER_LAW_EXACT);
    expect_no_haste_after_a_reset(PLAYER_LAW_CLASSIC);
}

static void test_shape_of_a_step_is_one_however_short_it_is(void)
{
    for (uint8_t ticks = 1; ticks <= 12; ticks++) {
        expect_one_shape_a_step(PLAYER_LAW_EXACT, ticks, 0);
        expect_one_shape_a_step(PLAYER_LAW_CLASSIC, ticks, 4);
    }
}
