/* SPDX-License-Identifier: MIT
 * player.h - plays pages: each tick (1/128 s) turns pages and links into goal positions.
 * Pure: knows neither bus nor flash; reads pages through page_source_t, a few bytes at a time. Caller-owned state, main
 * loop only, one call per tick. Law of motion: player.md.
 *
 * A play is a player_t. What belongs to a joint is in player_joint_t and goal_pos, which two plays may share: each moves the
 * joints whose `owner` it is (layers.h).
 * RAM: player_t, link_t and 31 joints are at most 1024 bytes (tests/target/player_cycles.c holds them to that). */
#ifndef PLAYER_H
#define PLAYER_H

#include <stdbool.h>
#include <stdint.h>
#include "compiler.h"
#include "link.h"
#include "page.h"
#include "page_source.h"
#include "shape.h"
#include "shape_step.h"

#define PLAYER_TICKS_PER_SECOND 128u

typedef enum { PLAYER_LAW_EXACT = 0, PLAYER_LAW_CLASSIC } player_law_t;

typedef enum {
    PLAYER_OK = 0,
    PLAYER_ERR_RANGE,        /* page 0 or above 127 */
    PLAYER_ERR_PAGE,         /* the page is damaged: page_status_t in player.fault, the page in .fault_page */
    PLAYER_ERR_EMPTY,        /* the page has no steps, or PLAY_COUNT 0 and nothing playable along its link */
    PLAYER_ERR_BUSY,         /* a play is on */
    PLAYER_ERR_LAW           /* this program has no classic law (PLAYER_CLASSIC 0) */
} player_status_t;

/* What a tick did; bits. */
enum {
    PLAYER_EV_OUTPUT = 1 << 0,  /* goal_pos was made anew: send it (in a pause nothing is made) */
    PLAYER_EV_STEP = 1 << 1,    /* a step began: player.page, .step (1..7) */
    PLAYER_EV_PAGE = 1 << 2,    /* and it is the first of a page: player.page, .repetition */
    PLAYER_EV_LINK = 1 << 3,    /* the link after this page was decided: player.link_taken, .next_page */
    PLAYER_EV_ENDED = 1 << 5,   /* the play is over; player.fault tells whether a bad page ended it */
    PLAYER_EV_STANDING = 1 << 6 /* a break or a pause has brought all joints to a stand */
};

/* A step of a page, as the plan needs it. page 0: none. */
typedef struct {
    uint8_t page, step, steps;                /* step 1..steps */
    uint8_t schedule, page_speed, accel_time; /* of its page */
    uint8_t pause, time;                      /* bytes 62 and 63 of the step */
    uint16_t rate_percent;                    /* 100: as stored (shape.h) */
    uint8_t top_speed_q4_4;                   /* servo units a tick; 0: no limit (shape.h) */
    uint16_t ticks, hold_ticks;               /* its length and its pause, once they are measured (law.h) */
    uint32_t recip;                           /* exact: 2^32 over the ticks */
    uint16_t ramp_recip, ramp_share_q0_16;    /* exact: 1 / A; A / (N - A) */
} player_step_t;

/* A joint under the exact law, and under either law while it slows down and while the rest of an interrupted step is
 * played. Speeds are servo units per tick. */
typedef struct {
    int32_t pos_q16_16;         /* with its rounding: see exact_plan.c */
    int32_t speed_q16_16;       /* the way of the coming tick */
    int32_t accel_q16_16;
    uint32_t cruise_q16_16;     /* size of the speed between the ramps */
    uint32_t exit_q16_16;       /* size of the speed at the step's end */
} player_exact_t;

/* A joint under the classic law. Speeds in its units: 0.01875 servo units per tick. Names as in player.md. */
typedef struct {
    int16_t start_pos;          /* output when the section began */
    int16_t out_pos;            /* last output */
    int16_t speed;              /* v */
    int16_t carried;            /* w at the beginning of this step; of the next one, once it is aimed */
    int16_t acc;                /* way made in RISE */
    int16_t main;               /* way of CRUISE */
    int16_t to_go;              /* M, less the ways of the sections before this one */
    bool through;
    bool next_through;          /* through, M and v of the next step, once it is aimed and planned */
    int16_t next_to_go;
    int16_t next_speed;
} player_classic_t;

/* Who moves a joint. NONE: it is not there. */
enum { PLAYER_OWNER_MAIN, PLAYER_OWNER_LAYER, PLAYER_OWNER_CODE, PLAYER_OWNER_NONE };

/* What a program may leave out: 0 for the classic law (law_classic.c is not linked) and for layers (every joint is the main
 * play's). */
#ifndef PLAYER_CLASSIC
#define PLAYER_CLASSIC 1
#endif
#ifndef PLAYER_LAYERS
#define PLAYER_LAYERS 1
#endif

typedef struct {
    uint16_t target_pos;        /* where the running step ends */
    uint8_t owner;              /* PLAYER_OWNER_ */
    uint8_t hand_over : 3;      /* layers_hand.c's; 0: nothing is under way */
    bool down : 1;              /* exact: the step leads to a smaller position */
    union {
        player_exact_t exact;
        player_classic_t classic;
    };
} player_joint_t;

/* Small and often used fields come first: the AVR reaches the first 64 bytes with one instruction. */
typedef struct player {
    /* The planner's own. */
    player_joint_t *joint;
    uint8_t state;
    uint8_t self : 2;               /* PLAYER_OWNER_MAIN or _LAYER */
    bool looked : 1;                /* the step behind the coming one has been looked at (law.h) */
    bool measured : 1;              /* and the lengths that depend on it are known */
    bool runs_on : 1;               /* exact: a joint may keep its speed at the step's end */
    uint8_t shares_left : 3;        /* of the step that was looked at: pieces still to be read and shaped */
    bool ahead : 1;                 /* exact: joints may be planned for `now` before it is taken */
    bool aimed : 1;                 /* classic: the joints are aimed for `now` before it is taken */
    bool arrived : 1;               /* the joints are at the end of a step; `now` is planned and begins with the next tick */
    bool breaking : 1;
    bool resuming : 1;              /* while BRAKING: goes on as soon as it stands */
    uint8_t section;                /* classic */
    uint16_t tick, section_ticks;   /* tick: of the section (classic), of the step with its pause (exact) */
    uint16_t step_ticks, hold_ticks;
    uint8_t ramp_ticks, brake_ticks;
    uint8_t accel_time;             /* of the step's page, for the rest of an interrupted step */
    uint16_t ramp_recip, ramp_share_q0_16; /* exact: 1 / A; A / (N - A) */
    uint8_t left;                   /* ticks that the step still has behind this one; 255: that or more */
    uint8_t work;                   /* between steps, done in this tick by both plays: LAW_WORK_ units (law.h) */
    uint8_t own_joints;             /* how many it moved when the step was taken */
    uint8_t planned;                /* joints below this are planned for `now` */
    uint8_t announced_events;       /* PLAYER_EV_ bits of the beginning of `now` */
    uint16_t carry_q5_11;           /* the fraction of a tick that is left over */
    uint16_t coming_way, lent_way;  /* longest way in the coming step: of any joint; of one that is lent */
    uint32_t recip;                 /* exact: 2^32 over the ticks of the step */
    const page_source_t *source;
    const shape_t *shape;           /* NULL: as stored */
    shape_step_t *shaping;          /* the step that was looked at, while shares_left is not 0 */
    /* Public, read only for callers. */
    uint16_t *goal_pos;             /* the tick's output: 31 goals 0..1023, page coordinates (no trim) */
    uint8_t law;                    /* player_law_t */
    uint8_t page, step;             /* playing now; step 1..7 */
    uint8_t repetition;             /* 1.. PLAY_COUNT */
    uint8_t next_page, link_taken;  /* of the last PLAYER_EV_LINK */
    uint8_t fault_page, fault;      /* page that ended the play, and why: page_status_t or PAGE_EMPTY; PAGE_OK: none */
    uint32_t joints;                /* bit per joint: driven by this play: present, and used by a step that has begun (a
                                     * step begins with the last tick of the one before) */
    uint32_t present;               /* joints that may be driven, those lent to others included */
    uint32_t lent;                  /* joints that player_start gives to no play: set it between init and start (layers.h) */
    /* The planner's own. */
    player_step_t now, coming;      /* the step that plays, or begins next; the one behind it */
    uint8_t look_page;              /* classic: the page that the link named, before pages without action are passed over */
    uint8_t count_left;             /* repetitions, 8 bits as in the original */
    uint8_t coming_repetition;
    uint32_t coming_joints, looked_joints; /* that these steps use */
    uint16_t coming_pos[PAGE_JOINTS]; /* where the coming step ends, lent joints included */
    uint16_t looked_at[PAGE_JOINTS];  /* position words of the step that was looked at; PAGE_POS_UNUSED: stays */
} player_t;

/* Starts idle, as the main play. Source, joints and goals (both arrays of PAGE_JOINTS) stay the caller's. */
void player_init(player_t *player, const page_source_t *source, player_joint_t joint[PAGE_JOINTS],
                 uint16_t goal_pos[PAGE_JOINTS]);

/* Sets the shape that acts from the next step that is looked at; NULL: play as stored. Call it any time after player_init.
 * shaping: memory for a step that is being shaped, for this play alone; NULL in a program with shape_step_none.c. */
void player_set_shape(player_t *player, const shape_t *shape, shape_step_t *shaping);

/* Begins at step 1 of `page`. Call link_call before.
 * pose_pos : where the joints are (page coordinates; values above 1023 count as 1023); copied to goal_pos, may be goal_pos
 * present  : bit per joint that may be driven; others are never touched
 * Afterwards player.page is the page that plays first: pages with PLAY_COUNT 0 are passed over. The first output comes with
 * the next player_tick. Any error: nothing changed but .fault and .fault_page. */
MUST_CHECK player_status_t player_start(player_t *player, link_t *link, uint8_t page, player_law_t law,
                                        const uint16_t pose_pos[PAGE_JOINTS], uint32_t present);

/* For the approach: fills pose_pos with the positions of step 1 of `page`, shaped, and returns the bits of the joints that
 * have one. */
uint32_t player_first_pose(const page_source_t *source, const shape_t *shape, uint8_t page, uint16_t pose_pos[PAGE_JOINTS]);

/* One tick: player_move and player_prepare. Returns PLAYER_EV_ bits; 0 when idle. */
uint8_t player_tick(player_t *player, link_t *link) NOINLINE; /* by itself, so that the bench can measure it */

/* The two halves of a tick, for two plays at once (layers.h): makes the tick's goals; then prepares the coming step in what
 * is left of the tick's time. Set player.work to what the tick has done before each of them; they add what they do. */
uint8_t player_move(player_t *player, link_t *link);
void player_prepare(player_t *player, link_t *link);

/* Leaves the page at once: every joint slows to a stand within ACCEL_TIME ticks (at least 8), without reversal. */
void player_break(player_t *player);

/* pause slows all joints to a stand. resume goes on to the target of the interrupted step in the time that was left, but
 * never faster than a ramp of the length that slowing down took; while it still slows down, as soon as it stands. */
void player_pause(player_t *player);
void player_resume(player_t *player);

bool player_is_moving(const player_t *player);   /* a play is on, paused or breaking included */
bool player_is_paused(const player_t *player);   /* after player_pause, until player_resume */

/* Takes joints out of a running play (torque lost, servo silent): they keep their last goal and are not in `joints`. */
void player_drop_joints(player_t *player, uint32_t joints);

/* For layers.h: gives a joint that is at `pos` to this play. It moves again with the next step. */
void player_give_joint(player_t *player, uint8_t joint, uint16_t pos);

/* The position 0..1023 where the play wants `joint`, one of its own, when a tick has made no output. In a tick with output
 * that is goal_pos; a joint that is planned ahead has its step's end here already. */
uint16_t player_asks(const player_t *player, const player_joint_t *joint);

#endif
