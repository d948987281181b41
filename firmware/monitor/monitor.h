/* SPDX-License-Identifier: MIT
 * monitor.h - the declarations shared by the files of the Monitor image. */
#ifndef MONITOR_H
#define MONITOR_H

#include <stdint.h>
#include "shell.h"

#define TOSS_BUFFER_BYTES 64u   /* a power of two */

/* toss.c: connects the PC to the servos. Forwards packets from the console to the bus, and all bytes from the bus to the
 * console, unchanged. Blocks until three ESC arrive after a silence; kicks the watchdog. */
void toss_run(uint8_t buffer[TOSS_BUFFER_BYTES]);

/* monitor.c: prints the prompt, runs a line. */
void monitor_init(void);
void monitor_prompt(void);
void monitor_line(shell_t *shell);

#endif
