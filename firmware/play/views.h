/* SPDX-License-Identifier: MIT
 * views.h - prints lists and states, for Play's commands. Changes nothing. */
#ifndef VIEWS_H
#define VIEWS_H

#include "play.h"

void views_print_list(play_t *play);
void views_print_status(const play_t *play);
void views_print_servos(const play_t *play);
void views_print_faults(const play_t *play);
void views_print_settings(const play_t *play);
void views_print_version(void);

/* Rate, blend, amplitude (two hexadecimal digits a joint when they differ), layer, joints moved by code, as ` field=value`;
 * without a line end. */
void views_print_shape(const performer_t *performer);

/* "18 servos: 1-18", and the servos that were found but cannot be used. */
void views_print_servos_found(const play_t *play);

/* Why a code did not start a play; without a line end. */
void views_print_refusal(const inputs_refusal_t *refusal);

#endif
