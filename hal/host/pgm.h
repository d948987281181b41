/* SPDX-License-Identifier: MIT
 * pgm.h - the PC's version of hal/avr/pgm.h: flash constants are plain constants here. */
#ifndef PGM_H
#define PGM_H

#include <stdint.h>
#include <string.h>
#include <strings.h>

#define PROGMEM
#define PSTR(text) (text)
#define pgm_read_byte(address) (*(const uint8_t *)(address))
#define pgm_read_word(address) (*(const uint16_t *)(address))
#define pgm_read_dword(address) (*(const uint32_t *)(address))
#define pgm_read_ptr(address) (*(void *const *)(address))
#define memcpy_P memcpy
#define memcmp_P memcmp
#define strlen_P strlen
#define strcmp_P strcmp
#define strcasecmp_P strcasecmp
#define strncasecmp_P strncasecmp
#define strcpy_P strcpy

#endif
