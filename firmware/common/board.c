/* SPDX-License-Identifier: MIT */
#include "board.h"
#include "bus.h"
#include "clock.h"
#include "console.h"
#include "flash.h"
#include "irq.h"
#include "panel.h"
#include "system.h"
#include "tick.h"

#include <string.h>

/* The linker script places it; tools/dev/app_record fills it in. */
extern const app_record_t app_record;
const app_record_t app_record __attribute__((section(".app_record"), used)) = APP_RECORD_UNFILLED;

void board_start(void)
{
    system_init();
    panel_init();
    clock_init();
    console_init();
    bus_init();
    tick_init();
    system_watchdog_on();
    irq_enable();
}

void board_idle(void)
{
    system_kick();
    irq_disable();
    if (tick_is_due() || console_waiting() > 0 || bus_has_news()) {
        irq_enable();
    } else {
        system_sleep();
    }
}

void board_restart(settings_store_t *store)
{
    system_kick();
    settings_save_finish(store);
    console_flush();
    system_restart();
}

bool board_record(app_record_t *record)
{
    static const char magic[4] PROGMEM = APP_RECORD_MAGIC;
    flash_read(MEM_APP_RECORD, record, sizeof *record);
    return memcmp_P(record->magic, magic, sizeof magic) == 0 && record->length_bytes <= MEM_APP_END;
}
