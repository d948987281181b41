/* SPDX-License-Identifier: MIT */
#include "load.h"

#include "button.h"
#include "print.h"
#include "uart.h"
#include BOOT_PORTS_H

#define ESC 27
#define SILENCE_TICKS UART_TICKS(111)
#define REST_TICKS UART_TICKS(250)
#define END_TICKS UART_TICKS(100)
#define BLINK_TICKS 0x0400 /* this bit of the clock: 66 ms on, 66 ms off */
#define LOOK_TICKS UART_TICKS(20)
#define READY_LOOKS 3000u  /* 60 s to find the file and send it */
#define PATIENCE_TICKS UART_TICKS(2000)

/* Prints the address line and `ready`, then waits for data. false: a lone ESC, START, or a minute of silence. The ESC
 * stays in the ring; the prompt ignores it. */
static bool begin(uint32_t addr, const char *ready)
{
    SAY("Write Address : ");
    print_hex32(addr);
    print_say(ready);
    for (uint16_t look = 0; look < READY_LOOKS && button_look() != BUTTON_DOWN; look++) {
        if (uart_wait(LOOK_TICKS)) {
            uint16_t since = uart_clock();
            while (uart_peek() == ESC && uart_has() < 2 && uart_since(since) < SILENCE_TICKS) {
            }
            if (uart_peek() != ESC || uart_has() >= 2) {
                return true;
            }
            break;
        }
    }
    SAY("Cancelled.");
    return false;
}

/* First page after the region that `page` is in. */
static uint16_t region_end(uint16_t page)
{
    return page < MEM_APP_END / 256 ? MEM_APP_END / 256
           : page < MEM_JOURNAL_END / 256 ? MEM_JOURNAL_END / 256 : MEM_MOTION_END / 256;
}

static void report(const load_record_t *record, bool is_good)
{
    memory_ee_write(MEM_EE_LOAD_RECORD, record, sizeof *record);
    if (is_good && (uint8_t)record->sum == record->last) {
        memory_download_good();
        PUT("Success");
    } else {
        PUT("Error");
        uart_drain(REST_TICKS);
    }
    SAY("Rewriting:0X");
    print_hex16(memory_rewrites);
    SAY("Size:0X");
    print_hex32(record->size);
    PUT("  Checksum:");
    print_hex8((uint8_t)record->sum);
    uart_put('-');
    print_hex8(record->last);
}

/* Holds each byte back until the next one arrives, because the last one is the sum. memory_work has the page being
 * filled. */
void load_flash(uint32_t addr)
{
    uint16_t page = (uint16_t)(addr >> 8), end = region_end(page);
    uint8_t at = (uint8_t)addr, lost = uart_lost();
    load_record_t record = {.size = 0};
    bool is_good = true, is_open = false;
    memory_rewrites = 0;
    if (!begin(addr, PSTR("Ready.."))) {
        return;
    }
    while (uart_wait(SILENCE_TICKS)) {
        if (record.size++ > 0) {
            record.sum += record.last;
            if (page == end) {
                is_good = false;
            } else {
                if (!is_open) {
                    memory_read_page(page, memory_work);
                    is_open = true;
                }
                memory_work[at++] = record.last;
                if (at == 0) {
                    is_good &= memory_write_work(page++);
                    is_open = false;
                }
            }
        }
        record.last = uart_next();
    }
    if (is_open) {
        is_good &= memory_write_work(page);
    }
    report(&record, is_good && uart_lost() == lost);
}

void load_send(uint32_t addr, uint32_t count)
{
    uint8_t key = 0;
    bool was_pressed = false;
    SAY("Push button when ready...");
    while (!uart_has()) {
        PORTS_LEDS_OFF();
        if (uart_clock() & BLINK_TICKS) {
            PORTS_LEDS_ON();
        }
        button_t start = button_look();
        if (start == BUTTON_UP && was_pressed) {
            break;
        }
        was_pressed = was_pressed || start == BUTTON_DOWN;
    }
    PORTS_LEDS_OFF();
    if (uart_has()) {
        key = uart_next();
    }
    memory_seek(addr);
    while (count-- > 0 && key != ESC) {
        uart_put(memory_next());
    }
    uart_flush();
    uart_pause(END_TICKS);
}

void load_eeprom(uint16_t addr, uint16_t count)
{
    uint8_t *p = memory_work, *end = memory_work + count;
    if (!begin(addr, PSTR("Ready"))) {
        return;
    }
    for (; p < end; p++) {
        if (!uart_wait(PATIENCE_TICKS)) {
            SAY("Error");
            return;
        }
        *p = uart_next();
        if ((uint8_t)(p - memory_work) == 0xFF) {
            uart_put('.');
        }
    }
    memory_ee_write(addr, memory_work, count);
    SAY("O.K.");
}
