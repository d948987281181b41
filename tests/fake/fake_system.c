/* SPDX-License-Identifier: MIT */
#include "fake_system.h"
#include "system.h"

#include <stdlib.h>

static uint8_t cause;
static uint32_t kicks, sleeps;
static bool watchdog, asked_to_end;
static jmp_buf *restart_to;

void fake_system_reset(void)
{
    cause = SYSTEM_RESET_POWER_ON;
    kicks = 0;
    sleeps = 0;
    watchdog = false;
    restart_to = NULL;
    asked_to_end = false;
}

void fake_system_set_cause(uint8_t mask)
{
    cause = mask;
}

void fake_system_on_restart(jmp_buf *where)
{
    restart_to = where;
}

void fake_system_ask_to_end(void)
{
    asked_to_end = true;
}

uint32_t fake_system_kicks(void)
{
    return kicks;
}

bool fake_system_watchdog(void)
{
    return watchdog;
}

uint32_t fake_system_sleeps(void)
{
    return sleeps;
}

void system_init(void)
{
    watchdog = false;
}

uint8_t system_reset_cause(void)
{
    return cause;
}

void system_watchdog_on(void)
{
    watchdog = true;
}

void system_kick(void)
{
    kicks++;
}

void system_restart(void)
{
    if (restart_to == NULL) {
        abort();
    }
    longjmp(*restart_to, 1);
}

bool system_is_asked_to_end(void)
{
    return asked_to_end;
}

void system_end(void)
{
    system_restart();
}

void system_sleep(void)
{
    sleeps++;
}

bool system_take_failed_assert(uint16_t *line, uint32_t *address)
{
    (void)line;
    (void)address;
    return false;
}

uint16_t system_adc(uint8_t channel)
{
    (void)channel;
    return 0;
}
