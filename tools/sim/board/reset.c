/* SPDX-License-Identifier: MIT */
#include "board_private.h"

static uint64_t watchdog_period(const board_t *board)
{
    return (uint64_t)M128_WATCHDOG_CYCLES << (board->reset.wdtcr & WDTCR_WDP);
}

bool reset_watchdog_runs(const board_t *board) { return (board->reset.wdtcr & WDTCR_WDE) != 0; }

static void watchdog_restart(board_t *board, uint64_t now)
{
    event_at(board, EVENT_WATCHDOG, reset_watchdog_runs(board) ? now + watchdog_period(board) : NEVER);
}

void reset_event(board_t *board, uint64_t now)
{
    (void)now;
    if (!violation_note(board, VIOLATION_UNEXPECTED_RESET, "the watchdog has bitten")) {
        reset_now(board, RESET_WATCHDOG);
    }
}

/* Safety level 1 (M103C and WDTON unprogrammed): the watchdog may be started by one write, but stopped or given
 * another time only within 4 cycles after WDCE and WDE were written together. */
static void write_wdtcr(avr_t *avr, avr_io_addr_t address, uint8_t value, void *param)
{
    board_t *board = param;
    reset_t *reset = &board->reset;
    bool open = avr->cycle <= reset->watchdog_open;
    (void)address;
    if ((value & WDTCR_WDCE) && (value & WDTCR_WDE)) {
        reset->watchdog_open = cpu_instruction_end(board) + M128_TIMED_SEQUENCE_CYCLES;
        value = (uint8_t)(WDTCR_WDE | (reset->wdtcr & WDTCR_WDP));
    } else {
        bool stops = (reset->wdtcr & WDTCR_WDE) && !(value & WDTCR_WDE);
        bool changes = (reset->wdtcr ^ value) & WDTCR_WDP;
        if ((stops || changes) && !open) {
            violation_note(board, VIOLATION_TIMED_SEQUENCE, "WDTCR = 0x%02X without the timed sequence", value);
            value = (uint8_t)((reset->wdtcr & (WDTCR_WDE | WDTCR_WDP)) | (value & WDTCR_WDE));
        }
        reset->watchdog_open = 0;
        value &= WDTCR_WDE | WDTCR_WDP;
    }
    bool was_running = reset_watchdog_runs(board);
    uint64_t since = board->events.when[EVENT_WATCHDOG] - watchdog_period(board);
    reset->wdtcr = value;
    watchdog_restart(board, was_running ? since : avr->cycle);
}

static uint8_t read_wdtcr(avr_t *avr, avr_io_addr_t address, void *param)
{
    const board_t *board = param;
    uint8_t value = board->reset.wdtcr;
    if (avr->cycle <= board->reset.watchdog_open) {
        value |= WDTCR_WDCE;
    }
    avr->data[address] = value;
    return value;
}

/* The cause flags are cleared by writing zeros. */
static void write_mcucsr(avr_t *avr, avr_io_addr_t address, uint8_t value, void *param)
{
    board_t *board = param;
    board->reset.mcucsr &= value;
    avr->data[address] = (uint8_t)(board->reset.mcucsr | (value & 0x80));
}

static void write_mcucr(avr_t *avr, avr_io_addr_t address, uint8_t value, void *param)
{
    board_t *board = param;
    uint8_t before = avr->data[address];
    if (value & MCUCR_SRE) {
        violation_note(board, VIOLATION_UNMODELLED, "external SRAM enabled (MCUCR 0x%02X)", value);
    }
    if (value & MCUCR_IVCE) {
        board->reset.ivsel_open = cpu_instruction_end(board) + M128_TIMED_SEQUENCE_CYCLES;
        value = (uint8_t)((value & ~MCUCR_IVSEL) | (before & MCUCR_IVSEL));
    } else if ((value ^ before) & MCUCR_IVSEL) {
        if (avr->cycle > board->reset.ivsel_open) {
            violation_note(board, VIOLATION_TIMED_SEQUENCE, "IVSEL changed without IVCE in the 4 cycles before");
            value ^= MCUCR_IVSEL;
        }
        board->reset.ivsel_open = 0;
    }
    avr->data[address] = value & (uint8_t)~MCUCR_IVCE;
    board->cpu.vector_base = value & MCUCR_IVSEL ? M128_NRWW_START : 0;
}

static void write_xdiv(avr_t *avr, avr_io_addr_t address, uint8_t value, void *param)
{
    if (value & 0x80) {
        violation_note(param, VIOLATION_UNMODELLED, "clock divided (XDIV 0x%02X)", value);
    }
    avr->data[address] = value;
}

static int io_request(avr_io_t *io, uint32_t request, void *param)
{
    board_t *board = (board_t *)((char *)io - offsetof(board_t, io));
    (void)param;
    if (request == AVR_IOCTL_DEF('w', 'd', 't', 'r')) {
        watchdog_restart(board, board->avr->cycle);
        return 0;
    }
    if (request == AVR_IOCTL_DEF('f', 's', 'p', 'm')) {
        flash_spm(board);
        return 0;
    }
    return -1;
}

void reset_init(board_t *board)
{
    board->io.kind = "motion512 board";
    board->io.ioctl = io_request;
    avr_register_io(board->avr, &board->io);
    board_io(board, M128_WDTCR, read_wdtcr, write_wdtcr, board);
    board_io(board, M128_MCUCSR, NULL, write_mcucsr, board);
    board_io(board, M128_MCUCR, NULL, write_mcucr, board);
    board_io(board, M128_XDIV, NULL, write_xdiv, board);
    board->allowed[VIOLATION_UNEXPECTED_RESET] = true;
}

void reset_now(board_t *board, reset_cause_t cause)
{
    reset_t *reset = &board->reset;
    cpu_reset(board, board->bootrst ? M128_NRWW_START : 0);
    reset->mcucsr = (uint8_t)(cause == RESET_POWER_ON ? RESET_POWER_ON : (reset->mcucsr | cause));
    board->avr->data[M128_MCUCSR] = reset->mcucsr;
    reset->cause = cause;
    reset->count++;
    reset->wdtcr = 0;
    reset->watchdog_open = reset->ivsel_open = 0;
    event_at(board, EVENT_WATCHDOG, NEVER);
    stack_reset(board);
    probe_reset(board);
    sweep_reset(board);
    flash_reset(board);
    eeprom_reset(board);
    timer_reset(&board->timer[0]);
    timer_reset(&board->timer[1]);
    uart_reset(&board->uart[0]);
    uart_reset(&board->uart[1]);
    panel_reset(board);
}

void board_hold_reset(board_t *board, bool held)
{
    if (held && !board->reset.held && board->power.on) {
        reset_now(board, RESET_EXTERNAL);
    }
    board->reset.held = held;
}

void board_brown_out(board_t *board)
{
    if (board->power.on) {
        flash_tear(board, board_random(board));
        eeprom_tear(board, board_random(board));
        reset_now(board, RESET_BROWN_OUT);
    }
}

uint32_t board_resets(const board_t *board) { return board->reset.count; }
reset_cause_t board_reset_cause(const board_t *board) { return board->reset.cause; }
