/* SPDX-License-Identifier: MIT
 * fake_console.h - the other end of console.h: what a test types and what it reads. Input beyond the ring's 255 bytes is
 * dropped and counted as on the robot. Blocking calls never wait: output goes to a buffer of 64 KiB. console_put obeys a
 * room that the test sets. */
#ifndef FAKE_CONSOLE_H
#define FAKE_CONSOLE_H

#include <stddef.h>
#include <stdint.h>

void fake_console_reset(void);
void fake_console_type(const char *text);                   /* bytes arrive */
void fake_console_type_bytes(const void *bytes, size_t count);
void fake_console_lose(uint8_t count);       /* so many bytes are lost in front of what is typed next */
const char *fake_console_output(void);                      /* everything since reset or clear, NUL-terminated */
size_t fake_console_output_count(void);
void fake_console_clear(void);                              /* forgets the output */
void fake_console_set_room(uint8_t room);                   /* bytes that console_put takes until set again; default 128 */
uint8_t fake_console_rate(void);                            /* divisor in force */
int fake_console_is_held(void);                             /* an XOFF is out */

#endif
