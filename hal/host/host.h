/* SPDX-License-Identifier: MIT
 * host.h - the interfaces between the files of hal/host. Bytes that interrupts receive on the chip are fetched here whenever
 * the firmware waits or kicks the watchdog. */
#ifndef HOST_H
#define HOST_H

#include <stdbool.h>
#include <stdint.h>

#define HOST_TICK_HALF_US 15625u   /* 1/128 s */

/* system.c: moves the bytes of both lines, in both directions. */
void host_fetch(void);
/* The same, then sleeps until `until` (machine_now) or the next byte. */
void host_wait(uint64_t until);

/* bus.c, console.c: their part of host_fetch. */
void host_fetch_bus(void);
void host_fetch_console(void);

/* console.c: what system_sleep calls, and whether the program has slept with nothing left to carry out or to print since the
 * last input. */
void host_console_rest(void);
bool host_console_has_rested(void);

/* time.c */
uint64_t host_next_tick(void);

/* bus.c: when the last byte of our last packet has left. */
uint64_t host_line_free(void);
/* bus.c: whether goals were sent within the last 0.25 s. */
bool host_is_moving(void);
/* bus.c: whether servos may hold their pose because of this program. */
bool host_has_held(void);
/* bus.c: switches the torque of all servos off, whatever the firmware does. */
void host_torque_off(void);

/* memory.c: loads the kept memories. Call before anything else. record: the image's record, for MEM_APP_RECORD. */
void host_recall(const void *record, uint16_t bytes);
/* memory.c: commits the kept EEPROM. Call while nothing moves. */
void host_settle(void);

#endif
