/* SPDX-License-Identifier: MIT
 * bus_port.h - the UART and direction pins as the engine (bus_core.c) uses them. Implemented by hal/avr/bus.c,
 * hal/host/bus.c and tests. No RAM of its own. */
#ifndef BUS_PORT_H
#define BUS_PORT_H

#include <stdint.h>
#include "target.h"

/* Switches the line to sending and starts to send the first `count` bytes of bus_packet(). Main loop. The bytes must not
 * change until bus_core_on_sent. The port calls bus_core_on_last when the last bytes go to the UART, and bus_core_on_sent
 * when their stop bit has left. */
void bus_port_send(uint8_t count);

/* Switches the line to listening and drops earlier received bytes. Called from bus_core_on_sent, in the ISR. */
void bus_port_listen(void);

/* The time-out of an answer beyond the servo's return delay and three characters. */
TARGET_BUS_TIME bus_port_margin_half_us(void);

#endif
