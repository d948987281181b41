/* SPDX-License-Identifier: MIT */
#include "cli_options.h"

#include <argp.h>
#include <stdlib.h>
#include <string.h>

#include "cli_text.h"
#include "servo_api.h"

const char *argp_program_version = "cm5sim 1.0 (Motion512)";

static const char doc[] =
    "The robot on your desk: a CM-5 or CM-2 controller board and its servos, simulated as strictly as the real ones.\v"
    "Keys in the terminal: everything goes to the robot (Ctrl-C too), but Ctrl-] leaves, and Ctrl-T is the "
    "prefix of the robot's own knobs: Ctrl-T ? lists them, Ctrl-T r turns the keyboard into an RC-100.\n"
    "\nExamples:\n"
    "  cm5sim play-cm5.hex                          the robot on this terminal\n"
    "  cm5sim edit-cm5.hex --pty=robot              on a serial port for other programs\n"
    "  cm5sim play-cm5.hex --motions walk.bin --rc  with a remote control\n"
    "  cm5sim play-cm5.hex --motions walk.bin --script walk.txt --plot walk.svg\n"
    "  cm5sim --bus-pty --servos 1-3                servos alone, for PC programs with a Dynamixel library\n"
    "  cm5sim boot-cm5.hex --flash robot.bin --eeprom robot.eep --pty    keeps what is written\n"
    "\nExit codes: 0 good, 1 an expectation of the script failed, 2 wrong usage or script, 3 the firmware did what "
    "the chip or the board does not allow, 4 a file or port could not be used.";

enum {
    OPT_BOARD = 256, OPT_SERVOS, OPT_MOTIONS, OPT_PTY, OPT_TCP, OPT_BUS_PTY, OPT_RC, OPT_SCRIPT, OPT_GDB,
    OPT_TRACE, OPT_PLOT, OPT_REALTIME, OPT_FAST, OPT_FLASH, OPT_EEPROM, OPT_SERVO_EEPROM, OPT_TIME, OPT_SEED,
    OPT_FAULT, OPT_ALLOW, OPT_NO_STDIO, OPT_SUMMARY, OPT_BODY, OPT_VIEW
};

static const struct argp_option descriptions[] = {
    {0, 0, 0, 0, "The robot:", 1},
    {"board", OPT_BOARD, "cm5|cm2", 0, "Controller board (default cm5)", 0},
    {"servos", OPT_SERVOS, "LIST", 0, "IDs: 1-18 (default), 1,2,7-9, none; 20:dx117 is a DX-117 at 57,142 bps, "
     "5@117647 another rate", 0},
    {"motions", OPT_MOTIONS, "FILE", 0, "Motion area: 65,536 bytes (.bin) or Intel HEX; not over a --flash file that "
     "exists", 0},
    {"fault", OPT_FAULT, "ID:NAME", 0, "Faulty servo: silent, dead, duplicate, checksum, noise, late, short, "
     "two-talkers, overload, overheating, low-voltage, angle-limit, mishears, blocked", 0},
    {"body", OPT_BODY, "NAME", 0, "A body in physics (MuJoCo): humanoid, gp, or a file; tells falls, way, heading. A hand "
     "holds it until its knees have moved and stand still", 0},
    {"view", OPT_VIEW, 0, 0, "With --body: shows it in MuJoCo's viewer (needs a display)", 0},
    {"seed", OPT_SEED, "N", 0, "What is in the SRAM at power-on (default 1)", 0},
    {"flash", OPT_FLASH, "FILE", 0, "Flash (131,072 bytes): read at the start if it exists, written at the end", 0},
    {"eeprom", OPT_EEPROM, "FILE", 0, "EEPROM (4,096 bytes), likewise", 0},
    {"servo-eeprom", OPT_SERVO_EEPROM, "FILE", 0, "EEPROM areas of the servos, likewise", 0},
    {0, 0, 0, 0, "Ways in (this terminal or standard input is always one, but for --no-stdio):", 2},
    {"pty", OPT_PTY, "LINK", OPTION_ARG_OPTIONAL, "Serial port of the PC; prints its path, LINK is made to point at it",
     0},
    {"tcp", OPT_TCP, "PORT", OPTION_ARG_OPTIONAL, "The same on 127.0.0.1:PORT (none: a free one is printed)", 0},
    {"no-stdio", OPT_NO_STDIO, 0, 0, "No console on standard input and output", 0},
    {"rc", OPT_RC, 0, 0, "Keys are the buttons of an RC-100 from the start", 0},
    {"bus-pty", OPT_BUS_PTY, "LINK", OPTION_ARG_OPTIONAL, "No board: the servo bus alone on a serial port, in real "
     "time", 0},
    {0, 0, 0, 0, "The run:", 3},
    {"script", OPT_SCRIPT, "FILE", 0, "Timed actions and expectations (see README.md); the run ends with it", 0},
    {"time", OPT_TIME, "T", 0, "End after this simulated time (500ms, 10s, 2min)", 0},
    {"realtime", OPT_REALTIME, 0, 0, "As fast as the real robot (default without a script)", 0},
    {"fast", OPT_FAST, 0, 0, "As fast as this PC can (default with a script)", 0},
    {"quiet", 'q', 0, 0, "No messages but errors", 0},
    {0, 0, 0, 0, "Looking inside:", 4},
    {"trace", OPT_TRACE, "FILE", 0, "CSV: goal and present position of every servo, 128 rows a second", 0},
    {"plot", OPT_PLOT, "FILE", 0, "Joints over time as .svg or .png (needs Python with matplotlib)", 0},
    {"summary", OPT_SUMMARY, 0, 0, "At the end: simulated and real time, CPU load, stack headroom, serial counters", 0},
    {"gdb", OPT_GDB, "PORT", OPTION_ARG_OPTIONAL, "Wait for avr-gdb on port PORT (default 1234) of 127.0.0.1", 0},
    {"allow", OPT_ALLOW, "KIND", 0, "Do not stop at this violation", 0},
    {0}};

/* Ends text at the first c and returns what stands behind it, NULL if there is no c. */
static char *cut(char *text, char c)
{
    char *at = strchr(text, c);
    if (at) {
        *at++ = 0;
    }
    return at;
}

/* "1-18,20:dx117@57142": each part ID[-ID][:model][@rate]. Changes list. */
static const char *parse_servos(options_t *options, char *list)
{
    options->servo_count = 0;
    if (strcmp(list, "none") == 0) {
        return NULL;
    }
    char *rest;
    for (char *part = strtok_r(list, ",", &rest); part; part = strtok_r(NULL, ",", &rest)) {
        const char *rate = cut(part, '@'), *model = cut(part, ':'), *last = cut(part, '-');
        const int which = model ? servo_api_model(model) : SERVO_AX12;
        long first_id, last_id, bps = which == SERVO_DX117 ? 57142 : 1000000;
        if (!cli_number(part, 0, 253, &first_id) || !cli_number(last ? last : part, first_id, 253, &last_id)) {
            return "IDs are 0..253, as 5 or 1-18";
        }
        if (which < 0) {
            return "models are ax12, ax18 and dx117";
        }
        if (rate && !cli_number(rate, 7843, 2000000, &bps)) {
            return "rates are 7843..2000000";
        }
        for (long id = first_id; id <= last_id; id++) {
            if (options->servo_count == CLI_SERVOS_MAX) {
                return "too many servos";
            }
            options->servos[options->servo_count++] =
                (servo_plan_t){(uint8_t)id, (servo_model_t)which, (uint32_t)bps};
        }
    }
    return NULL;
}

static const char *parse_fault(options_t *options, char *text)
{
    const char *name = cut(text, ':');
    long id;
    if (name == NULL || !cli_number(text, 0, 253, &id)) {
        return "give ID:NAME";
    }
    const servo_fault_t fault = servo_fault_by_name(name);
    if (fault == SERVO_FAULTS) {
        return "no such fault (see --help)";
    }
    if (options->fault_count == CLI_FAULTS_MAX) {
        return "too many faults";
    }
    options->faults[options->fault_count++] = (fault_plan_t){(uint8_t)id, fault};
    return NULL;
}

/* The parsers above cut their text to pieces; the command line stays whole for messages. */
static const char *with_copy(options_t *options, const char *text, const char *(*parse)(options_t *, char *))
{
    char copy[1024];
    if (strlen(text) >= sizeof copy) {
        return "too long";
    }
    return parse(options, strcpy(copy, text));
}

static void parse_port(struct argp_state *state, const char *what, const char *text, int *port)
{
    long value;
    if (text && !cli_number(text, 1, 65535, &value)) {
        argp_error(state, "%s: ports are 1..65535, not \"%s\"", what, text);
    } else if (text) {
        *port = (int)value;
    }
}

static void parse_board(struct argp_state *state, options_t *options, const char *text)
{
    if (strcmp(text, "cm5") != 0 && strcmp(text, "cm2") != 0) {
        argp_error(state, "--board: cm5 or cm2, not \"%s\"", text);
    }
    options->kind = strcmp(text, "cm2") == 0 ? BOARD_CM2 : BOARD_CM5;
}

static void parse_allow(struct argp_state *state, options_t *options, const char *text)
{
    const violation_kind_t kind = violation_find(text);
    if (kind == VIOLATION_NONE) {
        argp_error(state, "--allow: no such violation: \"%s\"", text);
    }
    options->allow[kind] = true;
}

static void parse_seed(struct argp_state *state, options_t *options, const char *text)
{
    long value;
    if (!cli_number(text, 0, 0x7FFFFFFF, &value)) {
        argp_error(state, "--seed: a number from 0 to 2147483647, not \"%s\"", text);
    }
    options->seed = (uint32_t)value;
}

static void check(struct argp_state *state, const char *option, const char *text, const char *error)
{
    if (error) {
        argp_error(state, "%s: %s: \"%s\"", option, error, text);
    }
}

static void add_image(struct argp_state *state, options_t *options, const char *path)
{
    if (options->image_count == CLI_IMAGES_MAX) {
        argp_error(state, "more than %d images", CLI_IMAGES_MAX);
    }
    options->images[options->image_count++] = path;
}

static void check_all(struct argp_state *state, const options_t *options)
{
    if (options->bus_pty && (options->image_count || options->script || options->use_pty || options->use_tcp)) {
        argp_error(state, "--bus-pty runs the servos alone: no images, script or console with it");
    }
    if (!options->bus_pty && options->image_count == 0 && options->flash == NULL) {
        argp_error(state, "no image given (for example play-cm5.hex); --help shows examples");
    }
    if ((options->body && options->bus_pty) || (options->view && !options->body)) {
        argp_error(state, "--view shows the --body, and --body needs a board (no --bus-pty)");
    }
    if (options->no_stdio && !options->use_pty && !options->use_tcp && !options->script && !options->bus_pty
        && options->time_cycles == UINT64_MAX) {
        argp_error(state, "--no-stdio without --pty, --tcp, --script or --time would run for ever, unseen");
    }
}

/* The robot itself, and what is done to it. */
static bool parse_robot(int key, char *arg, struct argp_state *state, options_t *options)
{
    switch (key) {
    case OPT_BOARD: parse_board(state, options, arg); break;
    case OPT_SERVOS: check(state, "--servos", arg, with_copy(options, arg, parse_servos)); break;
    case OPT_MOTIONS: options->motions = arg; break;
    case OPT_FAULT: check(state, "--fault", arg, with_copy(options, arg, parse_fault)); break;
    case OPT_SEED: parse_seed(state, options, arg); break;
    case OPT_FLASH: options->flash = arg; break;
    case OPT_EEPROM: options->eeprom = arg; break;
    case OPT_SERVO_EEPROM: options->servo_eeprom = arg; break;
    case OPT_BODY: options->body = arg; break;
    case OPT_VIEW: options->view = true; break;
    case OPT_ALLOW: parse_allow(state, options, arg); break;
    case ARGP_KEY_ARG: add_image(state, options, arg); break;
    default: return false;
    }
    return true;
}

/* Ways in and instruments. */
static bool parse_port_or_file(int key, char *arg, struct argp_state *state, options_t *options)
{
    switch (key) {
    case OPT_PTY: options->use_pty = true; options->pty_link = arg; break;
    case OPT_TCP: options->use_tcp = true; parse_port(state, "--tcp", arg, &options->tcp_port); break;
    case OPT_BUS_PTY: options->bus_pty = true; options->bus_link = arg; break;
    case OPT_NO_STDIO: options->no_stdio = true; break;
    case OPT_RC: options->rc = true; break;
    case OPT_SCRIPT: options->script = arg; break;
    case OPT_TRACE: options->trace = arg; break;
    case OPT_PLOT: options->plot = arg; break;
    case OPT_GDB: options->use_gdb = true; parse_port(state, "--gdb", arg, &options->gdb_port); break;
    default: return false;
    }
    return true;
}

static error_t parse(int key, char *arg, struct argp_state *state)
{
    options_t *options = state->input;
    if (parse_robot(key, arg, state, options) || parse_port_or_file(key, arg, state, options)) {
        return 0;
    }
    switch (key) {
    case OPT_TIME:
        check(state, "--time", arg, cli_duration(arg, &options->time_cycles) ? NULL : "a time like 10s or 500ms");
        break;
    case OPT_REALTIME: options->pace = PACE_REAL; break;
    case OPT_FAST: options->pace = PACE_FAST; break;
    case OPT_SUMMARY: options->summary = true; break;
    case 'q': options->quiet = true; break;
    case ARGP_KEY_END: check_all(state, options); break;
    default: return ARGP_ERR_UNKNOWN;
    }
    return 0;
}

void options_parse(options_t *options, int argc, char **argv)
{
    static const struct argp argp = {descriptions, parse, "IMAGE...", doc, 0, 0, 0};
    char all[] = "1-18";
    memset(options, 0, sizeof *options);
    options->gdb_port = 1234;
    options->seed = 1;
    options->time_cycles = UINT64_MAX;
    (void)parse_servos(options, all);
    argp_err_exit_status = EXIT_USAGE;
    argp_parse(&argp, argc, argv, 0, 0, options);
}
