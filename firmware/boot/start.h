/* SPDX-License-Identifier: MIT
 * start.h - leaving the loader. */
#ifndef START_H
#define START_H

#include <stdbool.h>
#include <stdint.h>

/* Jumps to word address `word`, in the state of ORIGINAL.md, section 5: interrupts off, vectors at 0, UART1 on at 57,143
 * with its receive interrupt, UART0 on, timers as after reset. MCUCSR is unchanged, so the application still sees the reset
 * cause. */
void start_jump(uint16_t word) __attribute__((noreturn));

/* Resets the chip by its watchdog, after 16 ms. */
void start_reset(void) __attribute__((noreturn));

/* EEPROM 0xFFF: stay in the loader ("system") or start the application. */
#define START_MODE_SYSTEM 0xFFu
#define START_MODE_APPLICATION 0x11u

#endif
