/* SPDX-License-Identifier: MIT
 * performer.h - the play engine of Play and Edit: pages, links, approach and servos, from "play page 5" to the end.
 * Knows no console, no remote and no panel; reports through a queue of events, which the image prints.
 * Main loop only. Caller-owned. The approach is a play without a page (player_move).
 *
 *          start, move          pose read, torque on           there, or no approach
 *   IDLE --------------> READY ---------------------> APPROACH -----------------------> PLAY
 *    ^                     |                           |                                  |
 *    |                     | break, silent servo       | break                            | break, end
 *    +---------------------+---------------------------+----------------------------------+
 *
 * READY handles one joint at a time between ticks, at most 5 ms each. Nothing moves before READY is complete. Joints that do
 * not answer or were switched off by hand are never driven. With the setting `approach` 0 there is no approach: the first
 * step starts from the present pose, as in the recorded traces. */
#ifndef PERFORMER_H
#define PERFORMER_H

#include <stdbool.h>
#include <stdint.h>
#include "compiler.h"
#include "layers.h"
#include "link.h"
#include "performer_event.h"
#include "player.h"
#include "servo_link.h"
#include "settings.h"
#include "shape.h"

typedef enum {
    PERFORMER_OK = 0,
    PERFORMER_ERR_RANGE,      /* page 0, or not below PAGE_COUNT */
    PERFORMER_ERR_PAGE,       /* the page, or one that its links lead to, is damaged: performer.fault_page, .fault */
    PERFORMER_ERR_EMPTY,      /* the page has no action */
    PERFORMER_ERR_BUSY,       /* something is playing */
    PERFORMER_ERR_LAW,        /* this image has no classic law; up to here as player_status_t */
    PERFORMER_ERR_NO_SERVOS,  /* no servo answered the last search */
    PERFORMER_ERR_RELEASED    /* every servo was switched off by hand (performer_off) */
} performer_status_t;

typedef enum {
    PERFORMER_IDLE = 0,
    PERFORMER_READY,      /* reads the pose, switches torque on */
    PERFORMER_APPROACH,   /* moves to the first pose */
    PERFORMER_PLAY
} performer_state_t;

/* Scalars first, arrays last: the AVR reaches 63 bytes after a pointer in one instruction. */
typedef struct {
    /* Read only for callers. */
    uint8_t state;              /* performer_state_t */
    uint8_t page;               /* requested, or playing */
    uint8_t fault_page, fault;  /* the page that caused PERFORMER_ERR_PAGE or _EMPTY, and its page_status_t */
    uint32_t released;          /* joints switched off by hand: not driven until performer_on */
    uint32_t faulty;            /* joints whose fault persists: silent, errors, torque lost; cleared at a start */
    /* Private. */
    uint8_t first_page;         /* the page that plays first: the requested one, or the one its links lead to */
    uint8_t end_reason;         /* performer_end_t to report */
    uint8_t since_stop_ticks;   /* since the last stop or break; at most UINT8_MAX */
    bool leaving;           /* a break is in progress, or has ended the play. Read only for callers */
    bool slopes_due;        /* PLAY: set the compliance of the pages again in this tick */
    bool is_driven;         /* performer_drive has set the shape */
    bool battery_reported;  /* once per play. Read only for callers */
    bool is_hot;            /* a servo has reached the setting hot; until all are 3 degrees below. Read only for callers */
    uint16_t move_deg_s;        /* a move's speed limit; 0: a play */
    uint32_t joints;            /* the joints that this play may drive; the goals of a move are in player.next_pos */
    uint32_t ready_left;        /* READY: joints not asked yet */
    const page_source_t *source;
    servo_link_t *servos;
    const settings_t *settings;
    layers_t *layers;           /* performer_shape.h; NULL in an image without layers */
    uint16_t drive_left_ticks;  /* until the next performer_drive is overdue; 0: not driven */
    uint8_t shape_voltage_dv;   /* the voltage that the shape's limit follows */
    shape_t shape;              /* of the main play. Set it with the functions of shape.h at any time */
    link_t link;                /* read only for callers */
    performer_events_t events;
    uint16_t goal_pos[PAGE_JOINTS]; /* the last goals of all joints; READY fills in the pose */
    player_t player;            /* kept after the end. Read only for callers */
    player_joint_t joint[PAGE_JOINTS];
} performer_t;

/* Starts idle; sends nothing. Keeps using the caller's source, servos and settings. */
void performer_init(performer_t *performer, const page_source_t *source, servo_link_t *servos,
                    const settings_t *settings);

/* Sets another source of pages (Edit: the open page is in RAM). Only while idle. */
void performer_set_source(performer_t *performer, const page_source_t *source);

/* Begins to play `page`, called by `code` (0: by its number). Checks the page and that a joint can move; performer_tick and
 * performer_poll do the rest. On an error nothing happens and nothing is queued. */
MUST_CHECK performer_status_t performer_start(performer_t *performer, uint8_t page, uint8_t code);

/* Moves `joints` to a pose (page coordinates) at up to deg_s degrees/s (1..360), ramped. Leaves absent joints out, and all
 * others as they are: limp, or held by their torque.
 * PERFORMER_ERR_NO_SERVOS: none is present; PERFORMER_ERR_RELEASED: all present ones are switched off. */
MUST_CHECK performer_status_t performer_move(performer_t *performer, const uint16_t to_pos[PAGE_JOINTS],
                                             uint32_t joints, uint16_t deg_s);

/* A soft stop: through the exit page. Ends a pause. A second one within a second is a break, as is one during the approach.
 * No effect when idle. */
void performer_stop(performer_t *performer);

/* Ends after the current repetition, without the exit page. A break during the approach. */
void performer_stop_without_exit(performer_t *performer);

/* A break: the joints of the play and of a second page slow down and stop; those moved by code stop at once. Torque stays
 * on. */
void performer_break(performer_t *performer);

/* pause stops all joints, with torque on; resume continues. false: nothing to pause or resume. A move cannot be paused. */
bool performer_pause(performer_t *performer);
bool performer_resume(performer_t *performer);

/* Sets the current code during a play (0: released; 255: stop). No effect when idle: to start a play by code, look up its
 * page. */
void performer_code(performer_t *performer, uint8_t code);

/* Switch the torque of `joints` that are present. on blocks 3 ms per servo and returns the joints that are on now; during a
 * play it returns 0. off also removes the joints from a play, and they are not driven until switched on again; it returns
 * the joints that confirmed it. */
uint32_t performer_on(performer_t *performer, uint32_t joints);
uint32_t performer_off(performer_t *performer, uint32_t joints);

bool performer_is_still(const performer_t *performer);   /* idle, and no layer moves a joint (performer_shape.h) */

static inline bool performer_is_idle(const performer_t *performer)    /* no play and no move */
{
    return performer->state == PERFORMER_IDLE;
}

/* Whether a stop, a break or an off of every joint came since the tick before the last one, even if nothing was moving. */
static inline bool performer_was_just_stopped(const performer_t *performer)
{
    return performer->since_stop_ticks <= 1;
}

/* The page that is playing (player.now.step is its step), or with which a play begins; 0: none. */
static inline uint8_t performer_page(const performer_t *performer)
{
    const uint8_t page = performer->state == PERFORMER_PLAY ? performer->player.now.page : performer->page;
    return performer_is_idle(performer) ? 0 : page;
}

static inline bool performer_is_paused(const performer_t *performer)
{
    return performer->state > PERFORMER_READY && player_is_paused(&performer->player);
}

/* Joints that answer the bus and were not switched off by hand. */
static inline uint32_t performer_usable(const performer_t *performer)
{
    return performer->servos->present & ~performer->released;
}

/* PAGE_BYTES of spare RAM that the next play or move overwrites. NULL unless idle. */
uint8_t *performer_spare(performer_t *performer);

/* Call once per tick: computes the goals and sends them to the servos. Cost: that of player_tick and servo_link_goals. */
void performer_tick(performer_t *performer) NOINLINE; /* a symbol of its own, so that the bench can measure it */

/* Call in every turn of the main loop: bus traffic, faults, READY. Blocks at most 5 ms, and only while nothing moves. */
void performer_poll(performer_t *performer);

/* For performer*.c: switches the joint's torque on and takes its position into goal_pos (servo_link_engage). false: reported
 * as PERFORMER_EV_UNREADY, and faulty. */
bool performer_engage(performer_t *performer, uint8_t id);

/* Takes the oldest event. false: none. */
bool performer_next_event(performer_t *performer, performer_event_t *event);

#endif
