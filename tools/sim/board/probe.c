/* SPDX-License-Identifier: MIT */
#include <stdlib.h>
#include <string.h>

#include "board_private.h"

#define PROBES 32
#define CALLS 32 /* calls of probed functions that may be open at once */

typedef struct { char name[64]; uint32_t address; probe_t result; } entry_t;
typedef struct { int probe; uint32_t back; uint16_t sp; uint64_t since, interrupts; } call_t;
struct probes { entry_t entries[PROBES]; int count; call_t calls[CALLS]; int open; };

static uint16_t stack_pointer(const board_t *board)
{
    return (uint16_t)(board->avr->data[M128_SPL] | board->avr->data[M128_SPH] << 8);
}

/* Interrupt cycles up to now, an interrupt in progress included: a probed function may run inside one. */
static uint64_t interrupt_cycles(const board_t *board)
{
    const cpu_t *cpu = &board->cpu;
    return cpu->interrupt_cycles + (cpu->depth ? board->avr->cycle - cpu->entered[0] : 0);
}

void probe_enter(board_t *board, uint32_t pc)
{
    struct probes *probes = board->probes;
    const uint8_t *data = board->avr->data;
    uint16_t sp = stack_pointer(board);
    for (int i = 0; probes && i < probes->count; i++) {
        if (probes->entries[i].address != pc || probes->open == CALLS || sp + 2u >= M128_RAM_END) {
            continue;
        }
        uint32_t back = (uint32_t)(data[sp + 1] << 8 | data[sp + 2]) * 2; /* high byte on top */
        probes->calls[probes->open++] = (call_t){ i, back, sp, board->avr->cycle, interrupt_cycles(board) };
        board->cpu.note[back / 2] |= NOTE_RETURN;
    }
}

static void note_result(probe_t *result, uint64_t now, uint64_t total, uint64_t own)
{
    result->calls++;
    result->total_sum += total;
    result->own_sum += own;
    result->last_total = total;
    result->last_own = own;
    if (total > result->total_max) {
        result->total_max = total;
    }
    if (own > result->own_max) {
        result->own_max = own;
        result->max_at = now;
    }
}

/* A call is over when its return address is reached with the stack as it was before the call. */
void probe_leave(board_t *board, uint32_t pc)
{
    struct probes *probes = board->probes;
    uint64_t now = board->avr->cycle;
    uint16_t sp = stack_pointer(board);
    while (probes && probes->open) {
        const call_t *call = &probes->calls[probes->open - 1];
        if (call->back != pc || sp < call->sp + 2) {
            return;
        }
        uint64_t total = now - call->since;
        uint64_t interrupts = interrupt_cycles(board) - call->interrupts;
        bool inside = board->cpu.depth != 0; /* of an interrupt itself: nothing to take out */
        note_result(&probes->entries[call->probe].result, now, total, inside ? total : total - interrupts);
        probes->open--;
    }
}

void probe_mark(board_t *board)
{
    struct probes *probes = board->probes;
    for (int i = 0; probes && i < probes->count; i++) {
        board->cpu.note[probes->entries[i].address / 2] |= NOTE_PROBE;
    }
    for (int i = 0; probes && i < probes->open; i++) {
        board->cpu.note[probes->calls[i].back / 2] |= NOTE_RETURN;
    }
}

void probe_reset(board_t *board)
{
    if (board->probes) {
        board->probes->open = 0;
    }
}

void probe_free(board_t *board) { free(board->probes); }

static entry_t *find(const board_t *board, const char *function)
{
    struct probes *probes = board->probes;
    for (int i = 0; probes && i < probes->count; i++) {
        if (strcmp(probes->entries[i].name, function) == 0) {
            return &probes->entries[i];
        }
    }
    return NULL;
}

bool board_probe(board_t *board, const char *function)
{
    uint32_t address = board_function(board, function);
    if (find(board, function)) {
        return true;
    }
    if (!board->probes) {
        board->probes = calloc(1, sizeof *board->probes);
    }
    struct probes *probes = board->probes;
    if (!probes || probes->count == PROBES || address == UINT32_MAX) {
        return false;
    }
    entry_t *entry = &probes->entries[probes->count++];
    snprintf(entry->name, sizeof entry->name, "%s", function);
    entry->address = address;
    probe_mark(board);
    return true;
}

const probe_t *board_probe_result(const board_t *board, const char *function)
{
    const entry_t *entry = find(board, function);
    return entry ? &entry->result : NULL;
}

void board_probe_clear(board_t *board)
{
    struct probes *probes = board->probes;
    for (int i = 0; probes && i < probes->count; i++) {
        memset(&probes->entries[i].result, 0, sizeof probes->entries[i].result);
    }
}
