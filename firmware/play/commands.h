/* SPDX-License-Identifier: MIT
 * commands.h - the words of Play's line shell. Answers end in " OK" or in one sentence that says what is wrong.
 * Main loop only; while an answer waits for room on the line, play_service goes on. */
#ifndef COMMANDS_H
#define COMMANDS_H

#include "play.h"

/* Runs the line that the shell has completed and prints its answer with CR LF. */
void commands_run(play_t *play);

/* The same for a line "@word ..." that is no word of machine.h: prints the answer without the word in front and OK behind.
 * Returns machine_status_t, SHELL_ERR_UNKNOWN or SHELL_ERR_COUNT. */
uint8_t commands_run_for_program(play_t *play, const shell_args_t *args);

#endif
