/* SPDX-License-Identifier: MIT
 * fake_console.h - the far end of console.h: what a test types and what it reads. Input beyond the ring's 255 bytes is
 * dropped and counted as on the robot. Blocking calls never wait: output goes to a buffer of 64 KiB. A test can limit
 * what console_put accepts. */
#ifndef FAKE_CONSOLE_H
#define FAKE_CONSOLE_H

#include <stddef.h>
#include <stdint.h>

void fake_console_reset(void);
void fake_console_type(const char *text);                   /* puts bytes into the receive ring */
void fake_console_type_bytes(const void *bytes, size_t count);
void fake_console_lose(uint8_t count);       /* so many bytes are lost before the next typed one */
const char *fake_console_output(void);                      /* everything since reset or clear, NUL-terminated */
size_t fake_console_output_count(void);
void fake_console_clear(void);                              /* forgets the output */
void fake_console_set_room(uint8_t room);                   /* what console_put accepts until set again; default 128 */
uint8_t fake_console_rate(void);                            /* baud rate divisor */
int fake_console_is_held(void);                             /* an XOFF was sent */

#endif
