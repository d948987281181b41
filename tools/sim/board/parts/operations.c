/* SPDX-License-Identifier: MIT */
#include "operations.h"

/* Power is cut in an event, never inside an instruction, which simavr's core would go on to finish. */
static void cut_at(operations_t *operations, uint64_t when)
{
    event_at(&operations->machine->events, EVENT_POWER, when);
}

static bool is_cut_here(const operations_t *operations, cut_phase_t phase)
{
    return operations->count == operations->cut_operation && operations->cut_phase == phase;
}

void operation_begins(operations_t *operations, operation_kind_t kind, uint32_t address)
{
    uint64_t now = operations->machine->avr->cycle;
    operations->count++;
    operations->log[operations->count % OPERATION_LOG].kind = (uint8_t)kind;
    operations->log[operations->count % OPERATION_LOG].address = address;
    if (is_cut_here(operations, CUT_BEFORE)) {
        cut_at(operations, now);
    } else if (is_cut_here(operations, CUT_DURING)) {
        uint64_t length = kind == OPERATION_EEPROM ? M128_EEPROM_CYCLES : M128_SPM_CYCLES;
        cut_at(operations, now + length / 8 + length / 8 * (operations->cut_tear % 7));
    }
}

void operation_is_done(operations_t *operations, operation_kind_t kind, uint32_t address)
{
    if (is_cut_here(operations, CUT_AFTER)) {
        cut_at(operations, operations->machine->avr->cycle);
    }
    if (operations->done) {
        operations->done(operations->done_context, operations->machine->avr->cycle, kind, address);
    }
}

bool operation_find(const operations_t *operations, uint64_t n, operation_kind_t *kind, uint32_t *address)
{
    if (n == 0 || n > operations->count || n + OPERATION_LOG <= operations->count) {
        return false;
    }
    *kind = (operation_kind_t)operations->log[n % OPERATION_LOG].kind;
    *address = operations->log[n % OPERATION_LOG].address;
    return true;
}
