/* SPDX-License-Identifier: MIT */
#include "cli_session.h"

#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cli_text.h"
#include "servo_api.h"

#define LINE_BPS 57600u
#define MESSAGE_BYTES 600
#define NOTE_CYCLES (1500u * BOARD_CYCLES_PER_MS)

/* ---- messages ---- */

static void message(const char *text)
{
    fprintf(stderr, "cm5sim: %s%s", text, keys_are_raw() ? "\r\n" : "\n");
}

void session_say(const session_t *session, const char *format, ...)
{
    char text[MESSAGE_BYTES];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    if (!session->options->quiet) {
        message(text);
    }
}

void session_complain(const session_t *session, const char *format, ...)
{
    char text[MESSAGE_BYTES];
    va_list arguments;
    (void)session;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    message(text);
}

bool session_is_on_terminal(const session_t *session)
{
    const char *term = getenv("TERM");
    return keys_are_raw() && session->console.use_stdout && isatty(STDOUT_FILENO) && term && strcmp(term, "dumb") != 0;
}

void session_leave_screen(session_t *session)
{
    overlay_hide(&session->overlay, &session->console);
    console_flush(&session->console);
    if (session->console.draws && session_is_on_terminal(session)) {
        session->console.draws = false;
        fputs("\x1b[0m\x1b[999;1H\r\n", stderr); /* plain letters, the last line */
    }
}

void session_page(session_t *session, overlay_kind_t kind, const char *text)
{
    if (session_is_on_terminal(session)) {
        overlay_show(&session->overlay, &session->console, kind, text);
        overlay_add(kind == OVERLAY_PAGE ? "\n(any key goes back to the robot)" : "");
    } else {
        fputs(text, stderr);
    }
}

void session_note(session_t *session, const char *format, ...)
{
    char text[MESSAGE_BYTES];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    if (session_is_on_terminal(session)) {
        session_page(session, OVERLAY_NOTE, text);
        session->overlay.until = board_now(session->board) + NOTE_CYCLES;
    } else if (!session->options->quiet) {
        message(text);
    }
}

void session_end(session_t *session, int exit_code)
{
    session->done = true;
    if (session->exit_code == EXIT_GOOD) {
        session->exit_code = exit_code;
    }
}

/* ---- hands ---- */

void session_send(session_t *session, const uint8_t *bytes, size_t count)
{
    board_console_send(session->board, CONSOLE_PC, bytes, count);
    session->last_traffic = board_now(session->board);
}

static uint64_t until(const session_t *session, uint64_t cycles)
{
    return cycles == NEVER_CYCLES ? NEVER_CYCLES : board_now(session->board) + cycles;
}

static void move_button(session_t *session, button_t button, bool down)
{
    session->button_down[button] = down;
    board_press(session->board, button, down);
}

void session_press(session_t *session, button_t button, uint64_t cycles)
{
    session->button_until[button] = until(session, cycles);
    move_button(session, button, true);
}

void session_release(session_t *session, button_t button)
{
    move_button(session, button, false);
}

void session_rc_send(session_t *session, uint16_t word)
{
    uint8_t packet[CLI_RC_BYTES];
    cli_rc_packet(word, packet);
    board_console_send(session->board, CONSOLE_REMOTE, packet, sizeof packet);
    session->rc_word = word;
    session->rc_next = board_now(session->board) + RC_REPEAT_CYCLES;
    session->last_traffic = board_now(session->board);
}

/* The word of the keys held now. */
static uint16_t rc_held(const session_t *session)
{
    unsigned word = 0;
    for (int key = 0; key < RC_KEYS; key++) {
        word |= session->rc_until[key] ? 1u << key : 0;
    }
    return (uint16_t)word;
}

void session_rc_hold(session_t *session, uint16_t keys, uint64_t cycles)
{
    for (int key = 0; key < RC_KEYS; key++) {
        if (keys & 1u << key) {
            session->rc_until[key] = until(session, cycles);
        }
    }
    if (rc_held(session) != session->rc_word) {
        session_rc_send(session, rc_held(session));
    }
}

void session_power(session_t *session, bool on)
{
    if (on) {
        board_power_on(session->board);
    } else {
        board_power_off(session->board);
    }
}

static uint64_t earlier(uint64_t a, uint64_t b)
{
    return a < b ? a : b;
}

uint64_t session_hands(session_t *session)
{
    const uint64_t now = board_now(session->board);
    uint64_t next = NEVER_CYCLES;
    for (int button = 0; button < BUTTON_COUNT; button++) {
        if (session->button_down[button] && session->button_until[button] <= now) {
            move_button(session, (button_t)button, false);
        } else if (session->button_down[button]) {
            next = earlier(next, session->button_until[button]);
        }
    }
    for (int key = 0; key < RC_KEYS; key++) {
        if (session->rc_until[key] <= now) {
            session->rc_until[key] = 0;
        } else {
            next = earlier(next, session->rc_until[key]);
        }
    }
    const uint16_t held = rc_held(session);
    const bool ours = held != 0 || session->rc_next != 0;
    if (ours && (held != session->rc_word || (held && now >= session->rc_next))) {
        session_rc_send(session, held);
        session->rc_next = held ? session->rc_next : 0;
    }
    return held ? earlier(next, session->rc_next) : next;
}

void session_follow_rate(session_t *session)
{
    const uint32_t bps = session->console.has_pty ? pty_rate(&session->console.pty) : 0;
    if (bps == session->pty_bps || bps < 300 || bps > 4000000) {
        return;
    }
    session->pty_bps = bps;
    board_console_rate(session->board, bps);
    if (bps * 100 < LINE_BPS * 96 || bps * 100 > LINE_BPS * 104) {
        session_say(session, "the serial port's rate was set to %u bps; the robot's is %u: both hear garbage", bps,
                    LINE_BPS);
    }
}

void session_list_servos(session_t *session)
{
    static char text[256 * 64];
    const uint64_t now = board_now(session->board);
    int at = snprintf(text, sizeof text, "ID  goal  present  torque  error byte\n");
    for (int i = 0; i < session->bus->count; i++) {
        servo_t *servo = servo_api_at(session->bus, i);
        const uint16_t present = servo_api_get(servo, now, SERVO_PRESENT, 2);
        at += snprintf(text + at, sizeof text - (size_t)at, "%-3u %4u  %7u  %-6s  0x%02X%s%s\n", servo_api_id(servo),
                       servo_get(servo, SERVO_GOAL, 2), present, servo->table[SERVO_TORQUE_ENABLE] ? "on" : "off",
                       servo->alarms, servo->held ? "  held" : "", servo->powered ? "" : "  no power");
    }
    session_page(session, OVERLAY_PAGE, text);
}
