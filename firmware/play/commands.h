/* SPDX-License-Identifier: MIT
 * commands.h - the words of Play, for requests.h. An answer ends in " OK" or in one sentence that states the error.
 * Main loop only. play_service runs while an answer waits for room on the line. */
#ifndef COMMANDS_H
#define COMMANDS_H

#include "play.h"

/* For persons and, with '@' in front, for programs. */
extern const requests_table_t commands_shared;

/* Runs the shell's complete line and prints its answer with CR LF. false: it was refused. */
bool commands_run(void);

#endif
