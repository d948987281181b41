/* SPDX-License-Identifier: MIT
 * sequence.c - finds the page and step that come next: repetitions, links, pages without action. */
#include "sequence_parts.h"

#define HEADER_BYTES 31u /* up to the checksum */

/* --- which page --------------------------------------------------------------------------------------------------- */

/* Reads the header from byte `from` on into its place; does not read the name. */
static void read_header(const page_source_t *source, uint8_t page, uint8_t header[HEADER_BYTES], uint8_t from)
{
    source->read(source->context, page, from, &header[from], (uint8_t)(HEADER_BYTES - from));
}

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
    sequence_read(player);
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
