/* SPDX-License-Identifier: MIT
 * memory_map.h - every address of the project, for C and (preprocessed) for the linker scripts.
 * Byte addresses, half open: [START, END). Facts: BOARD.md (memory map), boot/ORIGINAL.md (sections 2, 3, 7).
 * Plain integers only: no suffix, no cast, because the linker reads them too. In C an address above 0x7FFF is a
 * long already. */
#ifndef MEMORY_MAP_H
#define MEMORY_MAP_H

/* Flash, 128 KiB, 512 flash pages of 256 bytes. */
#define MEM_FLASH_PAGE_BYTES 256
/* The journal: 10 slots of 768 bytes (journal.h); the two flash pages after them stay free. */
#define MEM_APP_START 0x00000
#define MEM_APP_END 0x0C000
#define MEM_JOURNAL_START 0x0C000
#define MEM_JOURNAL_END 0x0E000
#define MEM_MOTION_START 0x0E000
#define MEM_MOTION_END 0x1E000
#define MEM_BOOT_START 0x1E000
#define MEM_BOOT_END 0x20000

/* Length + CRC-16 of our application images, right after the 35 four-byte vectors (see app_record.h). */
#define MEM_APP_RECORD 0x0008C
#define MEM_APP_RECORD_BYTES 16

/* Offset in the boot section of the vector of UART1's receiver (vector 30 of 4 bytes). */
#define MEM_BOOT_RX_VECTOR 0x78

/* The loader's call table for applications (see boot_api.h). */
#define MEM_BOOT_API 0x1FFE0

/* SRAM, 4 KiB. The factory loader's page-write routine takes its 256 bytes from a fixed place. */
#define MEM_RAM_START 0x0100
#define MEM_RAM_END 0x1100
#define MEM_BOOT_RAM_END 0x0AC0 /* the loader's variables end below: what an application keeps over a reset lies above */
#define MEM_FACTORY_BUFFER 0x0C61
#define MEM_FACTORY_BUFFER_BYTES 256

/* EEPROM, 4 KiB. Settings are ours; the mailbox and the loader's bytes have fixed meanings. */
#define MEM_EEPROM_BYTES 0x1000
#define MEM_EE_SETTINGS 0x0000
#define MEM_EE_SETTINGS_END 0x0100
#define MEM_EE_MAILBOX 0x0800
#define MEM_EE_MAILBOX_END 0x0A02
#define MEM_EE_APP_MARK 0x0FF0 /* an application without a record is incomplete (boot/memory.h) */
#define MEM_EE_PLAY_MODE 0x0FF2
#define MEM_EE_START_WORD 0x0FF3
#define MEM_EE_MAILBOX_STATE 0x0FF4
#define MEM_EE_MAILBOX_PAGE 0x0FF5
#define MEM_EE_LOAD_RECORD 0x0FF6
#define MEM_EE_BOOT_MODE 0x0FFF

#endif
