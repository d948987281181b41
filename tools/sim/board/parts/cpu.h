/* SPDX-License-Identifier: MIT
 * cpu.h - executing instructions and taking interrupts, with a look at each: cpu.c, opcode.c, interrupt.c. */
#ifndef SIM_PARTS_CPU_H
#define SIM_PARTS_CPU_H

#include "board.h"
#include "m128.h"

/* What cpu.c must look at before or behind an instruction, by flash word. Zero for most: they only compute. */
enum {
    NOTE_STACK = 0x01,   /* PUSH, calls: writes below the stack pointer */
    NOTE_FLASH = 0x02,   /* LPM, ELPM, SPM */
    NOTE_SLEEP = 0x04,
    NOTE_RETI = 0x08,
    NOTE_WRONG = 0x10,   /* erased, illegal or BREAK */
    NOTE_PROBE = 0x20,   /* first instruction of a probed or swept function */
    NOTE_RETURN = 0x40,  /* where a probed function may return to */
    NOTE_STOP = 0x80,    /* board_stop_at() */
    NOTE_DEVICE = 0x100, /* may read or write a register of a device, or change the I flag */
    NOTE_BACK = 0x200    /* jumps back: where a wait goes round (waits.c) */
};

/* What an interrupt must leave as it found it. */
typedef struct {
    uint8_t r[32], flags, rampz; /* flags: SREG without I */
} registers_t;

typedef struct {
    uint16_t note[M128_FLASH_BYTES / 2];
    uint64_t lines;        /* interrupt requests of our own modules, bit n = vector n */
    bool sleeping;
    bool enabled_before;   /* I was set before the last instruction too: an interrupt may come */
    uint32_t fetch_floor;  /* addresses below are busy (RWW) */
    uint64_t halted_until; /* CPU stopped by an NRWW page operation */
    uint64_t idle_cycles;
    uint32_t vector_base;  /* 0 or 0x1E000 (IVSEL) */
    uint8_t depth;         /* interrupts nested */
    uint64_t entered[16];
    uint8_t vector[16];
    registers_t found[16]; /* when the interrupt was taken */
    uint64_t interrupt_cycles, count[VECTOR_COUNT], longest[VECTOR_COUNT];
} cpu_t;

void cpu_init(board_t *board);
void cpu_reset(board_t *board, uint32_t pc);
void cpu_run(board_t *board); /* until board_end_run() */
void cpu_flash_changed(board_t *board, uint32_t address, uint32_t count);

/* For register handlers: when the instruction being executed will be over. */
uint64_t cpu_instruction_end(const board_t *board);

uint16_t opcode_note(uint16_t opcode);
bool opcode_is_legal(uint16_t opcode);
bool opcode_is_push(uint8_t high_byte);
bool opcode_jumps_back(uint16_t opcode);

/* Requests of our own modules are levels; simavr's are read from its flag registers. */
void interrupt_line(board_t *board, int vector, bool level);
bool interrupt_take(board_t *board);         /* true: one was taken */
void interrupt_return(board_t *board);       /* a RETI was executed */
bool interrupt_can_be_raised(int vector);    /* by board_interrupt() */

#endif
