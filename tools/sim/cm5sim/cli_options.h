/* SPDX-License-Identifier: MIT
 * cli_options.h - the command line of cm5sim, parsed. What each option means stands in `cm5sim --help` (cli_options.c)
 * and, with examples, in README.md. */
#ifndef CLI_OPTIONS_H
#define CLI_OPTIONS_H

#include "board.h"
#include "servo_bus.h"

#define CLI_IMAGES_MAX 8
#define CLI_SERVOS_MAX 254
#define CLI_FAULTS_MAX 32

enum { EXIT_GOOD = 0, EXIT_EXPECTATION = 1, EXIT_USAGE = 2, EXIT_VIOLATION = 3, EXIT_FILE = 4 };

typedef struct {
    uint8_t id;
    servo_model_t model;
    uint32_t rate_bps;
} servo_plan_t;

typedef struct {
    uint8_t id;
    servo_fault_t fault;
} fault_plan_t;

typedef enum { PACE_AUTO, PACE_REAL, PACE_FAST } pace_t;

typedef struct {
    board_kind_t kind;
    const char *images[CLI_IMAGES_MAX];
    int image_count;
    const char *motions;
    servo_plan_t servos[CLI_SERVOS_MAX];
    int servo_count;
    fault_plan_t faults[CLI_FAULTS_MAX];
    int fault_count;
    bool use_pty, use_tcp, bus_pty, rc, use_gdb, quiet, no_stdio, summary;
    const char *pty_link, *bus_link;
    int tcp_port, gdb_port; /* tcp_port 0: any free one */
    const char *body;             /* a body of tools/body, or a file; NULL: none */
    bool view;                    /* show it */
    const servo_body_t *hung_on;  /* what the servos hang on, NULL: nothing */
    const char *script, *trace, *plot, *flash, *eeprom, *servo_eeprom;
    pace_t pace;
    uint64_t time_cycles; /* end of the run, UINT64_MAX: none */
    uint32_t seed;
    bool allow[VIOLATION_COUNT];
} options_t;

/* Fills options, or prints what is wrong and ends the program (EXIT_USAGE). */
void options_parse(options_t *options, int argc, char **argv);

#endif
