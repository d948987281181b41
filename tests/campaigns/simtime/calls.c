/* SPDX-License-Identifier: MIT
 * calls.c - the page that a play begins with, by firmware/common/REMOTE.md: the named page, or, after a press, the
 * lowest valid page with the code and an action (PAGE_FORMAT.md). No play begins without such a call. */
#include "session.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define ANSWER (8u * SECOND)       /* a search for servos, with lines that wait for its end */
#define LINE_BEHIND 32u            /* ticks: a play may be over, or a line answered, before the report */
enum { STEPS_AT = 20, CODE_AT = 21, COUNT_AT = 15, SCHEDULE_AT = 16, SPEED_AT = 22, NEXT_AT = 25 };

static struct {
    int asked;                     /* by the newest line, until it is answered */
    int named;                     /* the next play begins with it; UNKNOWN: no page was named */
    uint32_t named_tick;
    uint32_t called_tick[PAGES];   /* when a code called the page first since the last play */
    uint32_t again_tick[PAGES];    /* the last time: the first may have been refused */
    bool is_open;                  /* a line may have called any page */
    bool is_begun, is_quiet;
    uint32_t over_tick;            /* the last report that a play is over */
    uint32_t going_tick;           /* when the starting play was reported; NEVER_TICK: not reported */
    uint32_t open_tick;            /* when the newest line was typed, until its OK */
} calls;

/* Checks a page by PAGE_FORMAT.md. */
bool page_is_good(unsigned page)
{
    const uint8_t *at = page_at(page);
    if (sum_of(at) != 0xFF || at[STEPS_AT] > 7 || (at[SCHEDULE_AT] != 0 && at[SCHEDULE_AT] != 10) || at[SPEED_AT] == 0) {
        return false;
    }
    for (unsigned step = 1; step <= at[STEPS_AT]; step++) {
        for (unsigned id = 0; id < JOINTS; id++) {
            const unsigned word = at[STEP_BYTES * step + 2 * id] | (unsigned)at[STEP_BYTES * step + 2 * id + 1] << 8;
            if (word > 1023 && (word & 0x6000u) == 0) {
                return false;
            }
        }
    }
    return true;
}

/* Returns the page that plays. Pages without repetitions are passed over. */
static int begun_with(unsigned page)
{
    for (unsigned i = 0; i < PAGES && page != 0 && page_at(page)[COUNT_AT] == 0; i++) {
        page = page_at(page)[NEXT_AT];
    }
    return (int)page;
}

static int page_by_name(const char *name)
{
    int found = UNKNOWN;
    for (unsigned page = 1; page < PAGES; page++) {
        char of[NAME_BYTES + 1] = "";
        memcpy(of, page_at(page), NAME_BYTES);
        if (page_is_good(page) && strcmp(of, name) == 0) {
            if (found != UNKNOWN) {
                return UNKNOWN;
            }
            found = (int)page;
        }
    }
    return found;
}

/* Returns the page that a code calls; 0: none. */
static unsigned page_of_code(unsigned code)
{
    for (unsigned page = 1; page < PAGES; page++) {
        const uint8_t *at = page_at(page);
        if (at[CODE_AT] == code && at[STEPS_AT] != 0 && at[COUNT_AT] != 0 && page_is_good(page)) {
            return page;
        }
    }
    return 0;
}

/* Returns whether a page was called after the last play was over and before this one was reported. */
static bool is_called_at(uint32_t tick)
{
    return tick != NEVER_TICK && tick + LINE_BEHIND >= calls.over_tick &&
           (calls.going_tick == NEVER_TICK || tick <= calls.going_tick);
}

static bool is_called(unsigned page)
{
    return is_called_at(calls.called_tick[page]) || is_called_at(calls.again_tick[page]);
}

/* Handles a code: a press at the remote or the panel, or typed. */
void calls_pressed(unsigned code)
{
    const unsigned page = page_of_code(code);
    if (!is_called_at(calls.called_tick[page])) {
        calls.called_tick[page] = session.tick;
    }
    calls.again_tick[page] = session.tick;
}

/* A line may wait for its answer: the program searches for servos, or asks a port that has answered late (hal/host). */
static bool is_slow(void)
{
    return rules_is_searching() || session.late_tick > session.boot_tick;
}

/* Handles a line that may begin a play. */
static void call_typed(const char *line)
{
    char name[32], more;
    unsigned page, code;
    if (sscanf(line, "play %u%c", &page, &more) == 1 || sscanf(line, "p %u%c", &page, &more) == 1 ||
        sscanf(line, "play %u %u%c", &page, &code, &more) == 2) {
        calls.asked = page > 0 && page < PAGES ? begun_with(page) : UNKNOWN;
    } else if (sscanf(line, "code %u%c", &code, &more) == 1 && code < PAGES) {
        calls_pressed(code);
    } else if (sscanf(line, "play %31[a-z ]%c", name, &more) == 1) {
        calls.asked = page_by_name(name);
        calls.is_open = calls.is_open || calls.asked == UNKNOWN;
    } else {
        calls.is_open = true;
    }
}

void calls_typed(const char *line)
{
    const bool is_request = *line == '@';   /* a request has another answer */
    line += is_request ? 1 : 0;
    const bool is_call = strncmp(line, "play", 4) == 0 || strncmp(line, "p ", 2) == 0 || strncmp(line, "code", 4) == 0;
    /* It is then unclear whose OK comes next. */
    const bool is_mixed = (is_call || calls.asked != UNKNOWN) &&
                          (is_slow() || !long_ago(calls.open_tick, ANSWER));
    calls.is_open = calls.is_open || !session.typed_is_known || (is_call && is_request) || is_mixed;
    calls.is_quiet = calls.is_quiet || strncmp(line, "settings talk", 13) == 0;
    calls.open_tick = session.tick;
    calls.asked = UNKNOWN;
    if (is_call && session.typed_is_known) {
        call_typed(line);
    }
    presses_typed();
}

bool calls_are_said(void)
{
    return !calls.is_quiet;
}

static void play_begins(unsigned page)
{
    const bool is_named = calls.named != UNKNOWN && (int)page == calls.named;
    /* Without status lines a play may be followed by the next page unseen. */
    if (!is_named && !is_called(page) && !calls.is_open && !calls.is_quiet) {
        session_fail("a play begins with the page that is called", "page %u, named was %d", page, calls.named);
    }
    reached(is_named ? "play of the page that was named" : "play of the page with the code");
    calls.named = UNKNOWN;
    calls.called_tick[page] = calls.again_tick[page] = NEVER_TICK;
    calls.is_begun = true;
}

static void play_ends(void)
{
    if (calls.named != UNKNOWN && session.tick - calls.named_tick > LINE_BEHIND) {
        calls.named = UNKNOWN;
    }
    calls.is_open = calls.is_open && is_slow();
    calls.is_begun = false;
    calls.over_tick = session.tick;
    calls.going_tick = NEVER_TICK;
}

void calls_printed(const char *line)
{
    static const char *const over[] = {"Ended", "Stopped", "Broken", "The pose", NULL};
    unsigned number;
    if (begins_with_one_of(line, over)) {
        play_ends();
    }
    if (strcmp(line, " OK") == 0) {
        calls.named_tick = calls.asked != UNKNOWN ? session.tick : calls.named_tick;
        calls.named = calls.asked != UNKNOWN ? calls.asked : calls.named;
        calls.asked = UNKNOWN;
        calls.open_tick = NEVER_TICK;
    } else if (strncmp(line, "Going to", 8) == 0) {
        calls.going_tick = session.tick;
    } else if (strncmp(line, "Moving, ", 8) == 0) {
        calls.is_begun = true;
    } else if (strstr(line, "dropped") != NULL) {
        calls.is_open = true;
    } else if (sscanf(line, "Playing page %u", &number) == 1 && number < PAGES && !calls.is_begun) {
        play_begins(number);
    } else if (sscanf(line, "No page has code %u", &number) == 1) {
        if (number < PAGES && page_of_code(number) != 0) {
            session_fail("a play begins with the page that is called", "\"%s\", and page %u has it", line,
                         page_of_code(number));
        }
    }
}

void calls_boot(void)
{
    const bool is_quiet = calls.is_quiet;   /* stored in EEPROM */
    memset(&calls, 0, sizeof calls);
    calls.is_quiet = is_quiet;
    calls.asked = calls.named = UNKNOWN;
}
