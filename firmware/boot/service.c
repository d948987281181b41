/* SPDX-License-Identifier: MIT */
#include "service.h"

#include "spm.h"
#include BOOT_PORTS_H

#include <avr/eeprom.h>
#include <avr/interrupt.h>
#include <avr/io.h>
#include <avr/pgmspace.h>
#include <avr/wdt.h>
#include <stddef.h>

#define TRIES 10

void service_poll(const boot_rx_t *rx)
{
    uint8_t status = UCSR1A;
    if (rx == NULL || !(status & 1 << RXC1)) {
        return;
    }
    uint8_t byte = UDR1;
    uint8_t head = *rx->head;
    if (status & 1 << DOR1) {
        ++*rx->lost;
    }
    if ((uint8_t)(head - *rx->tail) >= rx->mask) {
        ++*rx->lost;
        return;
    }
    rx->buffer[head & rx->mask] = byte;
    *rx->head = head + 1;
}

static void wait(const boot_rx_t *rx)
{
    while (spm_is_busy()) {
        service_poll(rx);
        wdt_reset();
    }
}

/* Polls the UART only for some bytes of the page, because a character takes 2,780 cycles. Polling for every byte would cost
 * 0.5 ms per page. */
static void poll_now_and_then(uint8_t at, const boot_rx_t *rx)
{
    if ((at & 0x1E) == 0) {
        service_poll(rx);
    }
}

/* Fills the buffer, erases, writes, compares. RAMPZ must select the 64 KiB half of the page. */
static bool write_once(uint16_t addr, const uint8_t *data, uint16_t bytes, uint8_t mode, const boot_rx_t *rx)
{
    uint8_t at = 0;
    bool good = true;
    spm_release();
    do {
        uint16_t word = 0xFFFF;
        if (at < bytes) {
            word = data[at] | data[at + 1] << 8;
        }
        spm_fill(addr | at, word);
        poll_now_and_then(at, rx);
        at += 2;
    } while (at != 0);
    if (mode == BOOT_MODE_WRITE) {
        spm_erase(addr);
        wait(rx);
    }
    spm_write(addr);
    wait(rx);
    spm_release();
    do {
        if (at < bytes && spm_read(addr | at) != data[at]) {
            good = false;
        }
        poll_now_and_then(at, rx);
    } while (++at != 0);
    return good;
}

uint16_t __attribute__((used, externally_visible))
boot_write_page(uint32_t addr, const uint8_t *data, uint16_t bytes, uint8_t mode, const boot_rx_t *rx)
{
    uint8_t result = BOOT_ERR_RANGE, failed = 0;
    if ((uint8_t)addr != 0 || addr >= MEM_BOOT_START || bytes - 2u > MEM_FLASH_PAGE_BYTES - 2u || (bytes & 1) != 0 ||
        mode > BOOT_MODE_PROGRAM) {
        return result;
    }
    eeprom_busy_wait();
    uint8_t flags = SREG, rampz = RAMPZ;
    cli();
    RAMPZ = (uint8_t)(addr >> 16);
    do {
        result = write_once((uint16_t)addr, data, bytes, mode, rx) ? BOOT_OK : BOOT_ERR_VERIFY;
    } while (result != BOOT_OK && ++failed < TRIES);
    RAMPZ = rampz;
    SREG = flags;
    return failed << 8 | result;
}

/* The call table. 0x940C is JMP; a function pointer is a word address. */
typedef struct {
    boot_api_head_t head;
    uint16_t jmp;
    boot_write_page_t *write_page;
    uint8_t reserved[14];
    uint16_t crc16;
} boot_api_t;
_Static_assert(sizeof(boot_api_t) == MEM_BOOT_END - MEM_BOOT_API, "the call table fills the end of the flash");

const boot_api_t boot_api __attribute__((used, externally_visible, section(".boot_api"))) = {
    .head = {.signature = {'M', '5', 'B', 'L'}, .version = BOOT_API_VERSION, .board = BOOT_BOARD,
             .features = BOOT_HAS_WRITE | BOOT_HAS_PROGRAM | BOOT_HAS_RX | BOOT_HAS_JOURNAL | BOOT_HAS_MAILBOX |
                         BOOT_HAS_STK500 | BOOT_HAS_BLOCK,
             .loader_version = BOOT_VERSION, .reserved = 0xFFFF},
    .jmp = 0x940C,
    .write_page = boot_write_page,
    .reserved = {[0 ... 13] = 0xFF},
    .crc16 = 0xFFFF};
