/* SPDX-License-Identifier: MIT
 * ansi.h - sends the few terminal sequences that the editor uses (ANSI X3.64, as on a VT100) to the console.
 * Waits while the console's ring is full; a play continues meanwhile. Main loop only. No RAM. */
#ifndef ANSI_H
#define ANSI_H

#include <stdint.h>

void ansi_put(char character);
void ansi_goto(uint8_t row, uint8_t column);  /* from 1 */
void ansi_right(uint8_t columns);             /* at least 1 */
void ansi_clear(void);                        /* and home */
void ansi_erase_line(void);                   /* from the cursor on */
void ansi_ask_size(void);                     /* the terminal answers ESC [ rows ; columns R */

#endif
