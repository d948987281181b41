/* SPDX-License-Identifier: MIT
 * sequence.c - finds the page and step that come next (repetitions, links, pages without action); reads and shapes them. */
#include <string.h>
#include "law.h"
#include "shape_step.h"

#define HEADER_BYTES 31u /* up to the checksum */

/* --- reading ------------------------------------------------------------------------------------------------------ */

/* Reads the header from byte `from` on into its place; does not read the name. */
static void read_header(const page_source_t *source, uint8_t page, uint8_t header[HEADER_BYTES], uint8_t from)
{
    source->read(source->context, page, from, &header[from], (uint8_t)(HEADER_BYTES - from));
}

/* The position words of a step, PAGE_POS_UNUSED for all that are not used or not in `joints`. Returns the joints' bits that
 * are used. */
static uint32_t read_words(const page_source_t *source, uint8_t page, uint8_t step, uint32_t joints,
                           uint16_t words[PAGE_JOINTS])
{
    /* A joint's bit leaves `joints` as the lowest one; the bit of what it uses enters as the highest. */
    source->read(source->context, page, (uint16_t)(PAGE_STEP_BYTES * step), words, 2u * PAGE_JOINTS);
    for (uint16_t *word = words; word < &words[PAGE_JOINTS]; word++) {
        bool is_used = ((uint8_t)joints & 1u) != 0 && page_pos_is_used(*word);
        joints >>= 1;
        if (is_used) {
            joints |= 0x80000000u;
        } else {
            *word = PAGE_POS_UNUSED;
        }
    }
    return joints >> 1; /* 31 joints */
}

uint32_t player_first_pose(const page_source_t *source, const shape_t *shape, uint8_t page, uint16_t pose_pos[PAGE_JOINTS])
{
    uint16_t words[PAGE_JOINTS];
    uint32_t joints = read_words(source, page, 1, UINT32_MAX, words);
    if (shape != NULL) {
        shape_step_t shaping;
        shape_step_begin(&shaping, shape, source, page, 1);
        while (shape_step_share(&shaping, source, words)) {
        }
    }
    for (uint8_t i = 0; i < PAGE_JOINTS; i++) {
        if (words[i] != PAGE_POS_UNUSED) {
            pose_pos[i] = words[i];
        }
    }
    return joints;
}

/* --- which page --------------------------------------------------------------------------------------------------- */

static uint8_t fail(player_t *player, uint8_t page, uint8_t fault)
{
    player->fault_page = page;
    player->fault = fault;
    return 0;
}

/* The link that is followed. A link above the last page counts as 0. */
static uint8_t follow(link_t *link, uint8_t page, const uint8_t header[HEADER_BYTES], link_taken_t *taken)
{
    uint8_t next = link_decide(link, page, header, taken);
    return next < PAGE_COUNT ? next : 0;
}

/* Notes a page in a set of pages. false: it is there already. */
static bool note(uint8_t set[PAGE_COUNT / 8], uint8_t page)
{
    uint8_t bit = (uint8_t)(1u << (page % 8)), *byte = &set[page / 8];
    bool fresh = (*byte & bit) == 0;
    *byte |= bit;
    return fresh;
}

/* The first page with action, from `page` on along the links of pages with PLAY_COUNT 0. 0: none, or a fault. Leaves
 * that page's header in `header`. */
static uint8_t resolve(player_t *player, link_t *link, uint8_t page, uint8_t header[HEADER_BYTES])
{
    uint8_t passed_over[PAGE_COUNT / 8] = {0};
    while (page != 0) {
        uint8_t status = player->source->check(player->source->context, page);
        if (status != PAGE_OK) {
            return fail(player, page, status);
        }
        read_header(player->source, page, header, PAGE_AT_PLAY_COUNT);
        if (page_is_playable(header)) {
            return page;
        }
        if (header[PAGE_AT_STEPS] == 0 || !note(passed_over, page)) {
            return fail(player, page, PAGE_EMPTY);
        }
        link_taken_t taken;
        page = follow(link, page, header, &taken);
    }
    return 0;
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

bool sequence_start(player_t *player, link_t *link, uint8_t page)
{
    uint8_t header[HEADER_BYTES];
    player->fault_page = 0;
    player->fault = PAGE_OK;
    page = resolve(player, link, page, header);
    if (page != 0) {
        take_header(player, page, header);
    }
    return page != 0;
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
    read_header(player->source, player->now.page, header, PAGE_AT_NEXT_PAGE);
    uint8_t named = follow(link, player->now.page, header, &taken);
    player->link_taken = (uint8_t)taken;
    player->next_page = named;
    uint8_t page = resolve(player, link, named, header);
    player->look_page = named;
    player->coming.page = 0;
    if (page != 0) {
        take_header(player, page, header);
    }
    return PLAYER_EV_LINK;
}

/* --- which step --------------------------------------------------------------------------------------------------- */

bool sequence_looks_elsewhere(const player_t *player)
{
    return LAW_IS_CLASSIC(player) && player->look_page != player->coming.page;
}

/* Whether the settings of shape.h change this play. */
static bool shapes(const player_t *player)
{
    return player->shape != NULL && !shape_is_neutral(player->shape);
}

/* Reads a step's words to looked_at. Page 0: no joint is used. */
static NOINLINE void look_at(player_t *player, uint8_t page, uint8_t step)
{
    player->looked_joints = read_words(player->source, page, step, page != 0 ? player->present : 0, player->looked_at);
}

static void shape_a_share(player_t *player)
{
    (void)shape_step_share(player->shaping, player->source, player->looked_at);
    player->shares_left--;
}

/* Shapes the remaining joints of the step that was looked at. */
static void shape_the_rest(player_t *player)
{
    while (player->shares_left != 0) {
        shape_a_share(player);
    }
}

STATIC_ASSERT(offsetof(player_step_t, time) == offsetof(player_step_t, pause) + 1, "side by side, as in a step");

/* Reads the coming step, and begins to shape it. */
static void look_at_coming(player_t *player)
{
    player_step_t *coming = &player->coming;
    const shape_t *shape = player->shape;
    bool shaped = shapes(player);
    look_at(player, coming->page, coming->step);
    player->source->read(player->source->context, coming->page,
                         (uint16_t)(PAGE_STEP_BYTES * coming->step + PAGE_STEP_AT_PAUSE), &coming->pause, 2);
    coming->rate_percent = shaped ? shape->rate_percent : SHAPE_NORMAL;
    coming->top_speed_q4_4 = shaped ? shape->top_speed_q4_4 : 0;
    player->shares_left = shaped ? SHAPE_STEP_SHARES : 0;
    if (shaped) {
        shape_step_begin(player->shaping, shape, player->source, coming->page, coming->step);
    }
}

void sequence_look(player_t *player, link_t *link)
{
    uint8_t events = PLAYER_EV_STEP;
    player->now = player->coming;
    player->look_page = player->now.page;
    player->looked = true;
    if (player->now.step == 1) {
        events |= PLAYER_EV_PAGE;
        player->repetition = player->coming_repetition;
    }
    if (player->now.step < player->now.steps) {
        player->coming.step++;
    } else {
        events |= decide(player, link);
    }
    player->announced_events = events;
    if (shapes(player)) {
        player->look_page = player->coming.page; /* the original has no shaped step to be equal to */
    }
    if (sequence_looks_elsewhere(player)) {
        look_at(player, player->look_page, 1);
    } else if (player->coming.page != 0) {
        look_at_coming(player);
    } else {
        look_at(player, 0, 0);
    }
}

/* Whether a piece of work is done in this tick: if the tick has time for it, or if there are not more ticks than pieces. */
static bool fits(player_t *player, uint8_t ticks, uint8_t pieces, uint8_t work)
{
    uint8_t most = LAW_WORK_MOST;
    if (PLAYER_LAYERS && player->self == PLAYER_OWNER_LAYER) {
        most = LAW_WORK_MOST - LAW_WORK_MOST / 3u; /* the main play comes after it */
    }
    if (PLAYER_LAYERS && pieces < ticks && player->work + work > most) {
        return false;
    }
    law_work(player, work);
    return true;
}

/* Whether the play may look in this tick. When a main play does depends on itself alone: with a layer and without, the same
 * settings, codes and stops count. */
static bool may_look(player_t *player, uint8_t left, bool begins)
{
    if (PLAYER_LAYERS && player->self == PLAYER_OWNER_LAYER) {
        return fits(player, left, 2, LAW_WORK_LOOK);
    }
    if (left > 1 && (left > SEQUENCE_AHEAD_SHAPED || (begins && left > SHAPE_STEP_SHARES) || !shapes(player))) {
        return false;
    }
    law_work(player, LAW_WORK_LOOK);
    return true;
}

bool sequence_prepare(player_t *player, link_t *link, uint8_t left, bool begins)
{
    if (!player->looked) {
        if (player->coming.page == 0 || !may_look(player, left, begins)) {
            return false;
        }
        sequence_look(player, link);
    }
    const uint8_t ticks = (uint8_t)(left + begins); /* a tick that has begun a step has little time */
    while (player->shares_left != 0) {
        if (!fits(player, ticks, (uint8_t)(player->shares_left + 1u), LAW_WORK_SHARE)) {
            return false;
        }
        shape_a_share(player);
    }
    return !player->measured && fits(player, ticks, 1, LAW_WORK_MEASURE);
}

void sequence_measure(player_t *player)
{
    uint16_t longest = 0, longest_lent = 0;
    if (sequence_looks_elsewhere(player)) { /* the step that will really be played */
        player->coming.page != 0 ? look_at_coming(player) : look_at(player, 0, 0);
    }
    shape_the_rest(player);
    player->coming_way = player->lent_way = 0;
    if (player->coming.schedule != PAGE_SCHEDULE_SPEED && player->coming.top_speed_q4_4 == 0) {
        return;
    }
    const uint16_t *looked_at = player->looked_at, *from = player->coming_pos;
    const uint8_t self = player->self;
    for (player_joint_t *joint = player->joint; joint < &player->joint[PAGE_JOINTS]; joint++) {
        uint16_t from_pos = *from++, to_pos = *looked_at++;
        if (to_pos == PAGE_POS_UNUSED) {
            continue;
        }
        uint16_t way = to_pos > from_pos ? (uint16_t)(to_pos - from_pos) : (uint16_t)(from_pos - to_pos);
        longest = way > longest ? way : longest;
        if (!law_owns(self, joint) && way > longest_lent) {
            longest_lent = way;
        }
    }
    player->coming_way = longest;
    player->lent_way = longest_lent;
}

uint8_t sequence_take(player_t *player)
{
    uint8_t own = 0;
    const uint8_t self = player->self;
    uint16_t *pos = player->coming_pos;
    const uint16_t *looked_at = player->looked_at;
    player_joint_t *joint = player->joint;
    for (uint8_t left = PAGE_JOINTS; left != 0; left--, joint++, pos++) {
        uint16_t word = *looked_at++;
        if (law_owns(self, joint)) {
            joint->target_pos = *pos;
            own++;
        }
        if (word != PAGE_POS_UNUSED) {
            *pos = word;
        }
    }
    player->coming_joints = player->looked_joints;
    player->looked = player->measured = false;
    return own;
}

void sequence_look_first(player_t *player)
{
    player->look_page = player->coming.page;
    look_at_coming(player);
}

uint8_t sequence_announce(player_t *player)
{
    if (!player->arrived) {
        return 0;
    }
    player->arrived = false;
    player->page = player->now.page;
    player->step = player->now.step;
    return player->announced_events;
}
