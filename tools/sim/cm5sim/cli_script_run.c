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

static void fail(const script_t *script, session_t *session, const command_t *command, const char *what)
{
    fprintf(stderr, "%s:%d: at %.3f s: %s\n", script->path, command->line, seconds(board_now(session->board)), what);
    session_end(session, EXIT_EXPECTATION);
}

/* Looks for the text behind the last match; moves behind it when it is there. */
static bool find_text(script_t *script, session_t *session, const command_t *command)
{
    size_t count;
    const uint8_t *output = board_console_output(session->board, &count);
    const uint8_t *found = count > script->heard_from
        ? memmem(output + script->heard_from, count - script->heard_from, command->text, command->length) : NULL;
    if (found) {
        script->heard_from = (size_t)(found - output) + command->length;
    }
    return found != NULL;
}

static step_t step_expect(script_t *script, session_t *session, const command_t *command, bool late)
{
    char what[160];
    if (find_text(script, session, command)) {
        return STEP_DONE;
    }
    if (!late) {
        return STEP_WAITING;
    }
    snprintf(what, sizeof what, "\"%.80s\" did not come within %.3f s", command->text, seconds(command->cycles));
    fail(script, session, command, what);
    show_tail(session, script->heard_from);
    return STEP_FAILED;
}

static step_t step_expect_no(script_t *script, session_t *session, const command_t *command, bool late)
{
    char what[160];
    if (!find_text(script, session, command)) {
        return late ? STEP_DONE : STEP_WAITING;
    }
    snprintf(what, sizeof what, "\"%.80s\" came, and should not have", command->text);
    fail(script, session, command, what);
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

/* The servo that a command names; NULL: there is none. */
static servo_t *servo_of(session_t *session, const command_t *command)
{
    return servo_bus_find(session->bus, (uint8_t)command->number);
}

static const char *no_servo(const command_t *command)
{
    static char text[60];
    snprintf(text, sizeof text, "there is no servo %ld", command->number);
    return text;
}

static step_t step_register(script_t *script, session_t *session, const command_t *command, bool late)
{
    const uint64_t now = board_now(session->board);
    servo_t *servo = servo_of(session, command);
    char what[120];
    if (servo == NULL) {
        fail(script, session, command, no_servo(command));
        return STEP_FAILED;
    }
    const double value = command->bytes == 0
        ? servo_api_alarms(servo, now) : servo_api_get(servo, now, (uint8_t)command->address, (uint8_t)command->bytes);
    if (holds(value, command->relation, command->value)) {
        return STEP_DONE;
    }
    if (!late) {
        return STEP_WAITING;
    }
    snprintf(what, sizeof what, "it is %.0f after %.3f s", value, seconds(command->cycles));
    fail(script, session, command, what);
    return STEP_FAILED;
}

static step_t step_panel(script_t *script, session_t *session, const command_t *command, bool late)
{
    const bool lit = board_leds(session->board) >> command->number & 1;
    if (lit == command->on) {
        return STEP_DONE;
    }
    if (!late) {
        return STEP_WAITING;
    }
    fail(script, session, command, command->on ? "the LED is not lit" : "the LED is lit");
    return STEP_FAILED;
}

static const char *act_on_servo(session_t *session, const command_t *command)
{
    const uint64_t now = board_now(session->board);
    servo_t *servo = servo_of(session, command);
    if (servo == NULL) {
        return no_servo(command);
    }
    switch (command->kind) {
    case DO_FAULT: servo_bus_fault(session->bus, now, servo, command->fault, (uint32_t)command->value); break;
    case DO_CLEAR: servo_api_clear(session->bus, now, servo); break;
    case DO_LOAD: servo_api_set_state(servo, now, SERVO_API_LOAD, command->value); break;
    case DO_LET_GO: servo_api_set_state(servo, now, SERVO_API_HELD, 0); break;
    default: /* DO_PUSH, DO_HOLD */
        servo_api_set_state(servo, now, SERVO_API_HELD, 0);
        servo_push_to(servo, now, command->value);
        servo_api_set_state(servo, now, SERVO_API_HELD, command->kind == DO_HOLD);
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

static void act_rc(session_t *session, const command_t *command)
{
    if (command->number && command->cycles) {
        session_rc_hold(session, (uint16_t)command->number, command->cycles);
    } else {
        session_rc_send(session, (uint16_t)command->number);
        session->rc_next = 0; /* one packet: nothing is held or repeated */
    }
}

const char *script_act(session_t *session, const command_t *command)
{
    switch (command->kind) {
    case DO_SEND: session_send(session, (const uint8_t *)command->text, command->length); break;
    case DO_PRESS:
        session_press(session, (button_t)command->number, command->cycles ? command->cycles : NEVER_CYCLES);
        break;
    case DO_RELEASE: session_release(session, (button_t)command->number); break;
    case DO_RC: act_rc(session, command); break;
    case DO_POWER: session_power(session, command->on); break;
    case DO_RESET: session_press(session, BUTTON_MODE, command->cycles); break;
    case DO_BATTERY: board_battery(session->board, command->value); break;
    case DO_FAULT: case DO_CLEAR: case DO_PUSH: case DO_LOAD: case DO_HOLD: return act_on_servo(session, command);
    case DO_LET_GO: return command->number < 0 ? let_go_of_all(session) : act_on_servo(session, command);
    case DO_NOTE: session_say(session, "%.3f s: %s", seconds(board_now(session->board)), command->text); break;
    case DO_QUIT: session_end(session, EXIT_GOOD); break;
    case DO_EXPECT: case DO_EXPECT_NO: case DO_WAIT: case DO_REGISTER: case DO_PANEL: return "only scripts wait and expect";
    }
    return NULL;
}

static bool is_action(const command_t *command)
{
    return command->kind != DO_EXPECT && command->kind != DO_EXPECT_NO && command->kind != DO_WAIT
        && command->kind != DO_REGISTER && command->kind != DO_PANEL;
}

/* Is the command over? A press and a held remote key last until they are let go. */
static step_t carry_on(script_t *script, session_t *session, const command_t *command)
{
    const bool late = board_now(session->board) >= script->begun_cycles + command->cycles;
    switch (command->kind) {
    case DO_EXPECT: return step_expect(script, session, command, late);
    case DO_EXPECT_NO: return step_expect_no(script, session, command, late);
    case DO_REGISTER: return step_register(script, session, command, late);
    case DO_PANEL: return step_panel(script, session, command, late);
    case DO_PRESS:
        if (late && command->cycles) {
            session_release(session, (button_t)command->number);
        }
        return late ? STEP_DONE : STEP_WAITING;
    default: return late ? STEP_DONE : STEP_WAITING;
    }
}

static uint64_t due(const script_t *script, const command_t *command)
{
    return command->at ? command->when_cycles : command->after ? script->ended_cycles + command->when_cycles : 0;
}

uint64_t script_step(script_t *script, session_t *session)
{
    while (script->next < script->count && !session->done) {
        const command_t *command = &script->commands[script->next];
        const uint64_t now = board_now(session->board);
        if (!script->begun) {
            if (now < due(script, command)) {
                return due(script, command);
            }
            script->begun = true;
            script->begun_cycles = now;
            const char *error = is_action(command) ? script_act(session, command) : NULL;
            if (error) {
                fail(script, session, command, error);
            }
            if (session->done) {
                break;
            }
        }
        const step_t step = carry_on(script, session, command);
        if (step == STEP_WAITING) {
            return script->begun_cycles + command->cycles;
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
