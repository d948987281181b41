/* SPDX-License-Identifier: MIT
 * opcode.h - what cpu.c must look at before or behind an instruction, told from its opcode alone. */
#ifndef SIM_OPCODE_H
#define SIM_OPCODE_H

#include <stdbool.h>
#include <stdint.h>

/* Notes by flash word. Zero for most: they only compute. The first four are marks, made by others; opcode_note() has the
 * rest. */
enum {
    NOTE_PROBE = 0x01,   /* first instruction of a probed function */
    NOTE_SWEEP = 0x02,   /* of a swept one */
    NOTE_RETURN = 0x04,  /* where a probed function may return to */
    NOTE_STOP = 0x08,    /* cpu_stop_at() */
    NOTE_STACK = 0x10,   /* PUSH, calls: writes below the stack pointer */
    NOTE_FLASH = 0x20,   /* LPM, ELPM, SPM */
    NOTE_SLEEP = 0x40,
    NOTE_RETI = 0x80,
    NOTE_WRONG = 0x100,  /* erased, illegal or BREAK */
    NOTE_DEVICE = 0x200, /* may read or write a register of a device, or change the I flag */
    NOTE_BACK = 0x400,   /* jumps back: where a wait goes round (waits.c) */
    NOTE_TOUCHES = 0x800 /* not for a wait: what it reads changes by itself, or what it does has effects. Never alone */
};

uint16_t opcode_note(uint16_t opcode, uint16_t next_word);
bool opcode_is_legal(uint16_t opcode);
bool opcode_is_push(uint8_t high_byte);

#endif
