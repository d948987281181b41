/* SPDX-License-Identifier: MIT
 * machine.h - what all parts of chip and board share: simavr's core, the end of a run, violations, random numbers,
 * events, notes on instructions, and the effects of parts on the CPU. Knows no part. */
#ifndef SIM_MACHINE_H
#define SIM_MACHINE_H

#include <simavr/sim_avr.h>

#include "board.h"
#include "events.h"
#include "m128.h"
#include "symbols.h"

/* What a part does when its interrupt is taken, and when a test raises it. */
typedef struct {
    void (*taken)(void *context, int vector);
    void (*raise)(void *context, int vector, uint8_t byte);
    void *context;
} interrupt_source_t;

typedef struct {
    avr_t *avr;
    events_t events;
    symbols_t symbols;
    uint32_t random; /* xorshift state */

    /* The run */
    bool stopped;
    board_stop_t stop;
    violation_t violation;
    bool allowed[VIOLATION_COUNT];
    uint32_t violations[VIOLATION_COUNT];

    /* Code: what cpu.c must check, by flash word (opcode.h). */
    uint16_t note[M128_FLASH_BYTES / 2];
    uint8_t mark[M128_FLASH_BYTES / 2]; /* notes that survive a change of the flash */

    /* Effects of parts on the CPU */
    bool powered;
    bool held;                /* in reset */
    bool sleeping;
    uint32_t fetch_floor;     /* addresses below are busy (RWW) */
    uint64_t halted_until;    /* CPU stopped by an NRWW page operation */
    uint32_t vector_base;     /* 0 or 0x1E000 (IVSEL) */
    uint64_t interrupts_from; /* none before this cycle (IVCE) */
    uint64_t lines;           /* interrupt requests of our own parts, bit n = vector n */
    interrupt_source_t source[VECTOR_COUNT];
    bool (*before_lpm)(void *context, uint32_t pc, uint16_t opcode); /* LPM, ELPM, SPM. true: done or refused */
    void *before_lpm_context;

    /* What a loop can see change without an event (waits.c) */
    uint64_t unsettled_until;
    uint16_t count_cycles[2]; /* cycles per count of timers 1 and 3; 0: stopped */
} machine_t;

/* false: libsimavr has no ATmega128, or out of memory. */
bool machine_init(machine_t *machine, uint32_t seed);
void machine_free(machine_t *machine);

uint32_t machine_random(machine_t *machine);
void machine_end_run(machine_t *machine, board_stop_t why);

/* Replaces simavr's handlers of one register. NULL: plain memory. */
void machine_io(machine_t *machine, uint16_t address, avr_io_read_t read, avr_io_write_t write, void *param);

/* For register handlers: the cycle at which the current instruction ends. */
uint64_t machine_instruction_end(const machine_t *machine);

/* Sets the request level of one of our own parts. Requests of simavr's parts come from its flag registers. */
void machine_line(machine_t *machine, int vector, bool level);

/* Until then, registers may change without an event. */
void machine_unsettled(machine_t *machine, uint64_t until);

/* Makes the notes again after a write to the flash. */
void machine_code_changed(machine_t *machine, uint32_t address, uint32_t count);
void machine_mark(machine_t *machine, uint32_t address, unsigned mark);
void machine_unmark(machine_t *machine, uint32_t address, unsigned mark);

/* Whether simavr has logged an error for the chip since the last call. Under GDB its state does not tell a bad access from a
 * watchpoint. */
bool machine_take_error(const machine_t *machine);

/* true: the run must end, and the caller leaves the chip's state alone. */
__attribute__((format(printf, 3, 4)))
bool violation_note(machine_t *machine, violation_kind_t kind, const char *format, ...);

#endif
