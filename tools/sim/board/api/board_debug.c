/* SPDX-License-Identifier: MIT */
#include "board_debug.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "board_struct.h"
#include "gdb.h"

uint32_t board_function(const board_t *board, const char *name)
{
    if (strncmp(name, "0x", 2) == 0) {
        return (uint32_t)strtoul(name, NULL, 16) & (M128_FLASH_BYTES - 2);
    }
    const symbol_t *symbol = symbols_find(&board->cpu.machine.symbols, name, true);
    return symbol ? symbol->address : UINT32_MAX;
}

uint32_t board_variable(const board_t *board, const char *name)
{
    const symbol_t *symbol = symbols_find(&board->cpu.machine.symbols, name, false);
    return symbol ? symbol->address : UINT32_MAX;
}

const char *board_function_at(const board_t *board, uint32_t address)
{
    const symbol_t *symbol = symbols_at(&board->cpu.machine.symbols, address);
    return symbol ? symbol->name : "?";
}

uint32_t board_pc(const board_t *board) { return board->cpu.machine.avr->pc; }

uint32_t board_stack_low(const board_t *board) { return stack_low(&board->cpu.stack); }
uint32_t board_stack_headroom(const board_t *board) { return stack_headroom(&board->cpu.stack); }

bool board_probe(board_t *board, const char *function)
{
    return probe_add(&board->cpu.probes, function, board_function(board, function));
}

const probe_t *board_probe_result(const board_t *board, const char *function)
{
    return probe_result(&board->cpu.probes, function);
}

void board_probe_clear(board_t *board) { probe_clear(&board->cpu.probes); }

uint64_t board_interrupt_count(const board_t *board, int vector)
{
    return vector > 0 && vector < VECTOR_COUNT ? board->cpu.interrupts.count[vector] : 0;
}

uint64_t board_interrupt_max(const board_t *board, int vector)
{
    return vector > 0 && vector < VECTOR_COUNT ? board->cpu.interrupts.longest[vector] : 0;
}

bool board_interrupt(board_t *board, int vector, uint8_t byte) { return interrupt_raise(&board->cpu.machine, vector, byte); }

bool board_sweep(board_t *board, const char *function, int vector, uint8_t byte)
{
    return sweep_add(&board->cpu.sweeps, function, board_function(board, function), vector, byte);
}

const sweep_t *board_sweep_result(const board_t *board, const char *function)
{
    return sweep_result(&board->cpu.sweeps, function);
}

void board_sweep_end(board_t *board) { sweep_end(&board->cpu.sweeps); }

void board_skip_waits(board_t *board, bool on) { waits_skip(&board->cpu.waits, on); }

uint32_t board_step(board_t *board) { return cpu_step(&board->cpu); }

bool board_gdb(board_t *board, int port, bool wait)
{
    bool started = gdb_start(board->cpu.machine.avr, port, wait);
    if (!started) {
        snprintf(board->error, sizeof board->error, "GDB: port %d of 127.0.0.1 cannot be opened", port);
    }
    return started;
}
