/* SPDX-License-Identifier: MIT */
#include "bus_wire.h"

#define PIN_DRIVE 0x04u  /* PE2 */
#define PIN_LISTEN 0x08u /* PE3, CM-5 only */
#define FRAME_BITS 10u

static uint8_t driven_high(const bus_wire_t *wire)
{
    const uint8_t *data = wire->machine->avr->data;
    return data[M128_DDRE] & data[M128_PORTE];
}

void bus_wire_follow(bus_wire_t *wire) { event_at(&wire->machine->events, EVENT_BUS, servo_bus_next_cycles(wire->bus)); }

static bool is_listening(const bus_wire_t *wire, uint8_t high)
{
    return wire->machine->powered && (wire->kind == BOARD_CM5 ? (high & PIN_LISTEN) != 0 : (high & PIN_DRIVE) == 0);
}

void bus_wire_pins(bus_wire_t *wire, uint8_t before, uint8_t after)
{
    if ((before & PIN_DRIVE) && !(after & PIN_DRIVE) && uart_is_sending(wire->uart)) {
        violation_note(wire->machine, VIOLATION_BUS_RELEASED, "bus released (PE2 low) before the last stop bit has left");
    }
    if (wire->kind == BOARD_CM5 && (after & PIN_DRIVE) && (after & PIN_LISTEN)) {
        violation_note(wire->machine, VIOLATION_BUS_BOTH, "PE2 and PE3 high together");
    }
    if (!(after & PIN_DRIVE)) {
        wire->character_end = NEVER;
    }
    if (!is_listening(wire, after)) {
        wire->listening_since = NEVER;
    } else if (wire->listening_since == NEVER) {
        wire->listening_since = wire->machine->avr->cycle;
        uint64_t turn = wire->sent_at == NEVER ? 0 : wire->machine->avr->cycle - wire->sent_at;
        wire->longest_turn = turn > wire->longest_turn ? turn : wire->longest_turn;
        wire->sent_at = NEVER;
    }
}

static void begin(void *line, uint8_t byte)
{
    bus_wire_t *wire = line;
    if (!(driven_high(wire) & PIN_DRIVE)) {
        violation_note(wire->machine, VIOLATION_BUS_UNDRIVEN, "byte 0x%02X sent on the bus with PE2 low", byte);
    }
}

static void note_pause(bus_wire_t *wire, uint64_t start)
{
    uint64_t pause = wire->character_end == NEVER ? 0 : start - wire->character_end;
    wire->longest_pause = pause > wire->longest_pause ? pause : wire->longest_pause;
}

static void sent(void *line, uint64_t now, uint8_t byte, uint32_t rate_bps)
{
    bus_wire_t *wire = line;
    wire->sent_at = now;
    if (driven_high(wire) & PIN_DRIVE) {
        note_pause(wire, now - FRAME_BITS * (uint64_t)M128_HZ / rate_bps);
        wire->character_end = now;
        servo_bus_host_byte(wire->bus, now, byte, rate_bps);
        bus_wire_follow(wire);
    }
}

/* A byte whose start bit passed before the board listened is garbage: the receiver mistakes a later edge for it. */
static void from_servo(void *context, uint64_t now, uint8_t byte, uint32_t rate_bps, bool bad)
{
    bus_wire_t *wire = context;
    uint64_t start = now - FRAME_BITS * (uint64_t)M128_HZ / rate_bps;
    if (wire->listening_since == NEVER) {
        wire->uart->counts.deaf++;
        return;
    }
    if (wire->listening_since > start) {
        byte = (uint8_t)(byte >> 3 | 0xE0);
        bad = true;
    }
    uart_receive(wire->uart, start, byte, rate_bps, bad);
}

static void something_is_due(void *context, uint64_t now)
{
    bus_wire_t *wire = context;
    servo_bus_advance(wire->bus, now);
    bus_wire_follow(wire);
}

void bus_wire_power(bus_wire_t *wire, bool on)
{
    servo_bus_power(wire->bus, wire->machine->avr->cycle, on);
    bus_wire_follow(wire);
}

void bus_wire_supply(bus_wire_t *wire, double volts)
{
    servo_bus_supply(wire->bus, wire->machine->avr->cycle, volts);
    bus_wire_follow(wire);
}

void bus_wire_body(bus_wire_t *wire, const servo_body_t *body)
{
    servo_bus_body(wire->bus, wire->machine->avr->cycle, body);
    bus_wire_follow(wire);
}

bool bus_wire_init(bus_wire_t *wire, machine_t *machine, uart_t *uart, board_kind_t kind)
{
    wire->machine = machine;
    wire->uart = uart;
    wire->kind = kind;
    wire->bus = servo_bus_new();
    if (!wire->bus) {
        return false;
    }
    wire->bus->on_byte = from_servo;
    wire->bus->on_byte_context = wire;
    wire->listening_since = wire->sent_at = wire->character_end = NEVER;
    uart->begin = begin;
    uart->sent = sent;
    uart->line = wire;
    events_handle(&machine->events, EVENT_BUS, something_is_due, wire);
    servo_bus_power(wire->bus, 0, false);
    return true;
}

void bus_wire_free(bus_wire_t *wire)
{
    if (wire->bus) {
        servo_bus_free(wire->bus);
    }
}
