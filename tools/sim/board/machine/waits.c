/* SPDX-License-Identifier: MIT
 * A firmware that waits goes round in a loop, and one round is like the other until something happens. When a jump back
 * finds registers, flags, stack and SRAM as the one before it did, and the round in between has looked at nothing else but
 * the count of timer 1, the buttons, and the state of UARTs, flash and EEPROM, the rounds up to the next event or count
 * would be the same: their cycles are added. The run stays the same to the cycle (tests/sim/test_board_waits.py). */
#include "waits.h"

#include <string.h>

#include "opcode.h"

void waits_skip(waits_t *waits, bool on)
{
    waits->on = on;
    waits->touched = true;
}

void waits_disturbed(waits_t *waits) { waits->touched = true; }

/* The first cycle behind `from` at which a round can find something changed: an event, one of simavr's timers, a count. */
static uint64_t next_change(const machine_t *machine, uint64_t from)
{
    const avr_t *avr = machine->avr;
    uint64_t next = machine->events.next;
    if (avr->cycle_timers.timer && avr->cycle_timers.timer->when < next) {
        next = avr->cycle_timers.timer->when;
    }
    for (int i = 0; i < 2; i++) {
        uint32_t cycles = machine->count_cycles[i];
        uint64_t count = cycles ? (from / cycles + 1) * cycles : NEVER;
        next = count < next ? count : next;
    }
    return machine->unsettled_until >= from ? from : next;
}

/* A watchdog that the loop feeds has to be fed once more before its time. */
static void skip(const waits_t *waits)
{
    machine_t *machine = waits->machine;
    uint64_t from = waits->at, now = machine->avr->cycle, next = next_change(machine, from);
    uint64_t end = machine->events.when[EVENT_WATCHDOG] == next ? next - (now - from) : next;
    if (next != NEVER && end > now) {
        machine->avr->cycle = now + (end - now) / (now - from) * (now - from);
    }
}

static void note_state(const avr_t *avr, uint8_t state[WAITS_STATE_BYTES])
{
    memcpy(state, &avr->pc, 4);
    memcpy(state + 4, avr->data, 32);
    memcpy(state + 36, avr->sreg, 8);
    state[44] = avr->data[M128_SPL];
    state[45] = avr->data[M128_SPH];
}

/* Whether the SRAM is as it was at the last jump back; then takes it as it is now. */
static bool ram_is_same(waits_t *waits)
{
    const uint8_t *ram = waits->machine->avr->data + M128_RAM_START;
    bool same = waits->knows_ram && memcmp(ram, waits->ram, sizeof waits->ram) == 0;
    if (!same) {
        memcpy(waits->ram, ram, sizeof waits->ram);
    }
    waits->knows_ram = true;
    return same;
}

void waits_passed(waits_t *waits, uint32_t pc)
{
    const avr_t *avr = waits->machine->avr;
    unsigned note = waits->machine->note[pc / 2 % (M128_FLASH_BYTES / 2)];
    if (!(note & NOTE_BACK) || avr->pc > pc) {
        waits->touched |= (note & NOTE_TOUCHES) != 0;
        return;
    }
    uint8_t state[WAITS_STATE_BYTES];
    note_state(avr, state);
    if (waits->touched) {
        waits->knows_ram = false;
    } else if (ram_is_same(waits) && memcmp(state, waits->state, sizeof state) == 0) {
        skip(waits);
    }
    memcpy(waits->state, state, sizeof state);
    waits->at = avr->cycle;
    waits->touched = false;
}
