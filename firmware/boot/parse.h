/* SPDX-License-Identifier: MIT
 * parse.h - splits a typed line into a word and hexadecimal arguments. Pure; tested on the PC.
 * Separators are space to '/' (0x20..0x2F) and TAB; several in a row are one. A line that begins with one that is not a
 * space, TAB or # is empty, as in the original. #s are left over from the start, which they have stopped. */
#ifndef PARSE_H
#define PARSE_H

#include <stdint.h>

#define PARSE_ARGS 2
#define PARSE_NUMBER_MAX 0xFFFFFul

typedef struct {
    const char *word;            /* in the line, upper case, with a NUL at its end; empty for an empty line */
    uint8_t count;               /* arguments read */
    uint32_t arg[PARSE_ARGS];    /* an address, 0 unless given, and a length, 1 unless given */
} parse_t;

/* What is wrong with the arguments. The word is set in any case. */
typedef enum {
    PARSE_OK = 0,
    PARSE_ERR_NUMBER, /* not hexadecimal, with or without 0x, or above PARSE_NUMBER_MAX */
    PARSE_ERR_COUNT   /* more than PARSE_ARGS */
} parse_status_t;

/* line : NUL-terminated; changed to upper case, with NUL in the place of separators */
parse_status_t parse_line(char *line, parse_t *parse);

#endif
