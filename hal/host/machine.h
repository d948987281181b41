/* SPDX-License-Identifier: MIT
 * machine.h - the computer as hal/host uses it: lines, clock, memory, keys. The linker selects an implementation:
 *   pc/            a Linux PC: serial port, terminal, files, the computer's clock
 *   simtime/       simulated time, for simulated servos
 *   web/           a web page: these functions are imported from it
 * Only machine_wait, machine_bus_rate, machine_bus_write, machine_keep, machine_settle and machine_end may block. One
 * caller: the program's only thread. */
#ifndef MACHINE_H
#define MACHINE_H

#include <stdbool.h>
#include <stdint.h>

/* ---- time ---- */

/* Half microseconds since the program began. Never falls. */
uint64_t machine_now(void);

/* Sleeps until that time, or until bytes arrive on a line, whichever comes first. May return early for no reason. */
void machine_wait(uint64_t until);

/* ---- the servo bus ---- */

/* Whether the port is open. The machine reopens a lost port when it returns. */
bool machine_bus_is_there(void);

/* Time-out in half microseconds before an answer time was measured: the known delay of the adapter and its driver. */
uint32_t machine_bus_first_patience(void);

/* The least time-out, however fast the answers have been: a busy computer may check this late. */
uint32_t machine_bus_least_patience(void);

/* Sets the rate of a divisor (bus.h), or the user's rate in place of 1 Mbps. Returns bits per second. */
uint32_t machine_bus_rate(uint8_t divisor);

/* Sends one packet, in one piece. Bytes that cannot be sent are lost, as on a cable. In a browser it blocks while the port
 * takes no bytes: so ticks come late, which ends a play, and goals never pile up. */
void machine_bus_write(const uint8_t *bytes, uint16_t count);

/* Takes up to `room` received bytes. Returns their number. */
uint16_t machine_bus_read(uint8_t *to, uint16_t room);

/* ---- the console ---- */

uint16_t machine_console_read(uint8_t *to, uint16_t room);

/* Returns the number of bytes taken; the caller retries the rest. */
uint16_t machine_console_write(const uint8_t *bytes, uint16_t count);

/* Panel buttons that are down (panel.h). */
uint8_t machine_buttons(void);

/* Shows the user a message, outside the console. */
void machine_tell(const char *sentence);

/* ---- persistent memory ---- */

typedef enum { MACHINE_PAGES = 0, MACHINE_JOURNAL, MACHINE_EEPROM, MACHINE_MEMORIES } machine_memory_t;

/* Fills in the kept contents. false: there are none; `bytes` is unchanged or has the initial motions (pc/). */
bool machine_recall(machine_memory_t memory, uint8_t *bytes, uint32_t count);

/* Replaces `count` bytes at `at`. true: they now survive a power cut (`now` false: only the end of the program). A power cut
 * meanwhile may leave any mixture of old and new bytes there, but affects no others. Bytes kept with `now` false are written
 * in order: a power cut leaves the memory as it was at some moment after machine_settle. A disk does so, because all copies
 * of the settings lie in one of its sectors. */
bool machine_keep(machine_memory_t memory, uint32_t at, const uint8_t *bytes, uint32_t count, bool now);

/* Makes bytes kept with `now` false survive a power cut. Takes milliseconds. */
void machine_settle(machine_memory_t memory);

/* ---- life ---- */

/* Call at least once per second; otherwise the machine ends the program. */
void machine_watch(void);

/* Whether the program should end: it stops the robot and calls machine_end. */
bool machine_is_asked_to_end(void);
_Noreturn void machine_end(void);

#endif
