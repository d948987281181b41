/* SPDX-License-Identifier: MIT */
#include "text.h"

#include <stdbool.h>

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

void text_P(const char *string_P)
{
    char character;
    while ((character = (char)pgm_read_byte(string_P++)) != '\0') {
        text_put(character);
    }
}

/* Digits by subtraction: a 32-bit division costs ten times as much and a page of code. */
void text_number32(uint32_t number)
{
    static const uint32_t powers[] PROGMEM = {1000000000UL, 100000000UL, 10000000UL, 1000000UL, 100000UL,
                                              10000UL,      1000UL,      100UL,      10UL,      1UL};
    bool begun = false;
    for (uint8_t i = 0; i < sizeof powers / sizeof powers[0]; i++) {
        const uint32_t power = pgm_read_dword(&powers[i]);
        char digit = '0';
        while (number >= power) {
            number -= power;
            digit++;
        }
        begun = begun || digit != '0' || power == 1;
        if (begun) {
            text_put(digit);
        }
    }
}

void text_number(uint16_t number)
{
    text_number32(number);
}

void text_padded(uint16_t number, uint8_t width, char pad)
{
    uint8_t digits = 1;
    for (uint16_t rest = number; rest >= 10; rest /= 10) {
        digits++;
    }
    for (; digits < width; digits++) {
        text_put(pad);
    }
    text_number(number);
}

void text_string_padded(const char *string, uint8_t width)
{
    for (; *string != '\0'; string++) {
        text_put(*string);
        width = width > 0 ? (uint8_t)(width - 1) : 0;
    }
    while (width-- > 0) {
        text_put(' ');
    }
}

void text_hex(uint16_t number, uint8_t digits)
{
    while (digits-- > 0) {
        const uint8_t nibble = (uint8_t)((number >> (4 * digits)) & 0x0F);
        text_put((char)(nibble < 10 ? '0' + nibble : 'A' + nibble - 10));
    }
}

void text_line_end(void)
{
    text_put('\r');
    text_put('\n');
}
