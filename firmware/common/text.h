/* SPDX-License-Identifier: MIT
 * text.h - prints characters, texts from flash and numbers.
 * Knows no console and no screen: the image provides the function that takes one character. Main loop only.
 * RAM: the pointer to that function. Nothing is buffered: a call takes as long as the image's function does. */
#ifndef TEXT_H
#define TEXT_H

#include <stdint.h>
#include "pgm.h"

/* Maximum nesting of the pairs of a packed text (text.c). */
#define TEXT_READER_BYTES 6u

typedef void (*text_put_t)(char character);

/* Sends all text to `put` from now on. */
void text_init(text_put_t put);

void text_put(char character);
void text_string(const char *string);   /* from RAM */
void text_P(const char *string_P);      /* from flash */

/* Texts that are only printed are marked, so that the images can pack them (tools/dev/pack_texts):
 *   TEXT("...")              prints the text
 *   TEXT_P("...")            is its address, for text_P and functions that call it; inside functions only
 *   TEXT_NAMED(name, "...")  defines an array, for tables
 * The literal has printable characters only; a packed text uses the other codes. Read a marked text only through a
 * text_reader_t. A text that is compared with typed words is a plain PSTR; the functions here take those as well. */
#define TEXT(literal) text_P(PSTR(literal))
#define TEXT_P(literal) PSTR(literal)
#define TEXT_NAMED(name, literal) static const char name[] PROGMEM = literal

/* Reads a flash text one character at a time. */
typedef struct {
    const char *at_P;
    uint8_t depth;                        /* bytes in waiting[] */
    uint8_t waiting[TEXT_READER_BYTES];
} text_reader_t;

void text_open_P(text_reader_t *reader, const char *string_P);
char text_next(text_reader_t *reader);           /* '\0' at the end; do not call again after that */
char *text_copy_P(char *to, const char *string_P);   /* copies to RAM; returns the address of the NUL */

void text_number(uint16_t number);                              /* decimal, without leading zeros */
void text_P_number(const char *string_P, uint16_t number);       /* a text from flash, then a number */
void text_signed(int16_t number);                               /* the same, with a minus if negative */
void text_number32(uint32_t number);
void text_padded(uint16_t number, uint8_t width, char pad);     /* right aligned; wider numbers are not cut */
void text_string_padded(const char *string, uint8_t width);     /* left aligned, filled with spaces */
void text_hex(uint16_t number, uint8_t digits);                 /* the lowest `digits` (1..4) digits, upper case, no 0x */
void text_mask(uint32_t joints);                                /* 8 hexadecimal digits */
void text_line_end(void);                                       /* CR LF */

#endif
