/* SPDX-License-Identifier: MIT */
#include "power.h"

#include "board_memory.h"
#include "board_struct.h"
#include "reset.h"

static void power_fails(void *context, uint64_t now)
{
    board_t *board = context;
    operations_t *operations = &board->operations;
    bool planned = operations->cut_operation != 0 && operations->cut_operation == operations->count;
    (void)now;
    if (planned && operations->cut_phase == CUT_BEFORE) {
        operations->flash_busy = operations->eeprom_busy = false;
    } else if (planned) {
        flash_tear(&board->flash, operations->cut_tear);
        eeprom_tear(&board->eeprom, operations->cut_tear);
    }
    operations->cut_operation = 0;
    board_power_off(board);
    machine_end_run(&board->cpu.machine, BOARD_STOP_POWER_CUT);
}

void board_power_off(board_t *board)
{
    if (!board->cpu.machine.powered) {
        return;
    }
    flash_tear(&board->flash, machine_random(&board->cpu.machine));
    eeprom_tear(&board->eeprom, machine_random(&board->cpu.machine));
    board->cpu.machine.powered = false;
    event_at(&board->cpu.machine.events, EVENT_EEPROM, NEVER);
    reset_now(board, RESET_POWER_ON);
    board->resets--;
    bus_wire_power(&board->wire, false);
}

void board_power_on(board_t *board)
{
    if (board->cpu.machine.powered) {
        return;
    }
    uint8_t *data = board->cpu.machine.avr->data;
    for (uint32_t i = 0; i < 32; i++) {
        data[i] = (uint8_t)machine_random(&board->cpu.machine);
    }
    for (uint32_t i = M128_RAM_START; i < M128_RAM_END; i++) {
        data[i] = (uint8_t)machine_random(&board->cpu.machine);
    }
    board->cpu.machine.powered = true;
    reset_now(board, RESET_POWER_ON);
    bus_wire_power(&board->wire, true);
}

bool board_is_powered(const board_t *board) { return board->cpu.machine.powered; }

void board_cut_power(board_t *board, uint64_t operation, cut_phase_t phase, uint32_t tear)
{
    board->operations.cut_operation = operation;
    board->operations.cut_phase = phase;
    board->operations.cut_tear = tear;
}

void board_cut_power_at(board_t *board, uint64_t cycle) { event_at(&board->cpu.machine.events, EVENT_POWER, cycle); }

void power_init(board_t *board) { events_handle(&board->cpu.machine.events, EVENT_POWER, power_fails, board); }
