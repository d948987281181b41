/* SPDX-License-Identifier: MIT
 * calls.c - which page a play begins with, from firmware/common/REMOTE.md: the one that was named, or the lowest with the
 * code. */
#include "session.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define CODES_END 256u
#define ANSWER (8u * SECOND)       /* a search for servos, and lines that wait behind it */
#define CODE_STOP 255u
enum { STEPS_AT = 20, CODE_AT = 21, COUNT_AT = 15, SCHEDULE_AT = 16, SPEED_AT = 22, NEXT_AT = 25 };

static struct {
    int asked;                     /* by the newest line, until it is answered */
    int named;                     /* the play that comes begins with it; UNKNOWN: nobody knows */
    bool is_possible[PAGES];       /* pages that a code may have called since the last play */
    bool has_codes, is_begun;
    uint32_t open_tick;            /* the newest line was typed, and no OK has come since */
} calls;

/* PAGE_FORMAT.md, the checks. */
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

/* Pages without repetitions are passed over. */
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

static void forget(void)
{
    memset(calls.is_possible, 0, sizeof calls.is_possible);
    calls.named = calls.asked = UNKNOWN;
    calls.has_codes = false;
}

void calls_typed(const char *line)
{
    char name[32], more;
    unsigned page, code;
    line += *line == '@' ? 1 : 0;
    if (!long_ago(calls.open_tick, ANSWER) || strncmp(line, "settings talk", 13) == 0) {
        forget();   /* one line was typed before the other was answered; or plays begin unsaid */
        calls.is_begun = true;
    }
    calls.open_tick = session.tick;
    if (!session.typed_is_known || strncmp(line, "code", 4) == 0) {
        forget();
        calls.is_begun = true;
    } else if (sscanf(line, "play %u%c", &page, &more) == 1 || sscanf(line, "p %u%c", &page, &more) == 1 ||
               sscanf(line, "play %u %u%c", &page, &code, &more) == 2) {
        calls.asked = page > 0 && page < PAGES ? begun_with(page) : UNKNOWN;
    } else if (sscanf(line, "play %31[a-z ]%c", name, &more) == 1) {
        calls.asked = page_by_name(name);
    } else {
        calls.asked = UNKNOWN;
    }
}

void calls_code(unsigned buttons)
{
    const unsigned code = buttons;
    if (calls.is_begun || code == 0) {
        return;
    }
    calls.has_codes = true;
    if (code >= CODES_END || code == CODE_STOP) {
        return;
    }
    for (unsigned page = 1; page < PAGES; page++) {
        if (page_is_good(page) && page_at(page)[CODE_AT] == code) {
            calls.is_possible[(unsigned)begun_with(page) % PAGES] = true;
            return;
        }
    }
}

void calls_printed(const char *line)
{
    unsigned page;
    if (strcmp(line, " OK") == 0) {
        calls.named = calls.asked != UNKNOWN ? calls.asked : calls.named;
        calls.asked = UNKNOWN;
        calls.open_tick = NEVER_TICK;
    } else if (strncmp(line, "Moving, ", 8) == 0) {
        forget();
        calls.is_begun = true;
    } else if (sscanf(line, "Playing page %u", &page) == 1 && !calls.is_begun) {
        const bool is_named = calls.named != UNKNOWN && (int)page == calls.named;
        if ((calls.named != UNKNOWN || calls.has_codes) && !is_named && !calls.is_possible[page % PAGES]) {
            session_fail("a play begins with the page that is called", "page %u, called was %d", page, calls.named);
        }
        reached(is_named ? "play of the page that was named" : "play of the page with the code");
        forget();
        calls.is_begun = true;
    } else if (strncmp(line, "Ended", 5) == 0 || strncmp(line, "Stopped", 7) == 0 || strncmp(line, "Broken", 6) == 0 ||
               strncmp(line, "The pose", 8) == 0) {
        forget();
        calls.is_begun = false;
    }
}

void calls_boot(void)
{
    forget();
    calls.is_begun = false;
    calls.open_tick = NEVER_TICK;
}
