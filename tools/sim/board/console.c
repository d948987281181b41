/* SPDX-License-Identifier: MIT */
#include <stdlib.h>
#include <string.h>

#include "board_private.h"

#define DEFAULT_BPS 57600u
#define FRAME_BITS 10u
#define CYCLES_PER_US (M128_HZ / 1000000u)
#define GATE_PC 0x20u     /* PD5, CM-5 */
#define GATE_REMOTE 0x40u /* PD6 */
enum { ITEM_PAUSE = 2 };  /* behind console_sender_t */

static bool gate_is_open(const board_t *board, uint8_t sender)
{
    const uint8_t *data = board->avr->data;
    uint8_t gate = sender == CONSOLE_PC ? GATE_PC : GATE_REMOTE;
    return board->kind == BOARD_CM2 || (data[M128_DDRD] & data[M128_PORTD] & gate);
}

static uint64_t item_cycles(const console_item_t *item)
{
    return item->kind == ITEM_PAUSE ? (uint64_t)item->value * CYCLES_PER_US
                                    : (FRAME_BITS * M128_HZ + item->value / 2) / item->value;
}

static void begin_item(board_t *board, uint64_t now)
{
    console_t *console = &board->console;
    console->on_line = console->count > 0;
    if (!console->on_line) {
        return;
    }
    const console_item_t *item = &console->queue[console->head];
    console->line_start = now;
    console->heard_from_start = item->kind != ITEM_PAUSE && gate_is_open(board, item->kind);
    if (item->kind != ITEM_PAUSE) {
        vcd_byte(board, 1, false, item->byte);
    }
    event_at(board, EVENT_CONSOLE, now + item_cycles(item));
}

void console_event(board_t *board, uint64_t now)
{
    console_t *console = &board->console;
    console_item_t item = console->queue[console->head];
    console->count--;
    console->head = console->count ? console->head + 1 : 0;
    vcd_byte(board, 1, false, -1);
    if (item.kind != ITEM_PAUSE) {
        if (console->heard_from_start && gate_is_open(board, item.kind)) {
            uart_receive(&board->uart[1], console->line_start, item.byte, item.value, false);
        } else {
            board->uart[1].counts.deaf++;
        }
    }
    begin_item(board, now);
}

/* The queue moves down when half of it has left, and grows otherwise. */
static bool make_room(console_t *console)
{
    if (console->head + console->count < console->room) {
        return true;
    }
    if (console->head > console->room / 2) {
        memmove(console->queue, console->queue + console->head, console->count * sizeof *console->queue);
        console->head = 0;
        return true;
    }
    size_t room = console->room ? console->room * 2 : 256;
    console_item_t *queue = realloc(console->queue, room * sizeof *queue);
    if (!queue) {
        return false;
    }
    console->queue = queue;
    console->room = room;
    return true;
}

static void add_item(board_t *board, console_item_t item)
{
    console_t *console = &board->console;
    if (!make_room(console)) {
        return;
    }
    console->queue[console->head + console->count++] = item;
    if (!console->on_line) {
        begin_item(board, board->avr->cycle);
    }
}

void board_console_send(board_t *board, console_sender_t sender, const uint8_t *bytes, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        add_item(board, (console_item_t){ .byte = bytes[i], .kind = (uint8_t)sender, .value = board->console.rate_bps });
    }
}

void board_console_pause(board_t *board, uint64_t cycles)
{
    add_item(board, (console_item_t){ .kind = ITEM_PAUSE, .value = (uint32_t)(cycles / CYCLES_PER_US) });
}

size_t board_console_waiting(const board_t *board) { return board->console.count; }

void board_console_flush(board_t *board)
{
    board->console.count = board->console.count && board->console.on_line ? 1 : 0;
}

void board_console_rate(board_t *board, uint32_t bps)
{
    if (bps) {
        board->console.rate_bps = bps;
    }
}

static void append(console_t *console, uint8_t byte)
{
    if (console->output_count == console->output_room) {
        size_t room = console->output_room ? console->output_room * 2 : 4096;
        uint8_t *output = realloc(console->output, room);
        if (!output) {
            return;
        }
        console->output = output;
        console->output_room = room;
    }
    console->output[console->output_count++] = byte;
}

static bool stop_text_seen(console_t *console)
{
    size_t length = strlen(console->stop_text);
    return length && console->output_count >= console->stop_from + length &&
           memcmp(console->output + console->output_count - length, console->stop_text, length) == 0;
}

static void sent(uart_t *uart, uint64_t now, uint8_t byte, uint32_t rate_bps)
{
    console_t *console = &uart->board->console;
    uint8_t seen;
    bool clean = uart_sample(byte, rate_bps, console->rate_bps, &seen);
    append(console, seen);
    if (console->heard) {
        console->heard(console->heard_context, now, seen, !clean);
    }
    if (stop_text_seen(console)) {
        console->stop_text[0] = 0;
        board_end_run(uart->board, BOARD_STOP_TEXT);
    }
}

void board_stop_on_text(board_t *board, const char *console_text)
{
    console_t *console = &board->console;
    snprintf(console->stop_text, sizeof console->stop_text, "%s", console_text ? console_text : "");
    console->stop_from = console->output_count;
}

const uint8_t *board_console_output(const board_t *board, size_t *count)
{
    *count = board->console.output_count;
    return board->console.output;
}

void board_console_forget(board_t *board)
{
    board->console.output_count = 0;
    board->console.stop_from = 0;
}

void board_on_console(board_t *board, board_byte_fn heard, void *context)
{
    board->console.heard = heard;
    board->console.heard_context = context;
}

void console_init(board_t *board)
{
    board->console.rate_bps = DEFAULT_BPS;
    board->uart[1].sent = sent;
}

void console_free(board_t *board)
{
    free(board->console.queue);
    free(board->console.output);
}
