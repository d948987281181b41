/* SPDX-License-Identifier: MIT
 * options.c - the command line. */
#include "pc.h"

#include <getopt.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { EXIT_USAGE = 2, TCP_PORT = 4512, TCP_MIN = 1, TCP_MAX = 65535, RATE_MIN = 9600, RATE_MAX = 3000000 };

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

/* The number of an option: decimal digits and nothing else. */
static int number_of(const char *option, const char *word, int min, int max, const char *unit)
{
    char *end;
    const long number = strtol(word, &end, 10);   /* too many digits: LONG_MAX */
    if (word[0] < '0' || word[0] > '9' || *end != '\0' || number < min || number > max) {
        fprintf(stderr, "%s: %s %s: %d..%d%s\n", pc_options.name, option, word, min, max, unit);
        exit(EXIT_USAGE);
    }
    return (int)number;
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
        const char *word = optarg != NULL ? optarg : "";
        switch (option) {
        case 'b':
            pc_options.rate_bps = (uint32_t)number_of("--rate", word, RATE_MIN, RATE_MAX, " bits a second");
            break;
        case 'r': pc_options.robot = optarg; break;
        case 'm': pc_options.motions = optarg; break;
        case 'p': pc_options.pty_link = word; break;
        case 't':
            pc_options.tcp_port = optarg != NULL ? number_of("--tcp", word, TCP_MIN, TCP_MAX, "") : TCP_PORT;
            break;
        case 'o': pc_options.off = true; break;
        case 'h': printf(help, pc_options.name, TCP_PORT); exit(EXIT_SUCCESS);
        default:   /* getopt_long has said what is wrong */
            fprintf(stderr, "%s --help lists the options\n", pc_options.name);
            exit(EXIT_USAGE);
        }
    }
    if (pc_options.pty_link != NULL && pc_options.tcp_port != 0) {
        fprintf(stderr, "%s: --pty and --tcp: one console only\n", pc_options.name);
        exit(EXIT_USAGE);
    }
    if (optind != argc - 1) {
        fprintf(stderr, help, pc_options.name, TCP_PORT);
        exit(EXIT_USAGE);
    }
    pc_options.bus = argv[optind];
}
