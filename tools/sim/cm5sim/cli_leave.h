/* SPDX-License-Identifier: MIT
 * cli_leave.h - shows how to leave the simulator where the robot's own screen does not cover it: in the terminal's title (a
 * console of Linux has none), and at the right end of its last row. */
#ifndef CLI_LEAVE_H
#define CLI_LEAVE_H

#include "cli_session.h"

/* open saves the title and sets its own; close restores it. Both do nothing without a terminal. */
void leave_open(session_t *session);
void leave_close(session_t *session);

/* Call it repeatedly. Writes the row when the robot has drawn its screen and is silent: after every redraw if the terminal
 * has a row below the robot's screen, else once for each start of the robot, until the robot writes there. */
void leave_show(session_t *session);

/* A person has pressed Ctrl-C, which goes to the robot: says once what ends the simulator. */
void leave_explain(session_t *session);

#endif
