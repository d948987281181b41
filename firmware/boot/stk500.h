/* SPDX-License-Identifier: MIT
 * stk500.h - STK500 version 1, as far as avrdude uses it: `avrdude -c arduino -p m128 -b 57600 -P PORT ...`.
 * Reads all of flash and EEPROM. In programming mode, writes EEPROM and flash below the boot section. Does not write a page
 * that already holds the data. "Chip erase" is accepted and does nothing, because each page is erased when it is written.
 * Fuses and lock bits are read, never written. */
#ifndef STK500_H
#define STK500_H

/* Answers the received sync and runs until LEAVE, a byte that is not a command, or 10 s of silence. */
void stk500_session(void);

#endif
