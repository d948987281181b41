/* SPDX-License-Identifier: MIT
 * board.h - start-up order and idling, the same for every application image.
 * Main loop only. RAM: none of its own. */
#ifndef BOARD_H
#define BOARD_H

#include <stdbool.h>
#include <stdint.h>
#include "app_record.h"
#include "pgm.h"
#include "settings.h"

/* First call of main. Takes the reset cause, initializes panel, tick, clock, console and bus regardless of what the loader
 * left running, turns the watchdog on and enables interrupts. Sends nothing to a servo. */
void board_start(void);

/* Kicks the watchdog. Sleeps until an interrupt, unless a tick is due, a console byte waits or the bus has news (so an
 * image that sends must poll the bus).
 * The main loop is  for (;;) { ...look at everything once...; board_idle(); }. */
void board_idle(void);

/* Restarts the controller. Use it for every intentional restart: it first completes a pending save of settings
 * (up to 0.45 s) and sends the buffered text. Nothing may be moving. */
void board_restart(settings_store_t *store) __attribute__((noreturn));

/* The record of the running image (app_record.h). false: it has no magic or was not filled in. */
bool board_record(app_record_t *record);

#endif
