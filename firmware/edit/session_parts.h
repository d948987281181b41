/* SPDX-License-Identifier: MIT
 * session_parts.h - what session_undo.c needs of session.c. For session*.c only. */
#ifndef SESSION_PARTS_H
#define SESSION_PARTS_H

#include "session.h"

/* Flips bits of one byte and marks its cell. Not noted for undo. */
void session_change_byte(uint16_t address, uint8_t bits);

/* Whether the page differs from what flash holds. Byte 31, the checksum, is not compared: a save makes it anew.
 * 2 ms when nothing differs. */
bool session_differs_from_flash(void);

#endif
