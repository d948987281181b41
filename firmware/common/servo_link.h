/* SPDX-License-Identifier: MIT
 * servo_link.h - the robot's joints as the player sees them: which servos are there, one tick of goals -> one SYNC WRITE,
 * and one servo's health in the rest of each tick. Page coordinates outside, servo coordinates (trim added, limited to
 * 0..1023) on the wire. Knows no pages. Works over bus.h. Main loop only. RAM: one servo_link_t, 270 bytes.
 *
 * Nothing is ever written to a servo's EEPROM area but by servo_link_fast_baud and servo_link_fast_answers, on request.
 *
 * A tick on the bus at 1 Mbps, 31 joints (times in us from servo_link_goals on):
 *
 *   0            ~1010                         ~2000                                   7812
 *   | SYNC WRITE | [slopes, when they do not fit] | READ of one servo, 0.2..0.9 ms | quiet |
 */
#ifndef SERVO_LINK_H
#define SERVO_LINK_H

#include <stdbool.h>
#include <stdint.h>
#include "compiler.h"

#define SERVO_LINK_JOINTS 31u            /* joint = servo ID 0..30 */
#define SERVO_LINK_ALL 0x7FFFFFFFul
#define SERVO_LINK_TRIM_MAX 300          /* a trim beyond this is taken for damage: see servo_link_set_trim */
#define SERVO_LINK_POLL_TRIES 3u         /* failed polls, one a tick, before a servo counts as silent */
#define SERVO_LINK_NO_POSE 0xFFFFu       /* present_pos of a joint that was never read */

/* One joint's mask bit. */
#define SERVO_LINK_BIT(id) (1ul << (id))

/* What may befall a servo. */
typedef enum {
    SERVO_FAULT_SILENT = 1,   /* does not answer any more */
    SERVO_FAULT_BACK,         /* answers again */
    SERVO_FAULT_ERRORS        /* reports errors: DXL_ERR_ bits in `errors` (voltage, angle, heat, overload) */
} servo_fault_kind_t;

typedef struct {
    uint8_t id;
    uint8_t kind;             /* servo_fault_kind_t */
    uint8_t errors;
} servo_fault_t;

/* Public fields are read only for callers. */
typedef struct {
    uint32_t present;         /* answered the last scan at 1 Mbps; a silent servo stays in here */
    uint32_t slow;            /* answered at 57,142 bps: named, not used, until servo_link_fast_baud */
    uint32_t torque;          /* torque is on, as commanded or seen last */
    uint32_t silent;          /* present, but silent now */
    uint32_t no_sync;         /* present, but deaf to SYNC WRITE: served by REG WRITE and ACTION */
    uint16_t present_pos[SERVO_LINK_JOINTS]; /* last pose heard, page coordinates, or SERVO_LINK_NO_POSE */
    uint8_t errors[SERVO_LINK_JOINTS];       /* last error byte heard */
    uint8_t voltage_dv;       /* lowest voltage heard in the round before, 0.1 V; 0: none yet */
    uint8_t hottest_degrees;  /* highest temperature heard in the round before, and whose it was */
    uint8_t hottest_id;
    uint16_t late;            /* ticks whose goals were not sent in time; stays at 65535 */
    /* Private. */
    int16_t trim_pos[SERVO_LINK_JOINTS];
    uint8_t slopes[SERVO_LINK_JOINTS];       /* compliance byte in force in the servo; 0 = not known */
    uint32_t slopes_pending;
    uint32_t goals_joints;                   /* deaf joints with a goal to send, this tick */
    uint16_t *goals_pos;
    uint32_t untold_errors, untold_silent, untold_back;
    uint8_t poll_id, poll_misses;
    uint8_t phase;
    uint8_t round_voltage_dv, round_degrees, round_degrees_id;
} servo_link_t;

void servo_link_init(servo_link_t *link);

/* ---- blocking, for set-up; nothing may be moving; the watchdog is kicked ---- */

/* Looks for IDs 0..30 at 57,142 bps, then at 1 Mbps (where the bus stays): at most 31 * 2 tries * (3.3 + 0.9) ms = 260 ms
 * with nobody there. Finds out who is deaf to SYNC WRITE (by the LED, which is restored), reads pose and torque. */
void servo_link_scan(servo_link_t *link);

/* Moves slow servos of `ids` to 1 Mbps (their address 4 = 1), then scans. Returns those that were moved. */
uint32_t servo_link_fast_baud(servo_link_t *link, uint32_t ids);

/* Sets the return delay (address 5) of `ids` to 0, for robots with many servos deaf to SYNC WRITE. Returns those done. */
uint32_t servo_link_fast_answers(servo_link_t *link, uint32_t ids);

/* Reads the present positions of `ids` into present_pos; returns those that answered. 0.3..0.9 ms a servo. */
uint32_t servo_link_read_pose(servo_link_t *link, uint32_t ids);

/* Torque on: reads each pose, makes it the goal, then enables, so that nothing snaps. A servo that does not tell its pose
 * is left off. Returns those that are on now. A servo whose torque limit an overload has cut to 0 gets it back from its
 * maximum torque (address 14). */
uint32_t servo_link_torque_on(servo_link_t *link, uint32_t ids);

/* Torque off, at once: one SYNC WRITE (and one WRITE for each deaf one). */
void servo_link_torque_off(servo_link_t *link, uint32_t ids);

/* ---- trim ---- */

/* Offsets added to each goal (page 0, step 2: page_store_trim). One beyond +-SERVO_LINK_TRIM_MAX is taken as 0; returns the
 * joints for which that was so. NULL: no trim. */
uint32_t servo_link_set_trim(servo_link_t *link, const int16_t trim_pos[SERVO_LINK_JOINTS]);

/* ---- running ---- */

/* Joints that may be driven now: present, not silent, torque on. */
uint32_t servo_link_drivable(const servo_link_t *link);

/* One tick's goals (page coordinates 0..1023) of `joints`; others are not touched; joints that are not drivable are left
 * out. goal_pos is read again during the same tick for deaf servos: keep it. Sends at once; a health poll still under way
 * is given up for it. Cost with 31 joints: see the figure above the function. */
void servo_link_goals(servo_link_t *link, uint16_t goal_pos[SERVO_LINK_JOINTS], uint32_t joints);

/* Compliance bytes of a page (motion512.md: nibbles CW, CCW; out-of-range nibbles count as 5): what differs from what is in
 * the servos goes out with the next goals (of those joints that are driven). */
void servo_link_slopes(servo_link_t *link, const uint8_t compliance[SERVO_LINK_JOINTS]);

/* Call every turn of the main loop: goes on with this tick's traffic. One health poll (READ 36..43) a tick, round robin over
 * `present`, so a round takes as many ticks as there are servos (31: 0.24 s). A servo that misses is asked again in the
 * following ticks and counts as silent after SERVO_LINK_POLL_TRIES misses: named within 0.3 s. Silent ones stay in the round. */
void servo_link_poll(servo_link_t *link);

/* Once a tick, before servo_link_goals or instead of it: allows this tick's health poll. */
void servo_link_tick(servo_link_t *link);

/* The next thing that befell a servo and was not told yet. false: nothing. */
bool servo_link_next_fault(servo_link_t *link, servo_fault_t *fault);

/* true while goals, slopes or a poll are on the wire. */
bool servo_link_is_busy(const servo_link_t *link);

/* Waits until the bus is quiet and keeps it so until servo_link_tick: before blocking bus calls. */
void servo_link_quiet(servo_link_t *link);

#endif
