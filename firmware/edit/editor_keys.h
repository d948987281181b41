/* SPDX-License-Identifier: MIT
 * editor_keys.h - what the bytes of the console do, now: they are keys, parts of a line, answers. Main loop only. */
#ifndef EDITOR_KEYS_H
#define EDITOR_KEYS_H

#include <stdint.h>

void editor_keys_init(void);

/* Takes a byte from the console; notices that none has come for a while. */
void editor_byte(uint8_t byte);
void editor_quiet(void);

#endif
