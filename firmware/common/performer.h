/* SPDX-License-Identifier: MIT
 * performer.h - the one play engine of Play and Edit: pages + links + approach + servos, from "play page 5" to the end.
 * Knows no console, no remote and no panel; what happened is told through a queue of events that the image prints.
 * Main loop only. Caller-owned. RAM: see performer_t; the approach and the player share their bytes, because the one
 * is over before the other begins.
 *
 *          start, move          pose read, torque on           there, or no approach
 *   IDLE --------------> READY ---------------------> APPROACH -----------------------> PLAY
 *    ^                     | break, silent servo          |        ^                      |
 *    |                     v                       pause, break    | resume (by READY)    | break, end
 *    +---------------------+------------------------------+--> STOOD                      |
 *    +------------------------------------------------------------------------------------+
 *
 * READY works joint by joint between ticks (5 ms at most each), so nothing waits for it. Nothing moves before READY is
 * through, and joints that do not answer, or that were switched off by name, are never driven. With the setting
 * `approach` 0 there is no approach: the first step starts from the present pose, as recorded traces do. */
#ifndef PERFORMER_H
#define PERFORMER_H

#include <stdbool.h>
#include <stdint.h>
#include "approach.h"
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
    PERFORMER_ERR_RANGE,      /* page 0 or above 127 */
    PERFORMER_ERR_PAGE,       /* the page, or one it passes on to, is damaged: performer.fault_page, .fault */
    PERFORMER_ERR_EMPTY,      /* the page has no action */
    PERFORMER_ERR_BUSY,       /* something is playing */
    PERFORMER_ERR_NO_SERVOS,  /* nobody answered the last search */
    PERFORMER_ERR_RELEASED,   /* every servo was switched off by hand (performer_off) */
    PERFORMER_ERR_LAW         /* this image has no classic law */
} performer_status_t;

typedef enum {
    PERFORMER_IDLE = 0,
    PERFORMER_READY,      /* getting ready: reads the pose, switches torque on */
    PERFORMER_APPROACH,   /* on the way to the first pose */
    PERFORMER_STOOD,      /* the approach was paused */
    PERFORMER_PLAY
} performer_state_t;

/* Scalars first, arrays last: the AVR reaches 63 bytes behind a pointer in one instruction. */
typedef struct {
    /* Read only for callers. */
    uint8_t state;              /* performer_state_t */
    uint8_t page;               /* asked for, or playing */
    uint8_t fault_page, fault;  /* the page behind PERFORMER_ERR_PAGE and _EMPTY, and its page_status_t */
    uint32_t released;          /* joints switched off by hand: not driven until performer_on */
    uint32_t faulty;            /* joints with a fault that is not over: silent, errors, torque lost; at a start none */
    /* Private. */
    uint8_t first_page;         /* the page that plays first: the one asked for, or where its links lead */
    uint8_t end_reason;         /* performer_end_t to report */
    uint8_t since_stop_ticks;   /* since the last stop, for "a second stop within a second" */
    bool leaving;               /* a break is under way, or was at the end. Read only for callers */
    bool pausing;               /* APPROACH: a pause is under way */
    bool slopes_due;            /* PLAY: the page's compliance goes out in this tick */
    bool battery_told, heat_told; /* each is told once a play. Read only for callers */
    uint16_t move_deg_s;        /* a move's speed limit; 0: a play */
    uint32_t joints;            /* that this play may drive */
    uint32_t ready_left;        /* joints READY has still to ask */
    uint32_t move_joints;       /* that a move concerns; its goals are in engine.approach.target_pos */
    const page_source_t *source;
    servo_link_t *servos;
    const settings_t *settings;
    layers_t *layers;           /* performer_shape.h; an image without layers never sets it */
    uint16_t drive_left_ticks;  /* until the next performer_drive must have come; 0: nobody waits for it */
    bool is_driven;             /* performer_drive has set the shape */
    uint8_t shape_voltage_dv;   /* that the shape knows of */
    shape_t shape;              /* of the main play. Set it by the functions of shape.h at any time */
    link_t link;                /* read only for callers */
    performer_events_t events;
    uint16_t goal_pos[PAGE_JOINTS]; /* last goals of all joints; READY fills it with the pose */
    union {
        struct {
            player_t player;    /* state PLAY; kept after the end. Read only for callers */
            player_joint_t joint[PAGE_JOINTS];
        };
        approach_t approach;    /* state APPROACH */
    } engine;
} performer_t;

/* Idle; nothing is sent. The three others stay the caller's and are used from now on. */
void performer_init(performer_t *performer, const page_source_t *source, servo_link_t *servos,
                    const settings_t *settings);

/* Another source of pages (Edit: one of them from RAM). Only while idle. */
void performer_set_source(performer_t *performer, const page_source_t *source);

/* Begins to play `page`, called by `code` (0: by its number). Checks the page and that somebody can move, then goes on by
 * itself through performer_tick and performer_poll. Any error: nothing happens, nothing is queued. */
MUST_CHECK performer_status_t performer_start(performer_t *performer, uint8_t page, uint8_t code);

/* Goes to a pose (page coordinates, of `joints` only) with at most deg_s degrees/s (1..360), ramped. */
MUST_CHECK performer_status_t performer_move(performer_t *performer, const uint16_t to_pos[PAGE_JOINTS],
                                             uint32_t joints, uint16_t deg_s);

/* A soft stop: through the exit page. The second one within a second is a break. Ends a pause. On the way to the first
 * pose it is a break. Idle: nothing. */
void performer_stop(performer_t *performer);

/* Ends with the repetition that is on, without the exit page. On the way to the first pose it is a break. */
void performer_stop_without_exit(performer_t *performer);

/* Ends at once: all joints slow down to a stand and hold, those moved by code too. */
void performer_break(performer_t *performer);

/* Slows down to a stand, holds; resume goes on from there. false: nothing to pause or to resume (a move cannot be
 * paused). */
bool performer_pause(performer_t *performer);
bool performer_resume(performer_t *performer);

/* The code in force during a play (0: released; 255: stop). Idle: nothing; who starts by code looks the page up. */
void performer_code(performer_t *performer, uint8_t code);

/* Torque, of `joints` that are present. Off also takes them out of a running play; they stay undriven until switched on
 * again. On needs a stand (not during a play: it returns 0) and blocks 3 ms a servo; returns those that are on now. */
uint32_t performer_on(performer_t *performer, uint32_t joints);
void performer_off(performer_t *performer, uint32_t joints);

bool performer_is_idle(const performer_t *performer);    /* no play and no move is on */
bool performer_is_still(const performer_t *performer);   /* nor does a layer (performer_shape.h) */
bool performer_is_paused(const performer_t *performer);

/* Joints that answer the bus and were not switched off by hand. */
uint32_t performer_usable(const performer_t *performer);

/* PAGE_BYTES of RAM that only a play needs: for what may be lost at the next one. NULL unless idle. A move keeps them. */
uint8_t *performer_spare(performer_t *performer);

/* Once a tick: makes the goals and hands them to the servos. Cost: that of player_tick and servo_link_goals. */
void performer_tick(performer_t *performer) NOINLINE; /* by itself, so that the bench can measure it */

/* Every turn of the main loop: bus traffic, faults, getting ready. At most 5 ms, and only while nothing moves. */
void performer_poll(performer_t *performer);

/* Takes the oldest event. false: none. */
bool performer_next_event(performer_t *performer, performer_event_t *event);

#endif
