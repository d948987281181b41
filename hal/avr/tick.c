/* SPDX-License-Identifier: MIT */
#include "tick.h"
#include "irq.h"

#include <avr/io.h>

#define PRESCALER 8u
_Static_assert(TICK_CYCLES % PRESCALER == 0, "the tick is exact");
_Static_assert(TICK_CYCLES * TICK_HZ == F_CPU, "128 ticks are a second");

static volatile uint32_t ticks;   /* ISR */
static uint16_t taken;            /* low half of the last tick that was taken */
static uint16_t missed, late;

void tick_init(void)
{
    ticks = 0;
    taken = 0;
    missed = 0;
    late = 0;
    TCCR1A = 0;
    TCCR1B = 0;
    TCNT1 = 0;
    OCR1A = TICK_CYCLES / PRESCALER - 1u;
    ETIMSK &= (uint8_t)~(1u << OCIE1C);
    TIFR = (1u << OCF1A);
    TIMSK = (1u << OCIE1A);
    TCCR1B = (1u << WGM12) | (1u << CS11);
}

uint32_t tick_now(void)
{
    irq_state_t state = irq_save();
    uint32_t now = ticks;
    irq_restore(state);
    return now;
}

uint16_t tick_now16(void)
{
    irq_state_t state = irq_save();
    uint16_t now = (uint16_t)ticks;
    irq_restore(state);
    return now;
}

bool tick_is_due(void)
{
    return tick_now16() != taken;
}

bool tick_take(void)
{
    uint16_t now = tick_now16();
    uint16_t waiting = now - taken;
    if (waiting == 0) {
        return false;
    }
    late = waiting - 1u;
    uint16_t sum = missed + late;
    missed = sum < missed ? 0xFFFFu : sum;
    taken = now;
    return true;
}

uint16_t tick_late(void)
{
    return late;
}

uint16_t tick_missed(void)
{
    return missed;
}

void tick_forgive(void)
{
    taken = tick_now16();
}

/* 128 times per second; 62 cycles measured. */
ISR(TIMER1_COMPA_vect)
{
    ticks++;
}
