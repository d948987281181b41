/* SPDX-License-Identifier: MIT */
#include "start.h"

#include "uart.h"
#include BOOT_PORTS_H

#include <avr/interrupt.h>
#include <avr/io.h>
#include <avr/wdt.h>

void start_jump(uint16_t word)
{
    uart_flush();
    cli();
    MCUCR = 1 << IVCE;
    MCUCR = 0;
    uart_open(UART_UBRR_57143);
    TCCR1B = 0;
    TCNT1 = 0;
    TIFR = 1 << TOV1 | 1 << OCF1A | 1 << OCF1B; /* all flags that timer 1 may have set */
    UCSR0A = 1 << U2X0;
    UCSR0B = 1 << RXEN0 | 1 << TXEN0;
    PORTS_HAND_OVER();
    ((void (*)(void))word)();
    __builtin_unreachable();
}

void start_reset(void)
{
    wdt_enable(WDTO_15MS);
    for (;;) {
    }
}
