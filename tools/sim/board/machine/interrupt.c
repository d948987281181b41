/* SPDX-License-Identifier: MIT */
#include "interrupt.h"

#include <simavr/sim_core.h>
#include <string.h>

#define RESPONSE_CYCLES 4u /* push of the program counter; the JMP in the vector is extra (data sheet: Interrupt
                            * Response Time) */
#define WAKE_CYCLES 4u     /* extra, out of sleep */

/* Bits of ETIFR by vector. */
static const uint8_t extended_mask[VECTOR_COUNT] = {
    [VECTOR_T1_COMPC] = 0x01, [VECTOR_T3_COMPC] = 0x02, [VECTOR_T3_OVF] = 0x04,
    [VECTOR_T3_COMPB] = 0x08, [VECTOR_T3_COMPA] = 0x10, [VECTOR_T3_CAPT] = 0x20
};

/* Requests are levels (flag AND mask), as in the chip. simavr loses an interrupt whose mask is set after its flag. */
static uint64_t requests(const machine_t *machine)
{
    static const uint8_t extended[6] = { VECTOR_T1_COMPC, VECTOR_T3_COMPC, VECTOR_T3_OVF, VECTOR_T3_COMPB,
                                         VECTOR_T3_COMPA, VECTOR_T3_CAPT };
    const uint8_t *data = machine->avr->data;
    uint64_t wanted = machine->lines;
    unsigned timers = data[M128_TIFR] & data[M128_TIMSK];
    for (int bit = 0; timers >> bit; bit++) {
        wanted |= (uint64_t)(timers >> bit & 1) << (VECTOR_T0_OVF - bit);
    }
    timers = data[M128_ETIFR] & data[M128_ETIMSK] & 0x3F;
    for (int bit = 0; timers >> bit; bit++) {
        wanted |= (uint64_t)(timers >> bit & 1) << extended[bit];
    }
    wanted |= (uint64_t)(data[M128_EIFR] & data[M128_EIMSK]) << VECTOR_INT0;
    if ((data[M128_ADCSRA] & (ADCSRA_ADIE | ADCSRA_ADIF)) == (ADCSRA_ADIE | ADCSRA_ADIF)) {
        wanted |= 1ull << VECTOR_ADC;
    }
    return wanted;
}

/* Clears the flag that the chip clears on entry to the vector. The other flags follow their cause. */
static void acknowledge(machine_t *machine, int vector)
{
    uint8_t *data = machine->avr->data;
    const interrupt_source_t *source = &machine->source[vector];
    if (vector >= VECTOR_T2_COMP && vector <= VECTOR_T0_OVF) {
        data[M128_TIFR] &= (uint8_t)~(1u << (VECTOR_T0_OVF - vector));
    } else if (vector < VECTOR_T2_COMP) {
        data[M128_EIFR] &= (uint8_t)~(1u << (vector - VECTOR_INT0));
    } else if (vector == VECTOR_ADC) {
        data[M128_ADCSRA] &= (uint8_t)~ADCSRA_ADIF;
    } else {
        data[M128_ETIFR] &= (uint8_t)~extended_mask[vector];
    }
    if (source->taken) {
        source->taken(source->context, vector);
    }
}

static registers_t registers_now(const avr_t *avr)
{
    registers_t now = { .rampz = avr->data[M128_RAMPZ] };
    memcpy(now.r, avr->data, sizeof now.r);
    for (int bit = 0; bit < S_I; bit++) {
        now.flags |= (uint8_t)(avr->sreg[bit] << bit);
    }
    return now;
}

static void check_registers(machine_t *machine, int vector, const registers_t *found)
{
    registers_t now = registers_now(machine->avr);
    const uint8_t *a = (const uint8_t *)found, *b = (const uint8_t *)&now;
    for (unsigned i = 0; i < sizeof now; i++) {
        if (a[i] != b[i]) {
            violation_note(machine, VIOLATION_INTERRUPT,
                           "interrupt %d came back with register %u (32: SREG, 33: RAMPZ) 0x%02X, found it 0x%02X",
                           vector, i, b[i], a[i]);
            return;
        }
    }
}

bool interrupt_take(interrupts_t *interrupts)
{
    machine_t *machine = interrupts->machine;
    avr_t *avr = machine->avr;
    uint64_t wanted = requests(machine);
    if (!wanted || avr->cycle < machine->interrupts_from || machine->halted_until > avr->cycle || !machine->powered) {
        return false;
    }
    int vector = __builtin_ctzll(wanted);
    if (interrupts->depth < INTERRUPTS_NESTED) {
        interrupts->entered[interrupts->depth] = avr->cycle;
        interrupts->vector[interrupts->depth] = (uint8_t)vector;
        interrupts->found[interrupts->depth] = registers_now(avr);
    }
    interrupts->depth++;
    avr->cycle += machine->sleeping ? RESPONSE_CYCLES + WAKE_CYCLES : RESPONSE_CYCLES;
    machine->sleeping = false;
    acknowledge(machine, vector);
    _avr_push_addr(avr, avr->pc);
    stack_moved(interrupts->stack, avr->pc, true);
    avr->sreg[S_I] = 0;
    avr->interrupt_state = 0;
    avr->pc = machine->vector_base + (uint32_t)vector * M128_VECTOR_BYTES;
    interrupts->count[vector]++;
    return true;
}

void interrupt_return(interrupts_t *interrupts)
{
    if (interrupts->depth == 0) {
        return; /* RETI used as a jump */
    }
    interrupts->depth--;
    if (interrupts->depth >= INTERRUPTS_NESTED) {
        return;
    }
    uint64_t took = interrupts->machine->avr->cycle - interrupts->entered[interrupts->depth];
    int vector = interrupts->vector[interrupts->depth];
    check_registers(interrupts->machine, vector, &interrupts->found[interrupts->depth]);
    if (took > interrupts->longest[vector]) {
        interrupts->longest[vector] = took;
    }
    if (interrupts->depth == 0) {
        interrupts->cycles += took;
    }
}

uint64_t interrupt_cycles(const interrupts_t *interrupts)
{
    return interrupts->cycles + (interrupts->depth ? interrupts->machine->avr->cycle - interrupts->entered[0] : 0);
}

bool interrupt_can_be_raised(const machine_t *machine, int vector)
{
    return vector > 0 && vector < VECTOR_COUNT &&
           (machine->source[vector].raise || (vector >= VECTOR_T2_COMP && vector <= VECTOR_T0_OVF) || extended_mask[vector]);
}

bool interrupt_raise(machine_t *machine, int vector, uint8_t byte)
{
    uint8_t *data = machine->avr->data;
    if (!interrupt_can_be_raised(machine, vector)) {
        return false;
    }
    if (machine->source[vector].raise) {
        machine->source[vector].raise(machine->source[vector].context, vector, byte);
    } else if (vector <= VECTOR_T0_OVF) {
        data[M128_TIFR] |= (uint8_t)(1u << (VECTOR_T0_OVF - vector));
    } else {
        data[M128_ETIFR] |= extended_mask[vector];
    }
    return true;
}
