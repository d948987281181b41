/* SPDX-License-Identifier: MIT
 * Flash of the ATmega128 for the loader built on a PC: constants are plain constants; far reads use
 * loader_flash_byte. */
#ifndef LOADER_PGMSPACE_H
#define LOADER_PGMSPACE_H

#include <stdint.h>
#include <string.h>

#define PROGMEM
#define PSTR(text) (text)

/* Returns the chip's byte `addr`; ASSERTs that it exists. */
uint8_t loader_flash_byte(uint32_t addr);

static inline uint16_t loader_flash_word(uint32_t addr)
{
    return (uint16_t)(loader_flash_byte(addr) | loader_flash_byte(addr + 1) << 8);
}

#define pgm_read_byte_far(addr) loader_flash_byte(addr)
#define pgm_read_byte(addr) loader_flash_byte(addr)
#define pgm_read_word(addr) loader_flash_word(addr)
#define pgm_read_dword(addr) (loader_flash_word(addr) | (uint32_t)loader_flash_word((addr) + 2u) << 16)

#endif
