/* SPDX-License-Identifier: MIT
 * shell_stage.h - fixture for the line shell tests: a shell of 20 characters with a history of 24 bytes, and its
 * output. Its ranges: 1 "Page" 1..127, 2 "Rate" 10..400, 3 "Blend" -100..100. Contains setUp and tearDown. */
#ifndef SHELL_STAGE_H
#define SHELL_STAGE_H

#include "shell.h"
#include "text.h"

#define LINE_BYTES 21u
#define HISTORY_BYTES 24u

extern shell_t shell;
extern char line[LINE_BYTES];

/* Output since setUp or clear_out. */
extern char out[256];
void clear_out(void);

/* Types bytes. Returns the event of the last byte. */
shell_event_t keys(const char *bytes);

/* Types a line and CR, expects the shell to accept it, and returns its words. */
shell_args_t enter(const char *text);

#endif
