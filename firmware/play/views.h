/* SPDX-License-Identifier: MIT
 * views.h - prints lists and states, for Play's commands. Changes nothing. */
#ifndef VIEWS_H
#define VIEWS_H

#include "play.h"

void views_print_list(void);
void views_print_status(void);
void views_print_servos(void);
void views_print_faults(void);
void views_print_settings(void);
void views_print_version(void);

/* Rate, blend, amplitude (two hexadecimal digits a joint when they differ), layer, joints moved by code, as ` field=value`;
 * without a line end. */
void views_print_shape(void);

/* "18 servos: 1-18", and the servos that were found but cannot be used. */
void views_print_servos_found(void);

/* Why a code did not start a play; without a line end. */
void views_print_refusal(const inputs_refusal_t *refusal);

#endif
