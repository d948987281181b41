/* SPDX-License-Identifier: MIT
 * hal_words.c - executes one-byte commands from the serial line on the real hal, for test_hal*.py:
 *
 *   p  checks all pages: "pages GOOD"
 *   f  CRC of flash 0xFF20..0x1011F, from the end in blocks of 64: "flash CRC"
 *   x  flow control on, reads all input, slower than the line: "took COUNT CRC"
 *   h  holds the line, waits 100 ms, resumes: "held"       a  a failed ASSERT            w  hangs (watchdog)
 *   r  restarts through the watchdog                       v  ADC channel 0: "adc VALUE"
 *   e  adds 1 to EEPROM byte 7A5, reads it back at once, and byte 0A5: "eeprom BYTE BYTE"
 *   i  pings servo 1 at the initial rate of the bus: "ping STATUS"
 *   b  prints "slow", changes to 117,647 baud, prints "fast"
 * Starts with "start CAUSE", and "assert LINE ADDRESS" after a failed ASSERT. Numbers are hexadecimal. */
#include "board.h"
#include "bus_call.h"
#include "clock.h"
#include "console.h"
#include "crc16.h"
#include "eeprom.h"
#include "flash.h"
#include "page_store.h"
#include "settings.h"
#include "system.h"
#include "tick.h"
#include "trap.h"

#include <string.h>

static settings_store_t store;
static page_store_t pages;

static void say_P(const char *text)
{
    for (uint8_t byte; (byte = pgm_read_byte(text)) != 0; text++) {
        console_write(&byte, 1);
    }
}

static void say_hex(uint32_t value)
{
    for (uint8_t shift = 32; shift > 0;) {
        shift = (uint8_t)(shift - 4u);
        uint8_t digit = (uint8_t)((value >> shift) & 15u);
        uint8_t byte = (uint8_t)(digit < 10u ? '0' + digit : 'A' + digit - 10);
        console_write(&byte, 1);
    }
}

static void say(const char *word, uint32_t a, uint32_t b)
{
    say_P(word);
    say_hex(a);
    say_P(PSTR(" "));
    say_hex(b);
    say_P(PSTR("\n"));
}

static void check_pages(void)
{
    uint8_t good = 0;
    page_store_init(&pages);
    for (uint8_t page = 0; page < PAGE_COUNT; page++) {
        good = (uint8_t)(good + page_store_is_good(&pages, page));
    }
    say(PSTR("pages "), good, 0);
}

static void check_flash(void)
{
    uint8_t block[64];
    uint16_t crc = CRC16_START;
    for (uint32_t addr = 0x100E0; addr >= 0x0FF20; addr -= sizeof block) {
        flash_read(addr, block, sizeof block);
        crc = crc16_bytes(crc, block, sizeof block);
    }
    say(PSTR("flash "), crc, 0);
}

static void take_all(void)
{
    uint8_t byte;
    uint16_t crc = CRC16_START, since = tick_now16(), count = 0;
    while ((uint16_t)(tick_now16() - since) < TICK_HZ / 2u) {
        system_kick();
        if (console_get(&byte)) {
            crc = crc16_byte(crc, byte);
            count++;
            since = tick_now16();
            clock_wait_us(250);   /* slower than the line */
        }
    }
    say(PSTR("took "), count, crc);
}

static void hold(void)
{
    console_set_flow(true);
    console_xoff();
    for (uint8_t i = 0; i < 100; i++) {
        clock_wait_us(1000);
        system_kick();
    }
    console_xon();
    say_P(PSTR("held\n"));
}

static void write_and_read(void)
{
    uint8_t byte = (uint8_t)(eeprom_byte(0x7A5) + 1u);
    (void)eeprom_start(0x7A5, byte);
    byte = eeprom_byte(0x7A5);   /* must wait for the write */
    say(PSTR("eeprom "), byte, eeprom_byte(0x0A5));
}

static void obey(uint8_t word)
{
    switch (word) {
    case 'e':
        write_and_read();
        break;
    case 'i':
        say(PSTR("ping "), (uint8_t)bus_call_ping(1, 1, 0), 0);
        break;
    case 'p':
        check_pages();
        break;
    case 'f':
        check_flash();
        break;
    case 'x':
        console_set_flow(true);
        take_all();
        break;
    case 'h':
        hold();
        break;
    case 'a':
        ASSERT(store.newest > 7);
        break;
    case 'w':
        for (;;) {
        }
    case 'r':
        system_restart();
    case 'b':
        say_P(PSTR("slow\n"));
        console_set_rate(CONSOLE_RATE_115200);
        say_P(PSTR("fast\n"));
        break;
    case 'v':
        say(PSTR("adc "), system_adc(0), 0);
        break;
    default:
        break;
    }
}

int main(void)
{
    uint8_t word;
    uint16_t line;
    uint32_t address;
    board_start();
    say(PSTR("start "), system_reset_cause(), 0);
    if (system_take_failed_assert(&line, &address)) {
        say(PSTR("assert "), line, address);
    }
    (void)settings_load(&store);
    for (;;) {
        while (console_get(&word)) {
            obey(word);
        }
        (void)tick_take();
        board_idle();
    }
}
