/* SPDX-License-Identifier: MIT */
#include "player.h"
#include <string.h>
#include "fix.h"
#include "law.h"

/*          start            last tick of the last page
 *   IDLE --------> PLAYING ---------------------------> IDLE
 *                  |   ^  ^ rest of the step played
 *            pause |   |  +--------------- RESTING
 *            break |   +-- still standing     ^ resume
 *                  v                          |
 *                BRAKING ------------> STANDING      (a break ends: IDLE)
 */
enum { STATE_IDLE, STATE_PLAYING, STATE_BRAKING, STATE_STANDING, STATE_RESTING };

/* Pages without action that are passed over in one tick before the play gives up. */
#define PASS_OVER_MAX PAGE_COUNT
#define ALL_JOINTS 0x7FFFFFFFu
#define HEADER_BYTES 31u /* up to the checksum */

void player_init(player_t *player, const page_source_t *source)
{
    *player = (player_t){.source = source, .state = STATE_IDLE};
}

uint16_t law_longest_way(const player_t *player, const uint8_t step[PAGE_STEP_BYTES])
{
    uint16_t longest = 0;
    const player_joint_t *joint = player->joint;
    uint32_t present = player->present;
    for (uint8_t left = PAGE_JOINTS; left != 0; left--, joint++, present >>= 1) {
        uint16_t word = page_word(step);
        step += 2;
        OPAQUE(word); /* load and step in one */
        if (((uint8_t)present & 1) != 0 && page_pos_is_used(word)) {
            uint16_t from = joint->coming_pos, way = (uint16_t)(word - from);
            if (word < from) {
                way = (uint16_t)(from - word);
            }
            if (way > longest) {
                longest = way;
            }
        }
    }
    return longest;
}

/* What the player looks at of a header: from PLAY_COUNT on. The name before it is left as it is. */
static void read_header(const page_source_t *source, uint8_t page, uint8_t header[HEADER_BYTES])
{
    source->read(source->context, page, PAGE_AT_PLAY_COUNT, &header[PAGE_AT_PLAY_COUNT],
                 HEADER_BYTES - PAGE_AT_PLAY_COUNT);
}

/* Only the links and their codes. */
static void read_links(const page_source_t *source, uint8_t page, uint8_t header[HEADER_BYTES])
{
    source->read(source->context, page, PAGE_AT_NEXT_PAGE, &header[PAGE_AT_NEXT_PAGE],
                 HEADER_BYTES - PAGE_AT_NEXT_PAGE);
}

/* The bytes of a step from `from` on, to their places. */
static void read_step(const page_source_t *source, uint8_t page, uint8_t step, uint8_t bytes[PAGE_STEP_BYTES], uint8_t from)
{
    source->read(source->context, page, (uint16_t)(PAGE_STEP_BYTES * step + from), &bytes[from],
                 (uint8_t)(PAGE_STEP_BYTES - from));
}

/* --- which page and step comes ----------------------------------------------------------------------------------- */

static uint8_t fail(player_t *player, uint8_t page, uint8_t fault)
{
    player->fault_page = page;
    player->fault = fault;
    return 0;
}

/* The first page with action, from `page` on along the links of pages with PLAY_COUNT 0. 0: none, or a fault. Leaves
 * that page's header in `header`. */
static uint8_t resolve(player_t *player, link_t *link, uint8_t page, uint8_t header[HEADER_BYTES])
{
    for (uint8_t passed = 0; page != 0 && passed < PASS_OVER_MAX; passed++) {
        uint8_t status = player->source->check(player->source->context, page);
        if (status != PAGE_OK) {
            return fail(player, page, status);
        }
        read_header(player->source, page, header);
        if (page_is_playable(header)) {
            return page;
        }
        if (header[PAGE_AT_PLAY_COUNT] != 0) {
            return fail(player, page, PAGE_EMPTY);
        }
        link_taken_t taken;
        uint8_t next = link_decide(link, page, header, &taken);
        if (next == page) {
            return fail(player, page, PAGE_EMPTY);
        }
        page = next;
    }
    return page == 0 ? 0 : fail(player, page, PAGE_EMPTY);
}

static void take_header(player_t *player, uint8_t page, const uint8_t header[HEADER_BYTES])
{
    player_step_t *step = &player->coming;
    step->page = page;
    step->step = 1;
    step->steps = header[PAGE_AT_STEPS];
    step->schedule = header[PAGE_AT_SCHEDULE];
    step->page_speed = header[PAGE_AT_SPEED];
    step->accel_time = header[PAGE_AT_ACCEL_TIME];
    player->count_left = header[PAGE_AT_PLAY_COUNT];
    player->coming_repetition = 1;
}

static bool has_steps(player_t *player, uint8_t page)
{
    uint8_t steps = 0;
    if (page != 0 && player->source->check(player->source->context, page) == PAGE_OK) {
        player->source->read(player->source->context, page, PAGE_AT_STEPS, &steps, 1);
    }
    return steps != 0;
}

/* At the last step of a page: the same page again, or along its link. */
static uint8_t decide(player_t *player, link_t *link)
{
    player->count_left--;
    if (player->count_left != 0 && !link_is_stopping(link)) {
        player->coming.step = 1;
        player->coming_repetition++;
        return 0;
    }
    uint8_t header[HEADER_BYTES];
    link_taken_t taken;
    read_links(player->source, player->now.page, header);
    uint8_t named = link_decide(link, player->now.page, header, &taken);
    player->link_taken = (uint8_t)taken;
    player->next_page = named;
    uint8_t page = resolve(player, link, named, header);
    player->look_page = page == named ? page : has_steps(player, named) ? named : 0;
    player->coming.page = 0;
    if (page != 0) {
        take_header(player, page, header);
    }
    return PLAYER_EV_LINK;
}

static void read_coming(player_t *player, uint8_t bytes[PAGE_STEP_BYTES], uint8_t from)
{
    read_step(player->source, player->coming.page, player->coming.step, bytes, from);
    player->coming.pause = bytes[PAGE_STEP_AT_PAUSE];
    player->coming.time = bytes[PAGE_STEP_AT_SPEED];
}

bool player_looks_ahead(const player_t *player)
{
    return player->look_page != 0;
}

void player_next_step(player_t *player, link_t *link, uint8_t step[PAGE_STEP_BYTES], uint8_t from)
{
    uint8_t events = PLAYER_EV_STEP;
    player->now = player->coming;
    player->look_page = player->now.page;
    if (player->now.step == 1) {
        events |= PLAYER_EV_PAGE;
        player->repetition = player->coming_repetition;
    }
    if (player->now.step < player->now.steps) {
        player->coming.step++;
    } else {
        events |= decide(player, link);
    }
    player->held_events = events;
    if (player->coming.page != 0) {
        read_coming(player, step, from);
    }
    if (player->law == PLAYER_LAW_CLASSIC && player->look_page != player->coming.page && player->look_page != 0) {
        read_step(player->source, player->look_page, 1, step, 0);
    } else {
        player->look_page = player->coming.page;
    }
}

uint8_t player_announce(player_t *player)
{
    uint8_t events = 0;
    if (player->primed) {
        events = player->held_events;
        player->primed = false;
        player->held_events = 0;
        player->page = player->now.page;
        player->step = player->now.step;
    }
    return events;
}

void player_read_coming(const player_t *player, uint8_t step[PAGE_STEP_BYTES])
{
    read_step(player->source, player->coming.page, player->coming.step, step, 0);
}

bool player_is_in_law(const player_t *player)
{
    return player->state == STATE_PLAYING;
}

uint8_t player_end(player_t *player)
{
    player->state = STATE_IDLE;
    return PLAYER_EV_ENDED;
}

/* --- what callers do --------------------------------------------------------------------------------------------- */

static void stand_at(player_t *player, const uint16_t pose_pos[PAGE_JOINTS], uint32_t present)
{
    player->present = present & ALL_JOINTS;
    player->joints = player->coming_joints = 0;
    for (uint8_t i = 0; i < PAGE_JOINTS; i++) {
        uint16_t pos = pose_pos[i] > PAGE_POS_MAX ? PAGE_POS_MAX : pose_pos[i];
        player->joint[i] = (player_joint_t){.target_pos = pos, .coming_pos = pos};
        player->goal_pos[i] = pos;
    }
}

player_status_t player_start(player_t *player, link_t *link, uint8_t page, player_law_t law,
                             const uint16_t pose_pos[PAGE_JOINTS], uint32_t present)
{
    if (player->state != STATE_IDLE) {
        return PLAYER_ERR_BUSY;
    }
    if (page == 0 || page >= PAGE_COUNT) {
        return PLAYER_ERR_RANGE;
    }
    if (law == PLAYER_LAW_CLASSIC && !classic_is_here()) {
        return PLAYER_ERR_LAW;
    }
    uint8_t bytes[PAGE_STEP_BYTES];
    player->fault_page = 0;
    player->fault = PAGE_OK;
    page = resolve(player, link, page, bytes);
    if (page == 0) {
        return player->fault == PAGE_OK || player->fault == PAGE_EMPTY ? PLAYER_ERR_EMPTY : PLAYER_ERR_PAGE;
    }
    take_header(player, page, bytes);
    read_coming(player, bytes, 0);
    stand_at(player, pose_pos, present);
    player->law = (uint8_t)law;
    player->page = page;
    player->step = 0;
    player->breaking = false;
    player->held_events = 0;
    player->primed = false;
    if (law == PLAYER_LAW_CLASSIC) {
        classic_start(player, link);
    } else {
        exact_start(player, link, bytes);
    }
    player->state = STATE_PLAYING;
    return PLAYER_OK;
}

uint32_t player_first_pose(const page_source_t *source, uint8_t page, uint16_t pose_pos[PAGE_JOINTS])
{
    uint8_t bytes[PAGE_STEP_BYTES];
    uint32_t joints = 0;
    read_step(source, page, 1, bytes, 0);
    for (uint8_t i = 0; i < PAGE_JOINTS; i++) {
        uint16_t word = page_word(&bytes[2 * i]);
        if (page_pos_is_used(word)) {
            pose_pos[i] = word;
            joints |= (uint32_t)1 << i;
        }
    }
    return joints;
}

static uint8_t tick_braking(player_t *player)
{
    if (brake_tick(player)) {
        return PLAYER_EV_OUTPUT;
    }
    if (player->breaking) {
        return (uint8_t)(PLAYER_EV_OUTPUT | PLAYER_EV_STANDING | player_end(player));
    }
    player->state = STATE_STANDING;
    return PLAYER_EV_OUTPUT | PLAYER_EV_STANDING;
}

static uint8_t tick_resting(player_t *player, link_t *link)
{
    bool classic = player->law == PLAYER_LAW_CLASSIC;
    uint8_t events = player_announce(player) | PLAYER_EV_OUTPUT;
    bool more = exact_rest_tick(player);
    if (!more) {
        player->state = STATE_PLAYING;
    }
    if (classic) {
        more ? classic_prepare_at_rest(player) : classic_thaw(player);
    } else if (!more) {
        events |= exact_go_on(player, link);
    }
    return events;
}

uint8_t player_tick(player_t *player, link_t *link)
{
    switch (player->state) {
    case STATE_PLAYING:
        return player->law == PLAYER_LAW_CLASSIC ? classic_tick(player, link) : exact_tick(player, link);
    case STATE_BRAKING:
        return tick_braking(player);
    case STATE_RESTING:
        return tick_resting(player, link);
    case STATE_STANDING:
        return player->breaking ? (uint8_t)(PLAYER_EV_STANDING | player_end(player)) : 0;
    default:
        return 0;
    }
}

static void slow_down(player_t *player)
{
    if (player->law == PLAYER_LAW_CLASSIC && player->state == STATE_PLAYING) {
        classic_freeze(player);
    } else {
        exact_freeze(player);
    }
    brake_start(player);
    player->state = STATE_BRAKING;
}

void player_break(player_t *player)
{
    if (player->state == STATE_PLAYING || player->state == STATE_RESTING) {
        slow_down(player);
    }
    player->breaking = player->state != STATE_IDLE;
}

void player_pause(player_t *player)
{
    if (player->state == STATE_PLAYING || player->state == STATE_RESTING) {
        slow_down(player);
    }
}

void player_resume(player_t *player)
{
    if (player->state != STATE_STANDING || player->breaking) {
        return;
    }
    if (!exact_rest_start(player)) {
        if (player->law == PLAYER_LAW_CLASSIC) {
            classic_thaw(player);
        }
        player->state = STATE_PLAYING;
        return;
    }
    player->state = STATE_RESTING;
}

bool player_is_moving(const player_t *player)
{
    return player->state != STATE_IDLE;
}

bool player_is_paused(const player_t *player)
{
    return (player->state == STATE_BRAKING || player->state == STATE_STANDING) && !player->breaking;
}

void player_drop_joints(player_t *player, uint32_t joints)
{
    bool classic_words = player->law == PLAYER_LAW_CLASSIC && player->state == STATE_PLAYING;
    player->present &= ~joints;
    player->joints &= ~joints;
    player->coming_joints &= ~joints;
    for (uint8_t i = 0; i < PAGE_JOINTS; i++) {
        if ((joints >> i & 1u) != 0) {
            uint16_t pos = player->goal_pos[i];
            player->joint[i] = (player_joint_t){.target_pos = pos, .coming_pos = pos};
            if (classic_words) {
                player->joint[i].classic.base = (int16_t)pos;
            } else {
                player->joint[i].exact.pos_q16_16 = (int32_t)pos << FIX_POS_BITS;
            }
        }
    }
}
