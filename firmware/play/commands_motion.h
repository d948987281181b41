/* SPDX-License-Identifier: MIT
 * commands_motion.h - the words of Play that move something or shape a motion. Handlers of shell.h: context is the
 * play_t, the results are those of requests.h. Main loop only. */
#ifndef COMMANDS_MOTION_H
#define COMMANDS_MOTION_H

#include "shell.h"

uint8_t commands_do_play(void *context, const shell_args_t *args);
uint8_t commands_do_stop(void *context, const shell_args_t *args);
uint8_t commands_do_break(void *context, const shell_args_t *args);
uint8_t commands_do_pause(void *context, const shell_args_t *args);
uint8_t commands_do_resume(void *context, const shell_args_t *args);
uint8_t commands_do_code(void *context, const shell_args_t *args);

uint8_t commands_do_rate(void *context, const shell_args_t *args);
uint8_t commands_do_amplitude(void *context, const shell_args_t *args);
uint8_t commands_do_blend(void *context, const shell_args_t *args);
uint8_t commands_do_drive(void *context, const shell_args_t *args);
uint8_t commands_do_shape(void *context, const shell_args_t *args);

uint8_t commands_do_layer(void *context, const shell_args_t *args);
uint8_t commands_do_aim(void *context, const shell_args_t *args);
uint8_t commands_do_swing(void *context, const shell_args_t *args);
uint8_t commands_do_free(void *context, const shell_args_t *args);

#endif
