/* SPDX-License-Identifier: MIT
 * editor_keys.h - interprets the bytes of the console by mode: as keys, parts of a line, or answers. Main loop only. */
#ifndef EDITOR_KEYS_H
#define EDITOR_KEYS_H

#include <stdint.h>

void editor_keys_init(void);

/* Takes a byte from the console; handles silence on it. */
void editor_byte(uint8_t byte);
void editor_quiet(void);

#endif
