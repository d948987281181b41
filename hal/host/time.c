/* SPDX-License-Identifier: MIT
 * time.c - tick.h and clock.h, from the half microseconds of the machine. */
#include "clock.h"
#include "host.h"
#include "machine.h"
#include "tick.h"

static uint64_t start;
static uint32_t taken;
static uint16_t late, missed;

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
    return tick_now() != taken;
}

bool tick_take(void)
{
    const uint32_t waiting = tick_now() - taken;   /* more than 16 bits hold, if the computer slept */
    if (waiting == 0) {
        return false;
    }
    late = waiting > UINT16_MAX ? UINT16_MAX : (uint16_t)(waiting - 1u);
    missed = late > UINT16_MAX - missed ? UINT16_MAX : (uint16_t)(missed + late);
    taken += waiting;
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
    taken = tick_now();
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
