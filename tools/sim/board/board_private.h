/* SPDX-License-Identifier: MIT
 * board_private.h - the one struct behind board.h, for the files of the board model only. Each part belongs to the
 * files that parts/<name>.h names; they change no other. */
#ifndef SIM_BOARD_PRIVATE_H
#define SIM_BOARD_PRIVATE_H

#include <simavr/sim_avr.h>
#include <simavr/sim_core.h>
#include <simavr/sim_gdb.h>
#include <stdio.h>

#include "board.h"
#include "m128.h"
#include "parts/bus_wire.h"
#include "parts/console.h"
#include "parts/cpu.h"
#include "parts/eeprom.h"
#include "parts/events.h"
#include "parts/flash.h"
#include "parts/look.h"
#include "parts/panel.h"
#include "parts/power.h"
#include "parts/reset.h"
#include "parts/stack.h"
#include "parts/sweep.h"
#include "parts/timer.h"
#include "parts/uart.h"
#include "parts/waits.h"
#include "symbols.h"

struct board {
    avr_t *avr;
    board_kind_t kind;
    bool bootrst;
    uint32_t random; /* xorshift state */
    bool stopped;
    board_stop_t stop;
    violation_t violation;
    bool allowed[VIOLATION_COUNT];
    uint32_t violations[VIOLATION_COUNT];
    char error[256];
    uint32_t stop_at;
    events_t events;
    cpu_t cpu;
    stack_guard_t stack;
    flash_t flash;
    eeprom_t eeprom;
    power_t power;
    uart_t uart[2];
    timer16_t timer[2];
    console_t console;
    bus_wire_t wire;
    panel_t panel;
    reset_t reset;
    symbols_t symbols;
    struct probes *probes;
    struct sweeps *sweeps;
    sweep_call_t sweep;
    waits_t waits;
    struct trace *trace;
    struct vcd *vcd;
    avr_io_t io; /* how simavr's core asks us about SPM and WDR */
};

uint32_t board_random(board_t *board);
void board_end_run(board_t *board, board_stop_t why);

/* Takes over one register: simavr's own handlers are not asked any more. NULL: plain memory. */
void board_io(board_t *board, uint16_t address, avr_io_read_t read, avr_io_write_t write, void *param);

/* violation.c: true if the run must end (the caller then leaves the chip's state alone). */
__attribute__((format(printf, 3, 4)))
bool violation_note(board_t *board, violation_kind_t kind, const char *format, ...);

#endif
