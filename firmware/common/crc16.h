/* SPDX-License-Identifier: MIT
 * crc16.h - the one CRC of this project: CRC-16/IBM-3740 ("CCITT false"): polynomial 0x1021, start 0xFFFF, most
 * significant bit first, no final inversion. Known answer: "123456789" -> 0x29B1.
 * Used by the application record, settings, journal, block protocol and m512. No table: 20 cycles per byte. */
#ifndef CRC16_H
#define CRC16_H

#include <stdint.h>
#include "compiler.h"

#define CRC16_START 0xFFFFu

ONE_COPY uint16_t crc16_byte(uint16_t crc, uint8_t byte);
ONE_COPY uint16_t crc16_bytes(uint16_t crc, const void *from, uint16_t bytes);

/* Polynomial division by eight bits at once. x = high ^ byte; x ^= x >> 4 gives the eight quotient bits. x times the
 * polynomial is x << 12 ^ x << 5 ^ x, added byte by byte on this 8-bit machine. */
ONE_COPY uint16_t crc16_byte(uint16_t crc, uint8_t byte)
{
    uint8_t x = (uint8_t)((uint8_t)(crc >> 8) ^ byte);
    x = (uint8_t)(x ^ (x >> 4));
    uint8_t high = (uint8_t)((uint8_t)crc ^ (uint8_t)(x << 4) ^ (uint8_t)(x >> 3));
    uint8_t low = (uint8_t)((uint8_t)(x << 5) ^ x);
    return (uint16_t)(high << 8 | low);
}

ONE_COPY uint16_t crc16_bytes(uint16_t crc, const void *from, uint16_t bytes)
{
    const uint8_t *p = from;
    while (bytes--) {
        crc = crc16_byte(crc, *p++);
    }
    return crc;
}

#endif
