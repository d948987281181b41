/* SPDX-License-Identifier: MIT
 * player.h - plays pages: each tick (1/128 s) turns pages and links into 31 goal positions.
 * Pure: knows neither bus nor flash; pages come through page_source_t a few bytes at a time, straight from where they
 * are kept. Caller-owned state, main loop only, one call per tick. Law of motion: player.md.
 * RAM: sizeof(player_t) + sizeof(link_t) <= 1024 bytes. */
#ifndef PLAYER_H
#define PLAYER_H

#include <stdbool.h>
#include <stdint.h>
#include "compiler.h"
#include "link.h"
#include "page.h"

#define PLAYER_TICKS_PER_SECOND 128u

typedef enum { PLAYER_LAW_EXACT = 0, PLAYER_LAW_CLASSIC } player_law_t;

/* Where pages come from. Both calls must be cheap (a tick makes up to about 40 of read). */
typedef struct {
    void *context;
    /* Copies `count` bytes at byte `offset` of page `page` (0..127). */
    void (*read)(void *context, uint8_t page, uint16_t offset, void *to, uint8_t count);
    /* page_status_t of the whole page, from a cache. */
    uint8_t (*check)(void *context, uint8_t page);
} page_source_t;

typedef enum {
    PLAYER_OK = 0,
    PLAYER_ERR_RANGE,        /* page 0 or above 127 */
    PLAYER_ERR_PAGE,         /* the page is damaged: page_status_t in player.fault */
    PLAYER_ERR_EMPTY,        /* the page has no steps, or PLAY_COUNT 0 and nothing playable along its link */
    PLAYER_ERR_BUSY          /* a play is on */
} player_status_t;

/* What a tick did; bits. */
enum {
    PLAYER_EV_OUTPUT = 1 << 0,  /* goal_pos was made anew: send it (in a pause nothing is made) */
    PLAYER_EV_STEP = 1 << 1,    /* a step began: player.page, .step (1..7) */
    PLAYER_EV_PAGE = 1 << 2,    /* and it is the first of a page: player.page, .repetition */
    PLAYER_EV_LINK = 1 << 3,    /* the link after this page was decided: player.link_taken, .next_page */
    PLAYER_EV_SLOPES = 1 << 4,  /* the page's compliance differs from the last one's: send slopes */
    PLAYER_EV_ENDED = 1 << 5,   /* the play is over; player.fault tells whether a bad page ended it */
    PLAYER_EV_STANDING = 1 << 6 /* a break or a pause has brought all joints to a stand */
};

typedef struct player {
    /* Public, read only for callers. */
    uint16_t goal_pos[PAGE_JOINTS]; /* the tick's output, 0..1023, page coordinates (no trim) */
    uint32_t joints;                /* bit per joint: driven by this play (present, and used by a step so far) */
    uint8_t page, step;             /* playing now; step 1..7 */
    uint8_t repetition;             /* 1.. PLAY_COUNT */
    uint8_t next_page, link_taken;  /* of the last PLAYER_EV_LINK */
    uint8_t fault_page, fault;      /* page_status_t of the page that ended the play, or PAGE_OK */
    uint8_t law;                    /* player_law_t */
    /* The planner's own state follows (whoever implements this appends it). */
    const page_source_t *source;
} player_t;

/* Binds the source and sets everything idle. */
void player_init(player_t *player, const page_source_t *source);

/* Begins at step 1 of `page` with the joints standing at pose_pos (page coordinates). The caller has told `link` of the
 * call (link_call). `present`: bit per joint that may be driven; others are never touched.
 * Any error: nothing changed, the player stays as it was. The first output comes with the next player_tick. */
MUST_CHECK player_status_t player_start(player_t *player, link_t *link, uint8_t page, player_law_t law,
                                        const uint16_t pose_pos[PAGE_JOINTS], uint32_t present);

/* One tick. Returns PLAYER_EV_ bits; 0 when idle. */
uint8_t player_tick(player_t *player, link_t *link);

/* Leaves the page at once: every joint slows down to a stand within ACCEL_TIME ticks (at least 8), no reversal. */
void player_break(player_t *player);

/* Decelerates and holds; resume goes on to the interrupted step's target in the time that was left. */
void player_pause(player_t *player);
void player_resume(player_t *player);

bool player_is_moving(const player_t *player);   /* a play is on, paused or breaking included */
bool player_is_paused(const player_t *player);

/* Takes joints out of a running play (torque lost, servo silent): they keep their last goal and are not in `joints`. */
void player_drop_joints(player_t *player, uint32_t joints);

#endif
