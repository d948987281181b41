/* SPDX-License-Identifier: MIT
 * monitor.h - what the files of the Monitor image share. */
#ifndef MONITOR_H
#define MONITOR_H

#include <stdint.h>
#include "shell.h"

#define TOSS_BUFFER_BYTES 64u   /* a power of two */

/* toss.c: the PC speaks to the servos itself. Packets from the console go to the bus as they are, everything heard on the
 * bus goes to the console. Three ESC outside a packet end it. Blocks until then; the watchdog is kicked. */
void toss_run(uint8_t buffer[TOSS_BUFFER_BYTES]);

/* monitor.c: prints the prompt, runs a line. `args->hex` follows HEX and DEC. */
void monitor_init(void);
void monitor_prompt(void);
void monitor_line(shell_t *shell);

#endif
