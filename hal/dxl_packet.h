/* SPDX-License-Identifier: MIT
 * dxl_packet.h - builds instruction packets and finds status packets in received bytes.
 * Pure: knows neither UART nor time. No RAM of its own. */
#ifndef DXL_PACKET_H
#define DXL_PACKET_H

#include <stdbool.h>
#include <stdint.h>
#include "compiler.h"
#include "dxl.h"

#define DXL_PACKET_OVERHEAD 6u   /* FF FF ID LEN INST ... SUM */
#define DXL_PARAMS_AT 5u         /* the first parameter in a packet */
/* Parameters of the longest status packet that is accepted: a whole control table. An image may define fewer (bus.h). */
#ifndef DXL_ANSWER_PARAMS
#define DXL_ANSWER_PARAMS 64u
#endif

/* ---- building, in place ---- */

/* A packet under construction. The caller ensures that the buffer has room. */
typedef struct {
    uint8_t *packet;
    uint8_t *at;   /* where the next byte goes */
    uint8_t sum;
} dxl_writer_t;

ALWAYS_INLINE void dxl_begin(dxl_writer_t *writer, uint8_t *packet, uint8_t id, uint8_t instruction)
{
    packet[0] = 0xFF;
    packet[1] = 0xFF;
    packet[2] = id;
    packet[4] = instruction;
    writer->packet = packet;
    writer->at = packet + DXL_PARAMS_AT;
    writer->sum = (uint8_t)(id + instruction);
}

ALWAYS_INLINE void dxl_put(dxl_writer_t *writer, uint8_t byte)
{
    *writer->at++ = byte;
    writer->sum = (uint8_t)(writer->sum + byte);
}

/* Adds length and checksum; returns the packet's size in bytes. */
ALWAYS_INLINE uint8_t dxl_end(dxl_writer_t *writer)
{
    uint8_t length = (uint8_t)(writer->at - writer->packet - 3);
    writer->packet[3] = length;
    *writer->at++ = (uint8_t)~(uint8_t)(writer->sum + length);
    return (uint8_t)(writer->at - writer->packet);
}

/* Builds a whole packet; returns its size. `packet` has room for count + DXL_PACKET_OVERHEAD bytes. */
uint8_t dxl_build(uint8_t *packet, uint8_t id, uint8_t instruction, const uint8_t *params, uint8_t count);

/* ---- parsing ---- */

/* What was found in the bytes received so far. */
typedef enum {
    DXL_MORE = 0,       /* no complete status packet yet */
    DXL_GOOD,           /* *packet points to it: FF FF ID LEN ERROR params... SUM */
    DXL_BAD_CHECKSUM,   /* complete but wrong */
    DXL_BAD_LENGTH      /* a length that no status packet can have (below 2, above DXL_ANSWER_PARAMS + 2) */
} dxl_result_t;

/* Finds the first status packet in the bytes received since the instruction was sent. Bytes before FF FF ID are noise, as is
 * a third FF, because no servo has ID 255. *packet is written only on DXL_GOOD. About 40 cycles, and 8 per byte once the
 * packet is complete. */
dxl_result_t dxl_find_status(const uint8_t *heard, uint8_t count, const uint8_t **packet);

#endif
