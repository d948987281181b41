/* SPDX-License-Identifier: MIT
 * negative.h - shared by the negative programs. WRONG selects the wrong (1) or the right (0) variant. */
#ifndef NEGATIVE_H
#define NEGATIVE_H

#include <avr/boot.h>
#include <avr/eeprom.h>
#include <avr/interrupt.h>
#include <avr/io.h>
#include <avr/pgmspace.h>
#include <avr/sleep.h>
#include <avr/wdt.h>
#include <stdbool.h>
#include <stdint.h>

#define NOINLINE __attribute__((noinline, noclone, used))
#define PAGE 0x4000u /* a flash page of the application area, below 64 KiB */

static inline void console_on(void)
{
    DDRD |= _BV(PD5) | _BV(PD6);
    PORTD |= _BV(PD5) | _BV(PD6);
    UCSR1A = _BV(U2X1);
    UBRR1L = 34;
    UCSR1B = _BV(RXEN1) | _BV(TXEN1);
}

static inline void put(char character)
{
    while (!(UCSR1A & _BV(UDRE1))) {
    }
    UCSR1A |= _BV(TXC1);
    UDR1 = (uint8_t)character;
}

static inline void say(const char *text)
{
    while (*text) {
        put(*text++);
    }
}

/* Reports that no violation occurred. */
static inline void finish(void)
{
    say("right\n");
    for (;;) {
    }
}

static inline void bus_on(void)
{
    DDRE |= _BV(PE2) | _BV(PE3);
    UCSR0A = _BV(U2X0);
    UBRR0L = 1; /* 1 Mbit/s */
    UCSR0B = _BV(RXEN0) | _BV(TXEN0);
}

static inline void bus_put(uint8_t byte)
{
    while (!(UCSR0A & _BV(UDRE0))) {
    }
    UCSR0A |= _BV(TXC0);
    UDR0 = byte;
}

static inline void bus_drained(void)
{
    while (!(UCSR0A & _BV(TXC0))) {
    }
}

#endif
