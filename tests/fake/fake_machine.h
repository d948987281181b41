/* SPDX-License-Identifier: MIT
 * fake_machine.h - the computer below hal/host (machine.h): its clock stands unless the program waits, its adapter has the
 * delay, the echo and the plug that a test wants, and its memory loses power at the write that a test names. */
#ifndef FAKE_MACHINE_H
#define FAKE_MACHINE_H

#include <setjmp.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

void fake_machine_reset(void);                    /* a good adapter without servos, empty memories, nothing typed */

/* ---- time ---- */
void fake_machine_pass(uint32_t half_us);         /* the clock moves while the program does something else */

/* ---- the bus ---- */
typedef uint16_t fake_machine_servo_t(const uint8_t *packet, uint16_t size, uint8_t *answer);
/* Asked for each packet: writes an answer and returns its size; 0: none. */
void fake_machine_set_servo(fake_machine_servo_t *servo);
/* From the end of a packet until the program hears the answer, or the echo. */
void fake_machine_set_latency(uint32_t half_us);
/* How late the computer may look: 20 ms unless a test says otherwise. */
void fake_machine_set_least_patience(uint32_t half_us);
void fake_machine_set_echo(bool echoes);
void fake_machine_plug(bool there);
uint16_t fake_machine_packets(void);              /* packets sent so far */
uint32_t fake_machine_rate(void);

/* ---- the console ---- */
void fake_machine_type(const char *text);         /* what waits in the computer; not copied */

/* ---- memory ---- */
/* The power fails at that machine_keep from now on (0: never): it leaves a mixture by chance, and so do earlier ones that
 * were not made sure. */
void fake_machine_cut(uint32_t write, uint32_t seed, jmp_buf *where);
uint32_t fake_machine_writes(void);               /* machine_keep calls since fake_machine_cut */

#endif
