/* SPDX-License-Identifier: MIT
 * commands_parts.h - how the files of Play's commands see each other. For commands*.c only. */
#ifndef COMMANDS_PARTS_H
#define COMMANDS_PARTS_H

#include "play.h"

/* commands.c: says why not; the status to return. */
uint8_t commands_refuse(performer_status_t status, uint8_t page, uint8_t fault);

/* commands_robot.c; context is the play_t. */
uint8_t commands_do_on(void *context, const shell_args_t *args);
uint8_t commands_do_off(void *context, const shell_args_t *args);
uint8_t commands_do_servos(void *context, const shell_args_t *args);
uint8_t commands_do_baud(void *context, const shell_args_t *args);
uint8_t commands_do_law(void *context, const shell_args_t *args);
uint8_t commands_do_remote(void *context, const shell_args_t *args);
uint8_t commands_do_settings(void *context, const shell_args_t *args);

#endif
