/* SPDX-License-Identifier: MIT
 * system.h - reset cause, watchdog, restart, sleep, ADC. Main loop only. RAM: 1 byte, and 6 that survive a reset. */
#ifndef SYSTEM_H
#define SYSTEM_H

#include <stdbool.h>
#include <stdint.h>

/* Reset causes, bits (several after a power-on with a slow supply). */
enum {
    SYSTEM_RESET_POWER_ON = 1 << 0,
    SYSTEM_RESET_EXTERNAL = 1 << 1,
    SYSTEM_RESET_BROWN_OUT = 1 << 2,
    SYSTEM_RESET_WATCHDOG = 1 << 3,
    SYSTEM_RESET_JTAG = 1 << 4
};

/* First thing in main: watchdog off, reset cause taken and cleared, vectors to the application. Interrupts are off and
 * stay off. */
void system_init(void);

uint8_t system_reset_cause(void);

/* Watchdog: 1.0 s nominal at 5 V. A kick costs one cycle. */
void system_watchdog_on(void);
void system_kick(void);

/* Restarts the controller through the watchdog, within 20 ms; the boot loader then decides what runs. A word for the
 * next start may be left with system_set_note. Never returns. */
void system_restart(void) __attribute__((noreturn));

/* Waits for an interrupt with the CPU stopped. Call with interrupts disabled, after having looked that there is nothing
 * to do; enables them and sleeps in one step, so that nothing slips in between. Returns with interrupts enabled. */
void system_sleep(void);

/* A failed ASSERT of the run before this reset: the line, and the byte address it was called from; false: none.
 * Told once. */
bool system_take_failed_assert(uint16_t *line, uint32_t *address);

/* One conversion of an ADC channel (0..7) against AREF: 0..1023. Blocks 104 us. The battery stands on channels 0 and 1
 * behind a divider that is not documented, so it is not turned into volts here: servos report theirs. */
uint16_t system_adc(uint8_t channel);

#endif
