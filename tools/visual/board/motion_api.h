/* SPDX-License-Identifier: MIT
 * motion_api.h - the firmware's page checks and player (motion/) as flat functions for a web page: motion.wasm. What
 * the page draws with it is what the robot plays; no part of the motion law is written twice. Numbers only. Memory is
 * shared through the pointers below, which never change. One document per module instance. Everything declared here is
 * exported under its own name. Page numbers are 0..127; others are refused. */
#ifndef MOTION_API_H
#define MOTION_API_H

#include <stdbool.h>
#include <stdint.h>

#pragma GCC visibility push(default)

/* The motion area: 128 pages of 512 bytes. The page writes it; player and checks read it. */
uint8_t *motion_api_pages(void);

/* page_status_t of a page (0: good, 1: checksum, 2: steps, 3: schedule, 4: speed, 6: position; 5 is never returned);
 * -1: no such page. */
int motion_api_check(int page);

/* seal sets the checksum byte. clear makes a page empty. */
void motion_api_seal(int page);
void motion_api_clear(int page);
bool motion_api_is_playable(int page);

/* The CRC-16 of a page, as in @crcs and @save. */
int motion_api_crc16(int page);

/* A position mirrored to the joint on the other side. Neutral positions are in the middle. */
int motion_api_mirrored(int pos);

/* The position half-way from a to b; a half unit goes towards b. */
int motion_api_pos_between(int a, int b);

/* Splits the time (0..255) of a step for a new step inserted half-way before it: the new step's share | the rest << 8.
 * An odd unit goes to the share. Both are at least 1, unless the time was 0. */
int motion_api_time_between(int time);

/* The code of these remote buttons (hal/remote.h). 0 if they give none: no button, a stop, a pause. */
int motion_api_remote_code(int buttons);

/* --- Links --- */

typedef enum { MOTION_API_LEAD_NEXT, MOTION_API_LEAD_EXIT, MOTION_API_LEAD_LINKED1, MOTION_API_LEAD_LINKED2,
               MOTION_API_LEAD_BLEND_RIGHT, MOTION_API_LEAD_BLEND_LEFT, MOTION_API_LEADS } motion_api_lead_t;

/* Where a page leads, as link.c decides it. Links that are never followed (a linked page without a code, a page above
 * 127) are left out. Rows of three bytes: motion_api_lead_t, page 1..127, the code that selects it (0: none is needed).
 * Returns the number of rows, at most MOTION_API_LEADS; 0 if the page is damaged or has no steps. */
#define MOTION_API_LEAD_BYTES 3
int motion_api_leads(int page);
const uint8_t *motion_api_leads_table(void);

/* Marks the pages that a play of page `first` can reach, including itself; first 0: the same for all pages that a code
 * calls. 128 bytes, 1 or 0. A damaged or empty page is marked if something leads to it. */
const uint8_t *motion_api_reach(int first);

/* The exit links form a circle: a stop that begins in this page is ended by link.c, not by a page without an exit. */
bool motion_api_exits_round(int page);

/* Updates the links and partners of a good page after pages have moved, and seals it. motion_api_moved() holds the new
 * number of each page, 0 if nothing is left to lead to. Works like `m512 pages` (pages/operations.py). */
uint8_t *motion_api_moved(void);
void motion_api_relink(int page);

/* --- Play --- */

/* Joint positions before a play: 31 words, servo units. Fill them before motion_api_start(). */
uint16_t *motion_api_pose(void);

/* The pose of a page's step 1. Writes the joints that it uses into the pose and returns their bits. */
uint32_t motion_api_first_pose(int page);

/* The pose after a step: the first pose, then steps 0..step. Stops at a step that does not exist. Fills the pose. */
void motion_api_pose_after(int page, int step);

/* Ticks of a step (0..6) of a good page under a law (0 exact, 1 classic), and of its pause. Fractions of a tick are not
 * carried over. Before step 0 the joints are as in the pose; this matters only for pages in speed base. -1: no such
 * step. */
int motion_api_step_ticks(int page, int step, int law);
int motion_api_pause_ticks(int page, int step, int law);

/* Shapes all plays that start from now on (shape.h): rate 10..400 %, amplitude 0..150 % of all joints about the pose of
 * page 1, blend -100..100 % to the left or right partner. false: a number is out of range, nothing changed. */
bool motion_api_shape(int rate_percent, int amplitude_percent, int blend_percent);

/* The highest speed that the firmware asks of an AX-12 at this voltage (0.1 V): 1/16 servo unit per tick. 0:
 * unknown. */
int motion_api_top_speed_q4_4(int decivolts);

/* Starts a page. law: player_law_t (0 exact, 1 classic); mode: link_mode_t (0 latch, 1 hold); code: the code of the
 * call, 0 for a call by number; present: one bit per joint that may be driven. Returns player_status_t, 0 = started. A
 * running play is ended first. */
int motion_api_start(int page, int law, int mode, int code, uint32_t present);

/* Passes a code (0 released, 255 stop). It takes effect at the next decision of a link, as in the robot. */
void motion_api_code(int code);

/* Continues the play for at most `ticks` (up to MOTION_API_CURVE_TICKS) and writes its curve: for each tick (1/128 s)
 * 31 goals and three bytes (page, step, PLAYER_EV_ bits). Returns the ticks played. Fewer than requested: the play ended. */
#define MOTION_API_CURVE_TICKS 76800 /* 10 minutes */
#define MOTION_API_MARK_BYTES 3
uint32_t motion_api_curve(uint32_t ticks);
const uint16_t *motion_api_curve_goals(void);
const uint8_t *motion_api_curve_marks(void);

#pragma GCC visibility pop

#endif
