/* SPDX-License-Identifier: MIT
 * cli_bus.h - cm5sim --bus-pty: servos without a board, on a serial port, in real time. Any PC program that speaks
 * Dynamixel protocol 1.0 can be tried against them. */
#ifndef CLI_BUS_H
#define CLI_BUS_H

#include "cli_options.h"

/* Runs until a signal, or --time. Returns the exit code. */
int bus_main(const options_t *options, const volatile int *interrupted);

#endif
