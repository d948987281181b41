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

/* First call of main. Takes the reset cause, sets every peripheral that the loader left running, panel, tick, clock,
 * console and bus, turns the watchdog on and enables interrupts. Nothing is sent to a servo. */
void board_start(void);

/* Waits for something to do: sleeps until an interrupt unless a tick is due, a console byte waits or the bus has
 * news (so an image that sends must poll). Kicks the watchdog.
 * The main loop is  for (;;) { ...look at everything once...; board_idle(); }. */
void board_idle(void);

/* Restarts the controller: the one way to do it on purpose. First keeps what was promised: the settings whose save is under
 * way are written to the end (up to 0.45 s), and the text on its way leaves the line. Nothing may be moving. */
void board_restart(settings_store_t *store, const settings_t *settings) __attribute__((noreturn));

/* The record of the running image (app_record.h). false: no magic, or not filled in. */
bool board_record(app_record_t *record);

#endif
