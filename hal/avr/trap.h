/* SPDX-License-Identifier: MIT
 * trap.h - ASSERT, AVR version (host version: hal/host/trap.h). Only for programming errors, never for external input.
 * A failed ASSERT stores its line and address in RAM that survives a reset, and restarts. The next start reports it
 * (system_take_failed_assert); avr-addr2line converts the address into a file name. */
#ifndef TRAP_H
#define TRAP_H

#include <stdint.h>

typedef struct {
    uint16_t magic;          /* TRAP_MAGIC: the record is valid */
    uint16_t line;
    uint16_t word_address;   /* of the call of trap_failed */
} trap_record_t;

#define TRAP_MAGIC 0x7A9Du

extern trap_record_t trap_record;

void trap_failed(uint16_t line) __attribute__((noreturn, noinline));

#define ASSERT(condition) do { if (!(condition)) { trap_failed((uint16_t)__LINE__); } } while (0)

#endif
