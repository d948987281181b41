/* SPDX-License-Identifier: MIT */
#include <string.h>

#include "board_private.h"

#define RESPONSE_CYCLES 4u /* push of the program counter; the JMP in the vector comes on top (data sheet: Interrupt
                             Response Time) */
#define WAKE_CYCLES 4u     /* more, out of sleep */

/* Bits of ETIFR by vector. */
static const uint8_t extended_mask[VECTOR_COUNT] = {
    [VECTOR_T1_COMPC] = 0x01, [VECTOR_T3_COMPC] = 0x02, [VECTOR_T3_OVF] = 0x04,
    [VECTOR_T3_COMPB] = 0x08, [VECTOR_T3_COMPA] = 0x10, [VECTOR_T3_CAPT] = 0x20
};

/* Requests are levels, flag AND mask, as in the chip; simavr forgets an interrupt whose mask is set after its flag. */
static uint64_t requests(const board_t *board)
{
    static const uint8_t extended[6] = { VECTOR_T1_COMPC, VECTOR_T3_COMPC, VECTOR_T3_OVF, VECTOR_T3_COMPB,
                                         VECTOR_T3_COMPA, VECTOR_T3_CAPT };
    const uint8_t *data = board->avr->data;
    uint64_t wanted = board->cpu.lines;
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

void interrupt_line(board_t *board, int vector, bool level)
{
    board->cpu.lines = (board->cpu.lines & ~(1ull << vector)) | ((uint64_t)level << vector);
}

/* Flags that the chip clears when it enters the vector. The others follow their cause. */
static void acknowledge(board_t *board, int vector)
{
    uint8_t *data = board->avr->data;
    if (vector >= VECTOR_T2_COMP && vector <= VECTOR_T0_OVF) {
        data[M128_TIFR] &= (uint8_t)~(1u << (VECTOR_T0_OVF - vector));
    } else if (vector < VECTOR_T2_COMP) {
        data[M128_EIFR] &= (uint8_t)~(1u << (vector - VECTOR_INT0));
    } else if (vector == VECTOR_ADC) {
        data[M128_ADCSRA] &= (uint8_t)~ADCSRA_ADIF;
    } else if (vector == VECTOR_USART0_TX || vector == VECTOR_USART1_TX) {
        board->uart[vector == VECTOR_USART1_TX].a &= (uint8_t)~UCSRA_TXC;
        interrupt_line(board, vector, false);
    } else {
        data[M128_ETIFR] &= (uint8_t)~extended_mask[vector];
    }
    timer_flags_changed(board);
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

static void check_registers(board_t *board, int vector, const registers_t *found)
{
    registers_t now = registers_now(board->avr);
    const uint8_t *a = (const uint8_t *)found, *b = (const uint8_t *)&now;
    for (unsigned i = 0; i < sizeof now; i++) {
        if (a[i] != b[i]) {
            violation_note(board, VIOLATION_INTERRUPT,
                           "interrupt %d came back with register %u (32: SREG, 33: RAMPZ) 0x%02X, found it 0x%02X",
                           vector, i, b[i], a[i]);
            return;
        }
    }
}

bool interrupt_take(board_t *board)
{
    avr_t *avr = board->avr;
    cpu_t *cpu = &board->cpu;
    uint64_t wanted = requests(board);
    if (!wanted || avr->cycle < board->reset.ivsel_open || cpu->halted_until > avr->cycle || !board->power.on) {
        return false;
    }
    int vector = __builtin_ctzll(wanted);
    if (cpu->depth < sizeof cpu->vector) {
        cpu->entered[cpu->depth] = avr->cycle;
        cpu->vector[cpu->depth] = (uint8_t)vector;
        cpu->found[cpu->depth] = registers_now(avr);
    }
    cpu->depth++;
    avr->cycle += cpu->sleeping ? RESPONSE_CYCLES + WAKE_CYCLES : RESPONSE_CYCLES;
    cpu->sleeping = false;
    acknowledge(board, vector);
    _avr_push_addr(avr, avr->pc);
    stack_moved(board, avr->pc, true);
    avr->sreg[S_I] = 0;
    avr->interrupt_state = 0;
    avr->pc = cpu->vector_base + (uint32_t)vector * M128_VECTOR_BYTES;
    cpu->count[vector]++;
    return true;
}

void interrupt_return(board_t *board)
{
    cpu_t *cpu = &board->cpu;
    if (cpu->depth == 0) {
        return; /* RETI used as a jump */
    }
    cpu->depth--;
    if (cpu->depth >= sizeof cpu->vector) {
        return;
    }
    uint64_t took = board->avr->cycle - cpu->entered[cpu->depth];
    int vector = cpu->vector[cpu->depth];
    check_registers(board, vector, &cpu->found[cpu->depth]);
    if (took > cpu->longest[vector]) {
        cpu->longest[vector] = took;
    }
    if (cpu->depth == 0) {
        cpu->interrupt_cycles += took;
    }
}

static bool is_of_uart(int vector)
{
    return (vector >= VECTOR_USART0_RX && vector <= VECTOR_USART0_TX) ||
           (vector >= VECTOR_USART1_RX && vector <= VECTOR_USART1_TX);
}

bool interrupt_can_be_raised(int vector)
{
    return is_of_uart(vector) || (vector >= VECTOR_T2_COMP && vector <= VECTOR_T0_OVF) ||
           (vector >= VECTOR_T1_COMPC && vector <= VECTOR_T3_OVF);
}

bool board_interrupt(board_t *board, int vector, uint8_t byte)
{
    uint8_t *data = board->avr->data;
    if (!interrupt_can_be_raised(vector)) {
        return false;
    }
    if (is_of_uart(vector)) {
        uart_raise(&board->uart[vector >= VECTOR_USART1_RX], vector == VECTOR_USART0_RX || vector == VECTOR_USART1_RX, byte);
    } else if (vector <= VECTOR_T0_OVF) {
        data[M128_TIFR] |= (uint8_t)(1u << (VECTOR_T0_OVF - vector));
    } else {
        data[M128_ETIFR] |= extended_mask[vector];
    }
    return true;
}

uint64_t board_interrupt_count(const board_t *board, int vector)
{
    return vector > 0 && vector < VECTOR_COUNT ? board->cpu.count[vector] : 0;
}

uint64_t board_interrupt_max(const board_t *board, int vector)
{
    return vector > 0 && vector < VECTOR_COUNT ? board->cpu.longest[vector] : 0;
}
