/* SPDX-License-Identifier: MIT */
#include "sweep.h"

#include <stdio.h>
#include <string.h>

#include "opcode.h"

bool sweep_enter(sweeps_t *sweeps, uint32_t pc)
{
    const avr_t *avr = sweeps->machine->avr;
    uint16_t sp = stack_pointer(avr);
    for (int i = 0; !sweeps->is_open && i < sweeps->count; i++) {
        if (sweeps->entries[i].address == pc && sp + 2u < M128_RAM_END) {
            sweeps->current = i;
            sweeps->is_open = true;
            sweeps->is_raised = false;
            sweeps->depth = sweeps->interrupts->depth;
            sweeps->sp = sp;
            sweeps->back = (uint32_t)(avr->data[sp + 1] << 8 | avr->data[sp + 2]) * 2; /* high byte first */
            sweeps->passed = 0;
            return true;
        }
    }
    return false;
}

/* The next call is interrupted one place further on. After the last place, a new round begins. */
static void close_call(sweeps_t *sweeps)
{
    const sweep_entry_t *entry = &sweeps->entries[sweeps->current];
    sweep_t *result = &sweeps->entries[sweeps->current].result;
    result->calls++;
    result->last = sweeps->is_raised ? sweeps->machine->avr->cycle - sweeps->raised_at : 0;
    if (sweeps->is_raised) {
        result->taken += sweeps->interrupts->count[entry->vector] > sweeps->taken;
        result->place++;
    } else {
        result->rounds++;
        result->place = 0;
    }
    sweeps->is_open = false;
}

bool sweep_raise(sweeps_t *sweeps)
{
    const avr_t *avr = sweeps->machine->avr;
    if (sweeps->interrupts->depth != sweeps->depth) {
        return false; /* inside an interrupt */
    }
    if ((avr->pc & (M128_FLASH_BYTES - 1)) == sweeps->back && stack_pointer(avr) >= sweeps->sp + 2) {
        close_call(sweeps);
        return false;
    }
    const sweep_entry_t *entry = &sweeps->entries[sweeps->current];
    if (sweeps->is_raised || sweeps->passed != entry->result.place) {
        return false;
    }
    sweeps->is_raised = true;
    sweeps->raised_at = avr->cycle;
    sweeps->taken = sweeps->interrupts->count[entry->vector];
    return interrupt_raise(sweeps->machine, entry->vector, entry->byte);
}

void sweep_passed(sweeps_t *sweeps)
{
    if (sweeps->interrupts->depth == sweeps->depth) {
        sweeps->passed++;
    }
}

void sweep_reset(sweeps_t *sweeps) { sweeps->is_open = false; }

static int find(const sweeps_t *sweeps, const char *function)
{
    int i = 0;
    while (i < sweeps->count && strcmp(sweeps->entries[i].name, function) != 0) {
        i++;
    }
    return i;
}

bool sweep_add(sweeps_t *sweeps, const char *function, uint32_t address, int vector, uint8_t byte)
{
    int place = find(sweeps, function);
    if (place == SWEEPS || address == UINT32_MAX || !interrupt_can_be_raised(sweeps->machine, vector)) {
        return false;
    }
    sweeps->count += place == sweeps->count;
    sweep_entry_t *entry = &sweeps->entries[place];
    *entry = (sweep_entry_t){ .address = address, .vector = vector, .byte = byte };
    snprintf(entry->name, sizeof entry->name, "%s", function);
    sweeps->is_open = false;
    machine_mark(sweeps->machine, address, NOTE_SWEEP);
    return true;
}

const sweep_t *sweep_result(const sweeps_t *sweeps, const char *function)
{
    int place = find(sweeps, function);
    return place < sweeps->count ? &sweeps->entries[place].result : NULL;
}

void sweep_end(sweeps_t *sweeps)
{
    for (int i = 0; i < sweeps->count; i++) {
        machine_unmark(sweeps->machine, sweeps->entries[i].address, NOTE_SWEEP);
    }
    sweeps->count = 0;
    sweeps->is_open = false;
}
