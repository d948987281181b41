/* SPDX-License-Identifier: MIT
 * play.h - the parts of the Play image, and its urgent work. Used by commands*.c, views*.c and main.c, which defines the one
 * play_t. */
#ifndef PLAY_H
#define PLAY_H

#include "inputs.h"
#include "layers.h"
#include "page_store.h"
#include "performer.h"
#include "requests.h"
#include "servo_link.h"
#include "settings.h"
#include "shell.h"

#define PLAY_LINE_BYTES 112u /* requests have up to 110 characters */
#define PLAY_HISTORY_BYTES 40u

typedef struct {
    performer_t performer;
    servo_link_t servos;
    page_store_t pages;
    settings_store_t store;
    inputs_t inputs;
    shell_t shell;
    layers_t layers;
    char line[PLAY_LINE_BYTES];
    char history[PLAY_HISTORY_BYTES];
} play_t;
extern play_t the_play;

/* Does the urgent work: the tick, console input, the bus, a save of settings, lamps, the watchdog. Called in the main loop,
 * while text waits for room on the line, and between the parts of a long command. Prints nothing. */
void play_service(void);

/* Searches the bus for servos and loads the trim of page 0. Blocks 0.3 s; nothing may be moving. */
void play_find_servos(void);

#endif
