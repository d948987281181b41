/* SPDX-License-Identifier: MIT
 * servo_link.h - the robot's joints: finds the servos, sends one tick's goals as one SYNC WRITE, reads one servo's health
 * in the rest of each tick. Callers use page coordinates; on the wire the trim is added and the sum limited to 0..1023.
 * Knows no pages. Uses bus.h (hal/DYNAMIXEL.md has the protocol). Main loop only. RAM: one servo_link_t.
 *
 *   servo_link.c         the traffic of a tick
 *   servo_link_setup.c   the blocking part: search, torque, poses
 *   servo_link_masks.c   masks of joints
 *
 * Never writes to a servo's EEPROM area.
 *
 * A tick on the bus at 1 Mbps with 31 joints (us after servo_link_goals). Slopes are sent only after they have changed:
 *
 *   0            1010                  2020                                                 7812
 *   | SYNC WRITE | [SYNC WRITE: slopes] | [REG WRITEs to the deaf] | READ of one servo | quiet |
 */
#ifndef SERVO_LINK_H
#define SERVO_LINK_H

#include <stdbool.h>
#include <stdint.h>
#include "compiler.h"

#define SERVO_LINK_JOINTS 31u            /* joint = servo ID 0..30 */
#define SERVO_LINK_ALL 0x7FFFFFFFul
#define SERVO_LINK_TRIM_MAX 300          /* a larger trim counts as damaged */
#define SERVO_LINK_POLL_TRIES 3u         /* unanswered polls, one per tick, until a servo counts as silent */
#define SERVO_LINK_NO_POSE 0xFFFFu       /* present_pos of a joint that was never read */

/* A joint's bit in a mask. The macro is for constants, the functions for variables: on the AVR a 32-bit shift is a loop, and
 * a 32-bit operation takes 8 to 16 bytes of code. */
#define SERVO_LINK_BIT(id) ((uint32_t)1 << (id))
uint32_t servo_link_bit(uint8_t id) NOINLINE;
bool servo_link_has(const uint32_t *mask, uint8_t id);
void servo_link_put(uint32_t *mask, uint8_t id, bool on);
uint8_t servo_link_lowest(const uint32_t *mask);   /* the mask must not be empty */

/* Faults of a servo, and recoveries. */
typedef enum {
    SERVO_FAULT_SILENT = 1,   /* no longer answers */
    SERVO_FAULT_BACK,         /* answers again (its torque may be off: see `torque`) */
    SERVO_FAULT_ERRORS,       /* reports errors: DXL_ERR_ bits in `errors` (voltage, angle, heat, overload); 0: no more */
    SERVO_FAULT_TORQUE,       /* its torque went off by itself */
    SERVO_FAULT_KINDS = SERVO_FAULT_TORQUE
} servo_fault_kind_t;

typedef struct {
    uint8_t id;
    uint8_t kind;             /* servo_fault_kind_t */
    uint8_t errors;
} servo_fault_t;

/* Public fields are read only for callers. Small fields come first: the AVR accesses 64 bytes from a pointer on cheaply. */
typedef struct {
    uint32_t present;         /* answered the last scan at 1 Mbps and is a joint (`endless`); includes silent servos */
    uint32_t torque;          /* torque is on, as last commanded or read (servo_link_assume_on) */
    uint32_t silent;          /* present, but silent now */
    uint32_t no_sync;         /* present, but deaf to SYNC WRITE: served by REG WRITE and ACTION */
    uint32_t no_reply;        /* present, but answers only READ (status return level 1) */
    uint32_t endless;         /* both angle limits are 0, endless turn: reported, not used */
    uint32_t outside;         /* present, but refused torque: a hand has left it outside its own angle limits */
    uint32_t slow;            /* answered at 57,142 bps: reported, not used (the monitor image makes them fast) */
    uint8_t voltage_dv;       /* lowest voltage of the last full round, 0.1 V; 0: none yet */
    uint8_t hottest_degrees;  /* highest temperature of the last full round, and its servo */
    uint8_t hottest_id;
    uint8_t late;             /* ticks whose goals could not all be sent in time; stops at 255 */
    /* Private. */
    uint8_t phase;
    uint8_t poll_id, poll_misses;
    bool poll_waits;                         /* the poll's answer is outstanding */
    uint8_t round_voltage_dv, round_degrees, round_degrees_id;
    const uint16_t *goals_pos;
    uint32_t goals_joints;                   /* the joints that this tick's goals are for */
    uint32_t slopes_pending;                 /* joints whose slopes must still be sent */
    uint32_t deaf_left;                      /* deaf joints whose REG WRITE must still be sent */
    uint32_t unreported[SERVO_FAULT_KINDS];  /* [kind - 1]: joints whose fault servo_link_next_fault must still return */
    /* Public again. */
    uint8_t errors[SERVO_LINK_JOINTS];       /* last DXL_ERR_ bits received: those of SERVO_FAULT_ERRORS */
    uint16_t present_pos[SERVO_LINK_JOINTS]; /* last pose read, page coordinates, or SERVO_LINK_NO_POSE */
    int16_t trim_pos[SERVO_LINK_JOINTS];     /* the offset that is added to each goal */
    uint8_t slopes[SERVO_LINK_JOINTS];       /* private: the last compliance byte requested; 0 = none */
} servo_link_t;

void servo_link_init(servo_link_t *link);

/* ---- running: called every tick, blocking no longer than the rest of a packet (1 ms) ---- */

/* Joints that may be driven now: present, not silent, torque on. */
uint32_t servo_link_drivable(const servo_link_t *link);

/* Call first in each tick, even if nothing moves: ends the last tick's traffic and allows this tick's health poll. */
void servo_link_tick(servo_link_t *link);

/* Sends one tick's goals (page coordinates 0..1023) of `joints`, except those that are not drivable. goal_pos must not
 * change during the tick: it is read again for deaf servos. Deaf servos take about 0.7 ms each (0.2 ms with a return delay
 * of 0, which no image sets). Those that do not fit into the tick follow in the next one, which counts in `late`. */
void servo_link_goals(servo_link_t *link, const uint16_t goal_pos[SERVO_LINK_JOINTS], uint32_t joints)
    NOINLINE;   /* a symbol of its own: the bench counts its cycles */

/* Sets the compliance bytes of a page (motion/PAGE_FORMAT.md: nibbles CW, CCW; 0 and above 7 count as 5). Those that have
 * changed follow the next goals in a SYNC WRITE of their own, as do those of a servo in which a health poll finds other
 * slopes. */
void servo_link_slopes(servo_link_t *link, const uint8_t compliance[SERVO_LINK_JOINTS]);

/* Call in every turn of the main loop: continues this tick's traffic. One health poll (READ 24..43) per tick, round robin
 * over `present`: 31 servos take 0.24 s. A servo that does not answer is polled again in the following ticks and reported
 * as silent after SERVO_LINK_POLL_TRIES tries, within 0.3 s. Silent servos stay in the round. */
void servo_link_poll(servo_link_t *link);

/* Takes the next new fault or recovery. false: none. */
bool servo_link_next_fault(servo_link_t *link, servo_fault_t *fault);

/* Waits until the bus is quiet (at most 2 ms) and keeps it quiet until the next servo_link_tick. Call it before using bus.h
 * directly. */
void servo_link_quiet(servo_link_t *link);

/* Page coordinates of a joint <-> servo coordinates: trim added or subtracted, limited to 0..1023. A limited position is for
 * pages and for people. A motion begins at that of servo_link_engage. */
uint16_t servo_link_to_servo(const servo_link_t *link, uint8_t id, uint16_t pos) NOINLINE;
uint16_t servo_link_to_page(const servo_link_t *link, uint8_t id, uint16_t servo_pos) NOINLINE;

/* A page coordinate in two's complement, limited to 0..1023. */
uint16_t servo_link_limited(uint16_t pos) NOINLINE;

/* Sets the offsets added to each goal (page_store_trim); NULL: none. An offset beyond +-SERVO_LINK_TRIM_MAX counts as 0.
 * Discards all poses read so far. */
void servo_link_set_trim(servo_link_t *link, const int16_t trim_pos[SERVO_LINK_JOINTS]);

/* Writes `count` (1..4) bytes from address `at` on to a servo that is present; blocks 0.4..0.9 ms. Call servo_link_quiet
 * first. For the RAM area (address 24 on). false: each of BUS_CALL_TRIES tries got no answer, or the servo rejected the
 * write, or, if it does not answer WRITE (no_reply), other bytes were read back (1.5 ms). Without any answer it counts as
 * silent. */
MUST_CHECK bool servo_link_write(servo_link_t *link, uint8_t id, uint8_t at, const uint8_t *from, uint8_t count);

/* The answer_params of bus_submit for a WRITE to this servo: 0, or BUS_NO_ANSWER if it is in `no_reply`. */
uint8_t servo_link_write_answer(const servo_link_t *link, uint8_t id);

/* Call when a present joint did not answer your own bus call: it then counts as silent, and servo_link_next_fault reports
 * when it answers again. The functions below do this themselves. */
static inline void servo_link_lost(servo_link_t *link, uint8_t id)
{
    servo_link_put(&link->silent, id, true);
}

/* ---- blocking, for set-up: nothing may be moving; these call servo_link_quiet and kick the watchdog ---- */

/* Searches IDs 0..30 at 57,142 bps, then at 1 Mbps (where the bus stays), with two tries each: 0.25 s without servos. Finds
 * the ones deaf to SYNC WRITE (by the LED, which is off afterwards). Reads poses and torque. */
void servo_link_scan(servo_link_t *link);

/* Reads the present positions of `ids` into present_pos; returns those that answered. 0.3..0.9 ms per servo. */
uint32_t servo_link_read_pose(servo_link_t *link, uint32_t ids);

/* Switches torque on where it is off. Reads the pose, makes it the goal, reads that back, then enables torque, so that no
 * servo jumps. Restores a torque limit that a shutdown has set to 0 from the maximum torque (address 14). A servo whose
 * pose or goal cannot be read stays off, as does one that stands outside its own angle limits (`outside`): it would leap to
 * the limit. 3 ms per servo. Returns those of `ids` that are on now. */
uint32_t servo_link_torque_on(servo_link_t *link, uint32_t ids);

/* Switches torque off: first of all servos at once by SYNC WRITE, then of each by a WRITE, which servos confirm. Returns
 * those that did; the others also count as off until a poll reads otherwise. If none is left on, the SYNC WRITE names
 * every ID: a servo that did not answer the last search may hold its pose. */
uint32_t servo_link_torque_off(servo_link_t *link, uint32_t ids);

/* Those of the servos that are silent count as on, so that one that comes back limp is reported as faulty. */
static inline void servo_link_assume_on(servo_link_t *link, uint32_t ids)
{
    link->torque |= ids & link->silent;
}

/* The bus is gone: no servo counts as on until it answers. */
static inline void servo_link_assume_off(servo_link_t *link)
{
    link->torque = 0;
}

/* Prepares a servo that is present for a goal every tick: switches torque on as above, reads its position, and sets the
 * moving speed to 0, which means full speed. A servo with a slow one may still be on its way (a single move): it stops where
 * it is, and its position becomes the goal. 4 ms. true: it is ready, and *pos is where it stands, or its goal if it is still
 * moving there at full speed; in page coordinates that are not limited (-300..1323, in two's complement): as a goal it moves
 * no joint, not even one that its trim puts outside 0..1023. */
MUST_CHECK bool servo_link_engage(servo_link_t *link, uint8_t id, uint16_t *pos);

#endif
