/* SPDX-License-Identifier: MIT */
#include "uart.h"

#define BITS 10u            /* start, 8 data, stop */
#define TOLERANCE_PERCENT 3 /* always received correctly (data sheet: double speed, 8 bits) */
#define SHIFT_REGISTER 2u   /* index in fifo[] */

typedef struct { uint16_t udr, a, b, c, ubrrh, ubrrl; uint8_t vector; } place_t;
static const place_t places[2] = {
    { 0x2C, 0x2B, 0x2A, 0x95, 0x90, 0x29, VECTOR_USART0_RX },
    { 0x9C, 0x9B, 0x9A, 0x9D, 0x98, 0x99, VECTOR_USART1_RX },
};

/* A character for an empty shift register leaves UDR at the next bit of the transmitter clock, which runs freely. The
 * model always takes the longest time, a whole bit. (The character starts on the line at once.) */
static bool is_full(const uart_t *uart) { return uart->waiting || uart->moving; }

static void at(uart_t *uart, uint64_t when)
{
    event_at(&uart->machine->events, uart->index ? EVENT_UART1 : EVENT_UART0, when);
}

static void update_lines(uart_t *uart)
{
    int vector = places[uart->index].vector; /* RX, UDRE and TX are consecutive */
    machine_line(uart->machine, vector, (uart->b & UCSRB_RXCIE) && uart->fill);
    machine_line(uart->machine, vector + 1, (uart->b & UCSRB_UDRIE) && !is_full(uart));
    machine_line(uart->machine, vector + 2, (uart->b & UCSRB_TXCIE) && (uart->a & UCSRA_TXC));
}

static uint32_t bit_cycles(const uart_t *uart)
{
    return (uart->a & UCSRA_U2X ? 8u : 16u) * (uart->ubrr + 1u);
}

bool uart_is_sending(const uart_t *uart) { return uart->shifting || uart->waiting; }

bool uart_sample(uint8_t byte, uint32_t rate_from, uint32_t rate_to, uint8_t *seen)
{
    uint32_t difference = rate_from > rate_to ? rate_from - rate_to : rate_to - rate_from;
    unsigned wire = 0xFFFFFE00u | (unsigned)byte << 1;
    wire = (wire & 0x1FFu) | 0xFFFFFE00u; /* start bit 0, data, stop bit and idle line 1 */
    if ((uint64_t)difference * 100 <= (uint64_t)rate_to * TOLERANCE_PERCENT) {
        *seen = byte;
        return true;
    }
    unsigned value = 0;
    for (unsigned bit = 0; bit < BITS - 1; bit++) {
        uint64_t at = (uint64_t)(2 * bit + 1) * rate_from / (2ull * rate_to);
        value |= (at > 31 ? 1u : wire >> at & 1u) << bit;
    }
    *seen = (uint8_t)(value >> 1);
    return false;
}

static void load_shift(uart_t *uart, uint64_t now)
{
    uart->bit_cycles = bit_cycles(uart);
    uart->rate_bps = M128_HZ / (uint32_t)uart->bit_cycles;
    uart->shift = uart->udr;
    uart->waiting = false;
    uart->shifting = true;
    uart->ends_at = now + BITS * uart->bit_cycles;
    at(uart, uart->ends_at);
    if (uart->begin) {
        uart->begin(uart->line, uart->shift);
    }
}

static void bit_or_character_is_over(void *context, uint64_t now)
{
    uart_t *uart = context;
    uint8_t byte = uart->shift;
    uint32_t rate_bps = uart->rate_bps;
    if (uart->moving) {
        uart->moving = false;
        at(uart, uart->ends_at);
        update_lines(uart);
        return;
    }
    uart->shifting = false;
    uart->counts.sent++;
    if (uart->waiting) {
        load_shift(uart, now);
    } else {
        uart->a |= UCSRA_TXC;
    }
    update_lines(uart);
    uart->sent(uart->line, now, byte, rate_bps);
}

static void write_udr(avr_t *avr, avr_io_addr_t address, uint8_t value, void *param)
{
    uart_t *uart = param;
    (void)address;
    if (!(uart->b & UCSRB_TXEN)) {
        violation_note(uart->machine, VIOLATION_UART_TX_LOST, "UDR%u written with the transmitter off", uart->index);
        return;
    }
    if (is_full(uart)) {
        violation_note(uart->machine, VIOLATION_UART_TX_LOST, "UDR%u written while it is full", uart->index);
        return;
    }
    uart->udr = value;
    uart->waiting = true;
    if (!uart->shifting) {
        load_shift(uart, avr->cycle);
        uart->moving = true;
        at(uart, avr->cycle + uart->bit_cycles);
    }
    update_lines(uart);
}

static uint8_t read_udr(avr_t *avr, avr_io_addr_t address, void *param)
{
    uart_t *uart = param;
    uint8_t value = uart->fifo[0];
    if (uart->fill > SHIFT_REGISTER) {
        uart->freed_at = avr->cycle;
    }
    if (uart->fill) {
        uart->fill--;
        for (unsigned i = 0; i < SHIFT_REGISTER; i++) {
            uart->fifo[i] = uart->fifo[i + 1];
            uart->flags[i] = uart->flags[i + 1];
        }
    }
    avr->data[address] = value;
    update_lines(uart);
    return value;
}

static void overrun(uart_t *uart)
{
    uart->counts.overruns++;
    violation_note(uart->machine, uart->index ? VIOLATION_UART_OVERRUN : VIOLATION_BUS_OVERRUN,
                   "UART%u overrun: a third character waits and a fourth has come", uart->index);
}

/* A fourth character replaces the third, which waits in the shift register for space in the buffer. The third is lost
 * at the start bit of the fourth, even if space becomes free before the fourth is complete. */
void uart_receive(uart_t *uart, uint64_t start, uint8_t byte, uint32_t rate_bps, bool bad)
{
    uint8_t seen, flags = 0;
    if (!(uart->b & UCSRB_RXEN) || uart->enabled_at > start) {
        uart->counts.deaf++;
        return;
    }
    if (!uart_sample(byte, rate_bps, M128_HZ / bit_cycles(uart), &seen) || bad) {
        flags |= UCSRA_FE;
        uart->counts.framing++;
    }
    if (uart->fill > SHIFT_REGISTER || uart->freed_at > start) {
        flags |= UCSRA_DOR;
        uart->freed_at = 0;
        overrun(uart);
    }
    uart->counts.received++;
    unsigned place = uart->fill > SHIFT_REGISTER ? SHIFT_REGISTER : uart->fill;
    uart->fifo[place] = seen;
    uart->flags[place] = flags;
    uart->fill = (uint8_t)(place + 1);
    update_lines(uart);
}

static uint8_t read_a(avr_t *avr, avr_io_addr_t address, void *param)
{
    const uart_t *uart = param;
    unsigned value = uart->a;
    value |= is_full(uart) ? 0u : UCSRA_UDRE;
    value |= uart->fill ? (unsigned)UCSRA_RXC | uart->flags[0] : 0u;
    avr->data[address] = (uint8_t)value;
    return (uint8_t)value;
}

/* Completes the reception of a character, or the transmission of the current one, if any. */
static void raise_interrupt(void *context, int vector, uint8_t byte)
{
    uart_t *uart = context;
    uint64_t now = uart->machine->avr->cycle, bits = BITS * bit_cycles(uart);
    if (vector == places[uart->index].vector) {
        uart_receive(uart, now > bits ? now - bits : 0, byte, M128_HZ / bit_cycles(uart), false);
    } else if (uart->shifting) {
        uart->moving = false;
        at(uart, now);
    }
}

static void transmit_complete_taken(void *context, int vector)
{
    uart_t *uart = context;
    uart->a &= (uint8_t)~UCSRA_TXC;
    machine_line(uart->machine, vector, false);
}

static void refuse_change(uart_t *uart, const char *what)
{
    if (uart->shifting) {
        violation_note(uart->machine, VIOLATION_UART_SETUP, "%s of UART%u changed while it sends", what, uart->index);
    }
}

static void write_a(avr_t *avr, avr_io_addr_t address, uint8_t value, void *param)
{
    uart_t *uart = param;
    uint8_t before = uart->a;
    (void)avr;
    (void)address;
    if (value & UCSRA_MPCM) {
        violation_note(uart->machine, VIOLATION_UART_FORMAT, "UART%u in multi-processor mode", uart->index);
    }
    if ((before ^ value) & UCSRA_U2X) {
        refuse_change(uart, "U2X");
    }
    uart->a = (uint8_t)((value & UCSRA_U2X) | (before & UCSRA_TXC & ~value));
    update_lines(uart);
}

static void write_b(avr_t *avr, avr_io_addr_t address, uint8_t value, void *param)
{
    uart_t *uart = param;
    (void)address;
    if (value & UCSRB_UCSZ2) {
        violation_note(uart->machine, VIOLATION_UART_FORMAT, "UART%u with 9 data bits", uart->index);
    }
    if (!(value & UCSRB_RXEN)) {
        uart->fill = 0; /* disabling the receiver flushes the buffer */
        uart->freed_at = 0;
    } else if (!(uart->b & UCSRB_RXEN)) {
        uart->enabled_at = avr->cycle;
    }
    uart->b = value;
    avr->data[places[uart->index].b] = value;
    update_lines(uart);
}

static void write_c(avr_t *avr, avr_io_addr_t address, uint8_t value, void *param)
{
    uart_t *uart = param;
    if (value != UCSRC_8N1) {
        violation_note(uart->machine, VIOLATION_UART_FORMAT, "UCSR%uC = 0x%02X: not 8N1", uart->index, value);
    }
    uart->c = value;
    avr->data[address] = value;
}

static void write_ubrr(avr_t *avr, avr_io_addr_t address, uint8_t value, void *param)
{
    uart_t *uart = param;
    avr->data[address] = value;
    if (address == places[uart->index].ubrrl) {
        refuse_change(uart, "rate");
        uart->ubrr = (uint16_t)((avr->data[places[uart->index].ubrrh] & 0x0F) << 8 | value);
    }
}

void uart_reset(uart_t *uart)
{
    avr_t *avr = uart->machine->avr;
    const place_t *place = &places[uart->index];
    uart->a = uart->b = 0;
    uart->c = UCSRC_8N1;
    uart->ubrr = 0;
    uart->fill = 0;
    uart->freed_at = 0;
    uart->shifting = uart->waiting = uart->moving = false;
    avr->data[place->a] = UCSRA_UDRE;
    avr->data[place->b] = 0;
    avr->data[place->c] = UCSRC_8N1;
    avr->data[place->ubrrl] = avr->data[place->ubrrh] = 0;
    at(uart, NEVER);
    update_lines(uart);
}

void uart_init(uart_t *uart, machine_t *machine, int index)
{
    const place_t *place = &places[index];
    uart->machine = machine;
    uart->index = (uint8_t)index;
    events_handle(&machine->events, index ? EVENT_UART1 : EVENT_UART0, bit_or_character_is_over, uart);
    machine_io(machine, place->udr, read_udr, write_udr, uart);
    machine_io(machine, place->a, read_a, write_a, uart);
    machine_io(machine, place->b, NULL, write_b, uart);
    machine_io(machine, place->c, NULL, write_c, uart);
    machine_io(machine, place->ubrrl, NULL, write_ubrr, uart);
    machine_io(machine, place->ubrrh, NULL, write_ubrr, uart);
    machine->source[place->vector] = (interrupt_source_t){ NULL, raise_interrupt, uart };
    machine->source[place->vector + 1] = (interrupt_source_t){ NULL, raise_interrupt, uart };
    machine->source[place->vector + 2] = (interrupt_source_t){ transmit_complete_taken, raise_interrupt, uart };
}
