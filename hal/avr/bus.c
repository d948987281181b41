/* SPDX-License-Identifier: MIT */
#include "bus.h"
#include "bus_core.h"
#include "bus_port.h"
#include "clock.h"
#include "irq.h"

#include <avr/io.h>

#include BOARD_PINS_H

#define MODE_U2X (1u << U2X0)
#define FRAME_8N1 ((1u << UCSZ01) | (1u << UCSZ00))
/* The receiver is off while we drive the line: glitches of the turn-round are no answer. */
#define SENDING (1u << TXEN0 | 1u << UDRIE0)
#define TURNING (1u << TXEN0 | 1u << TXCIE0)
#define LISTENING (1u << TXEN0 | 1u << RXEN0 | 1u << RXCIE0)

static bus_core_t core;

static volatile uint8_t tx_at; /* bytes given to the UART so far; main loop until UDRIE is set, then ISR */
static uint8_t tx_count;       /* of how many; main loop, before */
static uint8_t rate;

void bus_port_send(uint8_t count)
{
    tx_count = count;
    tx_at = 0;
    UCSR0B = 1u << TXEN0;
    pins_bus_drive();
    irq_barrier();
    UCSR0B = SENDING;
}

void bus_port_listen(void)
{
    pins_bus_listen();
    UCSR0B = LISTENING;
}

void bus_init(void)
{
    UCSR0B = 0;
    bus_core_init(&core);
    rate = BUS_RATE_1M;
    pins_init_bus();
    UCSR0A = MODE_U2X | (1u << TXC0);
    UBRR0H = 0;
    UBRR0L = rate;
    UCSR0C = FRAME_8N1;
    bus_port_listen();
}

void bus_set_rate(uint8_t divisor)
{
    (void)bus_wait(0);
    rate = divisor;
    UBRR0L = divisor;
    bus_core_set_rate(&core, divisor);
}

uint8_t bus_rate(void)
{
    return rate;
}

void bus_set_return_delay_us(uint16_t us)
{
    core.return_delay_half_us = (uint16_t)(us * CLOCK_PER_US);
}

uint8_t *bus_packet(void)
{
    return core.packet;
}

bool bus_is_busy(void)
{
    return core.state != BUS_IDLE && bus_poll(0) == BUS_PENDING;
}

bus_status_t bus_submit(uint8_t size, uint8_t answer_params, uint8_t tries)
{
    return bus_core_submit(&core, size, answer_params, tries);
}

bus_status_t bus_poll(bus_answer_t *answer)
{
    return bus_core_poll(&core, clock_now(), answer);
}

bool bus_has_news(void)
{
    return bus_core_has_news(&core);
}

bus_status_t bus_wait(bus_answer_t *answer)
{
    bus_status_t status;
    do {
        status = bus_poll(answer);
    } while (status == BUS_PENDING);
    return status;
}

void bus_cancel(void)
{
    while (!bus_core_cancel(&core)) {
    }
}

void bus_set_tap(ring_t *ring)
{
    irq_state_t state = irq_save();
    core.tap = ring;
    irq_restore(state);
}

void bus_counts(bus_counts_t *counts)
{
    bus_core_counts(&core, counts);
}

/* 101 times in a frame of 31 joints; 65 cycles measured. A gap before the last byte leaves a stale transmit-complete flag.
 * Clearing it here cannot clear the last byte's own, which comes 160 cycles later. */
ISR(USART0_UDRE_vect)
{
    uint8_t at = tx_at;
    UDR0 = core.packet[at++];
    tx_at = at;
    if (at == tx_count) {
        UCSR0A = MODE_U2X | (1u << TXC0);
        UCSR0B = TURNING;
        bus_core_on_last(&core);
    }
}

/* Once a packet: 126 cycles measured. The line is released 17 us after the last stop bit at the latest (hal/README.md). */
ISR(USART0_TX_vect)
{
    bus_core_on_sent(&core, clock_now_noirq());
}

/* 119 cycles measured of the 160 between two characters at 1 Mbps; the UART holds three more. */
ISR(USART0_RX_vect)
{
    uint8_t status = UCSR0A;   /* before UDR0: the flags are those of the byte there */
    uint8_t byte = UDR0;
    uint8_t flags = 0;
    if (status & (1u << FE0)) {
        flags |= BUS_BYTE_FRAMING;
    }
    if (status & (1u << DOR0)) {
        flags |= BUS_BYTE_OVERRUN;
    }
    bus_core_on_byte(&core, byte, flags);
}
