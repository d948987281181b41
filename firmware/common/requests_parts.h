/* SPDX-License-Identifier: MIT
 * requests_parts.h - how the files of the requests see each other. For requests*.c only.
 *
 *   requests.c             the table, the dispatcher, ver and reset
 *     requests_list.c      list, page, dense, crcs: the pages in flash
 *     requests_state.c     pose, where, watch: the robot as it is now
 *     requests_motion.c    play, stop, move, torque: what moves the robot
 *       requests_answer.c  errors, and the joints that a line names
 *
 * Each uses only files below it. An answer is ` field=...` pieces and an end, OK or ERR. requests_run prints the end.
 * A request that fails prints nothing before its error. */
#ifndef REQUESTS_PARTS_H
#define REQUESTS_PARTS_H

#include "requests.h"

/* requests_list.c */
uint8_t request_list(void *context, const shell_args_t *args);
uint8_t request_page(void *context, const shell_args_t *args);
uint8_t request_dense(void *context, const shell_args_t *args);
uint8_t request_crcs(void *context, const shell_args_t *args);

/* requests_state.c */
uint8_t request_pose(void *context, const shell_args_t *args);
uint8_t request_where(void *context, const shell_args_t *args);
uint8_t request_watch(void *context, const shell_args_t *args);

/* requests_motion.c */
uint8_t request_move(void *context, const shell_args_t *args);
uint8_t request_torque(void *context, const shell_args_t *args);

/* requests_answer.c: who sent the line that runs, a program or a person. */
void requests_set_program(bool program);

#endif
