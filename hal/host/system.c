/* SPDX-License-Identifier: MIT
 * system.c - system.h, and the waiting of the program. */
#include "system.h"

#include "host.h"
#include "machine.h"

void host_fetch(void)
{
    host_fetch_bus();
    host_fetch_console();
}

void host_wait(uint64_t until)
{
    machine_watch();
    host_fetch();
    machine_wait(until);
    host_fetch();
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
    machine_watch();
    host_fetch();
}

void system_sleep(void)
{
    if (!host_is_moving()) {
        host_settle();
    }
    host_console_rest();
    const uint64_t tick = host_next_tick(), free = host_line_free();
    host_wait(free > machine_now() && free < tick ? free : tick);   /* the next packet waits until the line is free */
}

void system_restart(void)
{
    machine_end();
}

bool system_is_asked_to_end(void)
{
    return machine_is_asked_to_end();
}

void system_end(void)
{
    machine_end();
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
