/* SPDX-License-Identifier: MIT */
#include "text.h"

#include <stdbool.h>
#include "compiler.h"
#include "text_pairs.h"

STATIC_ASSERT(TEXT_PAIRS_DEPTH <= TEXT_READER_BYTES, "packed texts are nested no deeper than a reader can follow");
enum { FIRST_PAIR = 0x80 };

static text_put_t text_out;

void text_init(text_put_t put)
{
    text_out = put;
}

void text_put(char character)
{
    text_out(character);
}

void text_string(const char *string)
{
    while (*string != '\0') {
        text_put(*string++);
    }
}

void text_open_P(text_reader_t *reader, const char *string_P)
{
    reader->at_P = string_P;
    reader->depth = 0;
}

/* A code of a packed text stands for a pair. The first half, which may be a code too, comes next; the second half waits. */
char text_next(text_reader_t *reader)
{
    uint8_t code = reader->depth > 0 ? reader->waiting[--reader->depth] : pgm_read_byte(reader->at_P++);
    while ((int8_t)code < ' ' && code != 0) { /* 0x80..0xFF, 0x01..0x1F */
        const uint8_t *pair_P = text_pairs[(uint8_t)(code - FIRST_PAIR)];
        reader->waiting[reader->depth++] = pgm_read_byte(pair_P + 1);
        code = pgm_read_byte(pair_P);
    }
    return (char)code;
}

void text_P(const char *string_P)
{
    text_reader_t reader;
    text_open_P(&reader, string_P);
    for (char character; (character = text_next(&reader)) != '\0';) {
        text_put(character);
    }
}

char *text_copy_P(char *to, const char *string_P)
{
    text_reader_t reader;
    text_open_P(&reader, string_P);
    while ((*to = text_next(&reader)) != '\0') {
        to++;
    }
    return to;
}

void text_number32(uint32_t number)
{
    char digits[10];
    uint8_t count = 0;
    do {
        digits[count++] = (char)('0' + number % 10);
        number /= 10;
    } while (number > 0);
    while (count > 0) {
        text_put(digits[--count]);
    }
}

void text_number(uint16_t number)
{
    text_padded(number, 1, '0');
}

void text_P_number(const char *string_P, uint16_t number)
{
    text_P(string_P);
    text_number(number);
}

void text_signed(int16_t number)
{
    if (number < 0) {
        text_put('-');
    }
    text_number((uint16_t)(number < 0 ? -number : number));
}

void text_padded(uint16_t number, uint8_t width, char pad)
{
    char digits[5];
    uint8_t count = 0;
    do {
        digits[count++] = (char)('0' + number % 10);
        number /= 10;
    } while (number > 0);
    for (; width > count; width--) {
        text_put(pad);
    }
    while (count > 0) {
        text_put(digits[--count]);
    }
}

void text_string_padded(const char *string, uint8_t width)
{
    for (; *string != '\0'; width = width > 0 ? (uint8_t)(width - 1u) : 0) {
        text_put(*string++);
    }
    for (; width > 0; width--) {
        text_put(' ');
    }
}

void text_hex(uint16_t number, uint8_t digits)
{
    for (uint8_t place = 4; place > 0; place--, number = (uint16_t)(number << 4)) {
        if (place <= digits) {
            const uint8_t nibble = (uint8_t)(number >> 8) >> 4;
            text_put((char)(nibble < 10 ? '0' + nibble : 'A' + nibble - 10));
        }
    }
}

void text_mask(uint32_t joints)
{
    text_hex((uint16_t)(joints >> 16), 4);
    text_hex((uint16_t)joints, 4);
}

void text_line_end(void)
{
    text_put('\r');
    text_put('\n');
}
