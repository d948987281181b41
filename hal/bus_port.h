/* SPDX-License-Identifier: MIT
 * bus_port.h - what the engine (bus_core.c) asks of the UART and the direction pins below it. hal/avr/bus.c gives it, or a
 * test. No RAM of its own. */
#ifndef BUS_PORT_H
#define BUS_PORT_H

#include <stdint.h>

/* Turns the line to sending and starts to send the first `count` bytes of bus_packet(). Main loop. They stay unchanged until
 * bus_core_on_sent; bus_core_on_last is called when the last one went to the UART, bus_core_on_sent when its last stop bit
 * has left. */
void bus_port_send(uint8_t count);

/* Turns the line to listening. Called from bus_core_on_sent, in the ISR. What the receiver caught before is thrown away. */
void bus_port_listen(void);

#endif
