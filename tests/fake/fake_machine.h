/* SPDX-License-Identifier: MIT
 * fake_machine.h - a fake computer below hal/host (machine.h). Its clock advances only while the program waits. A test
 * sets the adapter's delay, echo and plug, and the write at which the memory loses power. */
#ifndef FAKE_MACHINE_H
#define FAKE_MACHINE_H

#include <setjmp.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

void fake_machine_reset(void);                    /* a good adapter, no servos, empty memories, nothing typed */

/* ---- time ---- */
void fake_machine_pass(uint32_t half_us);         /* the clock advances while the program does something else */

/* ---- the bus ---- */
typedef uint16_t fake_machine_servo_t(const uint8_t *packet, uint16_t size, uint8_t *answer);
/* Called for each packet. Writes an answer and returns its size; 0: none. */
void fake_machine_set_servo(fake_machine_servo_t *servo);
/* Delay from the end of a packet to the arrival of its answer or echo. */
void fake_machine_set_latency(uint32_t half_us);
/* How late the computer may look at its input; default 20 ms. */
void fake_machine_set_least_patience(uint32_t half_us);
void fake_machine_set_echo(bool echoes);
void fake_machine_plug(bool there);
uint16_t fake_machine_packets(void);              /* packets sent so far */
uint32_t fake_machine_rate(void);

/* ---- the console ---- */
void fake_machine_type(const char *text);         /* console input; not copied */
void fake_machine_block(bool blocked);            /* console output waits; default: it leaves at once */

/* ---- memory ---- */
/* Cuts the power at machine_keep call number `write` from now on (0: never). That write leaves a random mixture of old
 * and new bytes; writes before it that are not yet durable are lost, or the last of them. */
void fake_machine_cut(uint32_t write, uint32_t seed, jmp_buf *where);
uint32_t fake_machine_writes(void);               /* machine_keep calls since fake_machine_cut */

#endif
