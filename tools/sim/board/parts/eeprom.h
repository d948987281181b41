/* SPDX-License-Identifier: MIT
 * eeprom.h - the EEPROM and its write sequence. */
#ifndef SIM_PARTS_EEPROM_H
#define SIM_PARTS_EEPROM_H

#include "board_memory.h"
#include "m128.h"

typedef struct {
    uint8_t bytes[M128_EEPROM_BYTES];
    uint32_t wear[M128_EEPROM_BYTES];
    bool busy, ready_enabled;
    uint64_t master_until;
    uint16_t address;
    uint8_t value;
} eeprom_t;

void eeprom_init(board_t *board);
void eeprom_reset(board_t *board);
void eeprom_event(board_t *board, uint64_t now);
void eeprom_tear(board_t *board, uint32_t tear);

#endif
