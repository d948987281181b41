/* SPDX-License-Identifier: MIT
 * trap.h - ASSERT, AVR version (host version: tests/fake/trap.h). For our own mistakes only, never for what comes from
 * outside. A failed one notes line and address where they survive a reset, and restarts (system.h tells them). */
#ifndef TRAP_H
#define TRAP_H

#include <stdint.h>

void trap_failed(uint16_t line) __attribute__((noreturn, noinline));

#define ASSERT(condition) do { if (!(condition)) { trap_failed((uint16_t)__LINE__); } } while (0)

#endif
