/* SPDX-License-Identifier: MIT */
#include "fake_time.h"
#include "clock.h"
#include "tick.h"

#define HALF_US_PER_TICK 15625u
#define HALF_US_PER_LOOK 2u

static uint32_t ticks, half_us_total;
static uint32_t half_us_in_tick;
static uint16_t taken, missed, late;

void fake_time_reset(void)
{
    ticks = 0;
    half_us_total = 0;
    half_us_in_tick = 0;
    taken = 0;
    missed = 0;
    late = 0;
}

void fake_time_ticks(uint16_t count)
{
    ticks += count;
    half_us_total += (uint32_t)count * HALF_US_PER_TICK;
}

/* Advances the clock and, every 15,625 half us, the tick. */
static void advance(uint32_t half_us)
{
    half_us_total += half_us;
    half_us_in_tick += half_us;
    ticks += half_us_in_tick / HALF_US_PER_TICK;
    half_us_in_tick %= HALF_US_PER_TICK;
}

void tick_init(void)
{
    fake_time_reset();
}

uint32_t tick_now(void)
{
    return ticks;
}

uint16_t tick_now16(void)
{
    return (uint16_t)ticks;
}

bool tick_is_due(void)
{
    return taken != (uint16_t)ticks;
}

bool tick_take(void)
{
    uint16_t waiting = (uint16_t)((uint16_t)ticks - taken);
    if (waiting == 0) {
        return false;
    }
    late = (uint16_t)(waiting - 1u);
    uint32_t sum = (uint32_t)missed + late;
    missed = sum > 0xFFFFu ? 0xFFFFu : (uint16_t)sum;
    taken = (uint16_t)ticks;
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
    taken = (uint16_t)ticks;
}

void clock_init(void)
{
}

uint16_t clock_now_noirq(void)
{
    advance(HALF_US_PER_LOOK);
    return (uint16_t)half_us_total;
}

uint16_t clock_now(void)
{
    return clock_now_noirq();
}

void clock_wait_us(uint16_t us)
{
    advance((uint32_t)us * CLOCK_PER_US);
}
