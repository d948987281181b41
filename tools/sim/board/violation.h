/* SPDX-License-Identifier: MIT
 * violation.h - what the board does not allow. Most violations are things that a chip does wrongly and silently. Some
 * (overrun) must never happen on this board. The first violation stops the run and stays on record. An allowed kind is
 * only counted. */
#ifndef SIM_VIOLATION_H
#define SIM_VIOLATION_H

#include <stdint.h>

typedef enum {
    VIOLATION_NONE,
    /* parts/flash.c */
    VIOLATION_SPM_PLACE,       /* SPM executed outside the boot section */
    VIOLATION_SPM_SEQUENCE,    /* SPM without, or more than 4 cycles after, its SPMCSR write; unknown operation */
    VIOLATION_SPM_BUSY,        /* SPM or SPMCSR during an erase or a write */
    VIOLATION_SPM_EEPROM,      /* SPM during an EEPROM write, or the reverse */
    VIOLATION_RWW_FETCH,       /* instruction or vector fetched from the busy part of the flash */
    VIOLATION_RWW_READ,        /* LPM or ELPM from the busy part */
    VIOLATION_FLASH_UNERASED,  /* a write of ones where the flash has zeros */
    VIOLATION_FLASH_REFILL,    /* a word of the page buffer written twice */
    VIOLATION_FLASH_ALIGN,     /* page write with the word bits of Z not zero */
    VIOLATION_FLASH_WORN,      /* a page erased more than 10,000 times */
    /* parts/eeprom.c */
    VIOLATION_EEPROM_BUSY,     /* EEPROM read, written or addressed during a write */
    VIOLATION_EEPROM_SEQUENCE, /* EEWE without EEMWE in the preceding 4 cycles */
    VIOLATION_EEPROM_WORN,     /* a byte written more than 100,000 times */
    /* parts/uart.c, parts/bus_wire.c */
    VIOLATION_UART_OVERRUN,    /* received character lost: the firmware was too late */
    VIOLATION_BUS_OVERRUN,     /* the same on UART0, where a retry repairs it: allowed at first */
    VIOLATION_UART_TX_LOST,    /* UDR written while the buffer is full or the transmitter is off */
    VIOLATION_UART_FORMAT,     /* frame format other than 8N1 */
    VIOLATION_UART_SETUP,      /* rate changed while a character is being sent */
    VIOLATION_BUS_UNDRIVEN,    /* a byte sent on the bus while the drive pin is low */
    VIOLATION_BUS_BOTH,        /* drive and listen pins both high */
    VIOLATION_BUS_RELEASED,    /* drive pin low before the end of the last stop bit */
    /* parts/panel.c */
    VIOLATION_PULLUP,          /* a button read without its pull-up */
    VIOLATION_CHARGER,         /* battery charger on */
    VIOLATION_PIN_FIGHT,       /* an output against another driver of the pin */
    /* machine/cpu.c, machine/stack.c */
    VIOLATION_STACK,           /* stack grown into the variables */
    VIOLATION_STACK_UNSET,     /* stack used before it was set */
    VIOLATION_ERASED,          /* execution reached erased flash */
    VIOLATION_ILLEGAL,         /* an instruction that the ATmega128 does not have, or BREAK */
    VIOLATION_ADDRESS,         /* data access outside registers and SRAM, jump outside flash */
    VIOLATION_SLEEP,           /* sleep that nothing can end */
    VIOLATION_INTERRUPT,       /* an interrupt routine returned with other registers or flags */
    VIOLATION_UNMODELLED,      /* a feature of the real chip that this board lacks (external RAM, XDIV, ...) */
    /* parts/watchdog.c, api/reset.c */
    VIOLATION_TIMED_SEQUENCE,  /* WDTCR or IVSEL changed without the timed sequence: the chip ignores it */
    VIOLATION_UNEXPECTED_RESET, /* watchdog reset; off unless board_allow(.., false) asks for it */
    VIOLATION_COUNT
} violation_kind_t;

typedef struct {
    violation_kind_t kind;
    uint64_t cycle;
    uint32_t pc; /* byte address of the instruction */
    char function[64];
    char text[192];
} violation_t;

/* "spm-place", "rww-fetch", ...: close to the enum's name, in lower case. */
const char *violation_name(violation_kind_t kind);

/* Reverse of violation_name(); VIOLATION_NONE for an unknown name. */
violation_kind_t violation_find(const char *name);

#endif
