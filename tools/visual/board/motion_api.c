/* SPDX-License-Identifier: MIT */
#include "motion_api.h"

#include <string.h>

#include "player.h"
#include "shape.h"
#include "step_plan.h"

enum { MARK_BYTES = 3 };

static struct {
    uint8_t pages[PAGE_COUNT][PAGE_BYTES];
    uint16_t pose[PAGE_JOINTS];
    link_t link;
    player_t player;
    shape_t shape;
    shape_step_t shaping;
    bool is_shaped;
    player_joint_t joint[PAGE_JOINTS];
    uint16_t goal_pos[PAGE_JOINTS];
    uint16_t goals[MOTION_API_CURVE_TICKS][PAGE_JOINTS];
    uint8_t marks[MOTION_API_CURVE_TICKS][MARK_BYTES];
} api;

static bool is_page(int page) { return page >= 0 && page < (int)PAGE_COUNT; }

static void read_page(void *context, uint8_t page, uint16_t offset, void *to, uint8_t count)
{
    (void)context;
    memcpy(to, api.pages[page] + offset, count);
}

static uint8_t check_page(void *context, uint8_t page)
{
    (void)context;
    return (uint8_t)page_check(api.pages[page]);
}

static const page_source_t source = { .read = read_page, .check = check_page };

static const uint16_t layout[] = {
    PAGE_BYTES, PAGE_COUNT, PAGE_JOINTS, PAGE_STEPS, PAGE_STEP_BYTES, PAGE_NAME_BYTES,
    PAGE_AT_NAME, PAGE_AT_PLAY_COUNT, PAGE_AT_SCHEDULE, PAGE_AT_BLEND_RIGHT, PAGE_AT_BLEND_LEFT, PAGE_AT_STEPS,
    PAGE_AT_PLAY_CODE, PAGE_AT_SPEED, PAGE_AT_ACCEL_TIME, PAGE_AT_NEXT_PAGE, PAGE_AT_EXIT_PAGE, PAGE_AT_LINKED1_PAGE,
    PAGE_AT_LINKED1_CODE, PAGE_AT_LINKED2_PAGE, PAGE_AT_LINKED2_CODE, PAGE_AT_CHECKSUM, PAGE_AT_COMPLIANCE, PAGE_AT_STEP0,
    PAGE_STEP_AT_PAUSE, PAGE_STEP_AT_SPEED, PAGE_SCHEDULE_SPEED, PAGE_SCHEDULE_TIME, PAGE_SPEED_NOMINAL,
    PAGE_POS_MAX, PAGE_POS_UNUSED, PAGE_POS_TORQUE_OFF, PLAYER_TICKS_PER_SECOND,
};

const uint16_t *motion_api_layout(void) { return layout; }

int motion_api_layout_count(void) { return (int)(sizeof layout / sizeof layout[0]); }

uint8_t *motion_api_pages(void) { return api.pages[0]; }

int motion_api_check(int page) { return is_page(page) ? (int)page_check(api.pages[page]) : -1; }

int motion_api_check_step(int page, int step)
{
    if (!is_page(page) || step < 0 || step >= (int)PAGE_STEPS) {
        return -1;
    }
    return (int)page_check_step(api.pages[page] + PAGE_AT_STEP0 + (unsigned)step * PAGE_STEP_BYTES);
}

void motion_api_seal(int page)
{
    if (is_page(page)) {
        page_seal(api.pages[page]);
    }
}

void motion_api_clear(int page)
{
    if (is_page(page)) {
        page_clear(api.pages[page]);
    }
}

bool motion_api_is_playable(int page) { return is_page(page) && page_is_playable(api.pages[page]); }

uint16_t *motion_api_pose(void) { return api.pose; }

static const shape_t *shape_now(void) { return api.is_shaped ? &api.shape : NULL; }

uint32_t motion_api_first_pose(int page)
{
    return is_page(page) ? player_first_pose(&source, shape_now(), (uint8_t)page, api.pose) : 0;
}

bool motion_api_shape(int rate_percent, int amplitude_percent, int blend_percent)
{
    shape_t shape;
    shape_init(&shape);
    if (rate_percent < 0 || amplitude_percent < 0 || shape_set_rate(&shape, (uint16_t)rate_percent) != SHAPE_OK ||
        shape_set_amplitude(&shape, (uint16_t)amplitude_percent, UINT32_MAX) != SHAPE_OK ||
        shape_set_blend(&shape, (int16_t)blend_percent) != SHAPE_OK) {
        return false;
    }
    api.shape = shape;
    api.is_shaped = !shape_is_neutral(&shape);
    return true;
}

int motion_api_top_speed_q4_4(int decivolts)
{
    shape_t shape;
    shape_init(&shape);
    shape_set_voltage(&shape, (uint8_t)(decivolts < 0 ? 0 : decivolts > UINT8_MAX ? UINT8_MAX : decivolts));
    return shape.top_speed_q4_4;
}

static bool is_step(int page, int step) { return is_page(page) && step >= 0 && step < (int)PAGE_STEPS; }

/* Takes the joints that a step uses to its positions; returns the longest way. */
static uint16_t go_to_step(uint16_t pose[PAGE_JOINTS], const uint8_t *page, uint8_t step)
{
    uint16_t longest = 0;
    for (uint8_t joint = 0; joint < PAGE_JOINTS; joint++) {
        uint16_t word = page_pos(page, step, joint);
        if (page_pos_is_used(word)) {
            uint16_t way = (uint16_t)(word > pose[joint] ? word - pose[joint] : pose[joint] - word);
            longest = way > longest ? way : longest;
            pose[joint] = word;
        }
    }
    return longest;
}

static player_step_t step_at(const uint8_t *page, int step)
{
    const uint8_t *block = page + PAGE_AT_STEP0 + (unsigned)step * PAGE_STEP_BYTES;
    return (player_step_t){
        .page = 1, .step = (uint8_t)(step + 1), .steps = page[PAGE_AT_STEPS],
        .schedule = page[PAGE_AT_SCHEDULE], .page_speed = page[PAGE_AT_SPEED], .accel_time = page[PAGE_AT_ACCEL_TIME],
        .pause = block[PAGE_STEP_AT_PAUSE], .time = block[PAGE_STEP_AT_SPEED], .rate_percent = SHAPE_NORMAL,
    };
}

int motion_api_step_ticks(int page, int step, int law)
{
    if (!is_step(page, step)) {
        return -1;
    }
    const uint8_t *bytes = api.pages[page];
    uint16_t pose[PAGE_JOINTS], way = 0, carry = STEP_PLAN_CARRY_START;
    memcpy(pose, api.pose, sizeof pose);
    for (int i = 0; i <= step; i++) {
        way = go_to_step(pose, bytes, (uint8_t)i);
    }
    player_step_t asked = step_at(bytes, step);
    if (law == 0) {
        return step_plan_exact_ticks(&asked, way, &carry);
    }
    uint16_t ticks = step_plan_classic_ticks(&asked, way, &carry);
    (void)step_plan_classic_ramp(asked.accel_time, &ticks);
    return ticks;
}

int motion_api_pause_ticks(int page, int step, int law)
{
    uint16_t carry = STEP_PLAN_CARRY_START;
    if (!is_step(page, step)) {
        return -1;
    }
    player_step_t asked = step_at(api.pages[page], step);
    if (asked.page_speed == 0) {
        return -1;
    }
    return law ? step_plan_classic_hold(&asked, &carry) : step_plan_exact_hold(&asked, &carry);
}

int motion_api_start(int page, int law, int mode, int code, uint32_t present)
{
    if (!is_page(page)) {
        return PLAYER_ERR_RANGE;
    }
    player_init(&api.player, &source, api.joint, api.goal_pos);
    player_set_shape(&api.player, shape_now(), &api.shaping);
    link_init(&api.link, mode ? LINK_HOLD : LINK_LATCH);
    link_call(&api.link, (uint8_t)code);
    return (int)player_start(&api.player, &api.link, (uint8_t)page, law ? PLAYER_LAW_CLASSIC : PLAYER_LAW_EXACT,
                             api.pose, present);
}

int motion_api_fault_page(void) { return api.player.fault_page; }

void motion_api_code(int code) { link_code(&api.link, (uint8_t)code); }

int motion_api_tick(void) { return player_tick(&api.player, &api.link); }

const uint16_t *motion_api_goals(void) { return api.goal_pos; }

uint32_t motion_api_joints(void) { return api.player.joints; }

int motion_api_page(void) { return api.player.page; }

int motion_api_step(void) { return api.player.step; }

int motion_api_repetition(void) { return api.player.repetition; }

bool motion_api_is_moving(void) { return player_is_moving(&api.player); }

uint32_t motion_api_curve(uint32_t ticks)
{
    uint32_t played = 0;
    while (played < ticks && played < MOTION_API_CURVE_TICKS && player_is_moving(&api.player)) {
        int events = motion_api_tick();
        memcpy(api.goals[played], api.player.goal_pos, sizeof api.goals[played]);
        api.marks[played][0] = api.player.page;
        api.marks[played][1] = api.player.step;
        api.marks[played][2] = (uint8_t)events;
        played++;
    }
    return played;
}

const uint16_t *motion_api_curve_goals(void) { return api.goals[0]; }

const uint8_t *motion_api_curve_marks(void) { return api.marks[0]; }
