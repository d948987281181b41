/* SPDX-License-Identifier: MIT
 * service.c - an application for test_boot_service.py. After its start it sends 'R', the kind of boot section it found
 * and the result of journal_recover. Then it executes binary requests and answers each with one status byte.
 *
 *   W page16 256 bytes   flash_write          P page16 n, n bytes   flash_program
 *   V page16 256 bytes   the same, right after the start of an EEPROM write: 0x5A to 0x321
 *   J page8 512 bytes    journal_save         B page16 256 bytes    boot_call_write, then 2 bytes: stack used, RAM intact
 *   E                    no status: echoes the ring until it is empty for 50 ms
 *   M page8 512 bytes    page_service_post, then a watchdog reset */
#include "firmware/common/app_record.h"
#include "firmware/common/journal.h"
#include "firmware/common/page_service.h"
#include "hal/boot_call.h"
#include "hal/ring.h"

#include <avr/eeprom.h>
#include <avr/interrupt.h>
#include <avr/io.h>
#include <avr/wdt.h>
#include <string.h>
#include <util/delay.h>

#define PAINT 0xA7
#define PAINT_BYTES 200

const app_record_t app_record __attribute__((used, section(".app_record"))) = APP_RECORD_UNFILLED;

static uint8_t storage[128], data[512], lost;
static ring_t ring;
static boot_rx_t rx;
static uint8_t witness[1200]; /* RAM that the calls must not change */

ISR(USART1_RX_vect)
{
    uint8_t byte = UDR1;
    if (!ring_put(&ring, byte)) {
        lost++;
    }
}

static void put(uint8_t byte)
{
    while (!(UCSR1A & 1 << UDRE1)) {
    }
    UDR1 = byte;
}

static uint8_t take(void)
{
    uint8_t byte;
    while (!ring_get(&ring, &byte)) {
    }
    return byte;
}

static void take_data(uint16_t bytes)
{
    for (uint16_t i = 0; i < bytes; i++) {
        data[i] = take();
    }
}

static uint16_t take16(void)
{
    uint16_t low = take();
    return (uint16_t)(low | (uint16_t)take() << 8);
}

/* Paints the RAM below the stack, calls the service, and counts the stack bytes used, including the call itself. */
static __attribute__((noinline)) void measured_write(uint16_t page)
{
    uint8_t *top = (uint8_t *)SP - 16;
    uint8_t *bottom = top - PAINT_BYTES;
    memset(witness, PAINT, sizeof witness);
    for (uint8_t *p = bottom; p < top; p++) {
        *p = PAINT;
    }
    uint8_t ramp = RAMPZ = 1;
    uint8_t result = boot_call_write((uint32_t)page << 8, data, 256, BOOT_MODE_WRITE, &rx);
    uint8_t intact = RAMPZ == ramp && (SREG & 0x80) != 0;
    uint8_t *used = bottom;
    while (used < top && *used == PAINT) {
        used++;
    }
    for (uint16_t i = 0; i < sizeof witness; i++) {
        if (witness[i] != PAINT) {
            intact = 0;
        }
    }
    put(result);
    put((uint8_t)(top + 16 - used));
    put(intact);
}

static void echo(void)
{
    uint8_t byte;
    for (uint16_t idle = 0; idle < 500; idle++) {
        _delay_us(100);
        while (ring_get(&ring, &byte)) {
            put(byte);
            idle = 0;
        }
    }
    put(lost);
}

static void obey(uint8_t request)
{
    uint16_t page;
    uint8_t count;
    switch (request) {
    case 'V':
    case 'W':
        page = take16();
        take_data(256);
        if (request == 'V') {
            eeprom_write_byte((uint8_t *)0x321, 0x5A);
        }
        put((uint8_t)flash_write(page, data, 256));
        break;
    case 'P':
        page = take16();
        count = take();
        take_data(count);
        put((uint8_t)flash_program(page, data, count));
        break;
    case 'J':
        count = take();
        take_data(512);
        put('j');
        put((uint8_t)journal_save(count, data));
        break;
    case 'B':
        page = take16();
        take_data(256);
        measured_write(page);
        break;
    case 'M':
        count = take();
        take_data(512);
        put(page_service_post(count, data));
        wdt_enable(WDTO_15MS);
        for (;;) {
        }
    case 'E':
        echo();
        break;
    }
}

int main(void)
{
    PORTD = 0x31;
    DDRD = 0x70;
    UCSR1A = 1 << U2X1;
    UBRR1H = 0;
    UBRR1L = 34;
    UCSR1B = 1 << RXCIE1 | 1 << RXEN1 | 1 << TXEN1;
    ring_init(&ring, storage, sizeof storage);
    rx = (boot_rx_t){.buffer = storage, .head = &ring.head, .tail = &ring.tail, .lost = &lost, .mask = ring.mask};
    sei();
    put('R');
    put((uint8_t)page_service_init(&rx));
    put((uint8_t)journal_recover(data));
    put((uint8_t)page_service_mail());
    for (;;) {
        obey(take());
    }
}
