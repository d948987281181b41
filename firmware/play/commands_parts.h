/* SPDX-License-Identifier: MIT
 * commands_parts.h - how the files of Play's commands see each other. For commands*.c only.
 *
 *   commands.c              the tables, help
 *     commands_play.c       play, stop, break, pause, resume, code
 *     commands_settings.c   law, remote, settings
 *     commands_shape.c      rate, amplitude, blend, drive, shape
 *     commands_layers.c     layer, aim, swing, free */
#ifndef COMMANDS_PARTS_H
#define COMMANDS_PARTS_H

#include "play.h"
#include "ranges_own.h"
#include "report.h"
#include "text.h"

/* Handlers: context is the play_t; the results are those of requests.h. */
uint8_t commands_do_play(void *context, const shell_args_t *args);
uint8_t commands_do_stop(void *context, const shell_args_t *args);
uint8_t commands_do_break(void *context, const shell_args_t *args);
uint8_t commands_do_pause(void *context, const shell_args_t *args);
uint8_t commands_do_resume(void *context, const shell_args_t *args);
uint8_t commands_do_code(void *context, const shell_args_t *args);

uint8_t commands_do_law(void *context, const shell_args_t *args);
uint8_t commands_do_remote(void *context, const shell_args_t *args);
uint8_t commands_do_settings(void *context, const shell_args_t *args);

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
