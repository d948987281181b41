/* SPDX-License-Identifier: MIT
 * parse.h - splits a typed line into a word and hexadecimal arguments. Pure; tested on the PC.
 * Separators are space to '/' (0x20..0x2F) and TAB; several in a row count as one. A line that begins with a separator other
 * than space, TAB or # is empty, as in the original. Leading #s are left over from stopping the start. */
#ifndef PARSE_H
#define PARSE_H

#include <stdint.h>

#define PARSE_ARGS 2
#define PARSE_NUMBER_MAX 0xFFFFFul

typedef struct {
    const char *word;            /* in the line, upper case, NUL-terminated; empty for an empty line */
    uint8_t count;               /* arguments read */
    uint32_t arg[PARSE_ARGS];    /* an address, default 0, and a length, default 1 */
} parse_t;

/* What is wrong with the arguments. The word is always set. */
typedef enum {
    PARSE_OK = 0,
    PARSE_ERR_NUMBER, /* not hexadecimal, with or without 0x, or above PARSE_NUMBER_MAX */
    PARSE_ERR_COUNT   /* more than PARSE_ARGS */
} parse_status_t;

/* line : NUL-terminated; changed to upper case, with NULs in place of separators */
parse_status_t parse_line(char *line, parse_t *parse);

#endif
