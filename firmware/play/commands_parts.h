/* SPDX-License-Identifier: MIT
 * commands_parts.h - how the files of Play's commands see each other. For commands*.c only.
 *
 *   commands.c              the table, help, the answer
 *     commands_play.c       play, stop, break, pause, resume, code
 *     commands_robot.c      on, off, servos, baud
 *     commands_settings.c   law, remote, settings */
#ifndef COMMANDS_PARTS_H
#define COMMANDS_PARTS_H

#include "play.h"
#include "report.h"

/* Handlers (shell.h): context is the play_t; a handler that fails has printed one sentence. */
uint8_t commands_do_play(void *context, const shell_args_t *args);
uint8_t commands_do_stop(void *context, const shell_args_t *args);
uint8_t commands_do_break(void *context, const shell_args_t *args);
uint8_t commands_do_pause(void *context, const shell_args_t *args);
uint8_t commands_do_resume(void *context, const shell_args_t *args);
uint8_t commands_do_code(void *context, const shell_args_t *args);

uint8_t commands_do_on(void *context, const shell_args_t *args);
uint8_t commands_do_off(void *context, const shell_args_t *args);
uint8_t commands_do_servos(void *context, const shell_args_t *args);
uint8_t commands_do_baud(void *context, const shell_args_t *args);

uint8_t commands_do_law(void *context, const shell_args_t *args);
uint8_t commands_do_remote(void *context, const shell_args_t *args);
uint8_t commands_do_settings(void *context, const shell_args_t *args);

/* Says why the performer did not do it; the status to return. */
static inline uint8_t commands_refuse(performer_status_t status, uint8_t page, uint8_t fault)
{
    report_refusal(status, page, fault);
    return status == PERFORMER_OK ? SHELL_OK : SHELL_ERR_SAID;
}

#endif
