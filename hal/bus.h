/* SPDX-License-Identifier: MIT
 * bus.h - the servo bus as packets: one instruction out, at most one status packet back, half duplex, by interrupt.
 * One packet at a time: build it in bus_packet(), bus_submit() it, call bus_poll() until it is not BUS_PENDING.
 * Knows nothing of servos beyond the packet format. Main loop only. RAM: one bus_core_t, with the packet buffers below.
 * The engine is bus_core.[ch]. hal/avr/bus.c connects it to UART 0 and the direction pins. */
#ifndef BUS_H
#define BUS_H

#include <stdbool.h>
#include <stdint.h>
#include "compiler.h"
#include "dxl.h"
#include "ring.h"

/* Rates by divisor, as in a servo's address 4: 2,000,000 / (n + 1). */
#define BUS_RATE_1M 1u
#define BUS_RATE_57142 34u

/* Room for the outgoing packet. An image short of RAM may define it smaller (at least 101: 31 goals), and likewise
 * DXL_ANSWER_PARAMS (dxl_packet.h; at least 34: servo_link_setup.c), for the whole image in its CMakeLists.txt. */
#ifndef BUS_PACKET_BYTES
#define BUS_PACKET_BYTES 144u   /* DXL_PACKET_MAX */
#endif
#define BUS_NO_ANSWER 255u      /* bus_submit: no servo answers (broadcast, SYNC WRITE) */
#define BUS_TRIES_MAX 4u

typedef enum {
    BUS_OK = 0,
    BUS_PENDING,        /* in progress */
    BUS_ERR_TIMEOUT,    /* no answer, or an incomplete one */
    BUS_ERR_CHECKSUM,   /* an answer with a wrong checksum */
    BUS_ERR_FRAMING,    /* no good answer, and bytes were lost or had no stop bit: noise, two senders, a wrong rate */
    BUS_ERR_WRONG_ID,   /* another servo answered */
    BUS_ERR_LENGTH,     /* an answer with an unexpected number of parameters */
    BUS_ERR_REJECTED,   /* the servo rejected the packet: damaged on arrival, a value out of range, or unknown to it */
    BUS_ERR_BUSY        /* bus_submit: a packet is already in progress; nothing was changed */
} bus_status_t;

/* The last answer; valid from BUS_OK or BUS_ERR_REJECTED until the next submit. */
typedef struct {
    uint8_t id;
    uint8_t error;          /* DXL_ERR_ bits */
    uint8_t count;
    const uint8_t *params;  /* `count` bytes, owned by the bus */
} bus_answer_t;

/* Counted since start. A count never falls; a 16-bit one stops at 65535. */
typedef struct {
    uint32_t packets;       /* sent, retries included */
    uint32_t answers;       /* good answers */
    uint16_t timeouts;
    uint16_t checksums;
    uint16_t framing;
    uint16_t overruns;
    uint16_t wrong_ids;
    uint16_t lengths;
    uint16_t rejected;
    uint16_t retries;
    uint16_t strays;        /* bytes received when no answer was expected; modulo 65536 */
} bus_counts_t;

/* Sets every register of UART 0 and the direction pins: 1 Mbps, listening. Call before interrupts are enabled. */
void bus_init(void);

/* Waits until the current packet is done, then changes the rate. */
void bus_set_rate(uint8_t divisor);
uint8_t bus_rate(void);

/* The outgoing packet's buffer, BUS_PACKET_BYTES. May be written only while the bus is not busy. Build with dxl_packet.h. */
uint8_t *bus_packet(void);

/* Whether a packet is in progress. Checks the time-outs like bus_poll. */
bool bus_is_busy(void);

/* Whether a packet without an answer may be sent now. On a board, the same as "not busy". Through an adapter, answers arrive
 * late (hal/host/bus.c): there it is true as soon as the line itself is quiet again. */
bool bus_is_free(void);

/* Blocks until bus_is_free: 1 ms at most on a board, 3 ms through an adapter. */
void bus_wait_free(void);

/* Sends the first `size` bytes of bus_packet() (built by dxl_packet.h: the addressed ID is at [2]).
 * answer_params: number of parameters of the expected status packet, or BUS_NO_ANSWER.
 * tries: 1..BUS_TRIES_MAX; after a failed answer the packet is sent again until they are used up.
 * Returns at once: BUS_PENDING or BUS_ERR_BUSY. With BUS_NO_ANSWER while the bus is free but not idle: BUS_OK, and bus_poll
 * continues with the packet that awaits an answer. */
bus_status_t bus_submit(uint8_t size, uint8_t answer_params, uint8_t tries);

/* The state of the packet. Also checks the time-outs, so call it every few ms while the bus is busy. The result of the
 * last packet stays until the next submit. `answer` may be NULL. If no answer is expected, returns BUS_OK once the last stop
 * bit has left. */
bus_status_t bus_poll(bus_answer_t *answer);

/* Whether an interrupt brought something that bus_poll has not seen yet. Call it with interrupts off, before sleeping: the
 * last byte of an answer may arrive while the main loop still handles the previous one. */
bool bus_has_news(void);

/* Blocks until the result: at most tries * (packet + return delay + answer + 0.3 ms); 1 Mbps, 8 bytes read: 0.9 ms. */
bus_status_t bus_wait(bus_answer_t *answer);

/* Whether the adapter was unplugged since the last call. Never on a board. */
bool bus_was_lost(void);

/* Puts every received byte into `ring` only; drops it if the ring is full. NULL: no tap. For a bridge: while a tap is set,
 * submit only packets without an answer (BUS_NO_ANSWER). */
void bus_set_tap(ring_t *ring);

void bus_counts(bus_counts_t *counts);

#endif
