/* SPDX-License-Identifier: MIT
 * requests_parts.h - how requests.c and requests_motion.c see each other.
 * An answer is ` field=...` pieces and one of two ends, OK or ERR, put by requests_run; a request that fails prints nothing
 * before its error. */
#ifndef REQUESTS_PARTS_H
#define REQUESTS_PARTS_H

#include "requests.h"

/* requests_motion.c */
uint8_t request_move(void *context, const shell_args_t *args);
uint8_t request_torque(void *context, const shell_args_t *args);

#endif
