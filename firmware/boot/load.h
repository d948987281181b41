/* SPDX-License-Identifier: MIT
 * load.h - the transfers of the original's words: raw bytes, ended by silence or a length. */
#ifndef LOAD_H
#define LOAD_H

#include "memory.h"

/* What LOAD leaves in EEPROM from MEM_EE_LOAD_RECORD on, for VERIFY (bootloader-original.md, section 3). */
typedef struct __attribute__((packed)) {
    uint8_t last;  /* the last byte, which is the sum that the PC sent */
    uint32_t sum;  /* of all bytes before it */
    uint32_t size; /* of all, the last one included */
} load_record_t;

/* LOAD: raw data to flash from `addr` on, then an 8-bit sum byte, then 111 ms of silence. Writes nothing behind the
 * end of the region that addr is in, never the sum byte; keeps the rest of the first and the last flash page. */
void load_flash(uint32_t addr);

/* UP, EEP_UP: `count` raw bytes from memory.h's address `addr` on to the PC once START has been pressed and released, or any
 * byte received (ESC: none). */
void load_send(uint32_t addr, uint32_t count);

/* EEP_DN: takes exactly `count` (at most MEMORY_WORK_BYTES) raw bytes, then writes them. 2 s of silence give up. */
void load_eeprom(uint16_t addr, uint16_t count);

#endif
