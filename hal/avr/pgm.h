/* SPDX-License-Identifier: MIT
 * pgm.h - constants that stay in flash, AVR version (host version: hal/host/pgm.h). May be included anywhere.
 * The names are avr-libc's: PROGMEM, PSTR, pgm_read_byte/word/dword/ptr, memcpy_P, strlen_P, strcmp_P, strcasecmp_P,
 * strncasecmp_P, strcpy_P. Near reads only: the linker scripts keep PROGMEM below 64 KiB. (The loader, at 0x1E000, reads
 * its constants through print.h.) */
#ifndef PGM_H
#define PGM_H

#include <avr/pgmspace.h>
#include <string.h>

#endif
