/* SPDX-License-Identifier: MIT */
#include "bus.h"
#include "bus_core.h"
#include "clock.h"
#include "irq.h"

#include <avr/io.h>

#include BOARD_PINS_H

#define MODE_U2X (1u << U2X0)
#define FRAME_8N1 ((1u << UCSZ01) | (1u << UCSZ00))
/* The receiver is off while we drive the line: what it would catch of the turn-round is nobody's answer. */
#define SENDING (1u << TXEN0 | 1u << UDRIE0)
#define TURNING (1u << TXEN0 | 1u << TXCIE0)
#define LISTENING (1u << TXEN0 | 1u << RXEN0 | 1u << RXCIE0)

static bus_core_t core;

/* Saves 150 bytes (compiler.h, OPAQUE). Not for the ISRs, where the pointer would have to be saved. */
static inline bus_core_t *engine(void)
{
    bus_core_t *pointer = &core;
    OPAQUE(pointer);
    return pointer;
}

/* The address of the next byte to send stands in Timer 1's compare register B, which nobody uses and which is nearer than
 * RAM; its match only sets a flag. Main loop before UDRIE is set, then ISR. */
#define TX_AT_LOW OCR1BL
#define TX_AT_HIGH OCR1BH               /* written first: it waits in the timer's TEMP for the low byte */
static volatile uint8_t tx_end;         /* low byte of the address behind the last one; main loop */
static uint8_t rate;

void bus_port_send(const uint8_t *bytes, uint8_t count)
{
    TX_AT_HIGH = (uint8_t)((uintptr_t)bytes >> 8);
    TX_AT_LOW = (uint8_t)(uintptr_t)bytes;
    tx_end = (uint8_t)(uintptr_t)(bytes + count);
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
    TCCR0 = 0;   /* Timers 0 and 2 stand still, INT0 to INT7 are off: the transmit ISR keeps registers in theirs */
    TCCR2 = 0;
    EIMSK = 0;
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
    return bus_core_submit(engine(), size, answer_params, tries);
}

bus_status_t bus_poll(bus_answer_t *answer)
{
    return bus_core_poll(engine(), clock_now(), answer);
}

bool bus_has_news(void)
{
    return bus_core_has_news(engine());
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
    while (!bus_core_cancel(engine())) {
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
    bus_core_counts(engine(), counts);
}

/* 101 times in a frame of 31 joints, so every cycle counts: 29 a byte, response, vector and RETI included. In C, with the
 * registers that avr-gcc saves in every ISR, it took 63:
 *
 *     UDR0 = *tx_at++;
 *     if ((uint8_t)tx_at == tx_end) {
 *         UCSR0A = MODE_U2X | (1u << TXC0);
 *         UCSR0B = TURNING;
 *         bus_core_on_last(&core);
 *     }
 *
 * No instruction here touches a flag (LD Z+ counts, CPSE compares), so SREG need not be saved. Registers that nobody uses
 * keep r0, r30 and r31, at one cycle instead of two for the stack: the compare registers of Timers 0 and 2, which stand
 * still, and the sense control of the external interrupts 4 to 7, which are off. A packet is shorter than 256 bytes, so the
 * low byte of the address knows the end. A transmit complete that stands since a gap before the last byte is stale; clearing
 * it here cannot hit the byte's own, which is 160 cycles away. */
ISR(USART0_UDRE_vect, ISR_NAKED)
{
    __asm__ volatile(
        "out %[r30], r30 \n\t"
        "out %[r31], r31 \n\t"
        "out %[r0], r0 \n\t"
        "in r30, %[at_low] \n\t"
        "in r31, %[at_high] \n\t"
        "ld r0, Z+ \n\t"
        "out %[udr], r0 \n\t"
        "out %[at_high], r31 \n\t"
        "out %[at_low], r30 \n\t"
        "lds r31, %[end] \n\t"
        "cpse r30, r31 \n\t"
        "rjmp 1f \n\t"
        "ldi r31, %[clear_txc] \n\t"
        "out %[ucsra], r31 \n\t"
        "ldi r31, %[turning] \n\t"
        "out %[ucsrb], r31 \n\t"
        "ldi r31, %[state_turning] \n\t"
        "sts %[state], r31 \n"
        "1: in r0, %[r0] \n\t"
        "in r31, %[r31] \n\t"
        "in r30, %[r30] \n\t"
        "reti \n\t"
        :
        : [at_low] "I"(_SFR_IO_ADDR(TX_AT_LOW)), [at_high] "I"(_SFR_IO_ADDR(TX_AT_HIGH)), [end] "i"(&tx_end),
          [state] "i"(&core.state), [udr] "I"(_SFR_IO_ADDR(UDR0)),
          [r30] "I"(_SFR_IO_ADDR(OCR0)), [r31] "I"(_SFR_IO_ADDR(OCR2)), [r0] "I"(_SFR_IO_ADDR(EICRB)),
          [ucsra] "I"(_SFR_IO_ADDR(UCSR0A)), [ucsrb] "I"(_SFR_IO_ADDR(UCSR0B)),
          [clear_txc] "M"(MODE_U2X | 1u << TXC0), [turning] "M"(TURNING), [state_turning] "M"(BUS_TURNING));
}

/* Once a packet: 126 cycles measured, 8 us; a servo answers after 20 us at the earliest. */
ISR(USART0_TX_vect)
{
    bus_core_on_sent(&core, clock_now_noirq());
}

/* 131 cycles measured of the 160 between two characters at 1 Mbps; the UART holds three more. */
ISR(USART0_RX_vect)
{
    uint8_t status = UCSR0A;   /* before UDR0: it speaks of the byte there */
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
