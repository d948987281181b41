/* SPDX-License-Identifier: MIT */
#include "cli_script.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "cli_script_words.h"

#define WORDS_MAX 12
#define DEFAULT_PRESS (100u * (uint64_t)BOARD_CYCLES_PER_MS)

typedef struct {
    const char *name;
    long address, bytes;
} quantity_t;

static const quantity_t quantities[] = {
    {"goal", SERVO_GOAL, 2}, {"present", SERVO_PRESENT, 2}, {"torque", SERVO_TORQUE_ENABLE, 1},
    {"moving", SERVO_MOVING, 1}, {"speed", SERVO_SPEED, 2}, {"voltage", SERVO_VOLTAGE, 1},
    {"temperature", SERVO_TEMPERATURE, 1}, {"led", SERVO_LED, 1}, {"alarms", 0, 0}, {"register", -1, 1}};

static const char *const button_names[BUTTON_COUNT] = {
    [BUTTON_UP] = "UP", [BUTTON_DOWN] = "DOWN", [BUTTON_LEFT] = "LEFT", [BUTTON_RIGHT] = "RIGHT",
    [BUTTON_START] = "START", [BUTTON_MODE] = "MODE"};
static const char *const led_names[LED_COUNT] = {
    [LED_POWER] = "POWER", [LED_TXD] = "TXD", [LED_RXD] = "RXD", [LED_AUX] = "AUX", [LED_MANAGE] = "MANAGE",
    [LED_PROGRAM] = "PROGRAM", [LED_PLAY] = "PLAY"};

bool script_relation(const char *text, relation_t *relation)
{
    static const char *const names[] = {"==", "!=", "<", ">", "<=", ">="};
    for (int i = 0; i < (int)(sizeof names / sizeof names[0]); i++) {
        if (strcmp(text, names[i]) == 0) {
            *relation = (relation_t)i;
            return true;
        }
    }
    return false;
}

/* ---- one parser per verb ---- */

static void parse_send(rest_t *rest, command_t *command)
{
    command->kind = DO_SEND;
    take_text(rest, command, "a \"text\" to send is missing here");
}

static void parse_expect(rest_t *rest, command_t *command)
{
    const bool no = take_if(rest, "no");
    command->kind = no ? DO_EXPECT_NO : DO_EXPECT;
    take_text(rest, command, "a \"text\" to expect is missing here");
    if (rest->error == NULL && command->length == 0) {
        rest->error = "an empty text is always there";
    }
    if (!no) {
        take_within(rest, command);
    } else if (!take_if(rest, "for")) {
        rest->error = rest->error ? rest->error : "for how long? (expect no \"text\" for 2s)";
    } else {
        take_duration(rest, &command->cycles);
    }
}

static void parse_wait(rest_t *rest, command_t *command)
{
    command->kind = DO_WAIT;
    take_duration(rest, &command->cycles);
}

static void parse_press(rest_t *rest, command_t *command)
{
    command->kind = DO_PRESS;
    command->cycles = DEFAULT_PRESS;
    take_name(rest, button_names, BUTTON_COUNT, &command->number, "buttons are UP DOWN LEFT RIGHT START MODE");
    if (rest->count > 0) {
        take_duration(rest, &command->cycles);
    }
}

static void parse_release(rest_t *rest, command_t *command)
{
    command->kind = DO_RELEASE;
    take_name(rest, button_names, BUTTON_COUNT, &command->number, "buttons are UP DOWN LEFT RIGHT START MODE");
}

static void parse_rc(rest_t *rest, command_t *command)
{
    static const char what[] = "keys are U D L R 1..6, joined by +, or 0";
    uint16_t word_value = 0;
    command->kind = DO_RC;
    const cli_word_t *word = take(rest, false, what);
    if (word && !cli_rc_keys(word->text, &word_value)) {
        rest->error = what;
    }
    command->number = word_value;
    if (rest->count > 0) {
        take_duration(rest, &command->cycles);
    }
}

static void parse_power(rest_t *rest, command_t *command)
{
    command->kind = DO_POWER;
    take_on_off(rest, &command->on);
}

static void parse_reset(rest_t *rest, command_t *command)
{
    (void)rest;
    command->kind = DO_RESET;
    command->cycles = DEFAULT_PRESS;
}

static void parse_battery(rest_t *rest, command_t *command)
{
    command->kind = DO_BATTERY;
    take_real(rest, 0, 20, &command->value, "volts (0..20) are missing here");
}

static void parse_servo(rest_t *rest, command_t *command)
{
    static const char what[] = "what about the servo? push, load, clear or a fault: silent dead duplicate checksum "
                               "noise late short two-talkers overload overheating low-voltage angle-limit mishears "
                               "blocked";
    take_number(rest, 0, 253, &command->number, "a servo ID 0..253 is missing here");
    const cli_word_t *word = take(rest, false, what);
    if (word == NULL) {
        return;
    }
    if (strcmp(word->text, "clear") == 0) {
        command->kind = DO_CLEAR;
    } else if (strcmp(word->text, "push") == 0) {
        command->kind = DO_PUSH;
        take_real(rest, 0, 1023, &command->value, "a position 0..1023 is missing here");
    } else if (strcmp(word->text, "load") == 0) {
        command->kind = DO_LOAD;
        take_real(rest, -1, 1, &command->value, "a load -1..1 (of stall torque) is missing here");
    } else {
        command->kind = DO_FAULT;
        command->fault = servo_fault_by_name(word->text);
        command->value = SERVO_FAULT_ALWAYS;
        if (command->fault == SERVO_FAULTS) {
            rest->error = what;
        }
        if (rest->count > 0) {
            long times = 0;
            take_number(rest, 1, 1000000, &times, "how many times? (servo 5 silent 3 times)");
            command->value = (double)times;
            rest->error = rest->error || take_if(rest, "times") ? rest->error : "\"times\" is missing at the end";
        }
    }
}

static void parse_push(rest_t *rest, command_t *command)
{
    command->kind = DO_HOLD;
    take_number(rest, 0, 253, &command->number, "a servo ID 0..253 is missing here (push 3 600)");
    take_real(rest, 0, 1023, &command->value, "a position 0..1023 is missing here (push 3 600)");
}

static void parse_let(rest_t *rest, command_t *command)
{
    command->kind = DO_LET_GO;
    command->number = -1;
    if (!take_if(rest, "go")) {
        rest->error = "let go, or let go of one servo: let go 3";
    } else if (rest->count > 0) {
        take_number(rest, 0, 253, &command->number, "let go of which servo? (let go 3)");
    }
}

static void parse_quantity(rest_t *rest, command_t *command, const quantity_t *quantity)
{
    static const char what[] = "a comparison is missing here: == != < > <= >=";
    command->kind = DO_REGISTER;
    command->address = quantity->address;
    command->bytes = quantity->bytes;
    take_number(rest, 0, 253, &command->number, "a servo ID 0..253 is missing here");
    if (quantity->address < 0) {
        take_number(rest, 0, SERVO_TABLE_BYTES - 1, &command->address, "an address 0..49 is missing here");
    }
    const cli_word_t *word = take(rest, false, what);
    if (word && !script_relation(word->text, &command->relation)) {
        rest->error = what;
    }
    take_real(rest, 0, 65535, &command->value, "a number is missing here");
    take_within(rest, command);
}

static void parse_panel(rest_t *rest, command_t *command)
{
    command->kind = DO_PANEL;
    take_name(rest, led_names, LED_COUNT, &command->number, "LEDs are POWER TXD RXD AUX MANAGE PROGRAM PLAY");
    take_on_off(rest, &command->on);
    take_within(rest, command);
}

static void parse_note(rest_t *rest, command_t *command)
{
    command->kind = DO_NOTE;
    take_text(rest, command, "a \"text\" to say is missing here");
}

static void parse_quit(rest_t *rest, command_t *command)
{
    (void)rest;
    command->kind = DO_QUIT;
}

static const struct {
    const char *name;
    void (*parse)(rest_t *rest, command_t *command);
} verbs[] = {
    {"send", parse_send}, {"expect", parse_expect}, {"wait", parse_wait}, {"press", parse_press},
    {"release", parse_release}, {"rc", parse_rc}, {"power", parse_power}, {"reset", parse_reset},
    {"battery", parse_battery}, {"servo", parse_servo}, {"push", parse_push}, {"let", parse_let}, {"panel", parse_panel},
    {"note", parse_note}, {"quit", parse_quit}};

static void parse_verb(rest_t *rest, command_t *command)
{
    const cli_word_t *word = take(rest, false, "an action is missing here");
    for (size_t i = 0; word && i < sizeof verbs / sizeof verbs[0]; i++) {
        if (strcmp(word->text, verbs[i].name) == 0) {
            verbs[i].parse(rest, command);
            return;
        }
    }
    for (size_t i = 0; word && i < sizeof quantities / sizeof quantities[0]; i++) {
        if (strcmp(word->text, quantities[i].name) == 0) {
            parse_quantity(rest, command, &quantities[i]);
            return;
        }
    }
    rest->error = rest->error ? rest->error
                              : "unknown action (known: send expect wait press release rc power reset battery servo "
                                "push let panel note quit goal present torque moving speed voltage temperature led alarms "
                                "register)";
}

static const char *parse_line(rest_t *rest, command_t *command)
{
    if (take_if(rest, "at")) {
        command->at = true;
        take_duration(rest, &command->when_cycles);
    } else if (take_if(rest, "after")) {
        command->after = true;
        take_duration(rest, &command->when_cycles);
    }
    if (rest->error == NULL) {
        parse_verb(rest, command);
    }
    if (rest->error == NULL && rest->count > 0) {
        rest->error = "too many words: this one was not expected";
    }
    return rest->error;
}

/* NULL, or what is wrong. */
static const char *add(script_t *script, const command_t *command)
{
    command_t *commands = realloc(script->commands, (size_t)(script->count + 1) * sizeof *commands);
    if (commands == NULL) {
        return "no memory";
    }
    script->commands = commands;
    script->commands[script->count++] = *command;
    return NULL;
}

/* One line of the file. false: a mistake was printed. */
static bool load_line(script_t *script, int number, char *line)
{
    cli_word_t words[WORDS_MAX];
    const char *error = NULL;
    const int count = cli_split(line, words, WORDS_MAX, &error);
    command_t command = {.line = number};
    rest_t rest = {words, count, NULL};
    if (count > 0) {
        error = parse_line(&rest, &command);
        error = error ? error : add(script, &command);
    }
    if (error) {
        const char *at = count > 0 && rest.words > words ? rest.words[rest.count > 0 ? 0 : -1].text : NULL;
        fprintf(stderr, "%s:%d: %s%s%s%s\n", script->path, number, error, at ? " (at \"" : "", at ? at : "",
                at ? "\")" : "");
        free(command.text);
        return false;
    }
    return true;
}

const char *script_do_line(session_t *session, char *line)
{
    cli_word_t words[WORDS_MAX];
    const char *error = NULL;
    const int count = cli_split(line, words, WORDS_MAX, &error);
    command_t command = {.line = 0};
    rest_t rest = {words, count, NULL};
    if (count > 0) {
        error = parse_line(&rest, &command);
    }
    if (error == NULL && count > 0) {
        error = command.at || command.after ? "this is done at once: no `at`, no `after`" : script_act(session, &command);
    }
    free(command.text);
    return error;
}

bool script_load(script_t *script, const char *path)
{
    memset(script, 0, sizeof *script);
    script->path = path;
    FILE *file = fopen(path, "r");
    if (file == NULL) {
        fprintf(stderr, "cm5sim: %s: %s\n", path, strerror(errno));
        return false;
    }
    char *line = NULL;
    size_t size = 0;
    bool good = true;
    for (int number = 1; getline(&line, &size, file) >= 0; number++) {
        good = load_line(script, number, line) && good;
    }
    free(line);
    fclose(file);
    return good;
}

void script_free(script_t *script)
{
    for (int i = 0; i < script->count; i++) {
        free(script->commands[i].text);
    }
    free(script->commands);
}
