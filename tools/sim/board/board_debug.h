/* SPDX-License-Identifier: MIT
 * board_debug.h - looks into the running firmware: symbols, stack, cycles of a function, interrupts at each of its
 * instructions, GDB. Part of board.h. */
#ifndef SIM_BOARD_DEBUG_H
#define SIM_BOARD_DEBUG_H

#include "board.h"

/* Address of a function (flash, in bytes) or a variable (data space) in the loaded ELF files; UINT32_MAX if unknown.
 * Matches the name up to a dot, because -flto turns "player_tick" into "player_tick.constprop.0". A function may also
 * be a number ("0x1F238"). */
uint32_t board_function(const board_t *board, const char *name);
uint32_t board_variable(const board_t *board, const char *name);

/* Name of the function at a flash address, "?" if unknown. Valid until the next board_load(). */
const char *board_function_at(const board_t *board, uint32_t address);

/* Current program counter (byte address). */
uint32_t board_pc(const board_t *board);

/* Stack: the lowest address used since the running image set up the stack pointer, and the bytes between there and the
 * end of that image's variables, which were never used. */
uint32_t board_stack_low(const board_t *board);
uint32_t board_stack_headroom(const board_t *board);

/* Counts the cycles of a function from its first instruction to its return: total (as on a stop-watch) and own (without
 * interrupts). false: no such function, or 32 probes are in use. */
typedef struct {
    uint64_t calls;
    uint64_t total_max, total_sum, own_max, own_sum;
    uint64_t last_total, last_own;
    uint64_t max_at; /* cycle at which the call with the largest own time returned */
} probe_t;
bool board_probe(board_t *board, const char *function);
const probe_t *board_probe_result(const board_t *board, const char *function);
void board_probe_clear(board_t *board); /* sets the figures to 0, keeps the probes */

/* Number of interrupts taken through a vector 1..34. */
uint64_t board_interrupt_count(const board_t *board, int vector);
/* The longest interrupt of a vector, in cycles, with its response, its return and nested interrupts. */
uint64_t board_interrupt_max(const board_t *board, int vector);

/* Raises an interrupt now, as if its cause had just occurred: a timer flag (vectors 9..16, 24..29), the received
 * character `byte` (18, 30), or the end of the character being sent (19, 20, 31, 32; earlier than due). The interrupt
 * mask and the I flag apply as usual. false: this vector cannot be raised. */
bool board_interrupt(board_t *board, int vector, uint8_t byte);

/* A sweep interrupts every call of a function once, from now on: the first call before its first instruction, the next
 * call after the first instruction, the next after the second, and so on. Instructions of called functions count, those
 * of interrupts do not. When a call ends before its turn, the round is over and the next one begins. An atomic section
 * must give the right result at every place. Calls inside a swept call are not swept. Sweeping the same function again
 * starts over. false: no such function, the vector cannot be raised, or 32 sweeps are in use. */
typedef struct {
    uint32_t place;  /* for the next call: number of its instructions before the interrupt */
    uint64_t calls;  /* calls that have returned */
    uint64_t rounds; /* number of times all places were visited */
    uint64_t taken;  /* calls that served the interrupt before they returned */
    uint64_t last;   /* cycles from the interrupt request to the return of the last call; 0: none was raised */
} sweep_t;
bool board_sweep(board_t *board, const char *function, int vector, uint8_t byte);
const sweep_t *board_sweep_result(const board_t *board, const char *function);
void board_sweep_end(board_t *board); /* ends all sweeps */

/* Counts the rounds of loops that only wait, instead of executing them. The run stays the same to the cycle and is
 * seven times as fast in a boot loader that waits for the PC. Probes and sweeps do not see those rounds. Off at
 * first. */
void board_skip_waits(board_t *board, bool on);

/* Executes one instruction or interrupt response and returns its cycles. For tests of the model itself. */
uint32_t board_step(board_t *board);

/* Starts a GDB server on 127.0.0.1:port. If wait is true, the run waits for GDB at once. false: see board_error(). */
bool board_gdb(board_t *board, int port, bool wait);

#endif
