/* SPDX-License-Identifier: MIT
 * Waiting firmware runs in a loop whose rounds are identical until something happens. waits_passed() compares the state
 * at successive jumps back. If registers, flags, stack and SRAM are the same, and the round in between read nothing but
 * the count of timer 1, the buttons, and the state of UARTs, flash and EEPROM, then all rounds up to the next event or
 * count are the same. Their cycles are added without execution. The run stays the same to the cycle
 * (tests/sim/test_board_waits.py). */
#include "waits.h"

#include <string.h>

#include "opcode.h"

void waits_skip(waits_t *waits, bool on)
{
    waits->on = on;
    waits->touched = true;
}

void waits_disturbed(waits_t *waits) { waits->touched = true; }

/* The first cycle after `from` at which a round can see a change: an event, a simavr timer, a count. */
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

/* A loop that feeds the watchdog must feed it once more in time. */
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

/* Whether the SRAM is as at the last jump back. Then stores its present contents. */
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
