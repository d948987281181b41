/* SPDX-License-Identifier: MIT
 * commands_motion.h - the words of Play that move something or shape a motion. Handlers of shell.h; they return
 * the results of requests.h. Main loop only. */
#ifndef COMMANDS_MOTION_H
#define COMMANDS_MOTION_H

#include "shell.h"

uint8_t commands_do_play(const shell_args_t *args);
uint8_t commands_do_stop(const shell_args_t *args);
uint8_t commands_do_break(const shell_args_t *args);
uint8_t commands_do_pause(const shell_args_t *args);
uint8_t commands_do_resume(const shell_args_t *args);
uint8_t commands_do_code(const shell_args_t *args);

uint8_t commands_do_rate(const shell_args_t *args);
uint8_t commands_do_amplitude(const shell_args_t *args);
uint8_t commands_do_blend(const shell_args_t *args);
uint8_t commands_do_drive(const shell_args_t *args);
uint8_t commands_do_shape(const shell_args_t *args);

uint8_t commands_do_layer(const shell_args_t *args);
uint8_t commands_do_aim(const shell_args_t *args);
uint8_t commands_do_swing(const shell_args_t *args);
uint8_t commands_do_free(const shell_args_t *args);

#endif
