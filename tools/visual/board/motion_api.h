/* SPDX-License-Identifier: MIT
 * motion_api.h - the firmware's own page checks and player (motion/) as flat functions, for a web page: motion.wasm.
 * What is drawn with it is what the robot will play; nothing of the law is written a second time.
 * Numbers only; memory is shared through the pointers below, which never change. One document per module instance.
 * Everything declared here is exported under its own name. Page numbers are 0..127; a wrong one is refused. */
#ifndef MOTION_API_H
#define MOTION_API_H

#include <stdbool.h>
#include <stdint.h>

#pragma GCC visibility push(default)

/* The motion area: 128 pages of 512 bytes. The page writes it; play and checks read it. */
uint8_t *motion_api_pages(void);

/* page_status_t of a page (0: good, 1: checksum, 2: steps, 3: schedule, 4: speed, 5: link, 6: position); -1: no page. */
int motion_api_check(int page);

/* The same for its seven steps alone: 0 or 6 (PAGE_ERR_POSITION); -1: no such step. */
int motion_api_check_step(int page, int step);

/* Sets the checksum byte; makes a page empty. */
void motion_api_seal(int page);
void motion_api_clear(int page);
bool motion_api_is_playable(int page);

/* The CRC-16 of a page, as @crcs and @save have it. */
int motion_api_crc16(int page);

/* A position as the joint on the other side has it, neutral positions in the middle. */
int motion_api_mirrored(int pos);

/* The position and the time of a step that is put in half-way: page_edit_between() and page_edit_time_split() with 50 %. */
int motion_api_pos_between(int a, int b);
int motion_api_time_between(int time); /* the share | the rest << 8 */

/* The code that these buttons of a remote give (hal/remote.h); 0 when they give none: none is down, a stop, a pause. */
int motion_api_remote_code(int buttons);

/* --- Links --- */

typedef enum { MOTION_API_LEAD_NEXT, MOTION_API_LEAD_EXIT, MOTION_API_LEAD_LINKED1, MOTION_API_LEAD_LINKED2,
               MOTION_API_LEAD_BLEND_RIGHT, MOTION_API_LEAD_BLEND_LEFT, MOTION_API_LEADS } motion_api_lead_t;

/* Where a page leads, as link.c decides it: links that are never followed (a linked page without a code, a page above 127)
 * are none. Rows of three bytes: motion_api_lead_t, page 1..127, the code that chooses it (0: none is needed). Returns the
 * number of rows, at most MOTION_API_LEADS; a page that is damaged or has no steps leads nowhere. */
#define MOTION_API_LEAD_BYTES 3
int motion_api_leads(int page);
const uint8_t *motion_api_leads_table(void);

/* Marks the pages that a play of page `first` can come to, itself too; first 0: of all pages that a code calls. 128 bytes, 1
 * or 0. A page that is damaged or empty is marked when something leads to it. */
const uint8_t *motion_api_reach(int first);

/* The exit links go round: a stop that begins in this page is ended by link.c, not by a page without an exit. */
bool motion_api_exits_round(int page);

/* The links and partners of a good page follow pages that have moved: motion_api_moved() holds the new number of each page,
 * 0 where nothing is left to lead to. The page is sealed. As `m512 pages` does it (pages/operations.py). */
uint8_t *motion_api_moved(void);
void motion_api_relink(int page);

/* --- Play --- */

/* Where the joints stand before a play: 31 words, servo units. To be filled before motion_api_start(). */
uint16_t *motion_api_pose(void);

/* Where step 1 of a page wants its joints: fills those places of the pose; returns their bits. */
uint32_t motion_api_first_pose(int page);

/* Where a page leaves the joints behind a step: the first pose, and what its steps 0..step want; a step that is not there
 * ends it. Fills the pose. */
void motion_api_pose_after(int page, int step);

/* Ticks that a step (0..6) of a good page takes under a law (0 exact, 1 classic), and its pause; fractions of a tick are not
 * carried. Before step 0 the joints stand as in the pose; it matters only for pages in speed base. -1: no such step. */
int motion_api_step_ticks(int page, int step, int law);
int motion_api_pause_ticks(int page, int step, int law);

/* How the plays that begin from now on are shaped (shape.h): rate 10..400 %, amplitude 0..150 % of all joints about the
 * pose of page 1, blend -100..100 % to the left or right partner. false: a number is out of its range, nothing changed. */
bool motion_api_shape(int rate_percent, int amplitude_percent, int blend_percent);

/* What the firmware takes for the fastest that an AX-12 may be asked to go at this voltage (0.1 V): 1/16 servo unit a tick.
 * 0: not known. */
int motion_api_top_speed_q4_4(int decivolts);

/* Begins a page. law: player_law_t (0 exact, 1 classic); mode: link_mode_t (0 latch, 1 hold); code: the call's code, 0
 * for a call by number; present: bit per joint that may be driven. Returns player_status_t, 0 = started. A play that is
 * on ends first. motion_api_fault_page(): the page that was refused. */
int motion_api_start(int page, int law, int mode, int code, uint32_t present);
int motion_api_fault_page(void);

/* A code arrives (0 released, 255 stop). Works at the next decision of a link, as in the robot. */
void motion_api_code(int code);

/* One tick of 1/128 s: PLAYER_EV_ bits. Afterwards the goals, and where the play is. */
int motion_api_tick(void);
const uint16_t *motion_api_goals(void);
uint32_t motion_api_joints(void);
int motion_api_page(void);
int motion_api_step(void);
int motion_api_repetition(void);
bool motion_api_is_moving(void);

/* Plays on for at most `ticks` (up to MOTION_API_CURVE_TICKS) and writes the way: 31 goals a tick, and what happened in
 * each (page, step and events: three bytes). Returns the ticks played; fewer than asked for means that the play ended. */
#define MOTION_API_CURVE_TICKS 16384
#define MOTION_API_MARK_BYTES 3
uint32_t motion_api_curve(uint32_t ticks);
const uint16_t *motion_api_curve_goals(void);
const uint8_t *motion_api_curve_marks(void);

#pragma GCC visibility pop

#endif
