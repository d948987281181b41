/* SPDX-License-Identifier: MIT
 * servo_link.h - the robot's joints as the player sees them: which servos are there, one tick of goals -> one SYNC WRITE,
 * and one servo's health in the rest of each tick. Page coordinates outside, servo coordinates (trim added, limited to
 * 0..1023) on the wire. Knows no pages. Works over bus.h. Main loop only. RAM: one servo_link_t, 260 bytes.
 * Code: servo_link.c (while running), servo_link_setup.c (what blocks).
 *
 * Nothing is ever written to a servo's EEPROM area.
 *
 * A tick on the bus at 1 Mbps, 31 joints (us after servo_link_goals):
 *
 *   0            1010                         2020                                          7812
 *   | SYNC WRITE | [slopes, if they did not fit] | [REG WRITEs to the deaf] | READ of one servo | quiet |
 */
#ifndef SERVO_LINK_H
#define SERVO_LINK_H

#include <stdbool.h>
#include <stdint.h>
#include "compiler.h"

#define SERVO_LINK_JOINTS 31u            /* joint = servo ID 0..30 */
#define SERVO_LINK_ALL 0x7FFFFFFFul
#define SERVO_LINK_TRIM_MAX 300          /* a trim beyond this is taken for damage */
#define SERVO_LINK_POLL_TRIES 3u         /* failed polls, one a tick, before a servo counts as silent */
#define SERVO_LINK_NO_POSE 0xFFFFu       /* present_pos of a joint that was never read */

/* One joint's mask bit: for constants; servo_link_bit for variables (a 32-bit shift is a loop on the AVR, and
 * each 32-bit operation 8 to 16 bytes: hence functions for single bits of a mask). */
#define SERVO_LINK_BIT(id) ((uint32_t)1 << (id))
uint32_t servo_link_bit(uint8_t id) NOINLINE;
bool servo_link_has(const uint32_t *mask, uint8_t id) NOINLINE;
void servo_link_put(uint32_t *mask, uint8_t id, bool on) NOINLINE;

/* What may happen to a servo. */
typedef enum {
    SERVO_FAULT_SILENT = 1,   /* does not answer any more */
    SERVO_FAULT_BACK,         /* answers again (its torque may be off: see `torque`) */
    SERVO_FAULT_ERRORS,       /* reports errors: DXL_ERR_ bits in `errors` (voltage, angle, heat, overload), 0: no more */
    SERVO_FAULT_TORQUE,       /* its torque went off by itself */
    SERVO_FAULT_KINDS = SERVO_FAULT_TORQUE
} servo_fault_kind_t;

typedef struct {
    uint8_t id;
    uint8_t kind;             /* servo_fault_kind_t */
    uint8_t errors;
} servo_fault_t;

/* Public fields are read only for callers. Small fields first: the AVR reaches 63 bytes behind a pointer cheaply. */
typedef struct {
    uint32_t present;         /* answered the last scan at 1 Mbps; a silent servo stays in here */
    uint32_t torque;          /* torque is on, as commanded or seen last */
    uint32_t silent;          /* present, but silent now */
    uint32_t no_sync;         /* present, but deaf to SYNC WRITE: served by REG WRITE and ACTION */
    uint32_t no_reply;        /* present, but answers READ only (status return level 1) */
    uint32_t slow;            /* answered at 57,142 bps: named, not used: the monitor image makes them fast */
    uint32_t mute;            /* answers PING but no READ (status return level 0): named, not used */
    uint8_t voltage_dv;       /* lowest voltage heard in the last full round, 0.1 V; 0: none yet */
    uint8_t hottest_degrees;  /* highest temperature heard in the last full round, and whose it was */
    uint8_t hottest_id;
    uint8_t late;             /* ticks whose goals could not all be sent in time; stays at 255 */
    /* Private. */
    uint8_t phase;
    uint8_t slopes_wait;                     /* ticks until slopes may have packets of their own: theirs follow the goals' */
    uint8_t slopes_held;                     /* times that servo_link_hold_slopes has acted since servo_link_slopes */
    uint8_t poll_id, poll_misses;
    uint8_t round_voltage_dv, round_degrees, round_degrees_id;
    const uint16_t *goals_pos;
    uint32_t goals_joints;                   /* of this tick */
    uint32_t slopes_pending;                 /* joints that have not got their slopes yet */
    uint32_t deaf_left;                      /* deaf joints whose REG WRITE is still to be sent */
    uint32_t untold[SERVO_FAULT_KINDS];      /* [kind - 1]: joints with a fault that nobody was told of */
    /* Public again. */
    uint16_t present_pos[SERVO_LINK_JOINTS]; /* last pose heard, page coordinates, or SERVO_LINK_NO_POSE */
    int16_t trim_pos[SERVO_LINK_JOINTS];     /* in force */
    uint8_t errors[SERVO_LINK_JOINTS];       /* last DXL_ERR_ bits heard, of the four above */
    uint8_t slopes[SERVO_LINK_JOINTS];       /* private: compliance byte last asked for; 0 = none */
} servo_link_t;

void servo_link_init(servo_link_t *link);

/* ---- running: called every tick, never blocking longer than the end of a packet (1 ms) ---- */

/* Joints that may be driven now: present, not silent, torque on. */
uint32_t servo_link_drivable(const servo_link_t *link);

/* First thing in each tick, also when nothing moves: ends the last tick's traffic and allows this tick's health poll. */
void servo_link_tick(servo_link_t *link);

/* One tick's goals (page coordinates 0..1023) of `joints`; those that are not drivable are left out. goal_pos is read again
 * during the same tick for deaf servos: keep it. Sends at once. Deaf servos take about 0.7 ms each (0.2 ms
 * with a return delay of 0, which nobody here sets): those that do not fit into the tick go on in the next one, and `late`
 * counts. */
void servo_link_goals(servo_link_t *link, const uint16_t goal_pos[SERVO_LINK_JOINTS], uint32_t joints)
    NOINLINE;   /* a name of its own in the image: the bench counts its cycles */

/* Compliance bytes of a page (motion512.md: nibbles CW, CCW; 0 and above 7 count as 5): what differs from what was sent
 * last goes out with the next goals in the same packet, up to 27 joints. Above, it follows in packets of its own for 8
 * joints each, behind the goals of the ticks after that have room for it: the tick of a page change has enough to do. */
void servo_link_slopes(servo_link_t *link, const uint8_t compliance[SERVO_LINK_JOINTS]);

/* In a tick that has enough to do (a step begins): packets of slopes alone wait for the next one;
 * SERVO_LINK_SLOPES_HELD times since servo_link_slopes, so that they come through steps of one tick too. */
#define SERVO_LINK_SLOPES_HELD 16u
static inline void servo_link_hold_slopes(servo_link_t *link)
{
    if (link->slopes_held < SERVO_LINK_SLOPES_HELD) {
        link->slopes_held++;
        link->slopes_wait |= 1u;
    }
}

/* Every turn of the main loop: goes on with this tick's traffic. One health poll (READ 24..43) a tick, round robin over
 * `present`: 31 servos take 0.24 s. A servo that misses is asked again in the following ticks and counts as silent after
 * SERVO_LINK_POLL_TRIES misses: named within 0.3 s. Silent ones stay in the round. */
void servo_link_poll(servo_link_t *link);

/* The next fault, or end of one, that was not told yet. false: none. */
bool servo_link_next_fault(servo_link_t *link, servo_fault_t *fault);

/* true while something of ours is on the wire. */
bool servo_link_is_busy(const servo_link_t *link);

/* Waits until the bus is quiet (at most 2 ms) and keeps it so until the next servo_link_tick: before bus calls of one's
 * own. */
void servo_link_quiet(servo_link_t *link);

/* Page coordinates of a joint <-> what the servo is told: trim added or taken off, limited to 0..1023. */
uint16_t servo_link_to_servo(const servo_link_t *link, uint8_t id, uint16_t pos);
uint16_t servo_link_to_page(const servo_link_t *link, uint8_t id, uint16_t servo_pos);

/* Offsets added to each goal (page_store_trim). One beyond +-SERVO_LINK_TRIM_MAX is taken as 0; returns the joints for which
 * that was so. NULL: no trim. Poses heard before are forgotten. */
uint32_t servo_link_set_trim(servo_link_t *link, const int16_t trim_pos[SERVO_LINK_JOINTS]);

/* WRITE of `count` (1..4) bytes from address `at` on to one servo that is present; blocks 0.4..0.9 ms. A servo that does not
 * answer WRITE (no_reply) is told and not waited for: true then says only that it was sent. false: an answer that was due
 * did not come. For the RAM area (address 24 on). servo_link_quiet first. */
MUST_CHECK bool servo_link_write(const servo_link_t *link, uint8_t id, uint8_t at, const uint8_t *from, uint8_t count);

/* What a WRITE to this servo is answered with, as bus_submit's answer_params: the one place that knows `no_reply`. */
uint8_t servo_link_write_answer(const servo_link_t *link, uint8_t id);

/* A call of one's own to a joint that is present was not answered, and the caller says so: it counts as silent, so that
 * servo_link_next_fault tells when it answers again. Those below do this for poses and torque. */
static inline void servo_link_lost(servo_link_t *link, uint8_t id)
{
    servo_link_put(&link->silent, id, true);
}

/* ---- blocking, for set-up; nothing may be moving; quiet the bus themselves; kick the watchdog ---- */

/* Looks for IDs 0..30 at 57,142 bps, then at 1 Mbps (where the bus stays): 0.25 s with nobody there, two tries each. Finds
 * out who is deaf to SYNC WRITE (by the LED, which is off afterwards), reads poses and torque. */
void servo_link_scan(servo_link_t *link);

/* Reads the present positions of `ids` into present_pos; returns those that answered. 0.3..0.9 ms a servo. */
uint32_t servo_link_read_pose(servo_link_t *link, uint32_t ids);

/* Torque on: where it is off, reads the pose, makes it the goal, then enables, so that nothing snaps; a torque limit that a
 * shutdown has cut to 0 comes back from the maximum torque (address 14). Where it is on already, nothing is touched. A servo
 * that does not tell its pose is left off. 2 ms a servo. Returns those of `ids` that are on now. */
uint32_t servo_link_torque_on(servo_link_t *link, uint32_t ids);

/* Torque off: SYNC WRITE, twice (nobody confirms it), and a WRITE to each deaf one. */
void servo_link_torque_off(servo_link_t *link, uint32_t ids);

/* Moving speed back to 0, as fast as possible: after moves with a speed of their own. */
void servo_link_full_speed(servo_link_t *link, uint32_t ids);

#endif
