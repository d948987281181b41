/* SPDX-License-Identifier: MIT
 * player_state.h - what a player remembers. The functions are in player.h; README.md explains how one step becomes the next.
 * RAM: player_t, link_t and 31 joints are some 900 bytes; tools/dev/size_report counts those of an image. */
#ifndef PLAYER_STATE_H
#define PLAYER_STATE_H

#include <stdbool.h>
#include <stdint.h>
#include "page.h"
#include "shape.h"

typedef enum { PLAYER_LAW_EXACT = 0, PLAYER_LAW_CLASSIC } player_law_t;

/* What a tick did; bits. */
enum {
    PLAYER_EV_OUTPUT = 1 << 0,  /* there are new goals: send them (in the pause after a step there are none) */
    PLAYER_EV_STEP = 1 << 1,    /* this tick is the first of a step: player.now */
    PLAYER_EV_PAGE = 1 << 2,    /* and of a page: player.repetition */
    PLAYER_EV_LINK = 1 << 3,    /* and it is the last of the page's last repetition: player.link_taken, .link_page */
    PLAYER_EV_ENDED = 1 << 5,   /* the play is over; player.fault says whether a bad page ended it */
    PLAYER_EV_STOPPED = 1 << 6  /* a break or a pause has stopped all joints */
};

/* A step of a page. page 0: none. */
typedef struct {
    uint8_t page, step, steps;                /* step 1..steps */
    uint8_t schedule, page_speed, accel_time; /* from its page's header */
    uint8_t pause, time;                      /* bytes 62 and 63 of the step */
    uint8_t top_speed_q4_4;                   /* servo units a tick; 0: no limit (shape.h) */
    bool is_shaped;                           /* then the step after it is limited, too */
    uint16_t rate_percent;                    /* 100: as stored (shape.h) */
    uint16_t ticks, hold_ticks;               /* N and P: length of the step, and of the pause after it */
    uint32_t recip32;                         /* exact law: 2^32 / ticks */
    uint32_t joints;                          /* bit per joint that it uses */
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
    int16_t entry;              /* w: speed at the beginning of the section */
    int16_t reached;            /* g: speed after the last tick */
    int16_t distance;           /* M: from start to target of the step */
    int16_t rise_distance;      /* acc: covered in RISE so far */
    int16_t section_distance;   /* main: to cover in this section, CRUISE or FALL */
    bool through;               /* keeps its speed at the end of the step */
} player_classic_t;

typedef struct {
    uint16_t target_pos;        /* where `now` ends */
    union {                     /* player.moving_by says which */
        player_exact_t exact;
        player_classic_t classic;
    };
} player_joint_t;

typedef struct {
    /* Given by the caller. */
    const page_source_t *source;
    const shape_t *shape;           /* applies from the next step that the player reads; NULL: plays as stored. Any time */
    player_joint_t *joint;
    /* Read only for callers. */
    player_step_t now;              /* the step that plays */
    uint32_t present;               /* bit per joint: joints that the play moves */
    uint32_t joints;                /* of these, the joints that a step has used since the play began: send their goals */
    uint8_t repetition;             /* of the page: 1..PLAY_COUNT */
    uint8_t link_page, link_taken;  /* of the last PLAYER_EV_LINK: what that link names (a play may pass over it) */
    uint8_t fault_page, fault;      /* page that ends the play when `now` is over, and why: page_status_t; PAGE_OK: none */
    /* Private. */
    uint8_t law;                    /* player_law_t that was asked for */
    uint8_t moving_by;              /* player_law_t of the joints' fields: exact also while a classic play slows down, and
                                       for what is left of the step after a pause */
    uint8_t state, wish;            /* player.c has the diagram */
    bool is_planned;                /* player_plan has been called for the coming tick */
    uint8_t begun_events;           /* of `now`, until its first tick returns them */
    uint8_t ramp_ticks;             /* A: length of the ramps of `now` */
    uint8_t brake_ticks;            /* left until all joints have stopped */
    uint16_t tick;                  /* exact law: ticks done of `now` and its pause */
    uint8_t section;                /* classic law: RISE, CRUISE, FALL or HOLD */
    uint16_t section_tick, section_ticks; /* ticks done of it, and its length */
    uint16_t left_ticks;            /* of a step that was interrupted */
    uint16_t carry_q5_11;           /* fraction of a tick that the lengths so far have left over */
    player_step_t next;             /* the step after `now`; page 0: the play ends with `now` */
    uint16_t next_pos[PAGE_JOINTS]; /* where `next` ends */
    uint8_t next_repetition, count_left; /* of the page of `next`: which, and how many; 8 bits as in the original */
} player_t;

#endif
