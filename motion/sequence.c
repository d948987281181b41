/* SPDX-License-Identifier: MIT
 * sequence.c - repetitions, links and pages without action decide which step comes next. */
#include "sequence.h"

#include <stddef.h>
#include "shape_step.h"

#define HEADER_BYTES 31u /* up to the checksum */

static uint8_t fail(player_t *player, uint8_t page, uint8_t fault)
{
    player->fault_page = page;
    player->fault = fault;
    return 0;
}

/* The page that the link names. A link above the last page is taken as 0. */
static uint8_t follow(link_t *link, uint8_t page, const uint8_t header[HEADER_BYTES], link_taken_t *taken)
{
    *taken = LINK_NEXT;
    const uint8_t named = link != NULL ? link_decide(link, page, header, taken) : header[PAGE_AT_NEXT_PAGE];
    return page_is_there(named) ? named : 0;
}

/* The first page with action: `page`, or else the one that the links of pages with PLAY_COUNT 0 lead to. Fills in its
 * header. 0: there is none, or a fault. */
static uint8_t resolve(player_t *player, link_t *link, uint8_t page, uint8_t header[HEADER_BYTES])
{
    const page_source_t *source = player->source;
    uint8_t passed_over[PAGE_COUNT / 8] = {0};
    while (page != 0) {
        const uint8_t status = source->check(source->context, page);
        if (status != PAGE_OK) {
            return fail(player, page, status);
        }
        source->read(source->context, page, 0, header, HEADER_BYTES);
        if (page_is_playable(header)) {
            return page;
        }
        if (header[PAGE_AT_STEPS] == 0 || !page_set_add(passed_over, page)) {
            return fail(player, page, PAGE_EMPTY);
        }
        link_taken_t taken;
        page = follow(link, page, header, &taken);
    }
    return 0;
}

/* `next` becomes step 1 of a page. */
static void enter_page(player_t *player, uint8_t page, const uint8_t header[HEADER_BYTES])
{
    player->next = (player_step_t){.page = page,
                                   .step = 1,
                                   .steps = header[PAGE_AT_STEPS],
                                   .schedule = header[PAGE_AT_SCHEDULE],
                                   .page_speed = header[PAGE_AT_SPEED],
                                   .accel_time = header[PAGE_AT_ACCEL_TIME]};
    player->count_left = header[PAGE_AT_PLAY_COUNT];
    player->next_repetition = 1;
}

bool sequence_start(player_t *player, link_t *link, uint8_t named)
{
    uint8_t header[HEADER_BYTES];
    player->fault_page = 0;
    player->fault = PAGE_OK;
    const uint8_t page = resolve(player, link, named, header);
    if (page != 0) {
        enter_page(player, page, header);
    } else if (player->fault == PAGE_OK) {
        (void)fail(player, named, PAGE_EMPTY); /* pages with PLAY_COUNT 0 alone: nothing plays */
    }
    return page != 0;
}

/* `next` becomes what follows the last step of a page: the same page again, or the page that its link leads to. NOINLINE:
 * else the header's 31 bytes lie on the stack while the step is read, on the deepest path of the program. */
static NOINLINE uint8_t decide(player_t *player, link_t *link)
{
    player->count_left--;
    if (player->count_left != 0 && (link == NULL || !link_is_stopping(link))) {
        player->next.step = 1;
        player->next_repetition++;
        return 0;
    }
    uint8_t header[HEADER_BYTES];
    link_taken_t taken;
    player->source->read(player->source->context, player->now.page, 0, header, HEADER_BYTES);
    const uint8_t named = follow(link, player->now.page, header, &taken);
    player->link_page = named;
    player->link_taken = (uint8_t)taken;
    const uint8_t page = resolve(player, link, named, header);
    player->next.page = 0;
    if (page != 0) {
        enter_page(player, page, header);
    }
    return PLAYER_EV_LINK;
}

uint8_t sequence_advance(player_t *player, link_t *link)
{
    uint8_t events = PLAYER_EV_STEP;
    player->now = player->next;
    if (player->now.step == 1) {
        events |= PLAYER_EV_PAGE;
        player->repetition = player->next_repetition;
    }
    if (player->now.step < player->now.steps) {
        player->next.step++;
    } else {
        events |= decide(player, link);
    }
    return events;
}

void sequence_read_words(const page_source_t *source, const shape_t *shape, uint8_t page, uint8_t step,
                         uint16_t words[PAGE_JOINTS])
{
    source->read(source->context, page, (uint16_t)(PAGE_STEP_BYTES * step), words, 2u * PAGE_JOINTS);
    if (shape != NULL) {
        shape_step(shape, source, page, step, words);
    }
}

uint32_t sequence_read_positions(player_t *player, uint8_t page, uint8_t step)
{
    uint32_t used = 0, bit = 1;
    if (page != 0) {
        sequence_read_words(player->source, player->shape, page, step, player->next_pos);
    }
    for (uint8_t i = 0; i < PAGE_JOINTS; i++, bit <<= 1) {
        if (page != 0 && page_pos_is_used(player->next_pos[i])) {
            used |= bit;
        } else {
            player->next_pos[i] = player->joint[i].target_pos;
        }
    }
    return used & player->present;
}

void sequence_read_next(player_t *player)
{
    player_step_t *next = &player->next;
    const shape_t *shape = player->shape;
    const bool is_shaped = shape != NULL && !shape_is_neutral(shape);
    next->rate_percent = is_shaped ? shape->rate_percent : SHAPE_NORMAL;
    next->top_speed_q4_4 = shape != NULL && (is_shaped || player->now.is_shaped) ? shape->top_speed_q4_4 : 0;
    next->is_shaped = is_shaped;
    if (next->page != 0) {
        uint8_t pause_time[2];
        player->source->read(player->source->context, next->page,
                             (uint16_t)(PAGE_STEP_BYTES * next->step + PAGE_STEP_AT_PAUSE), pause_time, sizeof pause_time);
        next->pause = pause_time[0];
        next->time = pause_time[1];
    }
    next->joints = sequence_read_positions(player, next->page, next->step);
}
