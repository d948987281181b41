/* SPDX-License-Identifier: MIT
 * editor_parts.h - how the files of the editor see each other, in the order of editor.h. For editor*.c only. */
#ifndef EDITOR_PARTS_H
#define EDITOR_PARTS_H

#include <stdbool.h>
#include <stdint.h>
#include "page_source.h"

/* editor_keys.c: takes a byte from the console; takes note that none has come for a while. */
void editor_byte(uint8_t byte);
void editor_quiet(void);
void editor_keys_init(void);

/* editor_line.c: takes a complete line. editor_run runs the line in the_dialog.args, again after each answered question. */
void editor_line(void);
void editor_run(void);
void editor_program_line(void);

/* editor_source.c: the pages of the performer. The open one comes from RAM, the others from flash. */
extern const page_source_t editor_source;

#endif
