/* SPDX-License-Identifier: MIT
 * echo.h - drops sent packets that an adapter echoes (one-wire adapters do). Pure; caller-owned.
 * An echoed packet is dropped completely or not at all: a damaged echo passes as noise. */
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
    } sent[ECHO_PACKETS];               /* not echoed yet, oldest first */
    uint8_t count;
    uint16_t held_count;
    uint8_t held[ECHO_HELD_BYTES];      /* may still become one of our packets */
    uint32_t dropped;                   /* echoed packets */
} echo_t;

void echo_clear(echo_t *echo);

/* Call after sending a packet. */
void echo_sent(echo_t *echo, const uint8_t *packet, uint8_t size);

/* Takes a received byte. Writes the bytes that are not an echo to `out` (ECHO_HELD_BYTES) and returns their number. */
uint16_t echo_byte(echo_t *echo, uint8_t byte, uint8_t *out);

/* Call after a silence: releases the held bytes to `out` and returns their number. */
uint16_t echo_quiet(echo_t *echo, uint8_t *out);

#endif
