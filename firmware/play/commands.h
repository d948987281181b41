/* SPDX-License-Identifier: MIT
 * commands.h - the words of Play, for requests.h. Answers end in " OK" or in one sentence that says what is wrong.
 * Main loop only; while an answer waits for room on the line, play_service goes on. */
#ifndef COMMANDS_H
#define COMMANDS_H

#include "play.h"

/* For persons and, with '@' in front, for programs. */
#define COMMANDS_SHARED 14u
extern const shell_command_t commands_shared_P[COMMANDS_SHARED];

/* Runs the line that the shell has completed and prints its answer with CR LF. */
void commands_run(play_t *play);

#endif
