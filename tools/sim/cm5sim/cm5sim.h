/* SPDX-License-Identifier: MIT
 * cm5sim.h - the command cm5sim as a function: main.c calls it, and with a body the script with_body.py. */
#ifndef CM5SIM_H
#define CM5SIM_H

#include "servo_body.h"

/* The command line (argv ends with NULL). body: what the servos hang on; NULL: each turns by itself, and --body runs
 * with_body.py instead. Returns the exit code. Prints what is wrong with the options and ends the process itself. */
int cm5sim_run(int argc, char **argv, const servo_body_t *body);

#endif
