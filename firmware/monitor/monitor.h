/* SPDX-License-Identifier: MIT
 * monitor.h - what the files of the Monitor image share. */
#ifndef MONITOR_H
#define MONITOR_H

#include <stdint.h>
#include "shell.h"

#define TOSS_BUFFER_BYTES 64u   /* a power of two */

/* toss.c: connects the PC to the servos. Packets from the console go to the bus unchanged, everything heard on the bus goes
 * to the console. Blocks until three ESC come outside a packet; kicks the watchdog. */
void toss_run(uint8_t buffer[TOSS_BUFFER_BYTES]);

/* monitor.c: prints the prompt, runs a line. */
void monitor_init(void);
void monitor_prompt(void);
void monitor_line(shell_t *shell);

#endif
