/* SPDX-License-Identifier: MIT
 * machine.h - what hal/host needs of the computer below it: lines, clock, memory, keys. The other half is chosen by the
 * linker:
 *   pc/            a Linux PC: serial port, terminal, files, the computer's clock
 *   simtime/       simulated time, for simulated servos
 *   web/           a web page: these functions are imported from it
 * Everything returns at once but machine_wait, machine_bus_rate, machine_keep and machine_end. One caller: the program's
 * only thread. */
#ifndef MACHINE_H
#define MACHINE_H

#include <stdbool.h>
#include <stdint.h>

/* ---- time ---- */

/* Half microseconds since the program began. Never falls. */
uint64_t machine_now(void);

/* Sleeps until that moment, or until bytes have come on a line, whichever is first. May return early for no reason. */
void machine_wait(uint64_t until);

/* ---- the servo bus ---- */

/* Whether the port is open. A port that goes away is opened again by the machine when it comes back. */
bool machine_bus_is_there(void);

/* Half microseconds that an answer may take before one has been measured: what the adapter and its driver are known for. */
uint32_t machine_bus_first_patience(void);

/* The same at the least, however fast the answers have been: a busy computer may look that late. */
uint32_t machine_bus_least_patience(void);

/* Sets the rate of a divisor (bus.h), or the one that the person wants in place of 1 Mbps. Returns bits a second. */
uint32_t machine_bus_rate(uint8_t divisor);

/* Sends one packet, in one piece. What cannot be sent is lost, as on a cable. */
void machine_bus_write(const uint8_t *bytes, uint16_t count);

/* Takes up to `room` bytes that have come. Returns how many. */
uint16_t machine_bus_read(uint8_t *to, uint16_t room);

/* ---- the console ---- */

uint16_t machine_console_read(uint8_t *to, uint16_t room);

/* Returns how many were taken; the caller tries the others again. */
uint16_t machine_console_write(const uint8_t *bytes, uint16_t count);

/* Buttons of the panel that are down (panel.h). */
uint8_t machine_buttons(void);

/* Tells the person a sentence, beside the console. */
void machine_tell(const char *sentence);

/* ---- memory that stays ---- */

typedef enum { MACHINE_PAGES = 0, MACHINE_JOURNAL, MACHINE_EEPROM, MACHINE_MEMORIES } machine_memory_t;

/* Fills in what was kept; false: nothing was, and nothing is touched. */
bool machine_recall(machine_memory_t memory, uint8_t *bytes, uint32_t count);

/* Replaces `count` bytes at `at`. true: it is kept if the power fails from now on (`now` false: if the program ends). A
 * power cut meanwhile may leave any mixture of old and new bytes there, and touches no others. */
bool machine_keep(machine_memory_t memory, uint32_t at, const uint8_t *bytes, uint32_t count, bool now);

/* Makes what was kept with `now` false sure. Takes milliseconds. */
void machine_settle(machine_memory_t memory);

/* ---- life ---- */

/* Ends the program if this is not called for a second. */
void machine_watch(void);

/* Whether somebody wants the program to end: it brings the robot to a stand and calls machine_end. */
bool machine_is_asked_to_end(void);
_Noreturn void machine_end(void);

#endif
