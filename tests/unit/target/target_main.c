/* SPDX-License-Identifier: MIT
 * target_main.c - runs a Unity test file on the ATmega128. Prints the results on UART1 at 57,600 8N1, then the line
 * "target: done, N failed", then sleeps with interrupts off. A run without that last line has failed. */
#define TARGET_MAIN
#include <avr/interrupt.h>
#include <avr/io.h>
#include <avr/sleep.h>
#include "unity_config.h"

void target_put(char character)
{
    while ((UCSR1A & _BV(UDRE1)) == 0) {
    }
    UDR1 = (uint8_t)character;
}

static void put_text(const char *text)
{
    while (*text != '\0') {
        target_put(*text++);
    }
}

static void put_number(int number)
{
    if (number >= 10) {
        target_put((char)('0' + number / 10 % 10));
    }
    target_put((char)('0' + number % 10));
}

int main(void)
{
    UCSR1A = _BV(U2X1);
    UBRR1L = 34; /* 16 MHz / 8 / (34 + 1) = 57,143 */
    UCSR1C = _BV(UCSZ11) | _BV(UCSZ10);
    UCSR1B = _BV(TXEN1) | _BV(RXEN1);
    int failed = target_tests();
    put_text("target: done, ");
    put_number(failed);
    UCSR1A |= _BV(TXC1);
    put_text(" failed\n");
    while ((UCSR1A & _BV(TXC1)) == 0) {
    }
    cli();
    sleep_enable();
    for (;;) {
        sleep_cpu();
    }
}
