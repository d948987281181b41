/* SPDX-License-Identifier: MIT
 * cli_script.h - scripts of timed actions and expectations, one a line. Read whole and checked before the run.
 *
 *   [at T | after T] ACTION        at: time since the start; after: since the line before ended
 *
 *   send "play 1\r"                the PC sends
 *   expect "OK" [within 2s]        text from the robot behind the last match (1 s unless said)
 *   expect no "ERR" for 2s
 *   wait 500ms
 *   press START [200ms]            UP DOWN LEFT RIGHT START MODE; held 100 ms, or until `release START` if 0
 *   rc U+3 [500ms]                 remote: one packet, or held so long and let go; rc 0 lets go
 *   power off|on    reset    battery 7.2
 *   servo 5 silent [3 times]       a fault (servo_fault.h) until `servo 5 clear`, or for so many answers
 *   push 5 400                     a hand turns the horn and holds it, until   let go   or   let go 5
 *   servo 5 push 400               the same, but lets go at once;  servo 5 load -0.3   outside load, -1..1
 *   goal 3 == 512 [within 2s]      also present, torque, moving, speed, voltage (tenths), temperature, alarms, led;
 *                                  == != < > <= >=; also `register 3 28 == 32`
 *   panel PLAY on [within 1s]      an LED of the board
 *   note "half way"                a message;   quit   ends the run here, good
 *
 * Times: 500ms 2s 1.5s 20us 3ticks 2min. */
#ifndef CLI_SCRIPT_H
#define CLI_SCRIPT_H

#include "cli_session.h"
#include "cli_text.h"

typedef enum {
    DO_SEND, DO_EXPECT, DO_EXPECT_NO, DO_WAIT, DO_PRESS, DO_RELEASE, DO_RC, DO_POWER, DO_RESET, DO_BATTERY,
    DO_FAULT, DO_CLEAR, DO_PUSH, DO_LOAD, DO_HOLD, DO_LET_GO, DO_REGISTER, DO_PANEL, DO_NOTE, DO_QUIT
} command_kind_t;

typedef enum { IS_EQUAL, IS_NOT, IS_LESS, IS_MORE, IS_AT_MOST, IS_AT_LEAST } relation_t;

/* One line. Which fields count depends on the kind. */
typedef struct {
    int line;
    command_kind_t kind;
    bool at, after;      /* when */
    uint64_t when_cycles;
    uint64_t cycles;     /* within, for, held */
    char *text;
    size_t length;
    long number;         /* servo ID, button, LED, RC word, times */
    long address, bytes; /* of a register; bytes 0: the alarms */
    relation_t relation;
    double value;
    bool on;
    servo_fault_t fault;
} command_t;

typedef struct {
    const char *path;
    command_t *commands;
    int count;

    int next;              /* the command under way */
    bool begun;
    uint64_t begun_cycles; /* when it began */
    uint64_t ended_cycles; /* when the one before ended */
    size_t heard_from;     /* console output behind the last match */
} script_t;

/* Reads and checks a script; false: every mistake has been printed with its line number. */
bool script_load(script_t *script, const char *path);
void script_free(script_t *script);

/* Does what is due. Returns the cycle at which to ask again at the latest (it may look more often); the session ends
 * when the script does. */
uint64_t script_step(script_t *script, session_t *session);

/* Does an action at once. NULL, or why it could not be done (good until the next call); expectations cannot. */
const char *script_act(session_t *session, const command_t *command);

/* Does one line that holds an action (neither `at` nor an expectation), at once; a button pressed is let go by itself.
 * NULL, or why it was not done. Changes line. */
const char *script_do_line(session_t *session, char *line);

/* "==" and so on; false: no such relation. */
bool script_relation(const char *text, relation_t *relation);

#endif
