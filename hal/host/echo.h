/* SPDX-License-Identifier: MIT
 * echo.h - drops what an adapter repeats of the packets that it is sent (one-wire adapters do). Pure; caller-owned.
 * A repeated packet is dropped as a whole or not at all: one that came back damaged is noise to whoever reads on. */
#ifndef ECHO_H
#define ECHO_H

#include <stdbool.h>
#include <stdint.h>

#define ECHO_PACKETS 8u
#define ECHO_PACKET_BYTES 144u
#define ECHO_HELD_BYTES (ECHO_PACKET_BYTES + 64u)

typedef struct {
    struct {
        uint8_t size;
        uint8_t bytes[ECHO_PACKET_BYTES];
    } sent[ECHO_PACKETS];               /* not come back yet, oldest first */
    uint8_t count;
    uint16_t held_count;
    uint8_t held[ECHO_HELD_BYTES];      /* may still become a packet of ours */
    uint32_t dropped;                   /* packets that came back */
} echo_t;

void echo_clear(echo_t *echo);

/* A packet has been sent. */
void echo_sent(echo_t *echo, const uint8_t *packet, uint8_t size);

/* A byte has come. Writes the bytes that are not an echo to `out` (ECHO_HELD_BYTES) and returns how many. */
uint16_t echo_byte(echo_t *echo, uint8_t byte, uint8_t *out);

/* No byte has come for a while: gives up what is held. */
uint16_t echo_quiet(echo_t *echo, uint8_t *out);

#endif
