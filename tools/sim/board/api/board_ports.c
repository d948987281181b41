/* SPDX-License-Identifier: MIT */
#include "board_ports.h"

#include "board_struct.h"

void board_console_rate(board_t *board, uint32_t bps)
{
    if (bps) {
        board->console.rate_bps = bps;
    }
}

void board_console_send(board_t *board, console_sender_t sender, const uint8_t *bytes, size_t count)
{
    console_wire_send(&board->console, sender, bytes, count);
}

void board_console_pause(board_t *board, uint64_t cycles) { console_wire_pause(&board->console, cycles); }

size_t board_console_waiting(const board_t *board) { return board->console.count; }

void board_console_flush(board_t *board) { console_wire_flush(&board->console); }

const uint8_t *board_console_output(const board_t *board, size_t *count)
{
    *count = board->console.output_count;
    return board->console.output;
}

void board_console_forget(board_t *board) { console_wire_forget(&board->console); }

void board_on_console(board_t *board, board_byte_fn heard, void *context)
{
    board->console.heard = heard;
    board->console.heard_context = context;
}

servo_bus_t *board_servo_bus(board_t *board) { return board->wire.bus; }

void board_body(board_t *board, const servo_body_t *body) { bus_wire_body(&board->wire, body); }

uint64_t board_bus_turn(board_t *board, bool forget)
{
    uint64_t longest = board->wire.longest_turn;
    board->wire.longest_turn = forget ? 0 : longest;
    return longest;
}

uint64_t board_bus_pause(board_t *board, bool forget)
{
    uint64_t longest = board->wire.longest_pause;
    board->wire.longest_pause = forget ? 0 : longest;
    return longest;
}

void board_trace_start(board_t *board)
{
    trace_start(&board->trace, board->wire.bus);
}

const trace_packet_t *board_trace(const board_t *board, size_t *count)
{
    *count = board->trace.count;
    return board->trace.packets;
}

void board_uart_counts(const board_t *board, int uart, uart_counts_t *counts) { *counts = board->uart[uart == 1].counts; }

void board_press(board_t *board, button_t button, bool down)
{
    if (button == BUTTON_MODE) {
        board_hold_reset(board, down);
    } else {
        panel_press(&board->panel, button, down);
    }
}

void board_set_bounce(board_t *board, uint64_t cycles) { board->panel.bounce = cycles; }

uint8_t board_leds(const board_t *board) { return board->panel.leds; }

int board_pin(const board_t *board, char port, int bit)
{
    static const uint16_t ports[7] = { M128_PORTA, M128_PORTB, M128_PORTC, M128_PORTD, M128_PORTE, 0x62, 0x65 };
    if (port < 'A' || port > 'G' || bit < 0 || bit > 7) {
        return -1;
    }
    uint16_t address = ports[port - 'A'];
    unsigned ddr = board->cpu.machine.avr->data[address - 1], out = board->cpu.machine.avr->data[address];
    return ddr >> bit & 1 ? (int)(out >> bit & 1) : -1;
}

void board_battery(board_t *board, double volts) { panel_battery(&board->panel, volts); }
