/* SPDX-License-Identifier: MIT */
#include "flash.h"

#include <string.h>

#define ENDURANCE 10000u
#define OPERATION_BITS 0x1Fu
#define WORDS (M128_PAGE_BYTES / 2)

/* Lock bits, 0 = programmed */
enum { LOCK_APP_NO_SPM = 0x04, LOCK_APP_NO_LPM = 0x08, LOCK_BOOT_NO_SPM = 0x10, LOCK_BOOT_NO_LPM = 0x20 };

static bool armed(const flash_t *flash)
{
    return (flash->control & SPMCSR_SPMEN) && flash->machine->avr->cycle <= flash->armed_until;
}

static void update_line(flash_t *flash)
{
    machine_line(flash->machine, VECTOR_SPM_READY, (flash->control & SPMCSR_SPMIE) && !flash->operations->flash_busy);
}

static void clear_buffer(flash_t *flash)
{
    memset(flash->filled, 0, sizeof flash->filled);
    memset(flash->page, 0xFF, sizeof flash->page);
}

static void write_spmcsr(avr_t *avr, avr_io_addr_t address, uint8_t value, void *param)
{
    flash_t *flash = param;
    (void)address;
    (void)avr;
    if (flash->operations->flash_busy && (value & OPERATION_BITS)) {
        violation_note(flash->machine, VIOLATION_SPM_BUSY, "SPMCSR = 0x%02X during an erase or a write", value);
        return;
    }
    if (flash->operations->eeprom_busy && (value & SPMCSR_SPMEN)) {
        violation_note(flash->machine, VIOLATION_SPM_EEPROM, "SPMCSR = 0x%02X during an EEPROM write", value);
        return;
    }
    flash->control = value & (uint8_t)(OPERATION_BITS | SPMCSR_SPMIE);
    flash->armed_until = machine_instruction_end(flash->machine) + M128_TIMED_SEQUENCE_CYCLES;
    machine_unsettled(flash->machine, flash->armed_until);
    update_line(flash);
}

static uint8_t read_spmcsr(avr_t *avr, avr_io_addr_t address, void *param)
{
    const flash_t *flash = param;
    unsigned value = flash->control & SPMCSR_SPMIE;
    value |= flash->rww_locked ? SPMCSR_RWWSB : 0u;
    value |= flash->operations->flash_busy || armed(flash) ? flash->control & OPERATION_BITS : 0u;
    avr->data[address] = (uint8_t)value;
    return (uint8_t)value;
}

static uint32_t far_z(const avr_t *avr)
{
    return (uint32_t)((avr->data[M128_RAMPZ] & 1) << 16 | avr->data[31] << 8 | avr->data[30]);
}

static void fill_word(flash_t *flash)
{
    const uint8_t *data = flash->machine->avr->data;
    uint32_t word = far_z(flash->machine->avr) / 2 % WORDS;
    if (flash->filled[word] &&
        violation_note(flash->machine, VIOLATION_FLASH_REFILL, "page buffer word %u filled twice", (unsigned)word)) {
        return;
    }
    flash->filled[word] = true;
    flash->page[word] &= (uint16_t)(data[0] | data[1] << 8);
}

static bool wants_unerased(const flash_t *flash, uint32_t page)
{
    const uint8_t *to = &flash->machine->avr->flash[page];
    for (uint32_t word = 0; word < WORDS; word++) {
        uint16_t old = (uint16_t)(to[2 * word] | to[2 * word + 1] << 8);
        if (flash->filled[word] && (flash->page[word] & ~old)) {
            return true;
        }
    }
    return false;
}

static void begin(flash_t *flash, operation_kind_t kind)
{
    avr_t *avr = flash->machine->avr;
    uint32_t z = far_z(avr);
    uint32_t page = z & ~(M128_PAGE_BYTES - 1);
    bool boot = page >= M128_NRWW_START;
    if (!(flash->lock & (boot ? LOCK_BOOT_NO_SPM : LOCK_APP_NO_SPM))) {
        flash->control &= SPMCSR_SPMIE; /* the chip ignores it silently */
        return;
    }
    if (kind == OPERATION_WRITE && (z & (M128_PAGE_BYTES - 2)) &&
        violation_note(flash->machine, VIOLATION_FLASH_ALIGN, "page write with Z = 0x%05X", z)) {
        return;
    }
    if (kind == OPERATION_WRITE && wants_unerased(flash, page) &&
        violation_note(flash->machine, VIOLATION_FLASH_UNERASED, "page write at 0x%05X needs an erase first", page)) {
        return;
    }
    flash->operations->flash_busy = true;
    flash->operation = kind;
    flash->address = page;
    if (boot) {
        flash->machine->halted_until = avr->cycle + M128_SPM_CYCLES;
    } else {
        flash->rww_locked = true;
        flash->machine->fetch_floor = M128_NRWW_START;
    }
    event_at(&flash->machine->events, EVENT_SPM, avr->cycle + M128_SPM_CYCLES);
    update_line(flash);
    operation_begins(flash->operations, kind, page);
}

static void write_lock_bits(flash_t *flash)
{
    flash->lock_new = flash->machine->avr->data[0] | 0xC0;
    flash->locking = flash->operations->flash_busy = true;
    event_at(&flash->machine->events, EVENT_SPM, flash->machine->avr->cycle + M128_SPM_CYCLES);
    update_line(flash);
}

void flash_spm(flash_t *flash)
{
    avr_t *avr = flash->machine->avr;
    if (avr->pc < M128_NRWW_START &&
        violation_note(flash->machine, VIOLATION_SPM_PLACE, "SPM outside the boot section, at 0x%05X", avr->pc)) {
        return;
    }
    if (flash->operations->flash_busy) {
        violation_note(flash->machine, VIOLATION_SPM_BUSY, "SPM during an erase or a write");
        return;
    }
    if (!armed(flash)) {
        violation_note(flash->machine, VIOLATION_SPM_SEQUENCE, "SPM not within 4 cycles of SPMCSR: the chip ignores it");
        return;
    }
    uint8_t operation = flash->control & OPERATION_BITS;
    switch (operation) {
    case SPMCSR_SPMEN:
        fill_word(flash);
        break;
    case SPMCSR_SPMEN | SPMCSR_PGERS:
        begin(flash, OPERATION_ERASE);
        return;
    case SPMCSR_SPMEN | SPMCSR_PGWRT:
        begin(flash, OPERATION_WRITE);
        return;
    case SPMCSR_SPMEN | SPMCSR_BLBSET:
        write_lock_bits(flash);
        return;
    case SPMCSR_SPMEN | SPMCSR_RWWSRE:
        flash->rww_locked = false;
        flash->machine->fetch_floor = 0;
        clear_buffer(flash);
        break;
    default:
        violation_note(flash->machine, VIOLATION_SPM_SEQUENCE, "SPMCSR = 0x%02X is no operation", operation);
        break;
    }
    flash->control &= SPMCSR_SPMIE;
}

/* Executes an (E)LPM that does not read the flash: puts value into rd and increments Z for Z+. */
static bool lpm_gives(flash_t *flash, uint16_t opcode, uint8_t value)
{
    avr_t *avr = flash->machine->avr;
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

/* LPM soon after SPMEN with BLBSET (three cycles on the chip) reads lock bits and fuses: low, lock, extended, high for
 * Z 0..3. */
static uint8_t lock_or_fuse(const flash_t *flash)
{
    const uint8_t bytes[4] = { flash->fuses[0], flash->lock, flash->fuses[2], flash->fuses[1] };
    return bytes[flash->machine->avr->data[30] & 3];
}

/* Called before an LPM, ELPM or SPM. true: it was done here, or must not be executed. */
static bool before_lpm(void *context, uint32_t pc, uint16_t opcode)
{
    flash_t *flash = context;
    if (opcode == 0x95E8) {
        return false;
    }
    if (armed(flash) && (flash->control & OPERATION_BITS) == (SPMCSR_SPMEN | SPMCSR_BLBSET)) {
        flash->control &= SPMCSR_SPMIE;
        return lpm_gives(flash, opcode, lock_or_fuse(flash));
    }
    bool far = opcode == 0x95D8 || (opcode != 0x95C8 && (opcode & 2));
    uint32_t address = far ? far_z(flash->machine->avr) : far_z(flash->machine->avr) & 0xFFFF;
    if (address < flash->machine->fetch_floor &&
        violation_note(flash->machine, VIOLATION_RWW_READ, "flash read at 0x%05X while it is busy", address)) {
        return true;
    }
    bool from_boot = pc >= M128_NRWW_START, of_boot = address >= M128_NRWW_START;
    if (from_boot != of_boot && !(flash->lock & (of_boot ? LOCK_BOOT_NO_LPM : LOCK_APP_NO_LPM))) {
        return lpm_gives(flash, opcode, 0xFF);
    }
    return false;
}

static void erase_page(flash_t *flash)
{
    uint32_t page = flash->address / M128_PAGE_BYTES;
    memset(&flash->machine->avr->flash[flash->address], 0xFF, M128_PAGE_BYTES);
    symbols_erased(&flash->machine->symbols, flash->address, M128_PAGE_BYTES);
    if (++flash->wear[page] > ENDURANCE) {
        violation_note(flash->machine, VIOLATION_FLASH_WORN, "flash page %u erased %u times", (unsigned)page,
                       (unsigned)flash->wear[page]);
    }
}

static void write_page(flash_t *flash)
{
    uint8_t *to = &flash->machine->avr->flash[flash->address];
    for (uint32_t word = 0; word < WORDS; word++) {
        to[2 * word] &= (uint8_t)flash->page[word];
        to[2 * word + 1] &= (uint8_t)(flash->page[word] >> 8);
    }
    clear_buffer(flash);
}

static void end(flash_t *flash)
{
    flash->operations->flash_busy = flash->locking = false;
    flash->control &= SPMCSR_SPMIE;
    update_line(flash);
}

static void operation_is_over(void *context, uint64_t now)
{
    flash_t *flash = context;
    (void)now;
    if (flash->locking) {
        flash->lock &= flash->lock_new;
        end(flash);
        return;
    }
    if (flash->operation == OPERATION_ERASE) {
        erase_page(flash);
    } else {
        write_page(flash);
    }
    end(flash);
    machine_code_changed(flash->machine, flash->address, M128_PAGE_BYTES);
    operation_is_done(flash->operations, flash->operation, flash->address);
}

/* Leaves an operation half done. tear selects: few, half or most of the bits have changed, or only the first part of
 * the page. */
void flash_tear(flash_t *flash, uint32_t tear)
{
    if (!flash->operations->flash_busy || flash->locking) {
        return;
    }
    uint8_t *to = &flash->machine->avr->flash[flash->address];
    uint32_t edge = (tear / 4) % M128_PAGE_BYTES;
    for (uint32_t i = 0; i < M128_PAGE_BYTES; i++) {
        uint32_t r = machine_random(flash->machine);
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
    end(flash);
    event_at(&flash->machine->events, EVENT_SPM, NEVER);
    machine_code_changed(flash->machine, flash->address, M128_PAGE_BYTES);
}

void flash_reset(flash_t *flash)
{
    flash_tear(flash, flash->operations->flash_busy ? machine_random(flash->machine) : 0);
    end(flash);
    flash->control = 0;
    flash->rww_locked = false;
    event_at(&flash->machine->events, EVENT_SPM, NEVER);
    clear_buffer(flash);
    update_line(flash);
}

/* RAMPZ of this chip has one bit. With more, simavr reads beyond its flash. */
static void write_rampz(avr_t *avr, avr_io_addr_t address, uint8_t value, void *param)
{
    (void)param;
    avr->data[address] = value & 1;
}

void flash_init(flash_t *flash, machine_t *machine, operations_t *operations)
{
    flash->machine = machine;
    flash->operations = operations;
    machine->before_lpm = before_lpm;
    machine->before_lpm_context = flash;
    events_handle(&machine->events, EVENT_SPM, operation_is_over, flash);
    flash->lock = 0xFF;
    flash->fuses[0] = 0x1F; /* external crystal, slow start, brown-out detection at 4.0 V (BOARD.md, Fuses) */
    flash->fuses[1] = 0xC0;
    flash->fuses[2] = 0xFF;
    memset(flash->machine->avr->flash, 0xFF, M128_FLASH_BYTES);
    clear_buffer(flash);
    machine_io(flash->machine, M128_SPMCSR, read_spmcsr, write_spmcsr, flash);
    machine_io(flash->machine, M128_RAMPZ, NULL, write_rampz, flash);
}
