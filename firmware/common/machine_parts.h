/* SPDX-License-Identifier: MIT
 * machine_parts.h - how the files of machine see each other. For machine*.c only.
 * An answer is ` field=...` pieces and one of two ends, OK or ERR; a request that fails prints nothing before its error. */
#ifndef MACHINE_PARTS_H
#define MACHINE_PARTS_H

#include "machine.h"

/* machine.c: ends of answers. All but the first return the error's number. */
void machine_end_ok(void);
machine_status_t machine_error(machine_status_t status);                /* " ERR n ": the sentence follows */
machine_status_t machine_range_error(const char *what_P, uint16_t min, uint16_t max);
machine_status_t machine_refusal(performer_status_t status, uint8_t page, uint8_t fault); /* OK, or why not */

/* What may not wait gets its turn. */
void machine_serve(const machine_t *machine);

/* Numbers in requests are decimal or 0x, whatever the mode of a person's numbers. false: none, or out of range. */
bool machine_number(const shell_args_t *args, uint8_t index, uint16_t min, uint16_t max, uint16_t *value);

/* machine_motion.c */
machine_status_t machine_do_move(machine_t *machine, const shell_args_t *args);
machine_status_t machine_do_torque(machine_t *machine, const shell_args_t *args);
machine_status_t machine_do_play(machine_t *machine, const shell_args_t *args);
machine_status_t machine_do_stop(machine_t *machine, const shell_args_t *args);
machine_status_t machine_do_break(machine_t *machine, const shell_args_t *args);
machine_status_t machine_do_pause(machine_t *machine, const shell_args_t *args);
machine_status_t machine_do_resume(machine_t *machine, const shell_args_t *args);

/* machine_page.c */
machine_status_t machine_do_open(machine_t *machine, const shell_args_t *args);
machine_status_t machine_do_data(machine_t *machine, const shell_args_t *args);
machine_status_t machine_do_crc(machine_t *machine, const shell_args_t *args);
machine_status_t machine_do_save(machine_t *machine, const shell_args_t *args);

#endif
