/* SPDX-License-Identifier: MIT */
#include <stdlib.h>
#include <string.h>

#include "board_private.h"

#define SWEEPS 32

typedef struct { char name[64]; uint32_t address; int vector; uint8_t byte; sweep_t result; } entry_t;
struct sweeps { entry_t entries[SWEEPS]; int count, current; };

static uint16_t stack_pointer(const board_t *board)
{
    return (uint16_t)(board->avr->data[M128_SPL] | board->avr->data[M128_SPH] << 8);
}

static entry_t *find(const board_t *board, const char *function)
{
    struct sweeps *sweeps = board->sweeps;
    for (int i = 0; sweeps && i < sweeps->count; i++) {
        if (strcmp(sweeps->entries[i].name, function) == 0) {
            return &sweeps->entries[i];
        }
    }
    return NULL;
}

bool sweep_enter(board_t *board, uint32_t pc)
{
    struct sweeps *sweeps = board->sweeps;
    const uint8_t *data = board->avr->data;
    uint16_t sp = stack_pointer(board);
    for (int i = 0; sweeps && !board->sweep.is_open && i < sweeps->count; i++) {
        if (sweeps->entries[i].address == pc && sp + 2u < M128_RAM_END) {
            uint32_t back = (uint32_t)(data[sp + 1] << 8 | data[sp + 2]) * 2; /* high byte on top */
            board->sweep = (sweep_call_t){ .is_open = true, .depth = board->cpu.depth, .sp = sp, .back = back };
            sweeps->current = i;
            return true;
        }
    }
    return false;
}

/* The next call is interrupted one place further; behind the last one, the next begins again. */
static void close_call(board_t *board)
{
    entry_t *entry = &board->sweeps->entries[board->sweeps->current];
    sweep_t *result = &entry->result;
    const sweep_call_t *call = &board->sweep;
    result->calls++;
    result->last = call->is_raised ? board->avr->cycle - call->raised_at : 0;
    if (call->is_raised) {
        result->taken += board->cpu.count[entry->vector] > call->taken;
        result->place++;
    } else {
        result->rounds++;
        result->place = 0;
    }
    board->sweep.is_open = false;
}

bool sweep_raise(board_t *board)
{
    sweep_call_t *call = &board->sweep;
    if (board->cpu.depth != call->depth) {
        return false; /* inside an interrupt */
    }
    if ((board->avr->pc & (M128_FLASH_BYTES - 1)) == call->back && stack_pointer(board) >= call->sp + 2) {
        close_call(board);
        return false;
    }
    const entry_t *entry = &board->sweeps->entries[board->sweeps->current];
    if (call->is_raised || call->passed != entry->result.place) {
        return false;
    }
    call->is_raised = true;
    call->raised_at = board->avr->cycle;
    call->taken = board->cpu.count[entry->vector];
    return board_interrupt(board, entry->vector, entry->byte);
}

void sweep_passed(board_t *board)
{
    if (board->cpu.depth == board->sweep.depth) {
        board->sweep.passed++;
    }
}

void sweep_mark(board_t *board)
{
    for (int i = 0; board->sweeps && i < board->sweeps->count; i++) {
        board->cpu.note[board->sweeps->entries[i].address / 2] |= NOTE_PROBE;
    }
}

void sweep_reset(board_t *board) { board->sweep.is_open = false; }

void sweep_free(board_t *board) { free(board->sweeps); }

bool board_sweep(board_t *board, const char *function, int vector, uint8_t byte)
{
    uint32_t address = board_function(board, function);
    if (!board->sweeps) {
        board->sweeps = calloc(1, sizeof *board->sweeps);
    }
    entry_t *entry = find(board, function);
    if (!entry && board->sweeps && board->sweeps->count < SWEEPS) {
        entry = &board->sweeps->entries[board->sweeps->count];
    }
    if (!entry || address == UINT32_MAX || !interrupt_can_be_raised(vector)) {
        return false;
    }
    if (entry == &board->sweeps->entries[board->sweeps->count]) {
        board->sweeps->count++;
    }
    *entry = (entry_t){ .address = address, .vector = vector, .byte = byte };
    snprintf(entry->name, sizeof entry->name, "%s", function);
    board->sweep.is_open = false;
    sweep_mark(board);
    return true;
}

const sweep_t *board_sweep_result(const board_t *board, const char *function)
{
    const entry_t *entry = find(board, function);
    return entry ? &entry->result : NULL;
}

void board_sweep_end(board_t *board)
{
    if (board->sweeps) {
        board->sweeps->count = 0;
        board->sweep.is_open = false;
        cpu_flash_changed(board, 0, M128_FLASH_BYTES);
    }
}
