/* SPDX-License-Identifier: MIT
 * editor_parts.h - what editor.c (start, lines, main loop), editor_keys.c and editor_source.c share. */
#ifndef EDITOR_PARTS_H
#define EDITOR_PARTS_H

#include "editor.h"

/* editor.c: runs the line in the_editor.args, anew after each answered question. */
void editor_run(void);

/* editor_keys.c: one key, by mode. */
void editor_key(uint8_t key);

/* editor_source.c: the open page from RAM for the performer. */
void editor_source_read(void *context, uint8_t page, uint16_t offset, void *to, uint8_t count);
uint8_t editor_source_check(void *context, uint8_t page);

#endif
