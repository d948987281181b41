/* SPDX-License-Identifier: MIT
 * board_debug.h - looking into the running firmware: symbols, stack, cycles of a function, interrupts at every place of
 * one, GDB. Part of board.h. */
#ifndef SIM_BOARD_DEBUG_H
#define SIM_BOARD_DEBUG_H

#include "board.h"

/* Where a function (flash byte address) or a variable (data address) of the loaded ELF files is, UINT32_MAX if
 * nowhere. Matches the name up to a dot, as -flto makes "player_tick.constprop.0" of "player_tick"; a function may also
 * be a number ("0x1F238"). */
uint32_t board_function(const board_t *board, const char *name);
uint32_t board_variable(const board_t *board, const char *name);

/* Name of the function at a flash address, "?" if unknown. Good until the next board_load(). */
const char *board_function_at(const board_t *board, uint32_t address);

/* Current program counter (byte address). */
uint32_t board_pc(const board_t *board);

/* Stack: lowest address the stack pointer has pointed to since the running image set it up, and the bytes between
 * the end of that image's variables and there that were never used. */
uint32_t board_stack_low(const board_t *board);
uint32_t board_stack_headroom(const board_t *board);

/* Counts the cycles of a function from its first instruction to its return: total (what a stop-watch shows) and own
 * (interrupts taken out). false: no such function, or 32 probes are in use. */
typedef struct {
    uint64_t calls;
    uint64_t total_max, total_sum, own_max, own_sum;
    uint64_t last_total, last_own;
    uint64_t max_at; /* cycle at which the call with the largest own time returned */
} probe_t;
bool board_probe(board_t *board, const char *function);
const probe_t *board_probe_result(const board_t *board, const char *function);
void board_probe_clear(board_t *board); /* figures back to 0, probes stay */

/* How often the interrupt of a vector 1..34 was taken. */
uint64_t board_interrupt_count(const board_t *board, int vector);
/* The longest interrupt of a vector, in cycles: response, return and nested ones included. */
uint64_t board_interrupt_max(const board_t *board, int vector);

/* Raises an interrupt now, as if its cause had just come: a timer's flag (vectors 9..16, 24..29); a received character
 * (18, 30), which is `byte`; or the character that a UART is sending has left (19, 20, 31, 32; earlier than its time).
 * What mask and I flag then make of it is the chip's business. false: no other vector can be raised. */
bool board_interrupt(board_t *board, int vector, uint8_t byte);

/* A sweep: from now on every call of a function is interrupted once. The first call before its first instruction, the
 * next behind its first one, the next behind its second, and so on; instructions of what it calls count, those of
 * interrupts do not. A call that is over before its place comes ends the round: the next one begins again.
 * What must not be torn has to come out right at every place. false: no such function, or vector that cannot be raised,
 * or 32 sweeps are in use. The same function again: begins anew. Calls inside a swept call are not swept. */
typedef struct {
    uint32_t place;  /* of the next call: how many of its instructions come before the interrupt */
    uint64_t calls;  /* that have returned */
    uint64_t rounds; /* times that all places were visited */
    uint64_t taken;  /* calls in which the interrupt was served before they returned */
    uint64_t last;   /* cycles of the last call from the interrupt's being raised to its return; 0: none was raised */
} sweep_t;
bool board_sweep(board_t *board, const char *function, int vector, uint8_t byte);
const sweep_t *board_sweep_result(const board_t *board, const char *function);
void board_sweep_end(board_t *board); /* of all */

/* Rounds of loops that only wait are counted instead of executed, from now on: the same run to the cycle, seven times as
 * fast in a boot loader that waits for the PC. Probes and sweeps do not see those rounds. Off at first. */
void board_skip_waits(board_t *board, bool on);

/* Executes one instruction (or one interrupt response) and returns its cycles. For tests of the model itself. */
uint32_t board_step(board_t *board);

/* A GDB server on 127.0.0.1:port; the run waits for it at once if wait is true. false: board_error(). */
bool board_gdb(board_t *board, int port, bool wait);

#endif
