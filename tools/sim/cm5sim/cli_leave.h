/* SPDX-License-Identifier: MIT
 * cli_leave.h - how to leave the simulator, said where it stays when the robot has a screen of its own: in the terminal's title
 * (not on a console of Linux, which has none), and at the right end of its last row. */
#ifndef CLI_LEAVE_H
#define CLI_LEAVE_H

#include "cli_session.h"

/* Sets the title and keeps the one before; puts that back. Nothing without a terminal. */
void leave_open(session_t *session);
void leave_close(session_t *session);

/* Call it again and again. Writes the row once the robot has drawn its screen and is silent: after every redraw where the terminal has
 * a row below the robot's screen, else once for each start of the robot, until the robot writes there. */
void leave_show(session_t *session);

/* A person has pressed Ctrl-C, which goes to the robot: says once what ends the simulator. */
void leave_explain(session_t *session);

#endif
