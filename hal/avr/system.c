/* SPDX-License-Identifier: MIT */
#include "system.h"
#include "irq.h"
#include "trap.h"

#include <avr/io.h>
#include <avr/sleep.h>
#include <avr/wdt.h>

#define RESET_CAUSES 0x1Fu

static uint8_t cause;

void system_init(void)
{
    cli();
    wdt_reset();
    cause = MCUCSR & RESET_CAUSES;
    MCUCSR = 0;
    wdt_disable();
    /* Selects the application's vectors: IVSEL takes effect only right after IVCE. */
    MCUCR = (1u << IVCE);
    MCUCR = 0;
}

uint8_t system_reset_cause(void)
{
    return cause;
}

void system_watchdog_on(void)
{
    wdt_enable(WDTO_1S);
}

void system_kick(void)
{
    wdt_reset();
}

void system_restart(void)
{
    cli();
    wdt_enable(WDTO_15MS);
    for (;;) {
    }
}

bool system_is_asked_to_end(void)
{
    return false;
}

void system_end(void)
{
    system_restart();
}

/* SEI takes effect after the next instruction: no interrupt fits between it and SLEEP. */
void system_sleep(void)
{
    set_sleep_mode(SLEEP_MODE_IDLE);
    sleep_enable();
    sei();
    sleep_cpu();
    sleep_disable();
}

bool system_take_failed_assert(uint16_t *line, uint32_t *address)
{
    if (trap_record.magic != TRAP_MAGIC) {
        return false;
    }
    trap_record.magic = 0;
    *line = trap_record.line;
    *address = (uint32_t)trap_record.word_address * 2u;
    return true;
}

uint16_t system_adc(uint8_t channel)
{
    ADMUX = channel & 7u;
    ADCSRA = (1u << ADEN) | (1u << ADSC) | (1u << ADPS2) | (1u << ADPS1) | (1u << ADPS0);
    while (ADCSRA & (1u << ADSC)) {
    }
    uint16_t value = ADC;
    ADCSRA = 0;
    return value;
}
