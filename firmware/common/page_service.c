/* SPDX-License-Identifier: MIT */
#include "page_service.h"

#include "crc16.h"
#include "boot_call.h"
#include "eeprom.h"
#include "memory_map.h"
#include "pgm.h"
#include "target.h"

#include <stddef.h>
#include <string.h>

/* The factory loader 1.31, boot/ORIGINAL.md section 7b. A CRC and a sum, because one CRC-16 is too weak a proof before a
 * jump into foreign code. The CRC-32 of the spec would need code that nothing else uses. */
#define FACTORY_CRC 0xD53Eu
#define FACTORY_SUM 0x000F9AF0ul

#define BOOT_MODE_APPLICATION 0x11u /* EEPROM FFF: start the application */
#define MAIL_POSTED 0xAAu
#define MAIL_WRITTEN 0x55u
#define MAIL_NONE 0xFFu

static struct {
    uint8_t kind;
    const boot_rx_t *rx;
} service;

static bool is_ours(void)
{
    boot_api_head_t head;
    flash_read(MEM_BOOT_API, &head, sizeof head);
    return memcmp_P(head.signature, PSTR(BOOT_API_SIGNATURE), sizeof head.signature) == 0 && head.version >= 1 &&
           (head.features & (BOOT_HAS_WRITE | BOOT_HAS_PROGRAM)) == (BOOT_HAS_WRITE | BOOT_HAS_PROGRAM);
}

/* Identifies a loader that is not ours, in one pass over the 8 KiB of the boot section. */
static page_service_kind_t recognise(void)
{
    uint8_t piece[16];
    uint16_t crc = CRC16_START;
    uint32_t sum = 0;
    uint8_t all = 0xFF;
    for (uint32_t addr = MEM_BOOT_START; addr < MEM_BOOT_END; addr += sizeof piece) {
        flash_read(addr, piece, sizeof piece);
        for (uint8_t i = 0; i < sizeof piece; i++) {
            crc = crc16_byte(crc, piece[i]);
            sum += piece[i];
            all &= piece[i];
        }
    }
    if (all == 0xFF) {
        return PAGE_SERVICE_NONE;
    }
    return crc == FACTORY_CRC && sum == FACTORY_SUM ? PAGE_SERVICE_FACTORY : PAGE_SERVICE_MAILBOX;
}

page_service_kind_t page_service_init(const boot_rx_t *rx)
{
    service.rx = rx;
    service.kind = (uint8_t)(is_ours() ? PAGE_SERVICE_OURS : recognise());
    return page_service_kind();
}

page_service_kind_t page_service_kind(void)
{
    return (page_service_kind_t)service.kind;
}

static flash_status_t write_page(uint16_t page, const uint8_t *data, uint16_t bytes, uint8_t mode)
{
    uint32_t addr = (uint32_t)page * FLASH_PAGE_BYTES;
    uint8_t result;
    if (addr >= TARGET_FLASH_END || bytes < 2 || bytes > FLASH_PAGE_BYTES || (bytes & 1) != 0) {
        return FLASH_ERR_RANGE;
    }
    if (service.kind == PAGE_SERVICE_OURS) {
        result = boot_call_write(addr, data, bytes, mode, service.rx);
    } else if (service.kind == PAGE_SERVICE_FACTORY) {
        result = boot_call_factory(addr, data, bytes, mode);
    } else {
        return FLASH_ERR_NO_WRITER;
    }
    return result == BOOT_OK ? FLASH_OK : result == BOOT_ERR_RANGE ? FLASH_ERR_RANGE : FLASH_ERR_VERIFY;
}

flash_status_t flash_write(uint16_t page, const uint8_t *data, uint16_t bytes)
{
    return write_page(page, data, bytes, BOOT_MODE_WRITE);
}

flash_status_t flash_program(uint16_t page, const uint8_t *data, uint16_t bytes)
{
    return write_page(page, data, bytes, BOOT_MODE_PROGRAM);
}

/* NOINLINE: inlined, its variables would stay on the stack while a page is written. */
static NOINLINE void set_byte(uint16_t addr, uint8_t value)
{
    eeprom_update(addr, &value, 1);
}

static bool has_page(uint16_t page)   /* 16 bits: with the 256 pages of a PC, an 8-bit comparison is always true */
{
    return page < TARGET_MOTION_PAGES;
}

/* Clears FF4 first and sets it last: after a power cut in between, the loader finds no half-written page. */
bool page_service_post(uint8_t motion_page, const uint8_t data[512])
{
    if (!has_page(motion_page)) {
        return false;
    }
    set_byte(MEM_EE_MAILBOX_STATE, MAIL_NONE);
    set_byte(MEM_EE_BOOT_MODE, BOOT_MODE_APPLICATION);
    eeprom_update(MEM_EE_MAILBOX, data, 512);
    set_byte(MEM_EE_MAILBOX_PAGE, motion_page);
    set_byte(MEM_EE_MAILBOX_STATE, MAIL_POSTED);
    return true;
}

page_service_mail_t page_service_mail(void)
{
    uint8_t state = eeprom_byte(MEM_EE_MAILBOX_STATE);
    set_byte(MEM_EE_MAILBOX_STATE, MAIL_NONE);
    return state == MAIL_WRITTEN  ? PAGE_SERVICE_MAIL_WRITTEN
           : state == MAIL_POSTED ? PAGE_SERVICE_MAIL_IGNORED
                                  : PAGE_SERVICE_MAIL_NONE;
}
