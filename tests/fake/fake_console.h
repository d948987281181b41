/* SPDX-License-Identifier: MIT
 * fake_console.h - the far end of console.h: what a test types and what it reads. Input beyond the ring's 255 bytes is
 * dropped and counted as on the robot. Blocking calls never wait, and what is
 * sent is only counted. */
#ifndef FAKE_CONSOLE_H
#define FAKE_CONSOLE_H

#include <stddef.h>
#include <stdint.h>

void fake_console_reset(void);
void fake_console_type(const char *text);                   /* puts bytes into the receive ring */
void fake_console_type_bytes(const void *bytes, size_t count);
void fake_console_lose(uint8_t count);       /* so many bytes are lost before the next typed one */
int fake_console_is_held(void);                             /* an XOFF was sent */

#endif
