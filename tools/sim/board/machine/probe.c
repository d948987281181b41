/* SPDX-License-Identifier: MIT */
#include "probe.h"

#include <stdio.h>
#include <string.h>

#include "opcode.h"

void probe_enter(probes_t *probes, uint32_t pc)
{
    const avr_t *avr = probes->machine->avr;
    uint16_t sp = stack_pointer(avr);
    for (int i = 0; i < probes->count; i++) {
        if (probes->entries[i].address != pc || probes->open == PROBE_CALLS || sp + 2u >= M128_RAM_END) {
            continue;
        }
        uint32_t back = (uint32_t)(avr->data[sp + 1] << 8 | avr->data[sp + 2]) * 2; /* high byte first */
        probes->calls[probes->open].probe = i;
        probes->calls[probes->open].back = back;
        probes->calls[probes->open].sp = sp;
        probes->calls[probes->open].since = avr->cycle;
        probes->calls[probes->open].interrupts = interrupt_cycles(probes->interrupts);
        probes->open++;
        machine_mark(probes->machine, back, NOTE_RETURN);
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

/* A call is over when its return address is reached with the stack as before the call. */
void probe_leave(probes_t *probes, uint32_t pc)
{
    const avr_t *avr = probes->machine->avr;
    uint16_t sp = stack_pointer(avr);
    while (probes->open && probes->calls[probes->open - 1].back == pc && sp >= probes->calls[probes->open - 1].sp + 2) {
        probes->open--;
        uint64_t total = avr->cycle - probes->calls[probes->open].since;
        uint64_t interrupts = interrupt_cycles(probes->interrupts) - probes->calls[probes->open].interrupts;
        bool inside = probes->interrupts->depth != 0; /* called inside an interrupt: nothing to subtract */
        note_result(&probes->entries[probes->calls[probes->open].probe].result, avr->cycle, total,
                    inside ? total : total - interrupts);
    }
}

void probe_reset(probes_t *probes) { probes->open = 0; }

static int find(const probes_t *probes, const char *function)
{
    int i = 0;
    while (i < probes->count && strcmp(probes->entries[i].name, function) != 0) {
        i++;
    }
    return i;
}

bool probe_add(probes_t *probes, const char *function, uint32_t address)
{
    int place = find(probes, function);
    if (place < probes->count) {
        return true;
    }
    if (place == PROBES || address == UINT32_MAX) {
        return false;
    }
    probes->count++;
    snprintf(probes->entries[place].name, sizeof probes->entries[place].name, "%s", function);
    probes->entries[place].address = address;
    machine_mark(probes->machine, address, NOTE_PROBE);
    return true;
}

const probe_t *probe_result(const probes_t *probes, const char *function)
{
    int place = find(probes, function);
    return place < probes->count ? &probes->entries[place].result : NULL;
}

void probe_clear(probes_t *probes)
{
    for (int i = 0; i < probes->count; i++) {
        memset(&probes->entries[i].result, 0, sizeof probes->entries[i].result);
    }
}
