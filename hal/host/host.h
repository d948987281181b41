/* SPDX-License-Identifier: MIT
 * host.h - how the files of hal/host see each other. The bytes that interrupts bring on the chip are fetched here when the
 * firmware waits, and whenever it kicks the watchdog. */
#ifndef HOST_H
#define HOST_H

#include <stdbool.h>
#include <stdint.h>

#define HOST_TICK_HALF_US 15625u   /* 1/128 s */

/* system.c: moves the bytes of both lines, both ways. */
void host_fetch(void);
/* The same, then sleeps until `until` (machine_now) or the next byte. */
void host_wait(uint64_t until);

/* bus.c, console.c: their part of host_fetch. */
void host_fetch_bus(void);
void host_fetch_console(void);

/* time.c */
uint64_t host_next_tick(void);

/* bus.c: when the last byte of our last packet has left. */
uint64_t host_line_free(void);
/* bus.c: whether goals have been sent within the last quarter of a second. */
bool host_is_moving(void);
/* bus.c: whether servos may hold their pose because of this program. */
bool host_has_held(void);
/* bus.c: tells every servo to switch its torque off, at once and whatever the firmware does. */
void host_torque_off(void);

/* memory.c: fetches what was kept. Before anything else. record: what the image says of itself, at MEM_APP_RECORD. */
void host_recall(const void *record, uint16_t bytes);
/* memory.c: makes sure what was kept, once nothing moves. */
void host_settle(void);

#endif
