/* SPDX-License-Identifier: MIT */
#include "uart.h"

#include "service.h"

#include <avr/interrupt.h>
#include <avr/io.h>
#include <avr/wdt.h>

static uint8_t ring[256];
static volatile uint8_t head; /* written by the interrupt and service_poll */
static volatile uint8_t tail; /* written by uart_next */
static volatile uint8_t lost;

const boot_rx_t uart_rx = {.buffer = ring, .head = &head, .tail = &tail, .lost = &lost, .mask = 0xFF};

void uart_open(uint8_t ubrr)
{
    UCSR1A = 1 << U2X1;
    UBRR1H = 0;
    UBRR1L = ubrr;
    UCSR1B = 1 << RXCIE1 | 1 << RXEN1 | 1 << TXEN1;
    TCCR1B = 1 << CS12 | 1 << CS10;
}

void uart_put(uint8_t byte)
{
    while (!(UCSR1A & 1 << UDRE1)) {
        wdt_reset();
    }
    UDR1 = byte;
    UCSR1A = 1 << U2X1 | 1 << TXC1; /* cleared after UDR1: until then the previous byte could still set the flag */
}

void uart_flush(void)
{
    while (!(UCSR1A & 1 << TXC1)) {
    }
}

uint8_t uart_has(void)
{
    return head - tail;
}

uint8_t uart_peek(void)
{
    return ring[tail];
}

uint8_t uart_next(void)
{
    return ring[tail++];
}

bool uart_wait(uint16_t ticks)
{
    uint16_t since = uart_clock();
    do {
        wdt_reset();
        if (uart_has()) {
            return true;
        }
    } while (uart_since(since) < ticks);
    return false;
}

bool uart_wait_for(uint8_t byte, uint16_t ticks)
{
    if (!uart_wait(ticks) || uart_peek() != byte) {
        return false;
    }
    (void)uart_next();
    return true;
}

void uart_drain(uint16_t ticks)
{
    while (uart_wait(ticks)) {
        (void)uart_next();
    }
}

uint16_t uart_clock(void)
{
    return TCNT1;
}

uint16_t uart_since(uint16_t then)
{
    return TCNT1 - then;
}

void uart_pause(uint16_t ticks)
{
    uint16_t since = uart_clock();
    do {
        wdt_reset();
    } while (uart_since(since) < ticks);
}

uint8_t uart_lost(void)
{
    return lost;
}

/* About 110 cycles with entry and exit; at 117,647 baud a byte arrives every 1,360. */
ISR(USART1_RX_vect)
{
    service_poll(&uart_rx);
}

/* The only vector besides reset; the linker puts it in its place. */
static void __attribute__((naked, used, section(".vector_rx"))) rx_vector(void)
{
    asm volatile("jmp __vector_30");
}
