/* SPDX-License-Identifier: MIT
 * packets.h - sends one packet to a servo and shows it and its answer, byte by byte. Main loop only. RAM: none. */
#ifndef PACKETS_H
#define PACKETS_H

#include <stdbool.h>
#include <stdint.h>
#include "bus.h"

/* The place of the next packet's parameters, in the packet itself, which saves a buffer. */
uint8_t *packets_params(void);

/* Sends the first `count` parameters; prints the packet and the answer or its error. Blocks a few ms.
 * false: no good answer, an answer that rejects the packet, or a broadcast, which has no answer. */
bool packets_exchange(uint8_t id, uint8_t instruction, uint8_t count);

/* Prints " 0A 1B" after a text. */
void packets_print_bytes(const char *before_P, const uint8_t *bytes, uint8_t count);

/* Print a line, or the message for a failed packet. Both return SHELL_ERR_REPORTED, for handlers to return. */
uint8_t packets_say(const char *line_P);
uint8_t packets_say_status(bus_status_t status);

#endif
