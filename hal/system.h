/* SPDX-License-Identifier: MIT
 * system.h - reset cause, watchdog, restart, sleep, ADC. Main loop only. */
#ifndef SYSTEM_H
#define SYSTEM_H

#include <stdbool.h>
#include <stdint.h>

/* Reset causes, bits. Several after a power-on with a slow supply, and after a reset of the loader at its prompt. */
enum {
    SYSTEM_RESET_POWER_ON = 1 << 0,
    SYSTEM_RESET_EXTERNAL = 1 << 1,
    SYSTEM_RESET_BROWN_OUT = 1 << 2,
    SYSTEM_RESET_WATCHDOG = 1 << 3,
    SYSTEM_RESET_JTAG = 1 << 4
};

/* The first call of main. Switches the watchdog off, takes and clears the reset cause, moves the vectors to the application.
 * Leaves interrupts off. */
void system_init(void);

uint8_t system_reset_cause(void);

/* Watchdog: 1.0 s nominal at 5 V. A kick costs one cycle. */
void system_watchdog_on(void);
void system_kick(void);

/* Restarts the controller through the watchdog, within 20 ms. The boot loader then decides what runs. */
void system_restart(void) __attribute__((noreturn));

/* Whether the program should end (Ctrl-C on a PC): stop the robot, then call system_end. Never on a board. */
bool system_is_asked_to_end(void);
void system_end(void) __attribute__((noreturn));

/* Stops the CPU until an interrupt. Call with interrupts disabled, after checking that there is nothing to do. Enables them
 * and sleeps in one step, so that no interrupt is missed in between. Returns with interrupts enabled. */
void system_sleep(void);

/* A failed ASSERT of the run before this reset: its line, and the byte address of the call. false: there was none, or it has
 * already been taken. */
bool system_take_failed_assert(uint16_t *line, uint32_t *address);

/* One conversion of an ADC channel (0..7) against AREF: 0..1023. Blocks 104 us. Channels 0 and 1 measure the battery through
 * an undocumented divider, so they are not converted to volts: servos report their voltage. */
uint16_t system_adc(uint8_t channel);

#endif
