/* SPDX-License-Identifier: MIT
 * servo_words.h - the words for the current servo, which CID selects. Each sends a packet and shows it and its answer, byte
 * by byte (DUMP: only the bytes read). Handlers of shell.h. Main loop only. */
#ifndef SERVO_WORDS_H
#define SERVO_WORDS_H

#include <stdint.h>
#include "shell.h"

/* The signature of a word's handler. */
#define WORD(name) uint8_t name(const shell_args_t *args)

/* Selects servo 1. */
void servo_words_init(void);

/* The current servo's ID, 0..253; DXL_BROADCAST: all. */
uint8_t servo_words_current(void);

WORD(servo_words_cid);
WORD(servo_words_ping);
WORD(servo_words_read);
WORD(servo_words_write);
WORD(servo_words_reg_write);
WORD(servo_words_action);
WORD(servo_words_go);
WORD(servo_words_led);
WORD(servo_words_baud);
WORD(servo_words_id);
WORD(servo_words_reset);
WORD(servo_words_sync_write);
WORD(servo_words_dump);

#endif
