/* SPDX-License-Identifier: MIT
 * board.h - a CM-5 or CM-2 controller board with its ATmega128, as strict as the chip: power, time, code, reset.
 * The rest of the interface: board_ports.h (console, servo bus, panel), board_memory.h (flash, EEPROM, power cuts),
 * board_debug.h (symbols, stack, probes, GDB). Any number of boards may exist. Threads must not share a board.
 *
 * Time is counted in cycles of 16 MHz since board_new(). It never runs backwards and goes on while the power is off.
 * The same seed, images and calls give the same run, to the cycle.
 *
 * README.md lists what the board overrides in libsimavr, and why. */
#ifndef SIM_BOARD_H
#define SIM_BOARD_H

#include <stdbool.h>
#include <stdint.h>

#include "violation.h"

#define BOARD_CYCLES_PER_MS 16000u

typedef struct board board_t;
struct servo_bus;

typedef enum { BOARD_CM5, BOARD_CM2 } board_kind_t;

/* Why board_run() returned. */
typedef enum {
    BOARD_STOP_TIME,      /* the requested time is over */
    BOARD_STOP_VIOLATION, /* see board_violation(); running on repeats it */
    BOARD_STOP_POWER_CUT, /* the armed power cut has happened; power is off */
    BOARD_STOP_TEXT,      /* board_stop_on_text() */
    BOARD_STOP_ADDRESS,   /* board_stop_at() */
    BOARD_STOP_REQUEST    /* board_stop() from a callback */
} board_stop_t;

/* Reset causes, the bits of MCUCSR. */
typedef enum { RESET_POWER_ON = 1, RESET_EXTERNAL = 2, RESET_BROWN_OUT = 4, RESET_WATCHDOG = 8 } reset_cause_t;

/* Makes a board without power: flash and EEPROM erased, no servos, no button pressed. seed: contents of the SRAM at
 * power-on and of torn flash. NULL: libsimavr has no ATmega128, or out of memory. */
board_t *board_new(board_kind_t kind, uint32_t seed);
void board_free(board_t *board);

/* Loads an Intel HEX (*.hex) or ELF (*.elf) file at its own addresses, any other file as binary at address. Symbols
 * come from the ELF file of the same name in the same folder. Without it, functions have no names and the stack guard
 * ends at the start of the SRAM. false: nothing was loaded; board_error() says why. */
bool board_load(board_t *board, const char *path, uint32_t address);
const char *board_error(const board_t *board);

/* The BOOTRST fuse: programmed, a reset starts at 0x1E000 instead of 0. board_load() programs it for an image there. */
void board_set_bootrst(board_t *board, bool programmed);

/* Power on: power-on reset, random SRAM; also powers the servos. Neither call does anything in its own state. */
void board_power_on(board_t *board);
void board_power_off(board_t *board);
bool board_is_powered(const board_t *board);

/* A supply dip that the brown-out detector catches: reset, SRAM kept. */
void board_brown_out(board_t *board);

/* The MODE button is the reset pin. true: holds the chip in reset. */
void board_hold_reset(board_t *board, bool held);

/* Number of resets since board_new(), and the cause of the last one. */
uint32_t board_resets(const board_t *board);
reset_cause_t board_reset_cause(const board_t *board);

/* Runs for this many cycles and ends at the first instruction boundary after them. Skips the time asleep. */
board_stop_t board_run(board_t *board, uint64_t cycles);
uint64_t board_now(const board_t *board);

/* Cycles in which the CPU executed instructions (neither asleep nor halted). */
uint64_t board_busy_cycles(const board_t *board);

/* More ways to end a run; each works once. NULL or UINT32_MAX: none. */
void board_stop_on_text(board_t *board, const char *console_text);
void board_stop_at(board_t *board, uint32_t flash_address);
void board_stop(board_t *board);

/* The violation that ended the run, or kind VIOLATION_NONE. After clearing it, the board can run on. */
const violation_t *board_violation(const board_t *board);
void board_clear_violation(board_t *board);

/* Allows a kind (it is only counted) or forbids it again. At first all are forbidden except VIOLATION_UNEXPECTED_RESET
 * and VIOLATION_BUS_OVERRUN. */
void board_allow(board_t *board, violation_kind_t kind, bool allowed);
uint32_t board_violations(const board_t *board, violation_kind_t kind);

#endif
