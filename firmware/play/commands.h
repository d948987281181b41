/* SPDX-License-Identifier: MIT
 * commands.h - the words of Play's line shell. Answers end in " OK" or in one sentence that says what is wrong.
 * Main loop only; while an answer waits for room on the line, play_service goes on. */
#ifndef COMMANDS_H
#define COMMANDS_H

#include "play.h"

/* Requests (requests.h) that only Edit can fulfil: they say so. */
#define COMMANDS_REQUESTS 4u
extern const shell_command_t commands_requests_P[COMMANDS_REQUESTS];

/* Runs the line that the shell has completed and prints its answer with CR LF. */
void commands_run(play_t *play);

/* The same for a line "@word ..." that is no word of requests.h: prints the answer without the word in front and OK behind.
 * Returns request_status_t, SHELL_ERR_UNKNOWN or SHELL_ERR_COUNT. */
uint8_t commands_run_for_program(play_t *play, const shell_args_t *args);

#endif
