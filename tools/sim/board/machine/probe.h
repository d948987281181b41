/* SPDX-License-Identifier: MIT
 * probe.h - measures the cycles of a function, from its first instruction to its return. */
#ifndef SIM_PROBE_H
#define SIM_PROBE_H

#include "board_debug.h"
#include "interrupt.h"

#define PROBES 32
#define PROBE_CALLS 32 /* open calls of probed functions */

typedef struct {
    machine_t *machine;
    const interrupts_t *interrupts;
    int count, open;
    struct { char name[64]; uint32_t address; probe_t result; } entries[PROBES];
    struct { int probe; uint32_t back; uint16_t sp; uint64_t since, interrupts; } calls[PROBE_CALLS];
} probes_t;

void probe_reset(probes_t *probes);
void probe_enter(probes_t *probes, uint32_t pc);
void probe_leave(probes_t *probes, uint32_t pc);

/* For board_probe() and the like. address UINT32_MAX: no such function. */
bool probe_add(probes_t *probes, const char *function, uint32_t address);
const probe_t *probe_result(const probes_t *probes, const char *function);
void probe_clear(probes_t *probes);

#endif
