/* SPDX-License-Identifier: MIT
 * load.h - the transfers of the original's words: raw bytes that end with silence or at a length. */
#ifndef LOAD_H
#define LOAD_H

#include "memory.h"

/* The record that LOAD leaves in EEPROM at MEM_EE_LOAD_RECORD for VERIFY (ORIGINAL.md, section 3). */
typedef struct __attribute__((packed)) {
    uint8_t last;  /* the last byte: the sum that the PC sent */
    uint32_t sum;  /* of all bytes before it */
    uint32_t size; /* number of all bytes, including the last one */
} load_record_t;

/* LOAD: receives raw data for flash from `addr` on, then an 8-bit sum byte, then 111 ms of silence. Writes neither the sum
 * byte nor anything beyond the region of `addr`. Keeps the rest of the first and the last flash page. */
void load_flash(uint32_t addr);

/* UP, EEP_UP: sends `count` raw bytes from address `addr` (memory.h) on to the PC. First waits until START was pressed and
 * released, or any byte came (ESC: sends nothing). */
void load_send(uint32_t addr, uint32_t count);

/* EEP_DN: receives exactly `count` (at most MEMORY_WORK_BYTES) raw bytes, then writes them. Ends after 2 s of silence. */
void load_eeprom(uint16_t addr, uint16_t count);

#endif
