/* SPDX-License-Identifier: MIT */
#include "print.h"

#include "uart.h"

uint8_t print_byte(const void *progmem)
{
    return pgm_read_byte_far(0x10000UL | (uint16_t)progmem);
}

void print_put(const char *progmem)
{
    char c;
    while ((c = print_byte(progmem++)) != 0) {
        uart_put(c);
    }
}

void print_line(void)
{
    PUT("\r\n ");
}

void print_say(const char *progmem)
{
    print_line();
    print_put(progmem);
}

void print_nth(const char *progmem, uint8_t n)
{
    while (n > 0) {
        if (print_byte(progmem++) == 0) {
            n--;
        }
    }
    print_put(progmem);
}

static void digit(uint8_t value)
{
    value &= 15;
    uart_put((uint8_t)(value + (value < 10 ? '0' : 'A' - 10)));
}

void print_hex8(uint8_t value)
{
    digit(value >> 4);
    digit(value);
}

void print_hex16(uint16_t value)
{
    print_hex8((uint8_t)(value >> 8));
    print_hex8((uint8_t)value);
}

void print_hex32(uint32_t value)
{
    print_hex16((uint16_t)(value >> 16));
    print_hex16((uint16_t)value);
}
