/* SPDX-License-Identifier: MIT
 * print.h - prints strings of the boot section and hexadecimal numbers.
 * The boot section is above 64 KiB, so its 16-bit PROGMEM addresses are read with RAMPZ = 1. */
#ifndef PRINT_H
#define PRINT_H

#include <avr/pgmspace.h>
#include <stdint.h>

/* PROGMEM for small tables in the gap between the two used vectors: 112 bytes in total. */
#define PROGMEM_GAP __attribute__((section(".progmem.gap")))

/* Reads one byte of a PROGMEM object of the loader. */
uint8_t print_byte(const void *progmem);

/* Prints a PROGMEM string; print_say prints CR LF and a space before it, as the original does. */
void print_put(const char *progmem);
void print_say(const char *progmem);
#define SAY(literal) print_say(PSTR(literal))
#define PUT(literal) print_put(PSTR(literal))

/* Prints the n-th (from 0) of several NUL-terminated strings. */
void print_nth(const char *progmem, uint8_t n);

void print_line(void); /* CR LF space */
void print_hex8(uint8_t value);
void print_hex16(uint16_t value);
void print_hex32(uint32_t value);

#endif
