/* SPDX-License-Identifier: MIT
 * player.h - plays pages: each tick (1/128 s) turns pages and links into 31 goal positions.
 * Pure: knows neither bus nor flash; pages come through page_source_t a few bytes at a time, straight from where they
 * are kept. Caller-owned state, main loop only, one call per tick. Law of motion: player.md.
 * RAM: sizeof(player_t) + sizeof(link_t) <= 1024 bytes (tests/unit/test_player.c holds it to that on the ATmega128). */
#ifndef PLAYER_H
#define PLAYER_H

#include <stdbool.h>
#include <stdint.h>
#include "compiler.h"
#include "link.h"
#include "page.h"

#define PLAYER_TICKS_PER_SECOND 128u

typedef enum { PLAYER_LAW_EXACT = 0, PLAYER_LAW_CLASSIC } player_law_t;

/* Where pages come from. Both calls must be cheap: a tick makes up to six reads of up to 64 bytes. */
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
    PLAYER_ERR_PAGE,         /* the page is damaged: page_status_t in player.fault, the page in .fault_page */
    PLAYER_ERR_EMPTY,        /* the page has no steps, or PLAY_COUNT 0 and nothing playable along its link */
    PLAYER_ERR_BUSY,         /* a play is on */
    PLAYER_ERR_LAW           /* this image has no classic law (it links law_classic_none.c) */
} player_status_t;

/* What a tick did; bits. */
enum {
    PLAYER_EV_OUTPUT = 1 << 0,  /* goal_pos was made anew: send it (in a pause nothing is made) */
    PLAYER_EV_STEP = 1 << 1,    /* a step began: player.page, .step (1..7) */
    PLAYER_EV_PAGE = 1 << 2,    /* and it is the first of a page: player.page, .repetition */
    PLAYER_EV_LINK = 1 << 3,    /* the link after this page was decided: player.link_taken, .next_page */
    PLAYER_EV_BUSY = 1 << 4,    /* a step is about to begin, or began: leave to the next tick what can wait */
    PLAYER_EV_ENDED = 1 << 5,   /* the play is over; player.fault tells whether a bad page ended it */
    PLAYER_EV_STANDING = 1 << 6 /* a break or a pause has brought all joints to a stand */
};

/* A step of a page, as the plan needs it. page 0: none. */
typedef struct {
    uint8_t page, step, steps;                /* step 1..steps */
    uint8_t schedule, page_speed, accel_time; /* of its page */
    uint8_t pause, time;                      /* bytes 62 and 63 of the step */
} player_step_t;

/* One joint. Speeds are servo units per tick; see law_exact.c and law_classic.c for what stands in which section. */
typedef struct {
    uint16_t target_pos;      /* where the step playing now ends */
    uint16_t coming_pos;      /* where the coming one ends */
    union {
        uint32_t mean_q16_16; /* exact: size of the coming step's mean speed */
        struct {
            int16_t stop_speed, through_speed; /* classic: the coming step's speed, either way */
        };
    };
    union {
        struct {
            int32_t pos_q16_16, speed_q16_16, accel_q16_16;
            uint32_t cruise_q16_16, exit_q16_16; /* sizes */
        } exact;
        struct {
            int16_t base, speed, carried, acc, main, value, quotient;
            uint16_t remainder, error;
            bool through;
        } classic;
    };
} player_joint_t;

typedef struct player {
    /* Public, read only for callers. */
    uint32_t joints;                /* bit per joint: driven by this play: present, and used by a step that has begun (a
                                     * step begins with the last tick of the one before) */
    uint8_t page, step;             /* playing now; step 1..7 */
    uint8_t repetition;             /* 1.. PLAY_COUNT */
    uint8_t next_page, link_taken;  /* of the last PLAYER_EV_LINK */
    uint8_t fault_page, fault;      /* page that ended the play, and why: page_status_t or PAGE_EMPTY; PAGE_OK: none */
    uint8_t law;                    /* player_law_t */
    /* The planner's own. */
    const page_source_t *source;
    uint32_t present, coming_joints; /* joints that may be driven; those that the coming step uses */
    player_step_t now, coming;
    uint8_t look_page;               /* classic: the page that the link named, before pages without action are passed */
    uint8_t count_left;              /* repetitions, 8 bits as in the original */
    uint8_t coming_repetition;
    uint8_t state;
    uint8_t ramp_ticks, brake_ticks;
    bool breaking;
    uint8_t held_events;             /* not 0: `now` is already the next step, which will begin with these */
    bool primed;                     /* ... and it begins with the next tick */
    union {
        struct {
            uint8_t section, coming_ramp_ticks;
            uint8_t prepared, pace;  /* classic: how much of the coming step is ready; how fast more of it has to be */
        };
        struct {
            uint16_t next_ticks, next_hold_ticks; /* exact: of `now` before it begins */
        };
    };
    uint16_t tick, section_ticks;
    uint16_t step_ticks, hold_ticks, coming_ticks;
    union {
        struct {
            uint16_t carry_q5_11;    /* exact: the fraction of a tick that is left over */
            uint16_t share_q0_16;    /* exact: RISE / (all but FALL), of the step to begin; 0: not made yet */
        };
        uint32_t through_recip;      /* classic: one over the divisor of through_speed */
    };
    uint16_t ramp_recip;             /* exact: one over the ramp, from the look at the next step on over that one's */
    uint32_t coming_recip;           /* exact: one over the coming step's ticks; classic: as through_recip, stop_speed */
    /* Arrays last: the AVR reaches only the first 64 bytes of a structure in one instruction. */
    uint16_t goal_pos[PAGE_JOINTS]; /* public: the tick's output, 0..1023, page coordinates (no trim) */
    player_joint_t joint[PAGE_JOINTS];
} player_t;

/* Binds the source and sets everything idle. */
void player_init(player_t *player, const page_source_t *source);

/* Begins at step 1 of `page` with the joints standing at pose_pos (page coordinates). The caller has told `link` of the
 * call (link_call). `present`: bit per joint that may be driven; others are never touched.
 * player.page is at once the page that will really be played first (pages with PLAY_COUNT 0 are passed over).
 * Any error: nothing changed but .fault and .fault_page. The first output comes with the next player_tick. */
MUST_CHECK player_status_t player_start(player_t *player, link_t *link, uint8_t page, player_law_t law,
                                        const uint16_t pose_pos[PAGE_JOINTS], uint32_t present);

/* Where step 1 of `page` wants its joints: fills those places of pose_pos and returns their bits. For the approach. */
uint32_t player_first_pose(const page_source_t *source, uint8_t page, uint16_t pose_pos[PAGE_JOINTS]);

/* One tick. Returns PLAYER_EV_ bits; 0 when idle. */
uint8_t player_tick(player_t *player, link_t *link) NOINLINE; /* by itself, so that the bench can measure it */

/* Leaves the page at once: every joint slows down to a stand within ACCEL_TIME ticks (at least 8), no reversal. */
void player_break(player_t *player);

/* Decelerates and holds; resume goes on to the interrupted step's target in the time that was left (but never faster
 * than a ramp of the length it took to slow down). */
void player_pause(player_t *player);
void player_resume(player_t *player);

bool player_is_moving(const player_t *player);   /* a play is on, paused or breaking included */
bool player_is_paused(const player_t *player);   /* told to pause: slowing down or standing */

/* Takes joints out of a running play (torque lost, servo silent): they keep their last goal and are not in `joints`. */
void player_drop_joints(player_t *player, uint32_t joints);

#endif
