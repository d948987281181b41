/* SPDX-License-Identifier: MIT
 * player.h - plays pages: each tick (1/128 s) turns pages and links into goal positions.
 * Pure: knows neither bus nor flash; reads pages through page_source_t. Main loop only. Caller-owned state: a player_t and
 * the array of its joints. The laws of motion are in LAWS.md; README.md explains how one step becomes the next.
 * RAM: player_t, link_t and 31 joints are at most 900 bytes (tests/unit/target/player_cycles.c checks it). */
#ifndef PLAYER_H
#define PLAYER_H

#include <stdbool.h>
#include <stdint.h>
#include "compiler.h"
#include "link.h"
#include "page.h"
#include "page_source.h"
#include "shape.h"

#define PLAYER_TICKS_PER_SECOND 128u

typedef enum { PLAYER_LAW_EXACT = 0, PLAYER_LAW_CLASSIC } player_law_t;

typedef enum {
    PLAYER_OK = 0,
    PLAYER_ERR_RANGE,        /* page 0 or above 127 */
    PLAYER_ERR_PAGE,         /* the page is damaged: page_status_t in player.fault, the page in .fault_page */
    PLAYER_ERR_EMPTY,        /* the page has no steps, or PLAY_COUNT 0 and nothing playable along its link */
    PLAYER_ERR_BUSY,         /* a play is on */
    PLAYER_ERR_LAW           /* this program has no classic law (it links law_classic_none.c) */
} player_status_t;

/* What a tick did; bits. */
enum {
    PLAYER_EV_OUTPUT = 1 << 0,  /* there are new goals: send them (in the pause after a step there are none) */
    PLAYER_EV_STEP = 1 << 1,    /* this tick is the first of a step: player.now */
    PLAYER_EV_PAGE = 1 << 2,    /* and of a page: player.repetition */
    PLAYER_EV_LINK = 1 << 3,    /* and the step is the page's last: its link is decided, player.link_taken, .next_page */
    PLAYER_EV_ENDED = 1 << 5,   /* the play is over; player.fault says whether a bad page ended it */
    PLAYER_EV_STANDING = 1 << 6 /* a break or a pause has stopped all joints */
};

/* A step of a page. page 0: none. */
typedef struct {
    uint8_t page, step, steps;                /* step 1..steps */
    uint8_t schedule, page_speed, accel_time; /* from its page's header */
    uint8_t pause, time;                      /* bytes 62 and 63 of the step */
    uint8_t top_speed_q4_4;                   /* servo units a tick; 0: no limit (shape.h) */
    uint16_t rate_percent;                    /* 100: as stored (shape.h) */
    uint16_t ticks, hold_ticks;               /* exact law: length of the step and of the pause after it */
    uint32_t recip32;                         /* exact law: 2^32 / ticks */
} player_step_t;

/* A joint that moves by the exact law. Speeds are in servo units a tick, with a sign. */
typedef struct {
    int32_t pos_q16_16;         /* includes the rounding: see law_exact.c */
    int32_t speed_q16_16;       /* what the next tick adds to pos */
    int32_t accel_q16_16;       /* what each tick adds to speed */
    int32_t cruise_q16_16;      /* speed between the ramps */
    int32_t exit_q16_16;        /* speed at the end of the step */
} player_exact_t;

/* A joint that moves by the classic law; the symbols are those of LAWS.md. Speeds are in the law's unit. */
typedef struct {
    int16_t start_pos;          /* where the section began */
    int16_t out_pos;            /* last goal */
    int16_t speed;              /* v: speed of the step */
    int16_t carried;            /* w: speed at the beginning of the section */
    int16_t reached;            /* g: speed after the last tick */
    int16_t distance;           /* M: from start to target of the step */
    int16_t acc;                /* covered in RISE */
    int16_t main;               /* to cover in CRUISE, then in FALL */
    bool through;               /* keeps its speed at the end of the step */
} player_classic_t;

typedef struct {
    uint16_t target_pos;        /* where the running step ends */
    union {                     /* player.moving_by says which */
        player_exact_t exact;
        player_classic_t classic;
    };
} player_joint_t;

typedef struct {
    /* Read only for callers. */
    player_step_t now;              /* the step that plays */
    uint32_t present;               /* bit per joint: joints that the play moves */
    uint32_t joints;                /* of these, the joints that a step has used since the play began: send their goals */
    uint8_t repetition;             /* of the page: 1..PLAY_COUNT */
    uint8_t next_page, link_taken;  /* of the last PLAYER_EV_LINK */
    uint8_t fault_page, fault;      /* page that ends the play, and why: page_status_t or PAGE_EMPTY; PAGE_OK: none */
    /* Private. */
    uint8_t law;                    /* player_law_t that was asked for */
    uint8_t moving_by;              /* player_law_t of the joints' fields: exact also while a classic play slows down, and
                                       for the rest of a step after a pause */
    uint8_t state;                  /* player.c has the diagram */
    uint8_t wish;                   /* go on, pause or break */
    bool is_planned;                /* the coming tick, by player_plan */
    uint8_t begun_events;           /* of the running step, until its first tick returns them */
    uint8_t section;                /* classic law: RISE, CRUISE, FALL or HOLD */
    uint8_t ramp_ticks;             /* A: length of RISE and of FALL */
    uint8_t brake_ticks;            /* left until all joints have stopped */
    uint16_t tick;                  /* ticks done: of the step with its pause (exact), of the section (classic) */
    uint16_t section_ticks;         /* classic law: length of the section */
    uint16_t step_ticks, hold_ticks; /* N and P: length of the running step, of the pause after it */
    uint16_t rest_ticks;            /* left of a step that was interrupted */
    uint16_t carry_q5_11;           /* fraction of a tick that the lengths so far have left over */
    player_step_t next;             /* the step after `now`; page 0: the play ends with `now` */
    uint8_t named_page;             /* page that the link names; the play may pass over it, or end there */
    uint8_t count_left;             /* repetitions of the page, 8 bits as in the original */
    uint8_t next_repetition;
    uint32_t next_joints;           /* joints that `next` uses */
    uint16_t next_pos[PAGE_JOINTS]; /* where `next` ends */
    const page_source_t *source;
    const shape_t *shape;           /* NULL: plays as stored */
    player_joint_t *joint;
} player_t;

/* Makes an idle player. The source and the array of PAGE_JOINTS joints stay the caller's. */
void player_init(player_t *player, const page_source_t *source, player_joint_t joint[PAGE_JOINTS]);

/* Sets the shape, which applies from the next step that the player looks at; NULL: play as stored. Any time. */
void player_set_shape(player_t *player, const shape_t *shape);

/* Starts at step 1 of `page`.
 * link     : what codes and stops do to the play, after link_call; NULL: a play without codes, which follows the next links
 * pose_pos : where the joints are (page coordinates; values above 1023 are taken as 1023)
 * present  : bit per joint that the play may move
 * Pages with PLAY_COUNT 0 are passed over: player.next.page is the page that plays first. The next player_tick makes the
 * first goals. After an error only .fault and .fault_page have changed. */
MUST_CHECK player_status_t player_start(player_t *player, link_t *link, uint8_t page, player_law_t law,
                                        const uint16_t pose_pos[PAGE_JOINTS], uint32_t present);

/* For player_move to the first pose of a page: fills pose_pos with the positions of step 1 of `page`, shaped, and returns
 * the bits of the joints that have one. */
uint32_t player_first_pose(const page_source_t *source, const shape_t *shape, uint8_t page, uint16_t pose_pos[PAGE_JOINTS]);

/* Moves `joints` from from_pos to player->next_pos, which the caller has set, without a page: an exact step with ramps,
 * whose length lets the longest distance keep to deg_s degrees/s (1..360), rounded up. All joints arrive together.
 * Everything else is as in a play, with NULL for the link. Returns the ticks; 0: all are within PLAYER_NEAR_POS already,
 * and nothing plays. */
#define PLAYER_NEAR_POS 3u
uint16_t player_move(player_t *player, const uint16_t from_pos[PAGE_JOINTS], uint32_t joints, uint16_t deg_s);

/* One tick: moves all joints. link: that of player_start. Returns PLAYER_EV_ bits; 0 when idle. */
uint8_t player_tick(player_t *player, link_t *link) NOINLINE; /* so that tools/bench can measure it */

/* Plans what the coming tick needs, if anything: after the last tick of a step it begins the next one (decides the link,
 * looks at the step after it, plans all joints); it begins a section of the step, a break or a pause, or goes on after one.
 * player_tick calls it first. A caller that calls it as soon as the goals of a tick are on their way, and after a break,
 * pause or resume, gets the goals of every tick equally early. */
void player_plan(player_t *player, link_t *link) NOINLINE;

/* Where the play wants a joint of `present`, 0..1023. */
uint16_t player_goal(const player_t *player, uint8_t joint);

/* Copies the goals of those joints; leaves the others. */
void player_goals(const player_t *player, uint32_t joints, uint16_t goal_pos[PAGE_JOINTS]);

/* Leaves the page at once: every joint slows down within ACCEL_TIME ticks (at least 8), without turning round; in a move
 * within its own ramp, so that one that is about to arrive arrives. */
void player_break(player_t *player);

/* Pause slows down like a break, and then waits. Resume goes on to the target of the interrupted step in the time that was
 * left, but in no less time than slowing down took; during the slowing down it takes effect at its end. */
void player_pause(player_t *player);
void player_resume(player_t *player);

bool player_is_moving(const player_t *player);   /* a play is on, also one that pauses or breaks */
bool player_is_paused(const player_t *player);   /* after player_pause, until player_resume */

/* Takes joints out of a play (torque lost, servo silent): player_goals leaves theirs as they are from now on. */
void player_drop_joints(player_t *player, uint32_t joints);

#endif
