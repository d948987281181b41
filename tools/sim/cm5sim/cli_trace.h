/* SPDX-License-Identifier: MIT
 * cli_trace.h - goal and present position of every servo by tick, as CSV:
 *   tick,ms,goal1,present1,goal2,present2,...
 * One row for each 1/128 s of simulated time. The goal of a limp servo is left empty. plot_trace.py draws it. */
#ifndef CLI_TRACE_H
#define CLI_TRACE_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

#include "servo_bus.h"

typedef struct {
    FILE *file;
    const servo_bus_t *bus;
    int columns; /* servos when the file was begun; ones plugged in later are left out */
} trace_t;

/* Begins a file with its head line; false: errno. */
bool trace_open(trace_t *trace, const char *path, const servo_bus_t *bus);
void trace_row(trace_t *trace, uint64_t tick, uint64_t now_cycles);

/* false: something could not be written. */
bool trace_close(trace_t *trace);

/* Runs plot_trace.py on a trace file. false: it has said why on standard error. */
bool trace_plot(const char *trace_path, const char *picture_path);

#endif
