/* SPDX-License-Identifier: MIT */
#include "check.h"

#include "boot_api.h"
#include "crc16.h"
#include "memory.h"
#include "print.h"
#include "uart.h"
#include BOOT_PORTS_H

#include <util/atomic.h>

#define PAGE_BYTES 512u
#define ROW 64u /* flash pages: 32 motion pages */
/* Bytes of the page header that are 0 if there is nothing to play (page.h). The bytes of a page sum to 0xFF. */
#define AT_PLAY_COUNT 15u
#define AT_STEPS 20u
#define GOOD_SUM 0xFFu

static uint16_t crc_of(uint16_t page, uint16_t end)
{
    memory_sums.crc = CRC16_START;
    for (; page < end; page++) {
        memory_scan(page);
    }
    return memory_sums.crc;
}

typedef enum { PAGE_VALID, PAGE_EMPTY, PAGE_BAD } page_kind_t;

/* Classifies a motion page: empty if erased or without steps or PlayCount, bad if its sum is wrong. Continues the CRC. */
static page_kind_t page_kind(uint16_t flash_page)
{
    memory_scan_start();
    memory_scan(flash_page);
    bool idle = memory_scratch[AT_PLAY_COUNT] == 0 || memory_scratch[AT_STEPS] == 0;
    memory_scan(flash_page + 1);
    if (memory_sums.all == 0xFF) {
        return PAGE_EMPTY;
    }
    return (uint8_t)memory_sums.sum != GOOD_SUM ? PAGE_BAD : idle ? PAGE_EMPTY : PAGE_VALID;
}

/* Writes two patterns to every byte of RAM and restores it. Interrupts are off for a microsecond at a time. */
static bool is_ram_good(void)
{
    bool good = true;
    for (uint16_t addr = MEM_RAM_START; addr < MEM_RAM_END; addr++) {
        volatile uint8_t *cell = (volatile uint8_t *)addr;
        ATOMIC_BLOCK(ATOMIC_FORCEON)
        {
            uint8_t kept = *cell;
            *cell = 0x55;
            if (*cell != 0x55) {
                good = false;
            }
            *cell = 0xAA;
            if (*cell != 0xAA) {
                good = false;
            }
            *cell = kept;
        }
    }
    return good;
}

static void put_app(void)
{
    print_nth(PSTR("none\0plain\0good\0bad"), memory_app());
}

static void put_crc(uint16_t page, uint16_t end)
{
    print_hex16(crc_of(page, end));
}

void check_all(void)
{
    uint8_t count[3] = {0};
    uint16_t page = MEM_MOTION_START / 256;
    SAY("+ valid . empty X bad");
    memory_sums.crc = CRC16_START;
    do {
        if (page % ROW == MEM_MOTION_START / 256 % ROW) {
            print_line();
        }
        page_kind_t kind = page_kind(page);
        count[kind]++;
        uart_put(print_byte(PSTR("+.X") + kind));
        page += 2;
    } while (page != MEM_MOTION_END / 256);
    SAY("CHECK app=");
    uint16_t motion_crc = memory_sums.crc;
    put_app();
    uart_put(',');
    put_crc(0, MEM_APP_END / 256);
    PUT(" motion=");
    print_hex16(motion_crc);
    for (uint8_t i = 0; i < 3; i++) {
        uart_put(',');
        print_hex8(count[i]);
    }
    PUT(" boot=");
    put_crc(MEM_BOOT_START / 256, MEM_BOOT_END / 256);
    PUT(" ram=");
    print_nth(PSTR("bad\0good"), is_ram_good());
    PUT(" ee=");
    for (uint8_t i = 4; i > 0; i--) {
        print_hex8(memory_ee(MEM_EE_PLAY_MODE - 1 + i));
    }
    print_hex8(memory_ee(MEM_EE_BOOT_MODE));
}

void check_id(void)
{
    SAY("ID Motion512 boot 1.00 " PORTS_BOARD_NAME " api=1 app=");
    put_app();
}
