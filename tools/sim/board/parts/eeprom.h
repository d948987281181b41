/* SPDX-License-Identifier: MIT
 * eeprom.h - the EEPROM and its write sequence. */
#ifndef SIM_EEPROM_H
#define SIM_EEPROM_H

#include "operations.h"

typedef struct {
    machine_t *machine;
    operations_t *operations;
    uint8_t bytes[M128_EEPROM_BYTES];
    uint32_t wear[M128_EEPROM_BYTES];
    bool ready_enabled;
    uint64_t master_until;
    uint16_t address;
    uint8_t value;
} eeprom_t;

void eeprom_init(eeprom_t *eeprom, machine_t *machine, operations_t *operations);
void eeprom_reset(eeprom_t *eeprom);

/* Interrupts a write in progress; tear selects the result. */
void eeprom_tear(eeprom_t *eeprom, uint32_t tear);

#endif
