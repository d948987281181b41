/* SPDX-License-Identifier: MIT */
#include <inttypes.h>
#include <string.h>

#include "cli_script.h"
#include "servo_api.h"

#define TAIL_BYTES 400 /* of the console, shown when an expectation fails */

typedef enum { STEP_DONE, STEP_WAITING, STEP_FAILED } step_t;

static double seconds(uint64_t cycles)
{
    return (double)cycles / (1000.0 * BOARD_CYCLES_PER_MS);
}

/* What the robot said last, with control characters made visible. */
static void show_tail(session_t *session, size_t from)
{
    size_t count;
    const uint8_t *output = board_console_output(session->board, &count);
    if (count - from > TAIL_BYTES) {
        from = count - TAIL_BYTES;
    }
    fputs("    since the last match the robot said: \"", stderr);
    for (size_t i = from; i < count; i++) {
        if (output[i] >= 0x20 && output[i] < 0x7F) {
            fputc(output[i], stderr);
        } else {
            const bool named = output[i] == '\r' || output[i] == '\n';
            fprintf(stderr, named ? "\\%c" : "\\x%02X", named ? (output[i] == '\r' ? 'r' : 'n') : output[i]);
        }
    }
    fputs("\"\n", stderr);
}

static void fail(const script_t *script, session_t *session, const deed_t *deed, const char *what)
{
    fprintf(stderr, "%s:%d: at %.3f s: %s\n", script->path, deed->line, seconds(board_now(session->board)), what);
    session_end(session, EXIT_EXPECTATION);
}

/* Looks for the text behind the last match; moves behind it when it is there. */
static bool find_text(script_t *script, session_t *session, const deed_t *deed)
{
    size_t count;
    const uint8_t *output = board_console_output(session->board, &count);
    const uint8_t *found = count > script->heard_from
        ? memmem(output + script->heard_from, count - script->heard_from, deed->text, deed->length) : NULL;
    if (found) {
        script->heard_from = (size_t)(found - output) + deed->length;
    }
    return found != NULL;
}

static step_t step_expect(script_t *script, session_t *session, const deed_t *deed, bool late)
{
    char what[160];
    if (find_text(script, session, deed)) {
        return STEP_DONE;
    }
    if (!late) {
        return STEP_WAITING;
    }
    snprintf(what, sizeof what, "\"%.80s\" did not come within %.3f s", deed->text, seconds(deed->cycles));
    fail(script, session, deed, what);
    show_tail(session, script->heard_from);
    return STEP_FAILED;
}

static step_t step_expect_no(script_t *script, session_t *session, const deed_t *deed, bool late)
{
    char what[160];
    if (!find_text(script, session, deed)) {
        return late ? STEP_DONE : STEP_WAITING;
    }
    snprintf(what, sizeof what, "\"%.80s\" came, and should not have", deed->text);
    fail(script, session, deed, what);
    return STEP_FAILED;
}

static bool holds(double left, relation_t relation, double right)
{
    switch (relation) {
    case IS_EQUAL: return left == right;
    case IS_NOT: return left != right;
    case IS_LESS: return left < right;
    case IS_MORE: return left > right;
    case IS_AT_MOST: return left <= right;
    case IS_AT_LEAST: return left >= right;
    }
    return false;
}

/* The servo that a deed names; NULL: there is none. */
static servo_t *servo_of(session_t *session, const deed_t *deed)
{
    return servo_bus_find(session->bus, (uint8_t)deed->number);
}

static const char *no_servo(const deed_t *deed)
{
    static char text[60];
    snprintf(text, sizeof text, "there is no servo %ld", deed->number);
    return text;
}

static step_t step_register(script_t *script, session_t *session, const deed_t *deed, bool late)
{
    const uint64_t now = board_now(session->board);
    servo_t *servo = servo_of(session, deed);
    char what[120];
    if (servo == NULL) {
        fail(script, session, deed, no_servo(deed));
        return STEP_FAILED;
    }
    const double value = deed->bytes == 0
        ? servo_api_alarms(servo, now) : servo_api_get(servo, now, (uint8_t)deed->address, (uint8_t)deed->bytes);
    if (holds(value, deed->relation, deed->value)) {
        return STEP_DONE;
    }
    if (!late) {
        return STEP_WAITING;
    }
    snprintf(what, sizeof what, "it is %.0f after %.3f s", value, seconds(deed->cycles));
    fail(script, session, deed, what);
    return STEP_FAILED;
}

static step_t step_panel(script_t *script, session_t *session, const deed_t *deed, bool late)
{
    const bool lit = board_leds(session->board) >> deed->number & 1;
    if (lit == deed->on) {
        return STEP_DONE;
    }
    if (!late) {
        return STEP_WAITING;
    }
    fail(script, session, deed, deed->on ? "the LED is not lit" : "the LED is lit");
    return STEP_FAILED;
}

static const char *act_on_servo(session_t *session, const deed_t *deed)
{
    const uint64_t now = board_now(session->board);
    servo_t *servo = servo_of(session, deed);
    if (servo == NULL) {
        return no_servo(deed);
    }
    switch (deed->kind) {
    case DO_FAULT: servo_bus_fault(session->bus, now, servo, deed->fault, (uint32_t)deed->value); break;
    case DO_CLEAR: servo_api_clear(session->bus, now, servo); break;
    case DO_LOAD: servo_api_set_state(servo, now, SERVO_API_LOAD, deed->value); break;
    case DO_LET_GO: servo_api_set_state(servo, now, SERVO_API_HELD, 0); break;
    default: /* DO_PUSH, DO_HOLD */
        servo_api_set_state(servo, now, SERVO_API_HELD, 0);
        servo_push_to(servo, now, deed->value);
        servo_api_set_state(servo, now, SERVO_API_HELD, deed->kind == DO_HOLD);
        break;
    }
    return NULL;
}

static const char *let_go_of_all(session_t *session)
{
    for (int i = 0; i < session->bus->count; i++) {
        servo_api_set_state(servo_api_at(session->bus, i), board_now(session->board), SERVO_API_HELD, 0);
    }
    return NULL;
}

static void act_rc(session_t *session, const deed_t *deed)
{
    if (deed->number && deed->cycles) {
        session_rc_hold(session, (uint16_t)deed->number, deed->cycles);
    } else {
        session_rc_send(session, (uint16_t)deed->number);
        session->rc_next = 0; /* one packet: nothing is held or repeated */
    }
}

const char *script_act(session_t *session, const deed_t *deed)
{
    switch (deed->kind) {
    case DO_SEND: session_send(session, (const uint8_t *)deed->text, deed->length); break;
    case DO_PRESS: session_press(session, (button_t)deed->number, deed->cycles ? deed->cycles : NEVER_CYCLES); break;
    case DO_RELEASE: session_release(session, (button_t)deed->number); break;
    case DO_RC: act_rc(session, deed); break;
    case DO_POWER: session_power(session, deed->on); break;
    case DO_RESET: session_press(session, BUTTON_MODE, deed->cycles); break;
    case DO_BATTERY: board_battery(session->board, deed->value); break;
    case DO_FAULT: case DO_CLEAR: case DO_PUSH: case DO_LOAD: case DO_HOLD: return act_on_servo(session, deed);
    case DO_LET_GO: return deed->number < 0 ? let_go_of_all(session) : act_on_servo(session, deed);
    case DO_NOTE: session_say(session, "%.3f s: %s", seconds(board_now(session->board)), deed->text); break;
    case DO_QUIT: session_end(session, EXIT_GOOD); break;
    case DO_EXPECT: case DO_EXPECT_NO: case DO_WAIT: case DO_REGISTER: case DO_PANEL: return "only scripts wait and expect";
    }
    return NULL;
}

static bool is_action(const deed_t *deed)
{
    return deed->kind != DO_EXPECT && deed->kind != DO_EXPECT_NO && deed->kind != DO_WAIT && deed->kind != DO_REGISTER
        && deed->kind != DO_PANEL;
}

/* Is the deed over? A press and a held remote key last until they are let go. */
static step_t carry_on(script_t *script, session_t *session, const deed_t *deed)
{
    const bool late = board_now(session->board) >= script->begun_cycles + deed->cycles;
    switch (deed->kind) {
    case DO_EXPECT: return step_expect(script, session, deed, late);
    case DO_EXPECT_NO: return step_expect_no(script, session, deed, late);
    case DO_REGISTER: return step_register(script, session, deed, late);
    case DO_PANEL: return step_panel(script, session, deed, late);
    case DO_PRESS:
        if (late && deed->cycles) {
            session_release(session, (button_t)deed->number);
        }
        return late ? STEP_DONE : STEP_WAITING;
    default: return late ? STEP_DONE : STEP_WAITING;
    }
}

static uint64_t due(const script_t *script, const deed_t *deed)
{
    return deed->at ? deed->when_cycles : deed->after ? script->ended_cycles + deed->when_cycles : 0;
}

uint64_t script_step(script_t *script, session_t *session)
{
    while (script->next < script->count && !session->done) {
        const deed_t *deed = &script->deeds[script->next];
        const uint64_t now = board_now(session->board);
        if (!script->begun) {
            if (now < due(script, deed)) {
                return due(script, deed);
            }
            script->begun = true;
            script->begun_cycles = now;
            const char *error = is_action(deed) ? script_act(session, deed) : NULL;
            if (error) {
                fail(script, session, deed, error);
            }
            if (session->done) {
                break;
            }
        }
        const step_t step = carry_on(script, session, deed);
        if (step == STEP_WAITING) {
            return script->begun_cycles + deed->cycles;
        }
        script->begun = false;
        script->ended_cycles = now;
        script->next += step == STEP_DONE;
    }
    if (!session->done) {
        session_end(session, EXIT_GOOD);
    }
    return board_now(session->board);
}
