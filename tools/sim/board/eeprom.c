/* SPDX-License-Identifier: MIT */
#include <string.h>

#include "board_private.h"

#define ENDURANCE 100000u
#define READ_HALT_CYCLES 4
#define WRITE_HALT_CYCLES 2

static void update_line(board_t *board)
{
    interrupt_line(board, VECTOR_EE_READY, board->eeprom.ready_enabled && !board->eeprom.busy);
}

static bool refuse_busy(board_t *board, const char *what)
{
    return board->eeprom.busy && violation_note(board, VIOLATION_EEPROM_BUSY, "%s during an EEPROM write", what);
}

static uint16_t pointed(const avr_t *avr)
{
    return (uint16_t)((avr->data[M128_EEARH] << 8 | avr->data[M128_EEARL]) % M128_EEPROM_BYTES);
}

static void start_write(board_t *board)
{
    eeprom_t *eeprom = &board->eeprom;
    avr_t *avr = board->avr;
    if (board->flash.busy &&
        violation_note(board, VIOLATION_SPM_EEPROM, "EEPROM write while the flash is being written")) {
        return;
    }
    eeprom->address = pointed(avr);
    eeprom->value = avr->data[M128_EEDR];
    eeprom->busy = true;
    eeprom->master_until = 0;
    avr->cycle += WRITE_HALT_CYCLES;
    event_at(board, EVENT_EEPROM, avr->cycle + M128_EEPROM_CYCLES);
    power_begin(board, OPERATION_EEPROM, eeprom->address);
}

static void read_byte(board_t *board)
{
    avr_t *avr = board->avr;
    if (!refuse_busy(board, "EEPROM read")) {
        avr->data[M128_EEDR] = board->eeprom.bytes[pointed(avr)];
        avr->cycle += READ_HALT_CYCLES;
    }
}

/* SBI and CBI read and write the whole register, so EEWE may come back as it is read. */
static void write_eecr(avr_t *avr, avr_io_addr_t address, uint8_t value, void *param)
{
    board_t *board = param;
    eeprom_t *eeprom = &board->eeprom;
    (void)address;
    eeprom->ready_enabled = value & EECR_EERIE;
    if ((value & EECR_EEWE) && !eeprom->busy) {
        if (avr->cycle <= eeprom->master_until) {
            start_write(board);
        } else {
            violation_note(board, VIOLATION_EEPROM_SEQUENCE, "EEWE without EEMWE in the 4 cycles before");
        }
    } else if (value & EECR_EEMWE) {
        eeprom->master_until = cpu_instruction_end(board) + M128_TIMED_SEQUENCE_CYCLES;
    }
    if (value & EECR_EERE) {
        read_byte(board);
    }
    update_line(board);
}

static uint8_t read_eecr(avr_t *avr, avr_io_addr_t address, void *param)
{
    const board_t *board = param;
    const eeprom_t *eeprom = &board->eeprom;
    unsigned value = eeprom->ready_enabled ? EECR_EERIE : 0u;
    value |= eeprom->busy ? EECR_EEWE : 0u;
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

void eeprom_event(board_t *board, uint64_t now)
{
    eeprom_t *eeprom = &board->eeprom;
    (void)now;
    eeprom->bytes[eeprom->address] = eeprom->value;
    eeprom->busy = false;
    if (++eeprom->wear[eeprom->address] > ENDURANCE) {
        violation_note(board, VIOLATION_EEPROM_WORN, "EEPROM byte 0x%03X written %u times", eeprom->address,
                       (unsigned)eeprom->wear[eeprom->address]);
    }
    update_line(board);
    power_done(board, OPERATION_EEPROM, eeprom->address);
}

/* A byte is erased, then programmed: cut in between it may be anything from the old value over 0xFF to the new. */
void eeprom_tear(board_t *board, uint32_t tear)
{
    eeprom_t *eeprom = &board->eeprom;
    if (!eeprom->busy) {
        return;
    }
    uint8_t *byte = &eeprom->bytes[eeprom->address];
    uint8_t r = (uint8_t)board_random(board);
    const uint8_t contents[4] = { (uint8_t)(*byte | r), 0xFF, (uint8_t)(eeprom->value | r), r };
    *byte = contents[tear % 4];
    eeprom->wear[eeprom->address]++;
    eeprom->busy = false;
    event_at(board, EVENT_EEPROM, NEVER);
}

/* A write in progress goes on over a reset, as long as there is power (data sheet: EEPROM Write, note on reset). */
void eeprom_reset(board_t *board)
{
    board->eeprom.ready_enabled = false;
    board->eeprom.master_until = 0;
    update_line(board);
}

void eeprom_init(board_t *board)
{
    memset(board->eeprom.bytes, 0xFF, sizeof board->eeprom.bytes);
    board_io(board, M128_EECR, read_eecr, write_eecr, board);
    board_io(board, M128_EEDR, NULL, write_pointer, board);
    board_io(board, M128_EEARL, NULL, write_pointer, board);
    board_io(board, M128_EEARH, NULL, write_pointer, board);
}
