/* SPDX-License-Identifier: MIT */
#include "eeprom.h"
#include "irq.h"
#include "system.h"
#include "trap.h"

#include <avr/io.h>

bool eeprom_is_busy(void)
{
    return EECR & (1u << EEWE);
}

void eeprom_wait(void)
{
    while (eeprom_is_busy()) {
    }
}

uint8_t eeprom_byte(uint16_t address)
{
    ASSERT(address < EEPROM_BYTES);
    eeprom_wait();
    EEAR = address;
    EECR |= (1u << EERE);
    return EEDR;
}

void eeprom_read(uint16_t address, void *to, uint16_t count)
{
    uint8_t *byte = to;
    while (count--) {
        *byte++ = eeprom_byte(address++);
    }
}

/* EEWE takes effect only within four cycles after EEMWE: two SBI in a row, interrupts off. */
static void write_cell(uint16_t address, uint8_t byte)
{
    EEAR = address;
    EEDR = byte;
    irq_state_t state = irq_save();
    EECR |= (1u << EEMWE);
    EECR |= (1u << EEWE);
    irq_restore(state);
}

bool eeprom_start(uint16_t address, uint8_t byte)
{
    if (eeprom_is_busy()) {
        return false;
    }
    if (eeprom_byte(address) != byte) {
        write_cell(address, byte);
    }
    return true;
}

void eeprom_update(uint16_t address, const void *from, uint16_t count)
{
    const uint8_t *byte = from;
    for (; count > 0; count--) {
        eeprom_wait();
        system_kick();
        (void)eeprom_start(address++, *byte++);
    }
    eeprom_wait();
}
