/* SPDX-License-Identifier: MIT */
#include "reset.h"

#include <stddef.h>

#include "board_struct.h"

static void watchdog_bites(void *context, uint64_t now)
{
    board_t *board = context;
    (void)now;
    if (!violation_note(&board->cpu.machine, VIOLATION_UNEXPECTED_RESET, "the watchdog has bitten")) {
        reset_now(board, RESET_WATCHDOG);
    }
}

/* Writing zeros clears the cause flags. */
static void write_mcucsr(avr_t *avr, avr_io_addr_t address, uint8_t value, void *param)
{
    board_t *board = param;
    board->mcucsr &= value;
    avr->data[address] = (uint8_t)(board->mcucsr | (value & 0x80));
}

static void write_mcucr(avr_t *avr, avr_io_addr_t address, uint8_t value, void *param)
{
    board_t *board = param;
    uint8_t before = avr->data[address];
    if (value & MCUCR_SRE) {
        violation_note(&board->cpu.machine, VIOLATION_UNMODELLED, "external SRAM enabled (MCUCR 0x%02X)", value);
    }
    if (value & MCUCR_IVCE) {
        board->cpu.machine.interrupts_from =
            machine_instruction_end(&board->cpu.machine) + M128_TIMED_SEQUENCE_CYCLES;
        value = (uint8_t)((value & ~MCUCR_IVSEL) | (before & MCUCR_IVSEL));
    } else if ((value ^ before) & MCUCR_IVSEL) {
        if (avr->cycle > board->cpu.machine.interrupts_from) {
            violation_note(&board->cpu.machine, VIOLATION_TIMED_SEQUENCE,
                           "IVSEL changed without IVCE in the 4 cycles before");
            value ^= MCUCR_IVSEL;
        }
        board->cpu.machine.interrupts_from = 0;
    }
    avr->data[address] = value & (uint8_t)~MCUCR_IVCE;
    board->cpu.machine.vector_base = value & MCUCR_IVSEL ? M128_NRWW_START : 0;
}

static void write_xdiv(avr_t *avr, avr_io_addr_t address, uint8_t value, void *param)
{
    board_t *board = param;
    if (value & 0x80) {
        violation_note(&board->cpu.machine, VIOLATION_UNMODELLED, "clock divided (XDIV 0x%02X)", value);
    }
    avr->data[address] = value;
}

static int io_request(avr_io_t *io, uint32_t request, void *param)
{
    board_t *board = (board_t *)((char *)io - offsetof(board_t, io));
    (void)param;
    if (request == AVR_IOCTL_DEF('w', 'd', 't', 'r')) {
        watchdog_feed(&board->watchdog);
        return 0;
    }
    if (request == AVR_IOCTL_DEF('f', 's', 'p', 'm')) {
        flash_spm(&board->flash);
        return 0;
    }
    return -1;
}

void reset_init(board_t *board)
{
    machine_t *machine = &board->cpu.machine;
    board->io.kind = "motion512 board";
    board->io.ioctl = io_request;
    avr_register_io(machine->avr, &board->io);
    machine_io(machine, M128_MCUCSR, NULL, write_mcucsr, board);
    machine_io(machine, M128_MCUCR, NULL, write_mcucr, board);
    machine_io(machine, M128_XDIV, NULL, write_xdiv, board);
    events_handle(&machine->events, EVENT_WATCHDOG, watchdog_bites, board);
    machine->allowed[VIOLATION_UNEXPECTED_RESET] = true;
}

void reset_now(board_t *board, reset_cause_t cause)
{
    cpu_reset(&board->cpu, board->bootrst ? M128_NRWW_START : 0);
    board->mcucsr = (uint8_t)(cause == RESET_POWER_ON ? RESET_POWER_ON : (board->mcucsr | cause));
    board->cpu.machine.avr->data[M128_MCUCSR] = board->mcucsr;
    board->cpu.machine.interrupts_from = 0;
    board->reset_cause = cause;
    board->resets++;
    watchdog_reset(&board->watchdog);
    flash_reset(&board->flash);
    eeprom_reset(&board->eeprom);
    timers_reset(&board->timers);
    uart_reset(&board->uart[0]);
    uart_reset(&board->uart[1]);
    panel_reset(&board->panel);
}

void board_hold_reset(board_t *board, bool held)
{
    if (held && !board->cpu.machine.held && board->cpu.machine.powered) {
        reset_now(board, RESET_EXTERNAL);
    }
    board->cpu.machine.held = held;
}

void board_brown_out(board_t *board)
{
    if (board->cpu.machine.powered) {
        flash_tear(&board->flash, machine_random(&board->cpu.machine));
        eeprom_tear(&board->eeprom, machine_random(&board->cpu.machine));
        reset_now(board, RESET_BROWN_OUT);
    }
}

uint32_t board_resets(const board_t *board) { return board->resets; }
reset_cause_t board_reset_cause(const board_t *board) { return board->reset_cause; }
