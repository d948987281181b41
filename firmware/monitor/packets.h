/* SPDX-License-Identifier: MIT
 * packets.h - sends one packet to a servo and shows it and its answer, byte by byte. Main loop only. RAM: none. */
#ifndef PACKETS_H
#define PACKETS_H

#include <stdbool.h>
#include <stdint.h>
#include "bus.h"

/* How often a packet is sent until it is answered. */
enum { PACKETS_TRIES = 2 };

/* Where the parameters of the next packet go: into the packet itself, which spares a buffer. */
uint8_t *packets_params(void);

/* Sends the first `count` parameters, prints the packet and the answer or what is wrong with it. Blocks a few ms.
 * false: no good answer, or one that rejects the packet; also when none can come, after a broadcast. */
bool packets_exchange(uint8_t id, uint8_t instruction, uint8_t count);

/* Prints " 0A 1B" after a text. */
void packets_print_bytes(const char *before_P, const uint8_t *bytes, uint8_t count);

/* Prints a line, or the sentence for a failed packet. Both return SHELL_ERR_REPORTED, for handlers to return. */
uint8_t packets_say(const char *line_P);
uint8_t packets_say_status(bus_status_t status);

#endif
