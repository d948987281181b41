/* SPDX-License-Identifier: MIT
 * inputs.h - where codes come from: remote control, panel, serial port; and the typed text beside them.
 * Takes the console's bytes, gives remote packets to the performer at once and keeps what was typed for the shell, so
 * that a stop on the remote never waits behind a long answer. Prints nothing. Main loop only. Caller-owned;
 * RAM: sizeof(inputs_t), 192 bytes. Source: remote.md. */
#ifndef INPUTS_H
#define INPUTS_H

#include <stdbool.h>
#include <stdint.h>
#include "page_store.h"
#include "performer.h"
#include "remote.h"
#include "ring.h"
#include "settings.h"
#include "steer.h"

#define INPUTS_TYPED_BYTES 128u
#define INPUTS_SILENCE_TICKS 64u  /* hold mode: 500 ms without a packet is a stop */
#define INPUTS_LOST_MAX (UINT16_MAX - UINT8_MAX)   /* with what the console counts it stays within 16 bits */
#define INPUTS_QUIET_TICKS 4u     /* an unfinished packet is given up after 24..31 ms */

/* Why a code started nothing. */
typedef struct {
    uint8_t code;
    bool no_page;           /* no page has this code */
    uint8_t status;         /* else performer_status_t, for `page` */
    uint8_t page, fault;
} inputs_refusal_t;

typedef struct {
    uint16_t lost;          /* typed bytes dropped because the shell was far behind; stays at INPUTS_LOST_MAX */
    /* Private. */
    performer_t *performer;
    const page_store_t *pages;
    const settings_t *settings;
    remote_t remote;
    uint16_t remote_buttons;   /* of the packet before: presses are edges */
    uint8_t panel_buttons;
    bool panel_was_free;       /* buttons held at power-on are no presses */
    uint8_t code;              /* the last one, from wherever */
    uint8_t silent_ticks;      /* since the last packet with buttons; INPUTS_SILENCE_TICKS: none held */
    uint8_t quiet_ticks;       /* since the last byte */
    bool pc_waits;             /* the PC was told to wait */
    bool refused;
    steer_t steer;
    inputs_refusal_t refusal;
    ring_t typed;
    uint8_t typed_bytes[INPUTS_TYPED_BYTES];
} inputs_t;

void inputs_init(inputs_t *inputs, performer_t *performer, const page_store_t *pages, const settings_t *settings);

/* Every turn of the main loop: takes what the console has heard. With the `flow` setting the PC is told to wait (XOFF)
 * while the shell is behind; a PC that does not listen loses typed bytes, never remote packets. */
void inputs_take(inputs_t *inputs);

/* Once a tick, after panel_tick. */
void inputs_tick(inputs_t *inputs);

/* The next typed byte. false: none. */
bool inputs_get(inputs_t *inputs, uint8_t *byte);

/* A code, 0..255, as if from the remote. Idle: starts the lowest page that has it. */
void inputs_code(inputs_t *inputs, uint8_t code);

/* Pause, or resume when paused. */
void inputs_pause(inputs_t *inputs);

/* The last code that started nothing and was not told yet. A button that stays held is told once. */
bool inputs_next_refusal(inputs_t *inputs, inputs_refusal_t *refusal);

#endif
