/* SPDX-License-Identifier: MIT */
#include "link.h"

#include <string.h>

void link_init(link_t *link, link_mode_t mode)
{
    link->mode = (uint8_t)mode;
    link_call(link, LINK_CODE_NONE);
}

void link_call(link_t *link, uint8_t code)
{
    link->code = code;
    link->held_code = code; /* a stop may come before the next packet of the button that called */
    link->stopping = false;
    link->stop_is_final = false;
    link->ending = false;
}

static void stop(link_t *link)
{
    if (!link->stopping) {
        memset(link->exits_seen, 0, sizeof link->exits_seen);
    }
    link->stopping = true;
    link->code = LINK_CODE_STOP;
}

void link_code(link_t *link, uint8_t code)
{
    bool repeated = code == link->held_code;
    if (code == LINK_CODE_STOP) {
        stop(link); /* a stop does not release a button that is held, so held_code stays */
        return;
    }
    link->held_code = code;
    if (code == LINK_CODE_NONE) {
        if (link->mode == LINK_HOLD) {
            stop(link);
        }
        return;
    }
    if (link->stopping && (link->stop_is_final || repeated)) {
        return;
    }
    link->stopping = false;
    link->code = code;
}

void link_stop(link_t *link)
{
    stop(link);
    link->stop_is_final = true;
    link->ending = false;
}

void link_end(link_t *link)
{
    link->ending = true;
}

bool link_is_stopping(const link_t *link)
{
    return link->stopping || link->ending;
}

static uint8_t exit_of(link_t *link, uint8_t page, uint8_t exit_page, link_taken_t *taken)
{
    (void)page_set_add(link->exits_seen, page);
    *taken = LINK_EXIT;
    if (exit_page != 0 && !page_set_add(link->exits_seen, exit_page)) {
        *taken = LINK_END_OF_EXIT_LOOP;
        return 0;
    }
    return exit_page;
}

static bool code_matches(const link_t *link, uint8_t linked_code)
{
    return linked_code != LINK_CODE_NONE && linked_code == link->code;
}

uint8_t link_decide(link_t *link, uint8_t page, const uint8_t *header, link_taken_t *taken)
{
    if (link->ending) {
        *taken = LINK_ENDED;
        return 0;
    }
    if (link->stopping) {
        return exit_of(link, page, header[PAGE_AT_EXIT_PAGE], taken);
    }
    if (code_matches(link, header[PAGE_AT_LINKED1_CODE])) {
        *taken = LINK_LINKED1;
        return header[PAGE_AT_LINKED1_PAGE];
    }
    if (code_matches(link, header[PAGE_AT_LINKED2_CODE])) {
        *taken = LINK_LINKED2;
        return header[PAGE_AT_LINKED2_PAGE];
    }
    *taken = LINK_NEXT;
    return header[PAGE_AT_NEXT_PAGE];
}
