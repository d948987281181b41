/* SPDX-License-Identifier: MIT */
#include "motion_api.h"

#include <string.h>

#include "crc16.h"
#include "page_edit.h"
#include "player.h"
#include "remote.h"
#include "shape_of.h"
#include "step_ticks.h"

static struct {
    uint8_t pages[PAGE_COUNT][PAGE_BYTES];
    uint16_t pose[PAGE_JOINTS];
    link_t link;
    player_t player;
    shape_t shape;
    bool is_shaped;
    player_joint_t joint[PAGE_JOINTS];
    uint16_t goal_pos[PAGE_JOINTS];
    uint16_t goals[MOTION_API_CURVE_TICKS][PAGE_JOINTS];
    uint8_t marks[MOTION_API_CURVE_TICKS][MOTION_API_MARK_BYTES];
    uint8_t leads[MOTION_API_LEADS][MOTION_API_LEAD_BYTES];
    uint8_t lead_count;
    uint8_t reached[PAGE_COUNT];
    uint8_t moved[PAGE_COUNT];
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

uint8_t *motion_api_pages(void) { return api.pages[0]; }

int motion_api_check(int page) { return is_page(page) ? (int)page_check(api.pages[page]) : -1; }

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

int motion_api_crc16(int page)
{
    return is_page(page) ? (int)crc16_bytes(CRC16_START, api.pages[page], PAGE_BYTES) : -1;
}

int motion_api_mirrored(int pos)
{
    return (int)page_edit_mirrored((uint16_t)pos, 2u * PAGE_POS_MIDDLE);
}

int motion_api_pos_between(int a, int b) { return b > a ? b - (b - a) / 2 : b + (a - b) / 2; }

int motion_api_time_between(int time)
{
    int rest = time / 2, share = time - rest;
    return share | (time == 1 ? 1 : rest) << 8;
}

int motion_api_remote_code(int buttons)
{
    uint8_t code;
    return remote_act((uint16_t)buttons, &code) == REMOTE_ACT_CODE ? code : LINK_CODE_NONE;
}

/* --- links --- */

/* In the order of motion_api_lead_t. */
static const uint8_t link_at[MOTION_API_LEADS] = { PAGE_AT_NEXT_PAGE, PAGE_AT_EXIT_PAGE, PAGE_AT_LINKED1_PAGE,
                                                   PAGE_AT_LINKED2_PAGE, PAGE_AT_BLEND_RIGHT, PAGE_AT_BLEND_LEFT };

static bool has_steps(int page) { return page_check(api.pages[page]) == PAGE_OK && api.pages[page][PAGE_AT_STEPS] != 0; }

static void lead(int page, motion_api_lead_t kind, uint8_t code)
{
    uint8_t to = api.pages[page][link_at[kind]];
    if (to != 0 && to < PAGE_COUNT) {
        uint8_t *row = api.leads[api.lead_count++];
        row[0] = (uint8_t)kind;
        row[1] = to;
        row[2] = code;
    }
}

/* The link that is followed at the end of the page if this code called it. */
static link_taken_t taken_by(int page, uint8_t code)
{
    link_t link;
    link_taken_t taken;
    link_init(&link, LINK_LATCH);
    link_call(&link, code);
    (void)link_decide(&link, (uint8_t)page, api.pages[page], &taken);
    return taken;
}

int motion_api_leads(int page)
{
    api.lead_count = 0;
    if (!is_page(page) || !has_steps(page)) {
        return 0;
    }
    lead(page, MOTION_API_LEAD_NEXT, LINK_CODE_NONE);
    lead(page, MOTION_API_LEAD_EXIT, LINK_CODE_NONE);
    for (uint8_t code = 1; code < LINK_CODE_STOP; code++) {
        link_taken_t taken = taken_by(page, code);
        if (taken == LINK_LINKED1 || taken == LINK_LINKED2) {
            lead(page, taken == LINK_LINKED1 ? MOTION_API_LEAD_LINKED1 : MOTION_API_LEAD_LINKED2, code);
        }
    }
    lead(page, MOTION_API_LEAD_BLEND_RIGHT, LINK_CODE_NONE);
    lead(page, MOTION_API_LEAD_BLEND_LEFT, LINK_CODE_NONE);
    return api.lead_count;
}

const uint8_t *motion_api_leads_table(void) { return api.leads[0]; }

const uint8_t *motion_api_reach(int first)
{
    uint8_t waiting[PAGE_COUNT];
    int count = 0;
    memset(api.reached, 0, sizeof api.reached);
    for (int page = 1; page < (int)PAGE_COUNT; page++) {
        if (first != 0 ? page == first : has_steps(page) && api.pages[page][PAGE_AT_PLAY_CODE] != LINK_CODE_NONE) {
            api.reached[page] = 1;
            waiting[count++] = (uint8_t)page;
        }
    }
    while (count > 0) {
        int leads = motion_api_leads(waiting[--count]);
        for (int i = 0; i < leads; i++) {
            uint8_t to = api.leads[i][1];
            if (api.reached[to] == 0) {
                api.reached[to] = 1;
                waiting[count++] = to;
            }
        }
    }
    return api.reached;
}

bool motion_api_exits_round(int page)
{
    link_t link;
    link_taken_t taken = LINK_NEXT;
    link_init(&link, LINK_LATCH);
    link_code(&link, LINK_CODE_STOP);
    while (is_page(page) && page != 0 && has_steps(page) && taken != LINK_END_OF_EXIT_LOOP) {
        page = link_decide(&link, (uint8_t)page, api.pages[page], &taken);
    }
    return taken == LINK_END_OF_EXIT_LOOP;
}

uint8_t *motion_api_moved(void) { return api.moved; }

void motion_api_relink(int page)
{
    if (!is_page(page) || page_check(api.pages[page]) != PAGE_OK) {
        return;
    }
    for (int i = 0; i < MOTION_API_LEADS; i++) {
        uint8_t *to = &api.pages[page][link_at[i]];
        if (*to != 0 && *to < PAGE_COUNT) {
            *to = api.moved[*to];
        }
    }
    page_seal(api.pages[page]);
}

/* --- play --- */

uint16_t *motion_api_pose(void) { return api.pose; }

static const shape_t *shape_now(void) { return api.is_shaped ? &api.shape : NULL; }

uint32_t motion_api_first_pose(int page)
{
    return is_page(page) ? player_first_pose(&source, shape_now(), (uint8_t)page, api.pose) : 0;
}

bool motion_api_shape(int rate_percent, int amplitude_percent, int blend_percent)
{
    shape_t shape;
    if (!shape_of(&shape, rate_percent, amplitude_percent, blend_percent)) {
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

/* Moves the joints that a step uses to its positions. Returns the longest distance. */
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

void motion_api_pose_after(int page, int step)
{
    (void)motion_api_first_pose(page);
    for (int i = 0; is_page(page) && is_step(page, i) && i <= step && i < api.pages[page][PAGE_AT_STEPS]; i++) {
        (void)go_to_step(api.pose, api.pages[page], (uint8_t)i);
    }
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
    uint16_t pose[PAGE_JOINTS], way = 0, carry = STEP_TICKS_CARRY_START;
    memcpy(pose, api.pose, sizeof pose);
    for (int i = 0; i <= step; i++) {
        way = go_to_step(pose, bytes, (uint8_t)i);
    }
    player_step_t asked = step_at(bytes, step);
    if (law == 0) {
        return step_ticks_exact(&asked, way, &carry);
    }
    uint16_t ticks = step_ticks_classic(&asked, way, &carry);
    (void)step_ticks_classic_ramp(asked.accel_time, &ticks);
    return ticks;
}

int motion_api_pause_ticks(int page, int step, int law)
{
    uint16_t carry = STEP_TICKS_CARRY_START;
    if (!is_step(page, step)) {
        return -1;
    }
    player_step_t asked = step_at(api.pages[page], step);
    if (asked.page_speed == 0) {
        return -1;
    }
    return law ? step_ticks_classic_hold(&asked, &carry) : step_ticks_exact_hold(&asked, &carry);
}

int motion_api_start(int page, int law, int mode, int code, uint32_t present)
{
    if (!is_page(page)) {
        return PLAYER_ERR_RANGE;
    }
    player_init(&api.player, &source, api.joint);
    memcpy(api.goal_pos, api.pose, sizeof api.goal_pos);
    api.player.shape = shape_now();
    link_init(&api.link, mode ? LINK_HOLD : LINK_LATCH);
    link_call(&api.link, (uint8_t)code);
    return (int)player_start(&api.player, &api.link, (uint8_t)page, law ? PLAYER_LAW_CLASSIC : PLAYER_LAW_EXACT,
                             api.pose, present);
}

void motion_api_code(int code) { link_code(&api.link, (uint8_t)code); }

uint32_t motion_api_curve(uint32_t ticks)
{
    uint32_t played = 0;
    while (played < ticks && played < MOTION_API_CURVE_TICKS && player_is_moving(&api.player)) {
        int events = player_tick(&api.player, &api.link);
        if ((events & PLAYER_EV_OUTPUT) != 0) {
            player_goals(&api.player, UINT32_MAX, api.goal_pos);
        }
        memcpy(api.goals[played], api.goal_pos, sizeof api.goals[played]);
        api.marks[played][0] = api.player.now.page;
        api.marks[played][1] = api.player.now.step;
        api.marks[played][2] = (uint8_t)events;
        played++;
    }
    return played;
}

const uint16_t *motion_api_curve_goals(void) { return api.goals[0]; }

const uint8_t *motion_api_curve_marks(void) { return api.marks[0]; }
