/* SPDX-License-Identifier: MIT
 * time.c - tick.h and clock.h, from the half microseconds of the machine. */
#include "clock.h"
#include "host.h"
#include "machine.h"
#include "tick.h"

static uint64_t start;
static uint16_t taken, missed;
static uint16_t late;

void tick_init(void)
{
    start = machine_now();
    taken = 0;
    missed = 0;
    late = 0;
}

uint32_t tick_now(void)
{
    return (uint32_t)((machine_now() - start) / HOST_TICK_HALF_US);
}

uint16_t tick_now16(void)
{
    return (uint16_t)tick_now();
}

bool tick_is_due(void)
{
    return tick_now16() != taken;
}

bool tick_take(void)
{
    uint16_t waiting = (uint16_t)(tick_now16() - taken);
    if (waiting == 0) {
        return false;
    }
    late = (uint16_t)(waiting - 1u);
    uint32_t sum = (uint32_t)missed + late;
    missed = sum > UINT16_MAX ? UINT16_MAX : (uint16_t)sum;
    taken = (uint16_t)(taken + waiting);
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

uint64_t host_next_tick(void)
{
    return start + ((uint64_t)tick_now() + 1u) * HOST_TICK_HALF_US;
}

void clock_init(void)
{
}

uint16_t clock_now(void)
{
    return (uint16_t)machine_now();
}

uint16_t clock_now_noirq(void)
{
    return clock_now();
}

void clock_wait_us(uint16_t us)
{
    const uint64_t until = machine_now() + (uint64_t)us * CLOCK_PER_US;
    while (machine_now() < until) {
        host_wait(until);
    }
}
