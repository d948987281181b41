/* SPDX-License-Identifier: MIT
 * requests_parts.h - how requests.c and requests_motion.c see each other.
 * An answer is ` field=...` pieces and one of two ends, OK or ERR, put by requests_run; a request that fails prints nothing
 * before its error. */
#ifndef REQUESTS_PARTS_H
#define REQUESTS_PARTS_H

#include "requests.h"

/* A performer's refusal as an error, with its sentence; REQUEST_OK for PERFORMER_OK. */
uint8_t requests_refusal(performer_status_t status);

/* requests_motion.c */
uint8_t request_move(void *context, const shell_args_t *args);
uint8_t request_torque(void *context, const shell_args_t *args);
uint8_t request_play(void *context, const shell_args_t *args);
uint8_t request_stop(void *context, const shell_args_t *args);
uint8_t request_break(void *context, const shell_args_t *args);
uint8_t request_pause(void *context, const shell_args_t *args);
uint8_t request_resume(void *context, const shell_args_t *args);

#endif
