/* SPDX-License-Identifier: MIT */
#include "eeprom.h"

#include <string.h>

#define ENDURANCE 100000u
#define READ_HALT_CYCLES 4
#define WRITE_HALT_CYCLES 2

static void update_line(eeprom_t *eeprom)
{
    machine_line(eeprom->machine, VECTOR_EE_READY, eeprom->ready_enabled && !eeprom->operations->eeprom_busy);
}

static bool refuse_busy(eeprom_t *eeprom, const char *what)
{
    return eeprom->operations->eeprom_busy &&
           violation_note(eeprom->machine, VIOLATION_EEPROM_BUSY, "%s during an EEPROM write", what);
}

static uint16_t pointed(const avr_t *avr)
{
    return (uint16_t)((avr->data[M128_EEARH] << 8 | avr->data[M128_EEARL]) % M128_EEPROM_BYTES);
}

static void start_write(eeprom_t *eeprom)
{
    avr_t *avr = eeprom->machine->avr;
    if (eeprom->operations->flash_busy &&
        violation_note(eeprom->machine, VIOLATION_SPM_EEPROM, "EEPROM write while the flash is being written")) {
        return;
    }
    eeprom->address = pointed(avr);
    eeprom->value = avr->data[M128_EEDR];
    eeprom->operations->eeprom_busy = true;
    eeprom->master_until = 0;
    avr->cycle += WRITE_HALT_CYCLES;
    event_at(&eeprom->machine->events, EVENT_EEPROM, avr->cycle + M128_EEPROM_CYCLES);
    operation_begins(eeprom->operations, OPERATION_EEPROM, eeprom->address);
}

static void read_byte(eeprom_t *eeprom)
{
    avr_t *avr = eeprom->machine->avr;
    if (!refuse_busy(eeprom, "EEPROM read")) {
        avr->data[M128_EEDR] = eeprom->bytes[pointed(avr)];
        avr->cycle += READ_HALT_CYCLES;
    }
}

/* SBI and CBI read and write the whole register, so they may write back the EEWE that they read. */
static void write_eecr(avr_t *avr, avr_io_addr_t address, uint8_t value, void *param)
{
    eeprom_t *eeprom = param;
    (void)address;
    eeprom->ready_enabled = value & EECR_EERIE;
    if ((value & EECR_EEWE) && !eeprom->operations->eeprom_busy) {
        if (avr->cycle <= eeprom->master_until) {
            start_write(eeprom);
        } else {
            violation_note(eeprom->machine, VIOLATION_EEPROM_SEQUENCE, "EEWE without EEMWE in the 4 cycles before");
        }
    } else if (value & EECR_EEMWE) {
        eeprom->master_until = machine_instruction_end(eeprom->machine) + M128_TIMED_SEQUENCE_CYCLES;
        machine_unsettled(eeprom->machine, eeprom->master_until);
    }
    if (value & EECR_EERE) {
        read_byte(eeprom);
    }
    update_line(eeprom);
}

static uint8_t read_eecr(avr_t *avr, avr_io_addr_t address, void *param)
{
    const eeprom_t *eeprom = param;
    unsigned value = eeprom->ready_enabled ? EECR_EERIE : 0u;
    value |= eeprom->operations->eeprom_busy ? EECR_EEWE : 0u;
    value |= avr->cycle <= eeprom->master_until ? EECR_EEMWE : 0u;
    avr->data[address] = (uint8_t)value;
    return (uint8_t)value;
}

static void write_pointer(avr_t *avr, avr_io_addr_t address, uint8_t value, void *param)
{
    if (!refuse_busy(param, address == M128_EEDR ? "EEDR written" : "EEAR written")) {
        avr->data[address] = value;
    }
}

static void write_is_over(void *context, uint64_t now)
{
    eeprom_t *eeprom = context;
    (void)now;
    eeprom->bytes[eeprom->address] = eeprom->value;
    eeprom->operations->eeprom_busy = false;
    if (++eeprom->wear[eeprom->address] > ENDURANCE) {
        violation_note(eeprom->machine, VIOLATION_EEPROM_WORN, "EEPROM byte 0x%03X written %u times", eeprom->address,
                       (unsigned)eeprom->wear[eeprom->address]);
    }
    update_line(eeprom);
    operation_is_done(eeprom->operations, OPERATION_EEPROM, eeprom->address);
}

/* A write erases the byte, then programs it. A cut may leave anything from the old value over 0xFF to the new value. */
void eeprom_tear(eeprom_t *eeprom, uint32_t tear)
{
    if (!eeprom->operations->eeprom_busy) {
        return;
    }
    uint8_t *byte = &eeprom->bytes[eeprom->address];
    uint8_t r = (uint8_t)machine_random(eeprom->machine);
    const uint8_t contents[4] = { (uint8_t)(*byte | r), 0xFF, (uint8_t)(eeprom->value | r), r };
    *byte = contents[tear % 4];
    eeprom->wear[eeprom->address]++;
    eeprom->operations->eeprom_busy = false;
    event_at(&eeprom->machine->events, EVENT_EEPROM, NEVER);
}

/* A write in progress continues through a reset while there is power (data sheet: EEPROM Write, note on reset). */
void eeprom_reset(eeprom_t *eeprom)
{
    eeprom->ready_enabled = false;
    eeprom->master_until = 0;
    update_line(eeprom);
}

void eeprom_init(eeprom_t *eeprom, machine_t *machine, operations_t *operations)
{
    eeprom->machine = machine;
    eeprom->operations = operations;
    events_handle(&machine->events, EVENT_EEPROM, write_is_over, eeprom);
    memset(eeprom->bytes, 0xFF, sizeof eeprom->bytes);
    machine_io(eeprom->machine, M128_EECR, read_eecr, write_eecr, eeprom);
    machine_io(eeprom->machine, M128_EEDR, NULL, write_pointer, eeprom);
    machine_io(eeprom->machine, M128_EEARL, NULL, write_pointer, eeprom);
    machine_io(eeprom->machine, M128_EEARH, NULL, write_pointer, eeprom);
}
