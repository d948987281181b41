/* SPDX-License-Identifier: MIT
 * link.h - which page follows: codes, calls, the four links, stop, chains of exit pages.
 * Pure: knows codes and page numbers, not their sources. One link_t per player, main loop only.
 * What a code does is described in firmware/common/REMOTE.md. */
#ifndef LINK_H
#define LINK_H

#include <stdbool.h>
#include <stdint.h>
#include "compiler.h"
#include "page.h"

#define LINK_CODE_NONE 0u
#define LINK_CODE_STOP 255u

/* LINK_DRIVE is as LINK_LATCH here: the source of the codes leaves out the buttons that steer. */
typedef enum { LINK_LATCH = 0, LINK_HOLD, LINK_DRIVE } link_mode_t;

/* Which link was taken (for the status line). */
typedef enum { LINK_NEXT = 0, LINK_EXIT, LINK_LINKED1, LINK_LINKED2, LINK_END_OF_EXIT_LOOP, LINK_ENDED } link_taken_t;

typedef struct {
    uint8_t mode;       /* link_mode_t */
    uint8_t code;       /* the code in force */
    uint8_t held_code;  /* the last code heard, except stops; 0: released */
    bool stopping;      /* a stop is in force: exit links are followed */
    bool stop_is_final; /* only a new call ends the stop (link_stop) */
    bool ending;        /* no link at all is followed (link_end) */
    uint8_t exits_seen[PAGE_COUNT / 8]; /* exit pages played since the stop: a chain that comes back ends */
} link_t;

void link_init(link_t *link, link_mode_t mode);

/* A play begins: by a code, or by a page number (code 0). Forgets any stop. */
void link_call(link_t *link, uint8_t code);

/* A code arrives: 0 = released, 255 = stop, else the code. In latch mode 0 changes nothing; in hold mode it is a stop.
 * Like any code, a stop stays in force until another one comes. A code that was held before the stop and is merely
 * heard again (a remote repeats its packets) is not another one: a thumb on `forward` cannot undo somebody's stop. */
void link_code(link_t *link, uint8_t code);

/* A soft stop, in both modes. It stays in force until a new call. Of link_stop and link_end the last one takes effect. */
void link_stop(link_t *link);

/* The play ends with the present repetition, without the exit page: every link is 0. Stays in force until a new call. */
void link_end(link_t *link);

/* true when the page must not be repeated: a stop or link_end is in force. */
bool link_is_stopping(const link_t *link);

/* The page that follows `page`, whose first 32 header bytes are `header`. The player asks when the last step of the last
 * repetition begins. 0 = the play ends. `taken` tells which link it was. */
uint8_t link_decide(link_t *link, uint8_t page, const uint8_t *header, link_taken_t *taken);

#endif
