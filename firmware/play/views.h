/* SPDX-License-Identifier: MIT
 * views.h - prints lists and states. Changes nothing. */
#ifndef VIEWS_H
#define VIEWS_H

#include "play.h"

/* Handlers of commands (shell.h). */
uint8_t views_list(const shell_args_t *args);
uint8_t views_status(const shell_args_t *args);
uint8_t views_faults(const shell_args_t *args);
uint8_t views_version(const shell_args_t *args);

void views_print_servos(void);
void views_print_settings(void);

/* Rate, blend, amplitude (two hexadecimal digits per joint if they differ), layer and joints moved by code, as
 * ` field=value`; without a line end. */
void views_print_shape(void);

/* "18 servos: 1-18", and the servos that were found but cannot be used. */
void views_print_servos_found(void);

/* Why a code did not start a play; without a line end. */
void views_print_refusal(const inputs_refusal_t *refusal);

#endif
