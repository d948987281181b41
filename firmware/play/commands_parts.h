/* SPDX-License-Identifier: MIT
 * commands_parts.h - how the files of Play's commands see each other. For commands*.c only.
 *
 *   commands.c              the table, help, the answer
 *     commands_play.c       play, stop, break, pause, resume, code
 *     commands_robot.c      on, off, servos, baud
 *     commands_settings.c   law, remote, settings
 *     commands_shape.c      rate, amplitude, blend, drive, shape: for programs too; their table
 *       commands_layers.c   layer: likewise
 *       commands_ask.c      numbers and joints of a line, errors */
#ifndef COMMANDS_PARTS_H
#define COMMANDS_PARTS_H

#include "play.h"
#include "report.h"

/* Handlers (shell.h): context is the play_t; a handler that fails has printed one sentence. */
uint8_t commands_do_play(void *context, const shell_args_t *args);
uint8_t commands_do_stop(void *context, const shell_args_t *args);
uint8_t commands_do_break(void *context, const shell_args_t *args);
uint8_t commands_do_pause(void *context, const shell_args_t *args);
uint8_t commands_do_resume(void *context, const shell_args_t *args);
uint8_t commands_do_code(void *context, const shell_args_t *args);

uint8_t commands_do_on(void *context, const shell_args_t *args);
uint8_t commands_do_off(void *context, const shell_args_t *args);
uint8_t commands_do_servos(void *context, const shell_args_t *args);
uint8_t commands_do_baud(void *context, const shell_args_t *args);

uint8_t commands_do_law(void *context, const shell_args_t *args);
uint8_t commands_do_remote(void *context, const shell_args_t *args);
uint8_t commands_do_settings(void *context, const shell_args_t *args);

uint8_t commands_do_layer(void *context, const shell_args_t *args);

/* Words for persons and programs. */
#define COMMANDS_SHAPE_COUNT 6u
extern const shell_command_t commands_shape_table[COMMANDS_SHAPE_COUNT];

/* Begins an error: its number (request_status_t), when a program asks. Returns it as the handler's status. */
uint8_t commands_error(const play_t *play, uint8_t number);
uint8_t commands_sentence(const play_t *play, uint8_t number, const char *sentence_P);   /* the whole of it */

/* What a number is called, in flash, and its bounds. */
typedef struct {
    const char *what_P;
    int16_t min, max;
} commands_range_t;

/* The words from `first` on as numbers, each within its range (in flash); a word that is not there leaves its value as it
 * is. false: it has been said what is wrong. */
bool commands_numbers(const play_t *play, const shell_args_t *args, uint8_t first, const commands_range_t *ranges_P,
                      uint8_t count, int16_t values[]);

/* IDs from word `first` on. false: it has been said what is wrong. */
bool commands_ids(const play_t *play, const shell_args_t *args, uint8_t first, uint32_t *joints);

/* The joints named from word `first` on; all that are present when there is no word. false: it has been said why. */
bool commands_joints(const play_t *play, const shell_args_t *args, uint8_t first, uint32_t *joints);

/* Says why the performer did not do it; the status to return. */
static inline uint8_t commands_refuse(performer_status_t status, uint8_t page, uint8_t fault)
{
    report_refusal(status, page, fault);
    return status == PERFORMER_OK ? SHELL_OK : SHELL_ERR_SAID;
}

#endif
