/* SPDX-License-Identifier: MIT */
#include "board.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "board_struct.h"
#include "image_file.h"
#include "power.h"
#include "reset.h"

/* In the order of dependency. false: out of memory. */
static bool init_parts(board_t *board, board_kind_t kind, uint32_t seed)
{
    machine_t *machine = &board->cpu.machine;
    if (!cpu_init(&board->cpu, seed)) {
        return false;
    }
    board->operations.machine = machine;
    flash_init(&board->flash, machine, &board->operations);
    eeprom_init(&board->eeprom, machine, &board->operations);
    watchdog_init(&board->watchdog, machine);
    timers_init(&board->timers, machine);
    uart_init(&board->uart[0], machine, 0);
    uart_init(&board->uart[1], machine, 1);
    if (!bus_wire_init(&board->wire, machine, &board->uart[0], kind)) {
        return false;
    }
    console_wire_init(&board->console, machine, &board->uart[1], kind);
    panel_init(&board->panel, machine, &board->wire, kind);
    reset_init(board);
    power_init(board);
    return true;
}

board_t *board_new(board_kind_t kind, uint32_t seed)
{
    board_t *board = calloc(1, sizeof *board);
    if (!board || !init_parts(board, kind, seed)) {
        board_free(board);
        return NULL;
    }
    board->cpu.machine.allowed[VIOLATION_BUS_OVERRUN] = true;
    machine_code_changed(&board->cpu.machine, 0, M128_FLASH_BYTES);
    reset_now(board, RESET_POWER_ON);
    board->resets = 0;
    return board;
}

void board_free(board_t *board)
{
    if (!board) {
        return;
    }
    trace_free(&board->trace);
    console_wire_free(&board->console);
    bus_wire_free(&board->wire);
    machine_free(&board->cpu.machine);
    free(board);
}

const char *board_error(const board_t *board) { return board->error; }

static void load_symbols(board_t *board, const char *path, bool boot)
{
    char elf[4096];
    const char *dot = strrchr(path, '.');
    size_t stem = dot && !strchr(dot, '/') ? (size_t)(dot - path) : strlen(path);
    snprintf(elf, sizeof elf, "%.*s.elf", (int)stem, path);
    symbols_load(&board->cpu.machine.symbols, elf, boot);
}

bool board_load(board_t *board, const char *path, uint32_t address)
{
    static uint8_t bytes[M128_FLASH_BYTES];
    static bool used[M128_FLASH_BYTES];
    image_status_t status = image_file_read(path, address, &(image_t){ bytes, used, sizeof bytes });
    if (status != IMAGE_OK) {
        snprintf(board->error, sizeof board->error, "%.200s %s", path, image_text(status));
        return false;
    }
    bool boot = false, application = false;
    for (uint32_t i = 0; i < M128_FLASH_BYTES; i++) {
        if (used[i]) {
            board->cpu.machine.avr->flash[i] = bytes[i];
            boot |= i >= M128_NRWW_START;
            application |= i < 0x0C000;
        }
    }
    board->bootrst |= boot;
    machine_code_changed(&board->cpu.machine, 0, M128_FLASH_BYTES);
    if (boot || application) {
        load_symbols(board, path, boot && !application);
    }
    return true;
}

void board_set_bootrst(board_t *board, bool programmed) { board->bootrst = programmed; }

board_stop_t board_run(board_t *board, uint64_t cycles)
{
    if (board->cpu.machine.violation.kind != VIOLATION_NONE) {
        return BOARD_STOP_VIOLATION;
    }
    board->cpu.machine.stopped = false;
    bus_wire_follow(&board->wire); /* a caller may have put something on the bus since the last run */
    event_at(&board->cpu.machine.events, EVENT_LIMIT, board->cpu.machine.avr->cycle + cycles);
    cpu_run(&board->cpu);
    event_at(&board->cpu.machine.events, EVENT_LIMIT, NEVER);
    return board->cpu.machine.stop;
}

uint64_t board_now(const board_t *board) { return board->cpu.machine.avr->cycle; }

uint64_t board_busy_cycles(const board_t *board) { return board->cpu.machine.avr->cycle - board->cpu.idle_cycles; }

void board_stop(board_t *board) { machine_end_run(&board->cpu.machine, BOARD_STOP_REQUEST); }

void board_stop_on_text(board_t *board, const char *console_text)
{
    console_wire_stop_on_text(&board->console, console_text);
}

void board_stop_at(board_t *board, uint32_t flash_address) { cpu_stop_at(&board->cpu, flash_address); }

const violation_t *board_violation(const board_t *board) { return &board->cpu.machine.violation; }

void board_clear_violation(board_t *board)
{
    memset(&board->cpu.machine.violation, 0, sizeof board->cpu.machine.violation);
}

void board_allow(board_t *board, violation_kind_t kind, bool allowed)
{
    if ((unsigned)kind < VIOLATION_COUNT) {
        board->cpu.machine.allowed[kind] = allowed;
    }
}

uint32_t board_violations(const board_t *board, violation_kind_t kind)
{
    return (unsigned)kind < VIOLATION_COUNT ? board->cpu.machine.violations[kind] : 0;
}
