/* SPDX-License-Identifier: MIT
 * editor_parts.h - how the files of the editor see each other; the order is in editor.h. */
#ifndef EDITOR_PARTS_H
#define EDITOR_PARTS_H

#include <stdbool.h>
#include <stdint.h>
#include "page_source.h"

/* editor_keys.c: one byte from the console; nothing has come for a while. */
void editor_byte(uint8_t byte);
void editor_quiet(void);
void editor_keys_init(void);

/* editor_line.c: a complete line. run: that of the_dialog.args, anew after each answered question. */
void editor_line(void);
void editor_run(void);
void editor_program_line(void);

/* editor_source.c: the open page from RAM, the others from flash, for the performer. */
extern const page_source_t editor_source;

#endif
