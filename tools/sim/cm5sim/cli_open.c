/* SPDX-License-Identifier: MIT
 * cli_open.c - the beginning and the end of a session (cli_session.h): images, servos, ports, instruments, and what is
 * kept afterwards. */
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "board_debug.h"
#include "cli_files.h"
#include "cli_leave.h"
#include "cli_script.h"
#include "cli_session.h"

#define LINE_ANSWER_BYTES 1200
#define CTRL_C 3

static const char hand_help[] =
    "A hand at the robot. One line, then Enter; Enter alone goes back.\n\n"
    "  push 3 600      turns the horn of servo 3 to position 600 and holds it there\n"
    "  let go          lets go of all (let go 3: of one)\n"
    "  battery 7.0     volts\n"
    "  servo 5 silent  a fault, until `servo 5 clear`\n"
    "and every other action that a script may have.\n\n";

static void heard(void *context, uint64_t now_cycles, uint8_t byte, bool bad)
{
    session_t *session = context;
    (void)bad;
    session->last_traffic = now_cycles;
    console_put(&session->console, byte);
}

/* A line of the hand was typed: done, or why not. */
static void take_line(session_t *session)
{
    char text[LINE_ANSWER_BYTES];
    overlay_t *overlay = &session->overlay;
    if (overlay->length == 0) {
        overlay_hide(overlay, &session->console);
        return;
    }
    const char *error = script_do_line(session, overlay->line);
    if (error == NULL) {
        overlay_hide(overlay, &session->console);
        return;
    }
    snprintf(text, sizeof text, "%s%s\n\n> ", hand_help, error);
    overlay_show(overlay, &session->console, OVERLAY_LINE, text);
}

static void press_key(session_t *session, key_press_t key)
{
    const uint64_t held = (uint64_t)KEY_HELD_MS * BOARD_CYCLES_PER_MS;
    const uint8_t value = (uint8_t)key.value;
    char text[LINE_ANSWER_BYTES];
    if (!board_is_powered(session->board) && (key.kind == KEY_BYTE || key.kind == KEY_RC || key.kind == KEY_BUTTON)) {
        session_note(session, "the power is off: Ctrl-T p switches it on");
        return;
    }
    switch (key.kind) {
    case KEY_BYTE: session_send(session, &value, 1); break;
    case KEY_EXIT: session_end(session, EXIT_GOOD); break;
    case KEY_HELP: session_page(session, OVERLAY_PAGE, keys_help()); break;
    case KEY_RC_MODE: session_note(session, value ? "keyboard: RC-100 (Ctrl-T r ends)" : "keyboard: serial line"); break;
    case KEY_RC: session_rc_hold(session, key.value, held); break;
    case KEY_BUTTON: session_press(session, (button_t)key.value, held / 3); break;
    case KEY_POWER:
        session_power(session, !board_is_powered(session->board));
        session_note(session, board_is_powered(session->board) ? "power on" : "power off (Ctrl-T p switches it on)");
        break;
    case KEY_SERVOS: session_list_servos(session); break;
    case KEY_LINE:
        snprintf(text, sizeof text, "%s> ", hand_help);
        session_page(session, OVERLAY_LINE, text);
        break;
    case KEY_NONE: break;
    }
}

static void typed(session_t *session, uint8_t byte)
{
    overlay_t *overlay = &session->overlay;
    const overlay_kind_t kind = overlay->kind;
    if (kind == OVERLAY_LINE && byte != KEY_LEAVE) {
        if (overlay_type(overlay, byte)) {
            take_line(session);
        }
        return;
    }
    overlay_hide(overlay, &session->console);
    if (kind != OVERLAY_PAGE || byte == KEY_LEAVE || byte == KEY_PREFIX) {
        press_key(session, keys_take(&session->keys, byte));
    }
    if (byte == CTRL_C && kind == OVERLAY_NONE) {
        leave_explain(session);
    }
}

static void input(void *context, console_source_t source, const uint8_t *bytes, size_t count)
{
    session_t *session = context;
    session_follow_rate(session);
    if (source != FROM_STDIN || (!keys_are_raw() && !session->keys.rc_mode)) {
        session_send(session, bytes, count);
        return;
    }
    for (size_t i = 0; i < count; i++) {
        typed(session, bytes[i]);
    }
}

static const char *load_memories(session_t *session)
{
    const options_t *options = session->options;
    bool kept = false;
    const char *error = options->flash ? files_load_flash(session->board, options->flash, &kept) : NULL;
    if (error == NULL && options->eeprom) {
        error = files_load_eeprom(session->board, options->eeprom);
    }
    for (int i = 0; i < options->image_count && error == NULL; i++) {
        error = files_load_image(session->board, options->images[i]);
    }
    if (error == NULL && options->motions && kept) {
        session_say(session, "%s keeps its motion pages; --motions %s was not loaded over them", options->flash,
                    options->motions);
    } else if (error == NULL && options->motions) {
        error = files_load_motions(session->board, options->motions);
    }
    return error;
}

static const char *open_trace(session_t *session)
{
    const options_t *options = session->options;
    if (options->trace) {
        snprintf(session->trace_path, sizeof session->trace_path, "%s", options->trace);
    } else if (options->plot) {
        const char *folder = getenv("TMPDIR");
        snprintf(session->trace_path, sizeof session->trace_path, "%s/cm5sim-%ld.csv", folder ? folder : P_tmpdir,
                 (long)getpid());
        session->trace_is_temporary = true;
    }
    if (session->trace_path[0]) {
        session->tracing = trace_open(&session->trace, session->trace_path, session->bus);
        if (!session->tracing) {
            return strerror(errno);
        }
    }
    return NULL;
}

/* The chip is on, so that the debugger finds it at its first instruction. */
static const char *open_gdb(session_t *session)
{
    const int port = session->options->gdb_port;
    if (!session->options->use_gdb) {
        return NULL;
    }
    session_say(session, "waiting for avr-gdb: target remote :%d", port);
    return board_gdb(session->board, port, true) ? NULL : board_error(session->board);
}

static void announce(session_t *session)
{
    const options_t *options = session->options;
    if (options->use_pty) {
        session_complain(session, "serial port: %s", session->console.pty.path);
    }
    if (options->use_tcp) {
        session_complain(session, "serial port: tcp 127.0.0.1:%d", session->console.tcp_port);
    }
    if (session->console.use_stdin && isatty(STDIN_FILENO) && keys_raw()) {
        session_say(session, "%s with %d servos. Ctrl-] leaves, Ctrl-T ? shows the keys%s.",
                    options->kind == BOARD_CM2 ? "CM-2" : "CM-5", session->bus->count,
                    options->rc ? "; keyboard: RC-100" : "");
        leave_open(session);
    }
    session->keys.rc_mode = options->rc;
}

int session_open(session_t *session, const options_t *options)
{
    memset(session, 0, sizeof *session);
    session->options = options;
    session->console.listener = session->console.client = -1;
    session->board = board_new(options->kind, options->seed);
    if (session->board == NULL) {
        session_complain(session, "no board: libsimavr without ATmega128, or no memory");
        return EXIT_FILE;
    }
    session->bus = board_servo_bus(session->board);
    for (int kind = 0; kind < VIOLATION_COUNT; kind++) {
        if (options->allow[kind]) {
            board_allow(session->board, (violation_kind_t)kind, true);
        }
    }
    const char *error = load_memories(session);
    error = error ? error : files_plug_in_servos(session->bus, options, board_now(session->board));
    if (options->hung_on) {
        board_body(session->board, options->hung_on);
    }
    error = error ? error : console_open(&session->console, options, input, session);
    error = error ? error : open_trace(session);
    if (error) {
        session_complain(session, "%s", error);
        return EXIT_FILE;
    }
    board_on_console(session->board, heard, session);
    announce(session);
    board_power_on(session->board);
    session->opened = true;
    error = open_gdb(session);
    if (error) {
        session_complain(session, "%s", error);
    }
    return error ? EXIT_FILE : EXIT_GOOD;
}

static void keep(session_t *session, const char *error)
{
    if (error) {
        session_complain(session, "%s", error);
        session_end(session, EXIT_FILE);
    }
}

static void keep_memories(session_t *session)
{
    const options_t *options = session->options;
    if (options->flash) {
        keep(session, files_save_flash(session->board, options->flash));
    }
    if (options->eeprom) {
        keep(session, files_save_eeprom(session->board, options->eeprom));
    }
    if (options->servo_eeprom) {
        keep(session, files_save_servos(session->bus, options->servo_eeprom));
    }
}

static void close_trace(session_t *session)
{
    const char *plot = session->options->plot;
    if (!trace_close(&session->trace)) {
        keep(session, "the trace could not be written");
    }
    if (plot && !trace_plot(session->trace_path, plot)) {
        keep(session, "no plot was made");
    }
    if (session->trace_is_temporary) {
        unlink(session->trace_path);
    }
}

void session_close(session_t *session)
{
    session_leave_screen(session);
    leave_close(session);
    console_close(&session->console);
    keys_restore();
    if (session->board == NULL) {
        return;
    }
    if (session->tracing) {
        close_trace(session);
    }
    if (session->opened) {
        keep_memories(session);
    }
    board_free(session->board);
}
