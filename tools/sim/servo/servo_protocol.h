/* SPDX-License-Identifier: MIT
 * servo_protocol.h - protocol 1.0 as one servo sees it: bytes to packets, packets to actions and replies.
 * Facts: DYNAMIXEL.md, "Packets". */
#ifndef SIM_SERVO_PROTOCOL_H
#define SIM_SERVO_PROTOCOL_H

#include "servo.h"

#define SERVO_GAP_CYCLES (100u * SERVO_CYCLES_PER_US) /* a longer pause inside a packet drops it */

enum {
    SERVO_PING = 1, SERVO_READ = 2, SERVO_WRITE_DATA = 3, SERVO_REG_WRITE = 4, SERVO_ACTION = 5, SERVO_RESET = 6,
    SERVO_SYNC_WRITE = 0x83
};

/* Inverted low byte of the sum of bytes[2] (ID) .. bytes[count - 2] (last parameter). */
uint8_t servo_checksum(const uint8_t *packet, uint8_t count);

/* Takes one byte that was on the wire from start to end. true: parser->bytes[0..count) is a packet of the right length,
 * its checksum not yet checked; call servo_parser_clear() after using it. stats may be NULL. */
bool servo_parser_byte(servo_parser_t *parser, servo_stats_t *stats, uint64_t start_cycles, uint64_t end_cycles,
                       uint8_t byte);
void servo_parser_clear(servo_parser_t *parser);

/* Obeys one packet from servo_parser_byte(). Call servo_advance() first. Writes the status packet and returns its
 * length; 0: no reply. A new ID or rate applies from the next packet on: the reply has the old ID, and the caller must
 * send it at the old rate. */
uint8_t servo_obey(servo_t *servo, const uint8_t *packet, uint8_t count, uint8_t answer[SERVO_PACKET_MAX]);

#endif
