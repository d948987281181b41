/* SPDX-License-Identifier: MIT
 * trial_api.h - the robot without its chip (tools/sim/quick) as flat functions, for a web page that tries a motion in
 * physics: the firmware's player, the virtual servos, and a body that the page brings (imported_body.h). trial.wasm exports
 * everything declared here under its own name, and besides that only `memory` and `_initialize`.
 *
 * One robot at a time. Time passes in ticks of 1/128 s, as fast as it can be computed. The same calls and the same body give
 * the same run. Wrong numbers are refused, never undefined; without a robot every function does nothing and returns 0. */
#ifndef TRIAL_API_H
#define TRIAL_API_H

#include <stdbool.h>
#include <stdint.h>

#pragma GCC visibility push(default)

#define TRIAL_API_IMAGE_BYTES 0x10000

/* 128 pages as they lie in flash: write them here before trial_api_new(). */
uint8_t *trial_api_image(void);

/* A robot with the image's motions and no servos; the one before is gone. volts: supply of the servos. false: no memory. */
bool trial_api_new(double volts);

/* Plugs in an AX-12 with this ID (0..30). false: another ID, or no memory. */
bool trial_api_add_servo(int id);

/* Hangs the servos' shafts on the body: they see where it is now. Then: torque on, each goal where its joint stands. */
void trial_api_stand(void);

/* How the next play is shaped, in percent (shape.h). false: out of range, nothing changed. */
bool trial_api_shape(int rate, int amplitude, int blend);

/* Begins to play a page. law: 0 exact, 1 classic. Returns player_status_t, 0 for done; -1: there is no such page. */
int trial_api_start(int page, int law);

/* Keys of a remote from now on: 0 let go, 255 stop. */
void trial_api_keys(int code);

/* Lets so many ticks pass. Returns true while a play is on. */
bool trial_api_run(int ticks);

/* What is played now: page 1..127, step 1..7; 0 when nothing is. */
int trial_api_page(void);
int trial_api_step(void);

/* Where the joints are: servo units with fractions, one a servo, in order of plugging in. */
const double *trial_api_positions(void);

#pragma GCC visibility pop

#endif
