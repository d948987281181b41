/* SPDX-License-Identifier: MIT
 * fake_system.h - the reset side of the board for system.h. system_restart jumps to the test's jmp_buf and aborts if
 * there is none. */
#ifndef FAKE_SYSTEM_H
#define FAKE_SYSTEM_H

#include <setjmp.h>
#include <stdint.h>

void fake_system_reset(void);
void fake_system_on_restart(jmp_buf *where);
uint32_t fake_system_kicks(void);                 /* system_kick calls */
/* system_is_asked_to_end returns true from now on; system_end then does what system_restart does. */
void fake_system_ask_to_end(void);

#endif
