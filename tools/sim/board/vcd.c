/* SPDX-License-Identifier: MIT */
#include <stdlib.h>
#include <string.h>

#include "board_private.h"

/* One line of the file's header each; the code is a letter from 'a' on. */
static const struct { const char *name; uint16_t ddr; uint8_t bit; } pins[] = {
    { "led_power", M128_DDRC, 0 },   { "led_txd", M128_DDRC, 1 },     { "led_rxd", M128_DDRC, 2 },
    { "led_aux", M128_DDRC, 3 },     { "led_manage", M128_DDRC, 4 },  { "led_program", M128_DDRC, 5 },
    { "led_play", M128_DDRC, 6 },    { "bus_drive", M128_DDRE, 2 },   { "bus_listen", M128_DDRE, 3 },
    { "gate_pc", M128_DDRD, 5 },     { "gate_remote", M128_DDRD, 6 }, { "charger_off", M128_DDRB, 5 },
};
#define PINS ((int)(sizeof pins / sizeof pins[0]))
static const char *const bytes[4] = { "bus_rx", "bus_tx", "console_rx", "console_tx" };

struct vcd {
    FILE *file;
    uint64_t time;
    char pin[PINS];
    int byte[4];
};

static void stamp(struct vcd *vcd, uint64_t now)
{
    if (now > vcd->time) {
        vcd->time = now;
        fprintf(vcd->file, "#%llu\n", (unsigned long long)(now * 125 / 2)); /* 62.5 ns in units of 1 ns */
    }
}

static char level(const board_t *board, int i)
{
    const uint8_t *data = board->avr->data;
    unsigned mask = 1u << pins[i].bit;
    if (!(data[pins[i].ddr] & mask)) {
        return 'z';
    }
    return data[pins[i].ddr + 1] & mask ? '1' : '0';
}

void vcd_pins(board_t *board)
{
    struct vcd *vcd = board->vcd;
    for (int i = 0; vcd && i < PINS; i++) {
        char now = level(board, i);
        if (now != vcd->pin[i]) {
            vcd->pin[i] = now;
            stamp(vcd, board->avr->cycle);
            fprintf(vcd->file, "%c%c\n", now, 'a' + i);
        }
    }
}

static void write_byte(struct vcd *vcd, int line)
{
    int byte = vcd->byte[line];
    fputc('b', vcd->file);
    for (int bit = 7; bit >= 0; bit--) {
        fputc(byte < 0 ? 'z' : '0' + (byte >> bit & 1), vcd->file);
    }
    fprintf(vcd->file, " %c\n", 'A' + line);
}

void vcd_byte(board_t *board, int uart, bool sent, int byte)
{
    struct vcd *vcd = board->vcd;
    int line = 2 * uart + sent;
    if (vcd && vcd->byte[line] != byte) {
        vcd->byte[line] = byte;
        stamp(vcd, board->avr->cycle);
        write_byte(vcd, line);
    }
}

static void write_header(struct vcd *vcd)
{
    fprintf(vcd->file, "$timescale 1 ns $end\n$scope module board $end\n");
    for (int i = 0; i < PINS; i++) {
        fprintf(vcd->file, "$var wire 1 %c %s $end\n", 'a' + i, pins[i].name);
    }
    for (int i = 0; i < 4; i++) {
        fprintf(vcd->file, "$var wire 8 %c %s $end\n", 'A' + i, bytes[i]);
    }
    fprintf(vcd->file, "$upscope $end\n$enddefinitions $end\n");
}

bool board_vcd_start(board_t *board, const char *path)
{
    board_vcd_stop(board);
    struct vcd *vcd = calloc(1, sizeof *vcd);
    FILE *file = vcd ? fopen(path, "w") : NULL;
    if (!file) {
        snprintf(board->error, sizeof board->error, "%.200s: cannot be written", path);
        free(vcd);
        return false;
    }
    vcd->file = file;
    write_header(vcd);
    stamp(vcd, board->avr->cycle);
    board->vcd = vcd;
    vcd_pins(board);
    for (int line = 0; line < 4; line++) {
        vcd->byte[line] = -1;
        write_byte(vcd, line);
    }
    return true;
}

void board_vcd_stop(board_t *board)
{
    if (board->vcd) {
        fclose(board->vcd->file);
        free(board->vcd);
        board->vcd = NULL;
    }
}

void vcd_free(board_t *board) { board_vcd_stop(board); }
