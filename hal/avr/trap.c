/* SPDX-License-Identifier: MIT */
#include "trap.h"

#include <avr/interrupt.h>
#include <avr/wdt.h>

trap_record_t trap_record __attribute__((section(".noinit")));

void trap_failed(uint16_t line)
{
    cli();
    trap_record.magic = TRAP_MAGIC;
    trap_record.line = line;
    trap_record.word_address = (uint16_t)(uintptr_t)__builtin_return_address(0);
    wdt_enable(WDTO_15MS);
    for (;;) {
    }
}
