/* SPDX-License-Identifier: MIT
 * opcode.h - what cpu.c must check before or after an instruction, derived from its opcode alone. */
#ifndef SIM_OPCODE_H
#define SIM_OPCODE_H

#include <stdbool.h>
#include <stdint.h>

/* Notes by flash word. Most are zero: the instruction only computes. The first four are marks set by other files;
 * opcode_note() returns the rest. */
enum {
    NOTE_PROBE = 0x01,   /* first instruction of a probed function */
    NOTE_SWEEP = 0x02,   /* first instruction of a swept function */
    NOTE_RETURN = 0x04,  /* where a probed function may return to */
    NOTE_STOP = 0x08,    /* cpu_stop_at() */
    NOTE_STACK = 0x10,   /* PUSH, calls: writes below the stack pointer */
    NOTE_FLASH = 0x20,   /* LPM, ELPM, SPM */
    NOTE_SLEEP = 0x40,
    NOTE_RETI = 0x80,
    NOTE_WRONG = 0x100,  /* erased, illegal or BREAK */
    NOTE_DEVICE = 0x200, /* may read or write a register of a device, or change the I flag */
    NOTE_BACK = 0x400,   /* jumps back: a wait loop closes here (waits.c) */
    NOTE_TOUCHES = 0x800 /* not in a wait loop: reads what changes by itself, or has side effects. Never set alone */
};

uint16_t opcode_note(uint16_t opcode, uint16_t next_word);
bool opcode_is_legal(uint16_t opcode);
bool opcode_is_push(uint8_t high_byte);

#endif
