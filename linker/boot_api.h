/* SPDX-License-Identifier: MIT
 * boot_api.h - what the boot loader offers to applications: a call table at a fixed address near the end of flash.
 * Shared by the loader (firmware/boot/service.c) and its callers (hal/avr/boot_call.c).
 *
 *   0x1FFE0  4  signature "M5BL"
 *   0x1FFE4  1  version of this table; entries are only ever added
 *   0x1FFE5  1  board: 1 = CM-5, 2 = CM-2 / CM-2+ (as in app_record.h)
 *   0x1FFE6  2  feature bits, BOOT_HAS_*
 *   0x1FFE8  2  version of the loader, major * 256 + minor
 *   0x1FFEA  2  0xFFFF, reserved
 *   0x1FFEC  4  JMP boot_write_page
 *   0x1FFF0 14  0xFF, reserved for three more entries
 *   0x1FFFE  2  CRC-16 (crc16.h) of 0x1E000..0x1FFFD, high byte first: over the whole section it comes out as 0
 *              (set by tools/dev/app_record)
 *
 * The entry is an ordinary avr-gcc function: r1 = 0, and a word address of 16 bits reaches all 128 KiB, since this chip
 * has no EIND. It uses no RAM but at most 64 bytes of the caller's stack. It restores RAMPZ and the
 * interrupt flag and leaves the lower flash readable. */
#ifndef BOOT_API_H
#define BOOT_API_H

#include "memory_map.h"

#define BOOT_API_VERSION 1
#define BOOT_API_WRITE_PAGE (MEM_BOOT_API + 12)

/* Feature bits. */
#define BOOT_HAS_WRITE 0x0001   /* boot_write_page */
#define BOOT_HAS_PROGRAM 0x0002 /* BOOT_MODE_PROGRAM */
#define BOOT_HAS_RX 0x0004      /* keeps what arrives on UART1 */
#define BOOT_HAS_JOURNAL 0x0008 /* recovers the page journal at start (journal.h) */
#define BOOT_HAS_MAILBOX 0x0010 /* answers the EEPROM mailbox of the factory application */
#define BOOT_HAS_STK500 0x0020
#define BOOT_HAS_BLOCK 0x0040   /* firmware/boot/BLOCK_PROTOCOL.md */

#ifndef __ASSEMBLER__
#include <stdint.h>

typedef struct {
    char signature[4];
    uint8_t version;
    uint8_t board;
    uint16_t features;
    uint16_t loader_version;
    uint16_t reserved;
} boot_api_head_t;
#define BOOT_API_SIGNATURE "M5BL"

/* The ring (hal/ring.h) that takes the bytes of UART1 while the caller's interrupts are off; its receive interrupt
 * writes the same ring. `head` counts the bytes put, `tail` those taken, both modulo 256; places are modulo mask + 1,
 * and the loader leaves one of them free. */
typedef struct {
    volatile uint8_t *buffer;
    volatile uint8_t *head;
    const volatile uint8_t *tail;
    volatile uint8_t *lost;   /* counts up for each byte that found the ring full or overran the UART */
    uint8_t mask;             /* size - 1, size a power of two up to 256 */
} boot_rx_t;

/* How to write. */
enum {
    BOOT_MODE_WRITE = 0,   /* erase, program */
    BOOT_MODE_PROGRAM = 1  /* program only: bits go from 1 to 0 */
};

/* Results. */
enum {
    BOOT_OK = 0,
    BOOT_ERR_RANGE = 1,  /* not a page start, or in the boot section, or a bad count or mode: nothing was touched */
    BOOT_ERR_VERIFY = 2  /* after ten tries the page still reads back wrong */
};

/* addr  : byte address of a flash page, a multiple of 256 below 0x1E000
 * data  : in RAM, anywhere
 * bytes : 2..256, even; the rest of the page is programmed as 0xFF, which leaves it erased or untouched
 * mode  : BOOT_MODE_*
 * rx    : ring for UART1, or NULL: then the bytes stay in the UART, which overruns
 * Returns a BOOT_* in the low byte and the number of failed tries in the high byte.
 * First waits for an EEPROM write under way (up to 8.5 ms). Then takes 9.5 ms (program only: 5 ms) with interrupts off.
 * Kicks the watchdog. Bytes of UART0 are lost meanwhile. */
typedef uint16_t boot_write_page_t(uint32_t addr, const uint8_t *data, uint16_t bytes, uint8_t mode,
                                   const boot_rx_t *rx);
#endif

#endif
