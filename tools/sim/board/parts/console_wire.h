/* SPDX-License-Identifier: MIT
 * console_wire.h - the line from the PC and the remote to UART1. */
#ifndef SIM_CONSOLE_WIRE_H
#define SIM_CONSOLE_WIRE_H

#include "uart.h"

/* One byte (kind: its console_sender_t, value: bits per second) or a pause (value: microseconds). Only eight bytes
 * long, because a fuzz test may queue millions. */
typedef struct { uint8_t byte, kind; uint32_t value; } console_item_t;

typedef struct {
    machine_t *machine;
    uart_t *uart;
    board_kind_t kind;
    uint32_t rate_bps;
    console_item_t *queue;
    size_t head, count, room;
    bool on_line;
    bool heard_from_start;
    uint64_t line_start;
    uint8_t *output;
    size_t output_count, output_room;
    board_byte_fn heard;
    void *heard_context;
    char stop_text[128];
    size_t stop_from;
} console_wire_t;

void console_wire_init(console_wire_t *console, machine_t *machine, uart_t *uart, board_kind_t kind);
void console_wire_free(console_wire_t *console);

/* As in board_ports.h. */
void console_wire_send(console_wire_t *console, console_sender_t sender, const uint8_t *bytes, size_t count);
void console_wire_pause(console_wire_t *console, uint64_t cycles);
void console_wire_flush(console_wire_t *console);
void console_wire_forget(console_wire_t *console);
void console_wire_stop_on_text(console_wire_t *console, const char *text);

#endif
