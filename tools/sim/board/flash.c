/* SPDX-License-Identifier: MIT */
#include <string.h>

#include "board_private.h"

#define ENDURANCE 10000u
#define OPERATION_BITS 0x1Fu
#define WORDS (M128_PAGE_BYTES / 2)

/* Lock bits, 0 = programmed */
enum { LOCK_APP_NO_SPM = 0x04, LOCK_APP_NO_LPM = 0x08, LOCK_BOOT_NO_SPM = 0x10, LOCK_BOOT_NO_LPM = 0x20 };

static bool armed(const board_t *board)
{
    return (board->flash.control & SPMCSR_SPMEN) && board->avr->cycle <= board->flash.armed_until;
}

static void update_line(board_t *board)
{
    interrupt_line(board, VECTOR_SPM_READY, (board->flash.control & SPMCSR_SPMIE) && !board->flash.busy);
}

static void clear_buffer(flash_t *flash)
{
    memset(flash->filled, 0, sizeof flash->filled);
    memset(flash->page, 0xFF, sizeof flash->page);
}

static void write_spmcsr(avr_t *avr, avr_io_addr_t address, uint8_t value, void *param)
{
    board_t *board = param;
    flash_t *flash = &board->flash;
    (void)address;
    (void)avr;
    if (flash->busy && (value & OPERATION_BITS)) {
        violation_note(board, VIOLATION_SPM_BUSY, "SPMCSR = 0x%02X during an erase or a write", value);
        return;
    }
    if (board->eeprom.busy && (value & SPMCSR_SPMEN)) {
        violation_note(board, VIOLATION_SPM_EEPROM, "SPMCSR = 0x%02X during an EEPROM write", value);
        return;
    }
    flash->control = value & (uint8_t)(OPERATION_BITS | SPMCSR_SPMIE);
    flash->armed_until = cpu_instruction_end(board) + M128_TIMED_SEQUENCE_CYCLES;
    update_line(board);
}

static uint8_t read_spmcsr(avr_t *avr, avr_io_addr_t address, void *param)
{
    const board_t *board = param;
    const flash_t *flash = &board->flash;
    unsigned value = flash->control & SPMCSR_SPMIE;
    value |= flash->rww_locked ? SPMCSR_RWWSB : 0u;
    value |= flash->busy || armed(board) ? flash->control & OPERATION_BITS : 0u;
    avr->data[address] = (uint8_t)value;
    return (uint8_t)value;
}

static uint32_t far_z(const avr_t *avr)
{
    return (uint32_t)((avr->data[M128_RAMPZ] & 1) << 16 | avr->data[31] << 8 | avr->data[30]);
}

static void fill_word(board_t *board)
{
    flash_t *flash = &board->flash;
    const uint8_t *data = board->avr->data;
    uint32_t word = far_z(board->avr) / 2 % WORDS;
    if (flash->filled[word] &&
        violation_note(board, VIOLATION_FLASH_REFILL, "page buffer word %u filled twice", (unsigned)word)) {
        return;
    }
    flash->filled[word] = true;
    flash->page[word] &= (uint16_t)(data[0] | data[1] << 8);
}

static bool wants_unerased(const board_t *board, uint32_t page)
{
    const uint8_t *to = &board->avr->flash[page];
    for (uint32_t word = 0; word < WORDS; word++) {
        uint16_t old = (uint16_t)(to[2 * word] | to[2 * word + 1] << 8);
        if (board->flash.filled[word] && (board->flash.page[word] & ~old)) {
            return true;
        }
    }
    return false;
}

static void begin(board_t *board, operation_kind_t kind)
{
    avr_t *avr = board->avr;
    flash_t *flash = &board->flash;
    uint32_t z = far_z(avr);
    uint32_t page = z & ~(M128_PAGE_BYTES - 1);
    bool boot = page >= M128_NRWW_START;
    if (!(flash->lock & (boot ? LOCK_BOOT_NO_SPM : LOCK_APP_NO_SPM))) {
        flash->control &= SPMCSR_SPMIE; /* the chip does nothing, and says nothing */
        return;
    }
    if (kind == OPERATION_WRITE && (z & (M128_PAGE_BYTES - 2)) &&
        violation_note(board, VIOLATION_FLASH_ALIGN, "page write with Z = 0x%05X", z)) {
        return;
    }
    if (kind == OPERATION_WRITE && wants_unerased(board, page) &&
        violation_note(board, VIOLATION_FLASH_UNERASED, "page write at 0x%05X needs an erase first", page)) {
        return;
    }
    flash->busy = true;
    flash->operation = kind;
    flash->address = page;
    if (boot) {
        board->cpu.halted_until = avr->cycle + M128_SPM_CYCLES;
    } else {
        flash->rww_locked = true;
        board->cpu.fetch_floor = M128_NRWW_START;
    }
    event_at(board, EVENT_SPM, avr->cycle + M128_SPM_CYCLES);
    update_line(board);
    power_begin(board, kind, page);
}

static void write_lock_bits(board_t *board)
{
    board->flash.lock_new = board->avr->data[0] | 0xC0;
    board->flash.locking = board->flash.busy = true;
    event_at(board, EVENT_SPM, board->avr->cycle + M128_SPM_CYCLES);
    update_line(board);
}

void flash_spm(board_t *board)
{
    avr_t *avr = board->avr;
    flash_t *flash = &board->flash;
    if (avr->pc < M128_NRWW_START &&
        violation_note(board, VIOLATION_SPM_PLACE, "SPM outside the boot section, at 0x%05X", avr->pc)) {
        return;
    }
    if (flash->busy) {
        violation_note(board, VIOLATION_SPM_BUSY, "SPM during an erase or a write");
        return;
    }
    if (!armed(board)) {
        violation_note(board, VIOLATION_SPM_SEQUENCE, "SPM not within 4 cycles of SPMCSR: the chip ignores it");
        return;
    }
    uint8_t operation = flash->control & OPERATION_BITS;
    switch (operation) {
    case SPMCSR_SPMEN:
        fill_word(board);
        break;
    case SPMCSR_SPMEN | SPMCSR_PGERS:
        begin(board, OPERATION_ERASE);
        return;
    case SPMCSR_SPMEN | SPMCSR_PGWRT:
        begin(board, OPERATION_WRITE);
        return;
    case SPMCSR_SPMEN | SPMCSR_BLBSET:
        write_lock_bits(board);
        return;
    case SPMCSR_SPMEN | SPMCSR_RWWSRE:
        flash->rww_locked = false;
        board->cpu.fetch_floor = 0;
        clear_buffer(flash);
        break;
    default:
        violation_note(board, VIOLATION_SPM_SEQUENCE, "SPMCSR = 0x%02X is no operation", operation);
        break;
    }
    flash->control &= SPMCSR_SPMIE;
}

/* (E)LPM done by hand, when it does not read the flash: into rd, Z+ included. */
static bool lpm_gives(board_t *board, uint16_t opcode, uint8_t value)
{
    avr_t *avr = board->avr;
    bool implied = opcode == 0x95C8 || opcode == 0x95D8;
    unsigned rd = implied ? 0 : (opcode >> 4 & 0x1Fu);
    if (!implied && (opcode & 1)) {
        uint32_t z = far_z(avr) + 1;
        avr->data[30] = (uint8_t)z;
        avr->data[31] = (uint8_t)(z >> 8);
        if (opcode & 2) {
            avr->data[M128_RAMPZ] = (uint8_t)(z >> 16 & 1);
        }
    }
    avr->data[rd] = value;
    avr->pc += 2;
    avr->cycle += 3;
    return true;
}

/* LPM within three cycles after SPMEN with BLBSET reads lock bits and fuses: low, lock, extended, high for Z 0..3. */
static uint8_t lock_or_fuse(const board_t *board)
{
    const flash_t *flash = &board->flash;
    const uint8_t bytes[4] = { flash->fuses[0], flash->lock, flash->fuses[2], flash->fuses[1] };
    return bytes[board->avr->data[30] & 3];
}

bool flash_before_lpm(board_t *board, uint32_t pc, uint16_t opcode)
{
    flash_t *flash = &board->flash;
    if (opcode == 0x95E8) {
        return false;
    }
    if (armed(board) && (flash->control & OPERATION_BITS) == (SPMCSR_SPMEN | SPMCSR_BLBSET)) {
        flash->control &= SPMCSR_SPMIE;
        return lpm_gives(board, opcode, lock_or_fuse(board));
    }
    bool far = opcode == 0x95D8 || (opcode != 0x95C8 && (opcode & 2));
    uint32_t address = far ? far_z(board->avr) : far_z(board->avr) & 0xFFFF;
    if (address < board->cpu.fetch_floor &&
        violation_note(board, VIOLATION_RWW_READ, "flash read at 0x%05X while it is busy", address)) {
        return true;
    }
    bool from_boot = pc >= M128_NRWW_START, of_boot = address >= M128_NRWW_START;
    if (from_boot != of_boot && !(flash->lock & (of_boot ? LOCK_BOOT_NO_LPM : LOCK_APP_NO_LPM))) {
        return lpm_gives(board, opcode, 0xFF);
    }
    return false;
}

static void erase_page(board_t *board)
{
    flash_t *flash = &board->flash;
    uint32_t page = flash->address / M128_PAGE_BYTES;
    memset(&board->avr->flash[flash->address], 0xFF, M128_PAGE_BYTES);
    if (++flash->wear[page] > ENDURANCE) {
        violation_note(board, VIOLATION_FLASH_WORN, "flash page %u erased %u times", (unsigned)page,
                       (unsigned)flash->wear[page]);
    }
}

static void write_page(board_t *board)
{
    flash_t *flash = &board->flash;
    uint8_t *to = &board->avr->flash[flash->address];
    for (uint32_t word = 0; word < WORDS; word++) {
        to[2 * word] &= (uint8_t)flash->page[word];
        to[2 * word + 1] &= (uint8_t)(flash->page[word] >> 8);
    }
    clear_buffer(flash);
}

static void end(board_t *board)
{
    board->flash.busy = board->flash.locking = false;
    board->flash.control &= SPMCSR_SPMIE;
    update_line(board);
}

void flash_event(board_t *board, uint64_t now)
{
    flash_t *flash = &board->flash;
    (void)now;
    if (flash->locking) {
        flash->lock &= flash->lock_new;
        end(board);
        return;
    }
    if (flash->operation == OPERATION_ERASE) {
        erase_page(board);
    } else {
        write_page(board);
    }
    end(board);
    cpu_flash_changed(board, flash->address, M128_PAGE_BYTES);
    power_done(board, flash->operation, flash->address);
}

/* What is left when an operation stops in the middle: by tear, few, half or most of the bits have changed, or the
 * first part of the page is done and the rest untouched. */
void flash_tear(board_t *board, uint32_t tear)
{
    flash_t *flash = &board->flash;
    if (!flash->busy || flash->locking) {
        return;
    }
    uint8_t *to = &board->avr->flash[flash->address];
    uint32_t edge = (tear / 4) % M128_PAGE_BYTES;
    for (uint32_t i = 0; i < M128_PAGE_BYTES; i++) {
        uint32_t r = board_random(board);
        uint8_t mask[4] = { (uint8_t)(r & r >> 8 & r >> 16), (uint8_t)r, (uint8_t)(r | r >> 8 | r >> 16),
                            i < edge ? 0xFF : 0 };
        uint8_t changed = mask[tear % 4];
        if (flash->operation == OPERATION_ERASE) {
            to[i] |= changed;
        } else {
            to[i] &= (uint8_t)(flash->page[i / 2] >> (i % 2 ? 8 : 0)) | (uint8_t)~changed;
        }
    }
    if (flash->operation == OPERATION_ERASE) {
        flash->wear[flash->address / M128_PAGE_BYTES]++;
    }
    end(board);
    event_at(board, EVENT_SPM, NEVER);
    cpu_flash_changed(board, flash->address, M128_PAGE_BYTES);
}

void flash_reset(board_t *board)
{
    flash_tear(board, board->flash.busy ? board_random(board) : 0);
    end(board);
    board->flash.control = 0;
    board->flash.rww_locked = false;
    event_at(board, EVENT_SPM, NEVER);
    clear_buffer(&board->flash);
    update_line(board);
}

/* RAMPZ of this chip is one bit wide; simavr reads beyond its flash with more. */
static void write_rampz(avr_t *avr, avr_io_addr_t address, uint8_t value, void *param)
{
    (void)param;
    avr->data[address] = value & 1;
}

void flash_init(board_t *board)
{
    flash_t *flash = &board->flash;
    flash->lock = 0xFF;
    flash->fuses[0] = 0x1F; /* external crystal, slow start, brown-out at 4.0 V on (BOARD.md, Fuses) */
    flash->fuses[1] = 0xC0;
    flash->fuses[2] = 0xFF;
    memset(board->avr->flash, 0xFF, M128_FLASH_BYTES);
    clear_buffer(flash);
    board_io(board, M128_SPMCSR, read_spmcsr, write_spmcsr, board);
    board_io(board, M128_RAMPZ, NULL, write_rampz, board);
}
