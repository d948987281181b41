/* SPDX-License-Identifier: MIT
 * console.h - the line between UART1 and the PC or the remote. */
#ifndef SIM_PARTS_CONSOLE_H
#define SIM_PARTS_CONSOLE_H

#include "board_ports.h"

/* One byte (kind: its console_sender_t, value: bits per second) or a pause (value: microseconds). Eight bytes, because
 * a fuzz test may queue millions. */
typedef struct { uint8_t byte, kind; uint32_t value; } console_item_t;

typedef struct {
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
} console_t;

void console_init(board_t *board);
void console_free(board_t *board);
void console_event(board_t *board, uint64_t now); /* a character or a pause is over */

#endif
