/* SPDX-License-Identifier: MIT */
#include "board.h"

#include <stdlib.h>
#include <string.h>

#include "board_private.h"
#include "image.h"

/* What libsimavr would print is told by violations, better. */
static void no_log(struct avr_t *avr, const int level, const char *format, va_list arguments)
{
    (void)avr;
    (void)level;
    (void)format;
    (void)arguments;
}

uint32_t board_random(board_t *board)
{
    uint32_t x = board->random;
    x ^= x << 13;
    x ^= x >> 17;
    x ^= x << 5;
    return board->random = x;
}

void board_io(board_t *board, uint16_t address, avr_io_read_t read, avr_io_write_t write, void *param)
{
    avr_t *avr = board->avr;
    avr_io_addr_t io = AVR_DATA_TO_IO(address);
    avr->io[io].r.c = read;
    avr->io[io].r.param = param;
    avr->io[io].w.c = write;
    avr->io[io].w.param = param;
}

/* simavr notices a store beyond the SRAM, and then does it: room for all that a 16-bit pointer reaches, and a word more,
 * keeps the rest of the process whole until the run has ended with VIOLATION_ADDRESS. */
static bool widen_data_space(avr_t *avr)
{
    uint8_t *data = realloc(avr->data, 0x10000u + 2u);
    if (!data) {
        return false;
    }
    memset(data + M128_RAM_END, 0, 0x10000u + 2u - M128_RAM_END);
    avr->data = data;
    return true;
}

static avr_t *make_chip(void)
{
    avr_global_logger_set(no_log);
    avr_t *avr = avr_make_mcu_by_name("atmega128");
    if (avr && avr_init(avr) == 0 && widen_data_space(avr)) {
        avr->frequency = M128_HZ;
        avr->vcc = avr->avcc = avr->aref = 5000;
        avr->log = LOG_NONE;
        return avr;
    }
    return NULL;
}

static void init_parts(board_t *board)
{
    reset_init(board);
    flash_init(board);
    eeprom_init(board);
    timer_init(board, 0);
    timer_init(board, 1);
    uart_init(board, 0);
    uart_init(board, 1);
    console_init(board);
    panel_init(board);
    cpu_init(board);
    board->allowed[VIOLATION_BUS_OVERRUN] = true;
}

board_t *board_new(board_kind_t kind, uint32_t seed)
{
    board_t *board = calloc(1, sizeof *board);
    if (!board) {
        return NULL;
    }
    board->avr = make_chip();
    board->power.log = calloc(OPERATION_LOG, sizeof *board->power.log);
    if (!board->avr || !board->power.log || !bus_wire_init(board)) {
        board_free(board);
        return NULL;
    }
    board->kind = kind;
    board->random = seed * 2654435761u + 1; /* never 0 for neighbours of 0; xorshift must not start there */
    if (board->random == 0) {
        board->random = 1;
    }
    for (int i = 0; i < EVENT_COUNT; i++) {
        event_at(board, (event_t)i, NEVER);
    }
    init_parts(board);
    reset_now(board, RESET_POWER_ON);
    board->reset.count = 0;
    return board;
}

void board_free(board_t *board)
{
    if (!board) {
        return;
    }
    vcd_free(board);
    trace_free(board);
    probe_free(board);
    sweep_free(board);
    console_free(board);
    bus_wire_free(board);
    symbols_free(&board->symbols);
    free(board->power.log);
    if (board->avr) {
        avr_terminate(board->avr);
        free(board->avr);
    }
    free(board);
}

const char *board_error(const board_t *board) { return board->error; }

static void load_symbols(board_t *board, const char *path, bool boot)
{
    char elf[4096];
    const char *dot = strrchr(path, '.');
    size_t stem = dot && !strchr(dot, '/') ? (size_t)(dot - path) : strlen(path);
    snprintf(elf, sizeof elf, "%.*s.elf", (int)stem, path);
    symbols_load(&board->symbols, elf, boot);
}

bool board_load(board_t *board, const char *path, uint32_t address)
{
    static uint8_t bytes[M128_FLASH_BYTES];
    static bool used[M128_FLASH_BYTES];
    image_status_t status = image_read(path, address, &(image_t){ bytes, used, sizeof bytes });
    if (status != IMAGE_OK) {
        snprintf(board->error, sizeof board->error, "%.200s %s", path, image_text(status));
        return false;
    }
    bool boot = false, application = false;
    for (uint32_t i = 0; i < M128_FLASH_BYTES; i++) {
        if (used[i]) {
            board->avr->flash[i] = bytes[i];
            boot |= i >= M128_NRWW_START;
            application |= i < 0x0C000;
        }
    }
    board->bootrst |= boot;
    cpu_flash_changed(board, 0, M128_FLASH_BYTES);
    if (boot || application) {
        load_symbols(board, path, boot && !application);
    }
    return true;
}

void board_set_bootrst(board_t *board, bool programmed) { board->bootrst = programmed; }

void board_end_run(board_t *board, board_stop_t why)
{
    if (!board->stopped || why != BOARD_STOP_TIME) {
        board->stop = why;
    }
    board->stopped = true;
}

board_stop_t board_run(board_t *board, uint64_t cycles)
{
    if (board->violation.kind != VIOLATION_NONE) {
        return BOARD_STOP_VIOLATION;
    }
    board->stopped = false;
    bus_wire_follow(board); /* somebody may have put something on the bus meanwhile */
    event_at(board, EVENT_LIMIT, board->avr->cycle + cycles);
    cpu_run(board);
    event_at(board, EVENT_LIMIT, NEVER);
    return board->stop;
}

uint64_t board_now(const board_t *board) { return board->avr->cycle; }

uint64_t board_busy_cycles(const board_t *board) { return board->avr->cycle - board->cpu.idle_cycles; }

void board_stop(board_t *board) { board_end_run(board, BOARD_STOP_REQUEST); }

void board_stop_at(board_t *board, uint32_t flash_address)
{
    uint32_t before = board->stop_at;
    board->stop_at = flash_address < M128_FLASH_BYTES ? flash_address & ~1u : UINT32_MAX;
    if (before != UINT32_MAX) {
        cpu_flash_changed(board, before, 2);
    }
    if (board->stop_at != UINT32_MAX) {
        cpu_flash_changed(board, board->stop_at, 2);
    }
}

uint32_t board_pc(const board_t *board) { return board->avr->pc; }

uint32_t board_function(const board_t *board, const char *name)
{
    if (strncmp(name, "0x", 2) == 0) {
        return (uint32_t)strtoul(name, NULL, 16) & (M128_FLASH_BYTES - 2);
    }
    const symbol_t *symbol = symbols_find(&board->symbols, name, true);
    return symbol ? symbol->address : UINT32_MAX;
}

uint32_t board_variable(const board_t *board, const char *name)
{
    const symbol_t *symbol = symbols_find(&board->symbols, name, false);
    return symbol ? symbol->address : UINT32_MAX;
}

const char *board_function_at(const board_t *board, uint32_t address)
{
    const symbol_t *symbol = symbols_at(&board->symbols, address);
    return symbol ? symbol->name : "?";
}
