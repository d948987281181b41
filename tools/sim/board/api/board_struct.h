/* SPDX-License-Identifier: MIT
 * board_struct.h - the board with all its parts. Private to this folder. */
#ifndef SIM_BOARD_STRUCT_H
#define SIM_BOARD_STRUCT_H

#include "bus_wire.h"
#include "console_wire.h"
#include "cpu.h"
#include "eeprom.h"
#include "flash.h"
#include "machine.h"
#include "operations.h"
#include "panel.h"
#include "timer.h"
#include "trace.h"
#include "uart.h"
#include "watchdog.h"

struct board {
    cpu_t cpu;
    timers_t timers;
    uart_t uart[2];
    operations_t operations;
    flash_t flash;
    eeprom_t eeprom;
    watchdog_t watchdog;
    bus_wire_t wire;
    console_wire_t console;
    panel_t panel;
    trace_t trace;
    bool bootrst;
    char error[256];
    avr_io_t io; /* through it simavr's core passes on SPM and WDR */
    /* reset.c */
    uint8_t mcucsr;
    uint32_t resets;
    reset_cause_t reset_cause;
};

#endif
