/* SPDX-License-Identifier: MIT
 * ring.h - a ring of bytes between one writer and one reader (an ISR and the main loop, in either role).
 * Free-running uint8_t indices, so neither side needs interrupts off: copy the byte, barrier, publish the index.
 * A ring of 2^n bytes, n <= 7, holds 2^n; one of 256 bytes holds 255.
 * The meaning of the indices is part of the page-write service: the boot loader fills a caller's ring (boot_api.h). */
#ifndef RING_H
#define RING_H

#include <stdbool.h>
#include <stdint.h>
#include "irq.h"

typedef struct {
    uint8_t *bytes;
    uint8_t mask;           /* size - 1 */
    volatile uint8_t head;  /* set only by the writer: bytes put so far, modulo 256 */
    volatile uint8_t tail;  /* set only by the reader: bytes taken so far, modulo 256 */
} ring_t;

/* storage: `size` bytes, a power of two 2..256; the ring keeps using it. Neither side may be active. */
static inline void ring_init(ring_t *ring, uint8_t *storage, uint16_t size)
{
    ring->bytes = storage;
    ring->mask = (uint8_t)(size - 1u);
    ring->head = 0;
    ring->tail = 0;
}

/* Bytes waiting. The reader never sees more than there are, the writer never fewer. */
static inline uint8_t ring_count(const ring_t *ring)
{
    return (uint8_t)(ring->head - ring->tail);
}

/* Bytes that still fit. The writer never sees more than there is room for. */
static inline uint8_t ring_room(const ring_t *ring)
{
    uint8_t capacity = ring->mask == 255u ? 255u : (uint8_t)(ring->mask + 1u);
    return (uint8_t)(capacity - ring_count(ring));
}

/* Writer. false: full, the byte was not taken. */
static inline bool ring_put(ring_t *ring, uint8_t byte)
{
    uint8_t head = ring->head;
    uint8_t used = (uint8_t)(head - ring->tail);
    if (used == 255u || used > ring->mask) {
        return false;
    }
    ring->bytes[head & ring->mask] = byte;
    irq_barrier();
    ring->head = (uint8_t)(head + 1u);
    return true;
}

/* Reader. false: empty, *byte unchanged. */
static inline bool ring_get(ring_t *ring, uint8_t *byte)
{
    uint8_t tail = ring->tail;
    if (tail == ring->head) {
        return false;
    }
    *byte = ring->bytes[tail & ring->mask];
    irq_barrier();
    ring->tail = (uint8_t)(tail + 1u);
    return true;
}

/* Reader. The byte that ring_get would take. false: empty, *byte unchanged. */
static inline bool ring_peek(const ring_t *ring, uint8_t *byte)
{
    if (ring->tail == ring->head) {
        return false;
    }
    *byte = ring->bytes[ring->tail & ring->mask];
    return true;
}

/* Reader. Drops all waiting bytes. */
static inline void ring_clear(ring_t *ring)
{
    ring->tail = ring->head;
}

#endif
