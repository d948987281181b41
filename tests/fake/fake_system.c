/* SPDX-License-Identifier: MIT */
#include "fake_system.h"
#include "system.h"

#include <stdlib.h>

static uint32_t kicks;
static bool asked_to_end;
static jmp_buf *restart_to;

void fake_system_reset(void)
{
    kicks = 0;
    restart_to = NULL;
    asked_to_end = false;
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

void system_init(void)
{
}

uint8_t system_reset_cause(void)
{
    return SYSTEM_RESET_POWER_ON;
}

void system_watchdog_on(void)
{
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
