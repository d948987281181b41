/* SPDX-License-Identifier: MIT
 * trial_api.h - the robot without its chip (tools/sim/quick) as flat functions for a web page that tries a motion in
 * physics: the firmware's player, the virtual servos, and a body supplied by the page (imported_body.h). trial.wasm
 * exports everything declared here under its own name, and otherwise only `memory` and `_initialize`.
 *
 * One robot at a time. Time advances in ticks of 1/128 s, as fast as possible. The same calls and the same body give
 * the same run. Wrong numbers are refused, never undefined. Without a robot every function does nothing and returns
 * 0. */
#ifndef TRIAL_API_H
#define TRIAL_API_H

#include <stdbool.h>
#include <stdint.h>

#pragma GCC visibility push(default)

#define TRIAL_API_IMAGE_BYTES 0x10000

/* 128 pages as in flash. Write them before trial_api_new(). */
uint8_t *trial_api_image(void);

/* Makes a robot with these motions and no servos. It replaces the previous one. volts: supply of the servos. false: no
 * memory. */
bool trial_api_new(double volts);

/* Plugs in an AX-12 with this ID (0..30). false: another ID, or no memory. */
bool trial_api_add_servo(int id);

/* Connects the servos' shafts to the body and reads its state. Then switches torque on, with each goal at its joint's
 * position. */
void trial_api_stand(void);

/* Shapes the next play, in percent (shape.h). false: out of range, nothing changed. */
bool trial_api_shape(int rate, int amplitude, int blend);

/* Starts a page. law: 0 exact, 1 classic. Returns player_status_t, 0 for done; -1: there is no such page. */
int trial_api_start(int page, int law);

/* Sets the keys of a remote from now on: 0 released, 255 stop. */
void trial_api_keys(int code);

/* Runs this many ticks. Returns true while a play is running. */
bool trial_api_run(int ticks);

/* The page and step that play now: page 1..127, step 1..7; 0 if nothing plays. */
int trial_api_page(void);
int trial_api_step(void);

/* Joint positions in servo units with fractions, one per servo, in the order of plugging in. */
const double *trial_api_positions(void);

#pragma GCC visibility pop

#endif
