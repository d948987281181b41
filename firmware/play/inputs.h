/* SPDX-License-Identifier: MIT
 * inputs.h - the sources of codes (remote control, panel, serial port) and the typed text between them.
 * Takes the console's bytes. Passes remote packets to the performer at once and queues typed text for the shell, so that a
 * stop on the remote never waits for a long answer. Prints nothing. Main loop only. Caller-owned;
 * RAM: one inputs_t. Source: REMOTE.md. */
#ifndef INPUTS_H
#define INPUTS_H

#include <stdbool.h>
#include <stdint.h>
#include "page_store.h"
#include "performer.h"
#include "remote.h"
#include "ring.h"
#include "steer.h"

#define INPUTS_TYPED_BYTES 128u
#define INPUTS_SILENCE_TICKS 64u  /* 500 ms without a packet: all buttons are released; in hold mode a stop */
#define INPUTS_RELEASE_TICKS 14u  /* 102 ms without a packet that has it: a button is released; one packet may be lost */
#define INPUTS_LOST_MAX (UINT16_MAX - UINT8_MAX)   /* so that the sum with the console's own count fits 16 bits */
#define INPUTS_QUIET_TICKS 4u     /* an unfinished packet is dropped after 24..31 ms */
#define INPUTS_ESC_TICKS 8u       /* an ESC followed by nothing for 55..62 ms is the Esc key, as in Edit */

/* Why a code did not start a play. */
typedef struct {
    uint8_t code;
    bool no_page;           /* no page has this code */
    uint8_t status;         /* otherwise: performer_status_t, for `page` */
    uint8_t page, fault;
} inputs_refusal_t;

/* The buttons of one source. Those that are down or recent count as held. */
typedef struct {
    uint8_t down;           /* now; of a remote: in the newest packet */
    uint8_t recent;         /* of a remote: in a packet of the last INPUTS_RELEASE_TICKS. A second remote may send between */
    uint8_t spent;          /* held since the start, a play or a stop: they start nothing until released */
} inputs_held_t;

typedef struct {
    uint16_t lost;          /* typed bytes dropped because the shell was too slow; stops at INPUTS_LOST_MAX */
    /* Private. */
    performer_t *performer;
    const page_store_t *pages;
    remote_t remote;
    uint8_t remote_act;        /* remote_act_t of the last packet, to detect presses */
    inputs_held_t remote_held; /* the first eight buttons */
    uint8_t recent_ticks[10];  /* until they, stop and pause are recent no more */
    inputs_held_t panel_held;  /* the arrows */
    uint8_t panel_heard;       /* the buttons that count; one held since the start is not a press. The arrows: all were up */
    uint8_t panel_buttons;     /* of these, the ones that are down */
    uint8_t holes;             /* bytes lost before the next typed one */
    uint8_t silent_ticks;      /* since the start or the last packet with buttons; INPUTS_SILENCE_TICKS: none held */
    uint8_t quiet_ticks;       /* since the last byte; at most INPUTS_ESC_TICKS */
    bool pc_waits;         /* XOFF was sent to the PC */
    bool refused;
    steer_t steer;
    inputs_refusal_t refusal;
    ring_t typed;
    uint8_t typed_bytes[INPUTS_TYPED_BYTES];
} inputs_t;

void inputs_init(inputs_t *inputs, performer_t *performer, const page_store_t *pages);

/* Call in every turn of the main loop: takes the console's bytes. With the setting `flow`, sends XOFF while the shell
 * cannot keep up. A PC that ignores it loses typed bytes, never remote packets. */
void inputs_take(inputs_t *inputs);

/* Call once per tick, after panel_tick. */
void inputs_tick(inputs_t *inputs);

/* The next typed byte (below 0x80), or INPUTS_HOLE + n: n bytes were lost here (at most INPUTS_HOLE_MAX). false: none. */
#define INPUTS_HOLE 0x80u
#define INPUTS_HOLE_MAX 127u
bool inputs_get(inputs_t *inputs, uint8_t *byte);

/* Whether a pending ESC was the Esc key. Call when inputs_get has nothing. */
static inline bool inputs_are_quiet(const inputs_t *inputs)
{
    return inputs->quiet_ticks == INPUTS_ESC_TICKS;
}

/* Handles a code 0..255 as if its button was pressed. If nothing is playing, starts the lowest page with this code. */
void inputs_code(inputs_t *inputs, uint8_t code);

/* Pauses the play, or resumes it if paused. */
void inputs_pause(inputs_t *inputs);

/* Takes the last code that did not start a play. false: none. A held button causes one refusal. */
bool inputs_next_refusal(inputs_t *inputs, inputs_refusal_t *refusal);

#endif
