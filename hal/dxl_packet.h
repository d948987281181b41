/* SPDX-License-Identifier: MIT
 * dxl_packet.h - builds instruction packets and takes status packets apart, byte by byte.
 * Pure: knows neither UART nor time.  RAM: caller-owned, sizeof(dxl_parser_t) = 8 bytes and
 * the parameters' buffer. */
#ifndef DXL_PACKET_H
#define DXL_PACKET_H

#include <stdbool.h>
#include <stdint.h>
#include "compiler.h"
#include "dxl.h"

#define DXL_PACKET_OVERHEAD 6u   /* FF FF ID LEN INST ... SUM */
#define DXL_PARAMS_AT 5u         /* the first parameter in a packet */
/* The longest status packet that is understood: a whole control table. An image may define it smaller (bus.h). */
#ifndef DXL_ANSWER_PARAMS
#define DXL_ANSWER_PARAMS 64u
#endif

/* ---- building, in place ---- */

/* A packet under construction. The buffer has room for what is put: the caller counts. */
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

/* Length and checksum; returns the packet's size in bytes. */
ALWAYS_INLINE uint8_t dxl_end(dxl_writer_t *writer)
{
    uint8_t length = (uint8_t)(writer->at - writer->packet - 3);
    writer->packet[3] = length;
    *writer->at++ = (uint8_t)~(uint8_t)(writer->sum + length);
    return (uint8_t)(writer->at - writer->packet);
}

/* All at once: returns the size. `packet` has room for count + DXL_PACKET_OVERHEAD bytes. */
uint8_t dxl_build(uint8_t *packet, uint8_t id, uint8_t instruction, const uint8_t *params, uint8_t count);

/* ---- parsing ---- */

/* What a byte led to. */
typedef enum {
    DXL_MORE = 0,       /* not at the end yet */
    DXL_GOOD,           /* a status packet is complete: id, error, params, count are its contents */
    DXL_BAD_CHECKSUM,   /* complete but wrong; the parser looks for the next header */
    DXL_BAD_LENGTH      /* a length that no status packet can have (below 2, above DXL_ANSWER_PARAMS + 2) */
} dxl_result_t;

/* Waiting for FF -> FF -> ID -> LEN -> ERROR -> PARAMS -> SUM; anything before FF FF is noise (counted by the caller). */
typedef struct {
    uint8_t state;
    uint8_t id, length, error;
    uint8_t count;      /* parameters so far; after DXL_GOOD, all */
    uint8_t sum;
    uint8_t *params;
} dxl_parser_t;

/* params: DXL_ANSWER_PARAMS bytes, lent for good. They may be the beginning of the very buffer that the parsed bytes are
 * in, when these are taken from front to back: a parameter is stored at least five bytes before its own place. */
void dxl_parser_init(dxl_parser_t *parser, uint8_t *params);

/* Takes one byte. A third FF in the header is noise before it: FF FF FF ID still works. After DXL_GOOD and the errors
 * the parser stands at the start again; the contents stay until the next byte. */
dxl_result_t dxl_parser_byte(dxl_parser_t *parser, uint8_t byte);

/* true before the first byte of a header: what came so far was noise or nothing. */
bool dxl_parser_is_empty(const dxl_parser_t *parser);

#endif
