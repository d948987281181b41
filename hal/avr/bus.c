/* SPDX-License-Identifier: MIT */
#include "bus.h"
#include "bus_core.h"
#include "bus_port.h"
#include "clock.h"
#include "compiler.h"
#include "irq.h"

#include <avr/io.h>

#include BOARD_PINS_H

#define MODE_U2X (1u << U2X0)
#define FRAME_8N1 ((1u << UCSZ01) | (1u << UCSZ00))
/* The receiver is off while we drive the line, so that turn-round glitches do not count as an answer. */
#define SENDING (1u << TXEN0 | 1u << TXCIE0)
#define LISTENING (1u << TXEN0 | 1u << RXEN0 | 1u << RXCIE0)

static bus_core_t core;

/* The rest to send; owned by the main loop until the first byte is written, then by the ISR. */
static const uint8_t *tx_next;
static uint8_t tx_pairs;

/* Waits for room in UDR0. An empty shift register takes its byte at the next bit clock: within 16 cycles at 1 Mbps, 280 at
 * 57,142. Interrupts are off here, so the wait ends after ROOM_TURNS of 6 cycles whatever the flag says: the packaged simavr
 * never sets UDRE0 again once TXEN0 was off. */
#define ROOM_TURNS 60u
ALWAYS_INLINE void put(uint8_t byte)
{
    for (uint8_t turns = ROOM_TURNS; !(UCSR0A & (1u << UDRE0)) && turns != 0; turns--) {
    }
    UDR0 = byte;
}

/* Sends the first byte, or the first two, so that the ISR has whole pairs left. */
void bus_port_send(uint8_t count)
{
    const uint8_t *next = core.packet;
    UCSR0B = SENDING;
    pins_bus_drive();
    tx_pairs = (uint8_t)(count - 1u) / 2u;
    irq_state_t state = irq_save(); /* otherwise the first byte could leave, and its ISR run, before the second is put */
    put(*next++);
    if ((count & 1u) == 0) {
        put(*next++);
    }
    tx_next = next;
    irq_restore(state);
}

void bus_port_listen(void)
{
    pins_bus_listen();
    UCSR0B = LISTENING;
}

TARGET_BUS_TIME bus_port_margin_half_us(void)
{
    return 600u;
}

void bus_init(void)
{
    UCSR0B = 0;
    bus_core_init(&core);
    pins_init_bus();
    UCSR0A = MODE_U2X | (1u << TXC0);
    UBRR0H = 0;
    UBRR0L = BUS_RATE_1M;
    UCSR0C = FRAME_8N1;
    UCSR0B = LISTENING;
}

void bus_set_rate(uint8_t divisor)
{
    (void)bus_wait(0);
    UBRR0L = divisor;
    bus_core_set_rate(&core, divisor);
}

uint8_t bus_rate(void)
{
    return UBRR0L;
}

uint8_t *bus_packet(void)
{
    return core.packet;
}

bool bus_is_busy(void)
{
    return core.state != BUS_IDLE && bus_poll(0) == BUS_PENDING;
}

bool bus_is_free(void)
{
    return !bus_is_busy();
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

void bus_wait_free(void)
{
    (void)bus_wait(0);
}

bool bus_was_lost(void)
{
    return false;
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

/* Two bytes have left: the shift register and UDR0 take two more. Runs 51 times for a packet of 31 joints, 84 to 87 cycles
 * measured; an interrupt for each byte, when UDR0 is empty, costs 2,800 more per packet. The line pauses 3 us before each
 * pair, or longer if other interrupts delay this one. The first write comes early, so that its byte moves on during the
 * rest. The last run releases the line, at most 16 us after the last stop bit (hal/README.md). */
ISR(USART0_TX_vect)
{
    uint8_t pairs = tx_pairs;
    if (pairs == 0) {
        bus_core_on_sent(&core, clock_now_noirq());
        return;
    }
    const uint8_t *next = tx_next;
    UDR0 = *next++;
    tx_pairs = --pairs;
    if (pairs == 0) {
        bus_core_on_last(&core);
    }
    tx_next = next + 1;
    put(*next);
}

/* 119 cycles measured of the 160 between two characters at 1 Mbps; the UART holds three more. */
ISR(USART0_RX_vect)
{
    uint8_t status = UCSR0A;   /* before UDR0: its flags belong to the byte there */
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
