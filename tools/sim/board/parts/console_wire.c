/* SPDX-License-Identifier: MIT */
#include "console_wire.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define DEFAULT_BPS 57600u
#define FRAME_BITS 10u
#define CYCLES_PER_US (M128_HZ / 1000000u)
#define GATE_PC 0x20u     /* PD5, CM-5 */
#define GATE_REMOTE 0x40u /* PD6 */
enum { ITEM_PAUSE = 2 };  /* the value after console_sender_t */

static bool gate_is_open(const console_wire_t *console, uint8_t sender)
{
    const uint8_t *data = console->machine->avr->data;
    uint8_t gate = sender == CONSOLE_PC ? GATE_PC : GATE_REMOTE;
    return console->kind == BOARD_CM2 || (data[M128_DDRD] & data[M128_PORTD] & gate);
}

static uint64_t item_cycles(const console_item_t *item)
{
    return item->kind == ITEM_PAUSE ? (uint64_t)item->value * CYCLES_PER_US
                                    : (FRAME_BITS * M128_HZ + item->value / 2) / item->value;
}

static void begin_item(console_wire_t *console, uint64_t now)
{
    console->on_line = console->count > 0;
    if (!console->on_line) {
        return;
    }
    const console_item_t *item = &console->queue[console->head];
    console->line_start = now;
    console->heard_from_start = item->kind != ITEM_PAUSE && gate_is_open(console, item->kind);
    event_at(&console->machine->events, EVENT_CONSOLE, now + item_cycles(item));
}

static void item_is_over(void *context, uint64_t now)
{
    console_wire_t *console = context;
    console_item_t item = console->queue[console->head];
    console->count--;
    console->head = console->count ? console->head + 1 : 0;
    if (item.kind != ITEM_PAUSE) {
        if (console->heard_from_start && gate_is_open(console, item.kind)) {
            uart_receive(console->uart, console->line_start, item.byte, item.value, false);
        } else {
            console->uart->counts.deaf++;
        }
    }
    begin_item(console, now);
}

/* Moves the queue down when more than half of its space is free at the front; otherwise enlarges it. */
static bool make_room(console_wire_t *console)
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

static void add_item(console_wire_t *console, console_item_t item)
{
    if (!make_room(console)) {
        return;
    }
    console->queue[console->head + console->count++] = item;
    if (!console->on_line) {
        begin_item(console, console->machine->avr->cycle);
    }
}

void console_wire_send(console_wire_t *console, console_sender_t sender, const uint8_t *bytes, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        add_item(console, (console_item_t){ .byte = bytes[i], .kind = (uint8_t)sender, .value = console->rate_bps });
    }
}

void console_wire_pause(console_wire_t *console, uint64_t cycles)
{
    add_item(console, (console_item_t){ .kind = ITEM_PAUSE, .value = (uint32_t)(cycles / CYCLES_PER_US) });
}

void console_wire_flush(console_wire_t *console) { console->count = console->count && console->on_line ? 1 : 0; }

static void append(console_wire_t *console, uint8_t byte)
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

static bool stop_text_seen(console_wire_t *console)
{
    size_t length = strlen(console->stop_text);
    return length && console->output_count >= console->stop_from + length &&
           memcmp(console->output + console->output_count - length, console->stop_text, length) == 0;
}

static void sent(void *line, uint64_t now, uint8_t byte, uint32_t rate_bps)
{
    console_wire_t *console = line;
    uint8_t seen;
    bool clean = uart_sample(byte, rate_bps, console->rate_bps, &seen);
    append(console, seen);
    if (console->heard) {
        console->heard(console->heard_context, now, seen, !clean);
    }
    if (stop_text_seen(console)) {
        console->stop_text[0] = 0;
        machine_end_run(console->machine, BOARD_STOP_TEXT);
    }
}

void console_wire_stop_on_text(console_wire_t *console, const char *text)
{
    snprintf(console->stop_text, sizeof console->stop_text, "%s", text ? text : "");
    console->stop_from = console->output_count;
}

void console_wire_forget(console_wire_t *console) { console->output_count = console->stop_from = 0; }

void console_wire_init(console_wire_t *console, machine_t *machine, uart_t *uart, board_kind_t kind)
{
    console->machine = machine;
    console->uart = uart;
    console->kind = kind;
    console->rate_bps = DEFAULT_BPS;
    uart->sent = sent;
    uart->line = console;
    events_handle(&machine->events, EVENT_CONSOLE, item_is_over, console);
}

void console_wire_free(console_wire_t *console)
{
    free(console->queue);
    free(console->output);
}
