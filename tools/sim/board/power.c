/* SPDX-License-Identifier: MIT */
#include <stdlib.h>

#include "board_private.h"
#include "servo_bus.h"

/* Power goes inside an event, never inside an instruction: simavr's core would go on with its own. */
static void cut_at(board_t *board, uint64_t when) { event_at(board, EVENT_POWER, when); }

static bool is_cut_here(const board_t *board, cut_phase_t phase)
{
    return board->power.count == board->power.cut_operation && board->power.cut_phase == phase;
}

void power_begin(board_t *board, operation_kind_t kind, uint32_t address)
{
    power_t *power = &board->power;
    uint64_t now = board->avr->cycle;
    power->count++;
    if (power->log) {
        power->log[power->count % OPERATION_LOG].kind = (uint8_t)kind;
        power->log[power->count % OPERATION_LOG].address = address;
    }
    if (is_cut_here(board, CUT_BEFORE)) {
        cut_at(board, now);
    } else if (is_cut_here(board, CUT_DURING)) {
        uint64_t length = kind == OPERATION_EEPROM ? M128_EEPROM_CYCLES : M128_SPM_CYCLES;
        cut_at(board, now + length / 8 + length / 8 * (power->cut_tear % 7));
    }
}

void power_done(board_t *board, operation_kind_t kind, uint32_t address)
{
    power_t *power = &board->power;
    if (is_cut_here(board, CUT_AFTER)) {
        cut_at(board, board->avr->cycle);
    }
    if (power->done) {
        power->done(power->done_context, board->avr->cycle, kind, address);
    }
}

void power_event(board_t *board, uint64_t now)
{
    power_t *power = &board->power;
    bool planned = power->cut_operation != 0 && power->cut_operation == power->count;
    (void)now;
    if (planned && power->cut_phase == CUT_BEFORE) {
        board->flash.busy = false;
        board->eeprom.busy = false;
    } else if (planned) {
        flash_tear(board, power->cut_tear);
        eeprom_tear(board, power->cut_tear);
    }
    power->cut_operation = 0;
    board_power_off(board);
    board_end_run(board, BOARD_STOP_POWER_CUT);
}

void board_power_off(board_t *board)
{
    if (!board->power.on) {
        return;
    }
    flash_tear(board, board_random(board));
    eeprom_tear(board, board_random(board));
    board->power.on = false;
    event_at(board, EVENT_EEPROM, NEVER);
    reset_now(board, RESET_POWER_ON);
    board->reset.count--;
    servo_bus_power(board->wire.bus, board->avr->cycle, false);
    bus_wire_follow(board);
}

void board_power_on(board_t *board)
{
    if (board->power.on) {
        return;
    }
    uint8_t *data = board->avr->data;
    for (uint32_t i = 0; i < 32; i++) {
        data[i] = (uint8_t)board_random(board);
    }
    for (uint32_t i = M128_RAM_START; i < M128_RAM_END; i++) {
        data[i] = (uint8_t)board_random(board);
    }
    board->power.on = true;
    reset_now(board, RESET_POWER_ON);
    servo_bus_power(board->wire.bus, board->avr->cycle, true);
    bus_wire_follow(board);
}

bool board_is_powered(const board_t *board) { return board->power.on; }

void board_cut_power(board_t *board, uint64_t operation, cut_phase_t phase, uint32_t tear)
{
    board->power.cut_operation = operation;
    board->power.cut_phase = phase;
    board->power.cut_tear = tear;
}

void board_cut_power_at(board_t *board, uint64_t cycle) { cut_at(board, cycle); }

uint64_t board_operations(const board_t *board) { return board->power.count; }

bool board_operation(const board_t *board, uint64_t n, operation_kind_t *kind, uint32_t *address)
{
    const power_t *power = &board->power;
    if (!power->log || n == 0 || n > power->count || n + OPERATION_LOG <= power->count) {
        return false;
    }
    *kind = (operation_kind_t)power->log[n % OPERATION_LOG].kind;
    *address = power->log[n % OPERATION_LOG].address;
    return true;
}

void board_on_operation(board_t *board, board_operation_fn done, void *context)
{
    board->power.done = done;
    board->power.done_context = context;
}
