/* SPDX-License-Identifier: MIT
 * A firmware that waits goes round in a loop, and one round is like the other until something happens. When a jump back
 * finds registers, flags, stack and SRAM as the one before it did, and the round in between has looked at nothing else but
 * the count of timer 1, the buttons, and the state of UARTs, flash and EEPROM, the rounds up to the next event or count
 * would be the same: their cycles are added. The run stays the same to the cycle (tests/sim/test_board_waits.py). */
#include <string.h>

#include "board_private.h"

enum { KIND_PLAIN, KIND_TOUCHES, KIND_JUMPS_BACK };
enum { IO_PINE = 0x01, IO_UCSR0A = 0x0B, IO_PIND = 0x10, IO_EECR = 0x1C, IO_TCNT1L = 0x2C, IO_TCNT1H = 0x2D, IO_SPL = 0x3D,
       IO_SREG = 0x3F, UCSR1A = 0x9B };

/* Reading has no effect, and the value changes with an event, or at a time that next_change() knows. */
static bool is_harmless_io(unsigned io)
{
    return io == IO_PINE || io == IO_UCSR0A || io == IO_PIND || io == IO_EECR || io == IO_TCNT1L || io == IO_TCNT1H ||
           (io >= IO_SPL && io <= IO_SREG);
}

/* Whether an instruction reads or writes what changes by itself or has effects: registers of devices, memory by pointer. */
static bool touches(uint16_t opcode, uint16_t operand)
{
    if ((opcode & 0xF800u) == 0xB000u) { /* IN */
        return !is_harmless_io((opcode >> 5 & 0x30u) | (opcode & 0xFu));
    }
    if ((opcode & 0xFE0Fu) == 0x9000u && (operand == UCSR1A || operand == M128_SPMCSR)) { /* LDS */
        return false;
    }
    if ((opcode & 0xFC0Fu) == 0x9000u) { /* LDS, STS */
        return operand < M128_RAM_START;
    }
    if ((opcode & 0xFD00u) == 0x9900u) { /* SBIC, SBIS */
        return !is_harmless_io(opcode >> 3 & 0x1Fu);
    }
    if ((opcode & 0xFC00u) == 0x9000u) { /* loads and stores, but for PUSH and POP */
        return (opcode & 0xFu) != 0xFu;
    }
    return (opcode & 0xF800u) == 0xB800u                      /* OUT */
           || (opcode & 0xFD00u) == 0x9800u                   /* CBI, SBI */
           || (opcode & 0xD000u) == 0x8000u                   /* LDD, STD */
           || opcode == 0x9518u || opcode == 0x9588u          /* RETI, SLEEP */
           || (opcode & 0xFFCFu) == 0x95C8u;                  /* LPM, ELPM, SPM */
}

static uint16_t word_at(const board_t *board, uint32_t word)
{
    const uint8_t *at = &board->avr->flash[2 * (word % (M128_FLASH_BYTES / 2))];
    return (uint16_t)(at[0] | at[1] << 8);
}

void waits_flash_changed(board_t *board, uint32_t address, uint32_t count)
{
    if (!board->waits.on) {
        return;
    }
    /* From the word before: its operand may have changed. */
    for (uint32_t word = address < 2 ? 0 : address / 2 - 1; word < (address + count + 1) / 2; word++) {
        uint16_t opcode = word_at(board, word);
        board->waits.kind[word] = opcode_jumps_back(opcode)                   ? KIND_JUMPS_BACK
                                  : touches(opcode, word_at(board, word + 1)) ? KIND_TOUCHES
                                                                              : KIND_PLAIN;
    }
    waits_disturbed(board);
}

void board_skip_waits(board_t *board, bool on)
{
    board->waits.on = on;
    waits_flash_changed(board, 0, M128_FLASH_BYTES);
}

void waits_disturbed(board_t *board)
{
    board->waits.touched = true;
}

/* The first cycle behind `from` at which a round can find something changed: an event, one of simavr's timers, a count. */
static uint64_t next_change(const board_t *board, uint64_t from)
{
    const avr_t *avr = board->avr;
    uint64_t next = board->events.next;
    if (avr->cycle_timers.timer && avr->cycle_timers.timer->when < next) {
        next = avr->cycle_timers.timer->when;
    }
    for (int i = 0; i < 2; i++) {
        uint32_t prescale = board->timer[i].prescale;
        uint64_t count = prescale ? (from / prescale + 1) * prescale : NEVER;
        next = count < next ? count : next;
    }
    for (unsigned i = 0; i < BUTTON_COUNT; i++) {
        next = board->panel.bounces_until[i] > from ? from : next;
    }
    bool in_sequence = board->eeprom.master_until >= from || board->flash.armed_until >= from;
    return in_sequence ? from : next;
}

/* A watchdog that the loop feeds has to be fed once more before its time. */
static void skip(board_t *board)
{
    uint64_t from = board->waits.at, now = board->avr->cycle, next = next_change(board, from);
    uint64_t end = board->events.when[EVENT_WATCHDOG] == next ? next - (now - from) : next;
    if (next != NEVER && end > now) {
        board->avr->cycle = now + (end - now) / (now - from) * (now - from);
    }
}

static void note_state(const avr_t *avr, uint8_t state[WAITS_STATE_BYTES])
{
    memcpy(state, &avr->pc, 4);
    memcpy(state + 4, avr->data, 32);
    memcpy(state + 36, avr->sreg, 8);
    state[44] = avr->data[M128_SPL];
    state[45] = avr->data[M128_SPH];
}

/* Whether the SRAM is as it was at the last jump back; then takes it as it is now. */
static bool ram_is_same(board_t *board)
{
    waits_t *waits = &board->waits;
    const uint8_t *ram = board->avr->data + M128_RAM_START;
    bool same = waits->knows_ram && memcmp(ram, waits->ram, sizeof waits->ram) == 0;
    if (!same) {
        memcpy(waits->ram, ram, sizeof waits->ram);
    }
    waits->knows_ram = true;
    return same;
}

void waits_passed(board_t *board, uint32_t pc)
{
    const avr_t *avr = board->avr;
    waits_t *waits = &board->waits;
    uint8_t kind = waits->kind[pc / 2 % (M128_FLASH_BYTES / 2)];
    if (kind != KIND_JUMPS_BACK || avr->pc > pc) {
        waits->touched |= kind == KIND_TOUCHES;
        return;
    }
    uint8_t state[WAITS_STATE_BYTES];
    note_state(avr, state);
    if (waits->touched) {
        waits->knows_ram = false;
    } else if (ram_is_same(board) && memcmp(state, waits->state, sizeof state) == 0) {
        skip(board);
    }
    memcpy(waits->state, state, sizeof state);
    waits->at = avr->cycle;
    waits->touched = false;
}
