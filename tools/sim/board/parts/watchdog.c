/* SPDX-License-Identifier: MIT */
#include "watchdog.h"

static bool is_running(const watchdog_t *watchdog) { return (watchdog->wdtcr & WDTCR_WDE) != 0; }

static uint64_t period(const watchdog_t *watchdog)
{
    return (uint64_t)M128_WATCHDOG_CYCLES << (watchdog->wdtcr & WDTCR_WDP);
}

static void restart(watchdog_t *watchdog, uint64_t since)
{
    event_at(&watchdog->machine->events, EVENT_WATCHDOG, is_running(watchdog) ? since + period(watchdog) : NEVER);
}

/* Safety level 1 (M103C and WDTON unprogrammed): one write starts the watchdog. Stopping it or changing its period
 * works only within 4 cycles after a write of WDCE and WDE together. */
static void write_wdtcr(avr_t *avr, avr_io_addr_t address, uint8_t value, void *param)
{
    watchdog_t *watchdog = param;
    bool is_open = avr->cycle <= watchdog->open_until;
    (void)address;
    if ((value & WDTCR_WDCE) && (value & WDTCR_WDE)) {
        watchdog->open_until = machine_instruction_end(watchdog->machine) + M128_TIMED_SEQUENCE_CYCLES;
        value = (uint8_t)(WDTCR_WDE | (watchdog->wdtcr & WDTCR_WDP));
    } else {
        bool stops = is_running(watchdog) && !(value & WDTCR_WDE);
        bool changes = (watchdog->wdtcr ^ value) & WDTCR_WDP;
        if ((stops || changes) && !is_open) {
            violation_note(watchdog->machine, VIOLATION_TIMED_SEQUENCE, "WDTCR = 0x%02X without the timed sequence", value);
            value = (uint8_t)((watchdog->wdtcr & (WDTCR_WDE | WDTCR_WDP)) | (value & WDTCR_WDE));
        }
        watchdog->open_until = 0;
        value &= WDTCR_WDE | WDTCR_WDP;
    }
    bool was_running = is_running(watchdog);
    uint64_t since = watchdog->machine->events.when[EVENT_WATCHDOG] - period(watchdog);
    watchdog->wdtcr = value;
    restart(watchdog, was_running ? since : avr->cycle);
}

static uint8_t read_wdtcr(avr_t *avr, avr_io_addr_t address, void *param)
{
    const watchdog_t *watchdog = param;
    uint8_t value = watchdog->wdtcr;
    if (avr->cycle <= watchdog->open_until) {
        value |= WDTCR_WDCE;
    }
    avr->data[address] = value;
    return value;
}

void watchdog_feed(watchdog_t *watchdog) { restart(watchdog, watchdog->machine->avr->cycle); }

void watchdog_reset(watchdog_t *watchdog)
{
    watchdog->wdtcr = 0;
    watchdog->open_until = 0;
    restart(watchdog, 0);
}

void watchdog_init(watchdog_t *watchdog, machine_t *machine)
{
    watchdog->machine = machine;
    machine_io(machine, M128_WDTCR, read_wdtcr, write_wdtcr, watchdog);
}
