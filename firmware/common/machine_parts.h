/* SPDX-License-Identifier: MIT
 * machine_parts.h - how the files of machine see each other. For machine*.c only.
 * An answer is ` field=...` pieces and one of two ends, OK (put by machine_run) or ERR; a request that fails prints nothing
 * before its error. */
#ifndef MACHINE_PARTS_H
#define MACHINE_PARTS_H

#include "machine.h"

/* machine.c: errors. " ERR n ": the sentence follows; the same with its sentence; both return `status`. */
uint8_t machine_error(uint8_t status);
uint8_t machine_says(uint8_t status, const char *sentence_P);
void machine_range_error(const char *what_P, uint16_t min, uint16_t max);                 /* MACHINE_ERR_RANGE */
uint8_t machine_refusal(performer_status_t status, uint8_t page, uint8_t fault); /* nothing when it is OK */

/* What may not wait gets its turn. */
void machine_serve(const machine_t *machine);

/* Numbers in requests are decimal or 0x, whatever the mode of a person's numbers. false: none, or out of range, which has
 * been said (MACHINE_ERR_RANGE). */
bool machine_number(const shell_args_t *args, uint8_t index, const char *what_P, uint16_t min, uint16_t max,
                    uint16_t *value);
bool machine_page_number(const shell_args_t *args, uint8_t index, uint16_t min, uint16_t *page);

/* machine_motion.c */
uint8_t machine_do_move(void *context, const shell_args_t *args);
uint8_t machine_do_torque(void *context, const shell_args_t *args);
uint8_t machine_do_play(void *context, const shell_args_t *args);
uint8_t machine_do_stop(void *context, const shell_args_t *args);
uint8_t machine_do_break(void *context, const shell_args_t *args);
uint8_t machine_do_pause(void *context, const shell_args_t *args);
uint8_t machine_do_resume(void *context, const shell_args_t *args);

/* machine_page.c */
uint8_t machine_do_open(void *context, const shell_args_t *args);
uint8_t machine_do_data(void *context, const shell_args_t *args);
uint8_t machine_do_crc(void *context, const shell_args_t *args);
uint8_t machine_do_save(void *context, const shell_args_t *args);

#endif
