/* SPDX-License-Identifier: MIT */
#include "violation.h"

#include <string.h>

static const char *const names[VIOLATION_COUNT] = {
    [VIOLATION_NONE] = "none",
    [VIOLATION_SPM_PLACE] = "spm-place",
    [VIOLATION_SPM_SEQUENCE] = "spm-sequence",
    [VIOLATION_SPM_BUSY] = "spm-busy",
    [VIOLATION_SPM_EEPROM] = "spm-eeprom",
    [VIOLATION_RWW_FETCH] = "rww-fetch",
    [VIOLATION_RWW_READ] = "rww-read",
    [VIOLATION_FLASH_UNERASED] = "flash-unerased",
    [VIOLATION_FLASH_REFILL] = "flash-refill",
    [VIOLATION_FLASH_ALIGN] = "flash-align",
    [VIOLATION_FLASH_WORN] = "flash-worn",
    [VIOLATION_EEPROM_BUSY] = "eeprom-busy",
    [VIOLATION_EEPROM_SEQUENCE] = "eeprom-sequence",
    [VIOLATION_EEPROM_WORN] = "eeprom-worn",
    [VIOLATION_UART_OVERRUN] = "uart-overrun",
    [VIOLATION_BUS_OVERRUN] = "bus-overrun",
    [VIOLATION_UART_TX_LOST] = "uart-tx-lost",
    [VIOLATION_UART_FORMAT] = "uart-format",
    [VIOLATION_UART_SETUP] = "uart-setup",
    [VIOLATION_BUS_UNDRIVEN] = "bus-undriven",
    [VIOLATION_BUS_BOTH] = "bus-both",
    [VIOLATION_BUS_RELEASED] = "bus-released",
    [VIOLATION_PULLUP] = "pullup",
    [VIOLATION_CHARGER] = "charger",
    [VIOLATION_PIN_FIGHT] = "pin-fight",
    [VIOLATION_STACK] = "stack",
    [VIOLATION_STACK_UNSET] = "stack-unset",
    [VIOLATION_ERASED] = "erased",
    [VIOLATION_ILLEGAL] = "illegal",
    [VIOLATION_ADDRESS] = "address",
    [VIOLATION_SLEEP] = "sleep",
    [VIOLATION_INTERRUPT] = "interrupt-registers",
    [VIOLATION_UNMODELLED] = "unmodelled",
    [VIOLATION_TIMED_SEQUENCE] = "timed-sequence",
    [VIOLATION_UNEXPECTED_RESET] = "unexpected-reset",
};

const char *violation_name(violation_kind_t kind)
{
    return (unsigned)kind < VIOLATION_COUNT ? names[kind] : "?";
}

violation_kind_t violation_find(const char *name)
{
    for (int kind = 1; kind < VIOLATION_COUNT; kind++) {
        if (strcmp(names[kind], name) == 0) {
            return (violation_kind_t)kind;
        }
    }
    return VIOLATION_NONE;
}
