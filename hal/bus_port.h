/* SPDX-License-Identifier: MIT
 * bus_port.h - what the engine (bus_core.c) needs of the UART and the direction pins below it. Implemented by hal/avr/bus.c
 * and by tests. No RAM of its own. */
#ifndef BUS_PORT_H
#define BUS_PORT_H

#include <stdint.h>
#include "target.h"

/* Turns the line to sending and starts to send the first `count` bytes of bus_packet(). Main loop. The bytes must not change
 * until bus_core_on_sent. The port calls bus_core_on_last when the last bytes go to the UART, and bus_core_on_sent when
 * their stop bit has left. */
void bus_port_send(uint8_t count);

/* Turns the line to listening and drops what the receiver caught before. Called from bus_core_on_sent, in the ISR. */
void bus_port_listen(void);

/* How long an answer may take beyond the servo's return delay and three characters before a try has failed. */
TARGET_BUS_TIME bus_port_margin_half_us(void);

#endif
