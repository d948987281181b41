/* SPDX-License-Identifier: MIT
 * options.c - the command line. */
#include "pc.h"

#include <getopt.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { EXIT_USAGE = 2, TCP_PORT = 4512, RATE_MIN = 9600, RATE_MAX = 3000000 };

pc_options_t pc_options = {.name = "motion512", .rate_bps = 1000000};

static const char help[] =
    "usage: %s [OPTION...] PORT\n\n"
    "Runs the firmware of the robot on this computer, with its servos on a USB adapter.\n\n"
    "  PORT               the adapter's serial port, such as /dev/ttyUSB0\n"
    "  --rate BPS         the rate of the servos (1000000)\n"
    "  --robot FOLDER     where motion pages and settings are kept (default: ~/.local/share/motion512)\n"
    "  --motions FILE     the pages that a new folder begins with: a raw motion area; one that has pages keeps its own\n"
    "  --pty[=LINK]       the console is a pty, not this terminal; LINK becomes a link to it\n"
    "  --tcp[=NUMBER]     the console is a socket on 127.0.0.1 (%d)\n"
    "  --off              switch the torque of all servos off at the end\n";

static uint32_t rate_of(const char *word)
{
    char *end;
    const long rate = strtol(word, &end, 10);
    if (*end != '\0' || rate < RATE_MIN || rate > RATE_MAX) {
        fprintf(stderr, "%s: --rate %s: %d..%d bits a second\n", pc_options.name, word, RATE_MIN, RATE_MAX);
        exit(EXIT_USAGE);
    }
    return (uint32_t)rate;
}

void pc_read_options(int argc, char **argv)
{
    static const struct option options[] = {
        {"rate", required_argument, NULL, 'b'},
        {"robot", required_argument, NULL, 'r'}, {"motions", required_argument, NULL, 'm'},
        {"pty", optional_argument, NULL, 'p'},   {"tcp", optional_argument, NULL, 't'},
        {"off", no_argument, NULL, 'o'},         {"help", no_argument, NULL, 'h'},
        {NULL, 0, NULL, 0},
    };
    if (argc > 0 && argv[0] != NULL) {
        const char *slash = strrchr(argv[0], '/');
        pc_options.name = slash != NULL ? slash + 1 : argv[0];
    }
    for (int option; (option = getopt_long(argc, argv, "h", options, NULL)) != -1;) {
        switch (option) {
        case 'b': pc_options.rate_bps = rate_of(optarg != NULL ? optarg : ""); break;
        case 'r': pc_options.robot = optarg; break;
        case 'm': pc_options.motions = optarg; break;
        case 'p': pc_options.pty_link = optarg != NULL ? optarg : ""; break;
        case 't': pc_options.tcp_port = optarg != NULL ? atoi(optarg) : TCP_PORT; break;
        case 'o': pc_options.off = true; break;
        case 'h': printf(help, pc_options.name, TCP_PORT); exit(EXIT_SUCCESS);
        default: exit(EXIT_USAGE);
        }
    }
    if (optind != argc - 1) {
        fprintf(stderr, help, pc_options.name, TCP_PORT);
        exit(EXIT_USAGE);
    }
    pc_options.bus = argv[optind];
}
