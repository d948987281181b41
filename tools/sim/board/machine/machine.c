/* SPDX-License-Identifier: MIT */
#include "machine.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "opcode.h"

/* Of the thread, as the run of a chip is. */
static _Thread_local const avr_t *with_error;

/* Violations report more than the log of libsimavr. */
static void log_error(struct avr_t *avr, const int level, const char *format, va_list arguments)
{
    (void)format;
    (void)arguments;
    if (level == LOG_ERROR) {
        with_error = avr;
    }
}

bool machine_take_error(const machine_t *machine)
{
    const bool found = with_error == machine->avr;
    with_error = NULL;
    return found;
}

/* simavr detects a store beyond the SRAM, but executes it. Space for every address of a 16-bit pointer, and one more
 * word, protects the process until the run has ended with VIOLATION_ADDRESS. */
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
    avr_global_logger_set(log_error);
    avr_t *avr = avr_make_mcu_by_name("atmega128");
    if (avr && avr_init(avr) == 0 && widen_data_space(avr)) {
        avr->frequency = M128_HZ;
        avr->vcc = avr->avcc = avr->aref = 5000;
        avr->log = LOG_NONE;
        return avr;
    }
    return NULL;
}

static void time_is_over(void *context, uint64_t now)
{
    (void)now;
    machine_end_run(context, BOARD_STOP_TIME);
}

bool machine_init(machine_t *machine, uint32_t seed)
{
    machine->avr = make_chip();
    machine->random = seed * 2654435761u + 1; /* xorshift must not start at 0 */
    if (machine->random == 0) {
        machine->random = 1;
    }
    events_init(&machine->events);
    events_handle(&machine->events, EVENT_LIMIT, time_is_over, machine);
    return machine->avr != NULL;
}

void machine_free(machine_t *machine)
{
    symbols_free(&machine->symbols);
    if (machine->avr) {
        avr_terminate(machine->avr);
        free(machine->avr);
    }
}

uint32_t machine_random(machine_t *machine)
{
    uint32_t x = machine->random;
    x ^= x << 13;
    x ^= x >> 17;
    x ^= x << 5;
    return machine->random = x;
}

void machine_end_run(machine_t *machine, board_stop_t why)
{
    if (!machine->stopped || why != BOARD_STOP_TIME) {
        machine->stop = why;
    }
    machine->stopped = true;
}

void machine_io(machine_t *machine, uint16_t address, avr_io_read_t read, avr_io_write_t write, void *param)
{
    avr_t *avr = machine->avr;
    avr_io_addr_t io = AVR_DATA_TO_IO(address);
    avr->io[io].r.c = read;
    avr->io[io].r.param = param;
    avr->io[io].w.c = write;
    avr->io[io].w.param = param;
}

/* Cycles of the instructions that can write a register in a timed sequence: OUT 1, the others 2. */
uint64_t machine_instruction_end(const machine_t *machine)
{
    const uint8_t *at = &machine->avr->flash[machine->avr->pc];
    uint16_t opcode = (uint16_t)(at[0] | at[1] << 8);
    return machine->avr->cycle + ((opcode & 0xF800u) == 0xB800u ? 1 : 2);
}

void machine_line(machine_t *machine, int vector, bool level)
{
    machine->lines = (machine->lines & ~(1ull << vector)) | ((uint64_t)level << vector);
}

void machine_unsettled(machine_t *machine, uint64_t until)
{
    machine->unsettled_until = until > machine->unsettled_until ? until : machine->unsettled_until;
}

static uint16_t word_at(const machine_t *machine, uint32_t word)
{
    const uint8_t *at = &machine->avr->flash[2 * (word % (M128_FLASH_BYTES / 2))];
    return (uint16_t)(at[0] | at[1] << 8);
}

/* Begins at the word before, whose operand may have changed. */
void machine_code_changed(machine_t *machine, uint32_t address, uint32_t count)
{
    for (uint32_t word = address < 2 ? 0 : address / 2 - 1; word < (address + count + 1) / 2; word++) {
        unsigned note = opcode_note(word_at(machine, word), word_at(machine, word + 1));
        machine->note[word] = (uint16_t)(note | machine->mark[word]);
    }
}

void machine_mark(machine_t *machine, uint32_t address, unsigned mark)
{
    machine->mark[address / 2] |= (uint8_t)mark;
    machine->note[address / 2] |= (uint8_t)mark;
}

void machine_unmark(machine_t *machine, uint32_t address, unsigned mark)
{
    machine->mark[address / 2] &= (uint8_t)~mark;
    machine->note[address / 2] &= (uint16_t)~mark;
}

bool violation_note(machine_t *machine, violation_kind_t kind, const char *format, ...)
{
    violation_t *record = &machine->violation;
    machine->violations[kind]++;
    if (machine->allowed[kind]) {
        return false;
    }
    if (record->kind == VIOLATION_NONE) {
        const symbol_t *symbol = symbols_at(&machine->symbols, machine->avr->pc);
        record->kind = kind;
        record->cycle = machine->avr->cycle;
        record->pc = machine->avr->pc;
        snprintf(record->function, sizeof record->function, "%s", symbol ? symbol->name : "?");
        va_list arguments;
        va_start(arguments, format);
        vsnprintf(record->text, sizeof record->text, format, arguments);
        va_end(arguments);
    }
    machine_end_run(machine, BOARD_STOP_VIOLATION);
    return true;
}
