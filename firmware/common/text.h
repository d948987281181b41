/* SPDX-License-Identifier: MIT
 * text.h - prints characters, texts from flash and numbers to the place an image has chosen.
 * Knows no console and no screen: the image hands over the function that takes one character. Main loop only.
 * RAM: the pointer to that function. Nothing is buffered here; a call takes as long as the image's function does. */
#ifndef TEXT_H
#define TEXT_H

#include <stdint.h>
#include "pgm.h"

typedef void (*text_put_t)(char character);

/* Every later text goes to `put`. */
void text_init(text_put_t put);

void text_put(char character);
void text_string(const char *string);   /* from RAM */
void text_P(const char *string_P);      /* from flash */

/* TEXT("...") prints a text that is kept in flash. */
#define TEXT(literal) text_P(PSTR(literal))

void text_number(uint16_t number);                              /* decimal, as short as it is */
void text_number32(uint32_t number);
void text_padded(uint16_t number, uint8_t width, char pad);     /* right aligned; wider numbers are not cut */
void text_string_padded(const char *string, uint8_t width);     /* left aligned, filled with spaces */
void text_hex(uint16_t number, uint8_t digits);                 /* the lowest `digits` (1..4) digits, upper case, no 0x */
void text_line_end(void);                                       /* CR LF */

#endif
