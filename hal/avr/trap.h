/* SPDX-License-Identifier: MIT
 * trap.h - ASSERT, AVR version (host version: tests/fake/trap.h). For our own mistakes only, never for what comes from
 * outside. A failed one notes line and place where they survive a reset, and restarts; the next start can tell
 * (system_take_failed_assert), and avr-addr2line makes a file name of the address. RAM: 6 bytes of .noinit. */
#ifndef TRAP_H
#define TRAP_H

#include <stdint.h>

typedef struct {
    uint16_t magic;          /* TRAP_MAGIC: the rest is true */
    uint16_t line;
    uint16_t word_address;   /* where trap_failed was called from */
} trap_record_t;

#define TRAP_MAGIC 0x7A9Du

extern trap_record_t trap_record;

void trap_failed(uint16_t line) __attribute__((noreturn, noinline));

#define ASSERT(condition) do { if (!(condition)) { trap_failed((uint16_t)__LINE__); } } while (0)

#endif
