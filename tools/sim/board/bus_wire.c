/* SPDX-License-Identifier: MIT */
#include "board_private.h"
#include "servo_bus.h"

#define PIN_DRIVE 0x04u  /* PE2 */
#define PIN_LISTEN 0x08u /* PE3, CM-5 only */
#define FRAME_BITS 10u

static uint8_t driven_high(const board_t *board)
{
    return board->avr->data[M128_DDRE] & board->avr->data[M128_PORTE];
}

void bus_wire_follow(board_t *board) { event_at(board, EVENT_BUS, servo_bus_next_cycles(board->wire.bus)); }

static bool is_listening(const board_t *board, uint8_t high)
{
    return board->power.on && (board->kind == BOARD_CM5 ? (high & PIN_LISTEN) != 0 : (high & PIN_DRIVE) == 0);
}

void bus_wire_pins(board_t *board, uint8_t before, uint8_t after)
{
    bus_wire_t *wire = &board->wire;
    if ((before & PIN_DRIVE) && !(after & PIN_DRIVE) && uart_is_sending(&board->uart[0])) {
        violation_note(board, VIOLATION_BUS_RELEASED, "bus released (PE2 low) before the last stop bit has left");
    }
    if (board->kind == BOARD_CM5 && (after & PIN_DRIVE) && (after & PIN_LISTEN)) {
        violation_note(board, VIOLATION_BUS_BOTH, "PE2 and PE3 high together");
    }
    if (!is_listening(board, after)) {
        wire->listening_since = NEVER;
    } else if (wire->listening_since == NEVER) {
        wire->listening_since = board->avr->cycle;
        uint64_t turn = wire->sent_at == NEVER ? 0 : board->avr->cycle - wire->sent_at;
        wire->longest_turn = turn > wire->longest_turn ? turn : wire->longest_turn;
        wire->sent_at = NEVER;
    }
}

static void begin(uart_t *uart, uint64_t now)
{
    (void)now;
    if (!(driven_high(uart->board) & PIN_DRIVE)) {
        violation_note(uart->board, VIOLATION_BUS_UNDRIVEN, "byte 0x%02X sent on the bus with PE2 low", uart->shift);
    }
}

static void sent(uart_t *uart, uint64_t now, uint8_t byte, uint32_t rate_bps)
{
    board_t *board = uart->board;
    bus_wire_t *wire = &board->wire;
    wire->sent_at = now;
    if (driven_high(board) & PIN_DRIVE) {
        servo_bus_host_byte(wire->bus, now, byte, rate_bps);
        bus_wire_follow(board);
    }
}

/* A byte whose start bit passed before the board listened is garbage: the receiver takes some later edge for it. */
static void from_servo(void *context, uint64_t now, uint8_t byte, uint32_t rate_bps, bool bad)
{
    board_t *board = context;
    bus_wire_t *wire = &board->wire;
    uint64_t start = now - FRAME_BITS * (uint64_t)M128_HZ / rate_bps;
    if (wire->listening_since == NEVER) {
        board->uart[0].counts.deaf++;
        return;
    }
    if (wire->listening_since > start) {
        byte = (uint8_t)(byte >> 3 | 0xE0);
        bad = true;
    }
    vcd_byte(board, 0, false, byte);
    uart_receive(&board->uart[0], start, byte, rate_bps, bad);
}

void bus_wire_event(board_t *board, uint64_t now)
{
    servo_bus_advance(board->wire.bus, now);
    bus_wire_follow(board);
}

void bus_wire_supply(board_t *board, double volts)
{
    servo_bus_supply(board->wire.bus, board->avr->cycle, volts);
    bus_wire_follow(board);
}

void board_body(board_t *board, const struct servo_body *body)
{
    servo_bus_body(board->wire.bus, board->avr->cycle, body);
    bus_wire_follow(board);
}

struct servo_bus *board_servo_bus(board_t *board) { return board->wire.bus; }

uint64_t board_bus_turn(board_t *board, bool forget)
{
    uint64_t longest = board->wire.longest_turn;
    board->wire.longest_turn = forget ? 0 : longest;
    return longest;
}

bool bus_wire_init(board_t *board)
{
    bus_wire_t *wire = &board->wire;
    wire->bus = servo_bus_new();
    if (!wire->bus) {
        return false;
    }
    wire->bus->on_byte = from_servo;
    wire->bus->on_byte_context = board;
    wire->listening_since = wire->sent_at = NEVER;
    board->uart[0].begin = begin;
    board->uart[0].sent = sent;
    servo_bus_power(wire->bus, 0, false);
    return true;
}

void bus_wire_free(board_t *board)
{
    if (board->wire.bus) {
        servo_bus_free(board->wire.bus);
    }
}
