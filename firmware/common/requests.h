/* SPDX-License-Identifier: MIT
 * requests.h - the line protocol for programs: one request line, one answer line, the same in Play and in Edit. Play also
 * runs the lines that a person types through it.
 * Knows no screen and no prompt: takes words, prints text (text.h). Main loop only.
 *
 * Every request of a program begins with '@', which no typed word does, and so does every answer line:
 *
 *     @where                                       the request
 *     @where state=idle page=0 ... OK              the answer: the word, fields, OK
 *     @play 300
 *     @play ERR 3 Page must be 1..127              or the word, ERR, a number, a sentence
 *
 * A person types the word without '@' and gets ` OK`, or the sentence alone.
 *
 * A program reads lines and ignores those that do not begin with '@' (echo, prompt, status lines). After @watch, lines
 * that begin with @now come by themselves. PROTOCOL.md is the manual, with every request. */
#ifndef REQUESTS_H
#define REQUESTS_H

#include <stdbool.h>
#include <stdint.h>
#include "page_store.h"
#include "performer.h"
#include "servo_link.h"
#include "shell.h"

/* Error numbers. They never change their meaning. */
typedef enum {
    REQUEST_OK = 0,
    REQUEST_ERR_WORD = 1,      /* no such request */
    REQUEST_ERR_COUNT = 2,     /* too few or too many words */
    REQUEST_ERR_RANGE = 3,     /* not a number, or out of range */
    REQUEST_ERR_BUSY = 4,      /* not while something moves */
    REQUEST_ERR_PAGE = 5,      /* the page is damaged */
    REQUEST_ERR_EMPTY = 6,     /* the page has no action */
    REQUEST_ERR_SERVOS = 7,    /* no servo answers */
    REQUEST_ERR_RELEASED = 8,  /* torque was switched off by hand */
    REQUEST_ERR_CRC = 9,       /* the CRC is wrong: nothing was changed */
    REQUEST_ERR_IMAGE = 10,    /* not in this image */
    REQUEST_ERR_SAVE = 11,     /* the page is not saved */
    REQUEST_ERR_UNSAVED = 12,  /* the page in RAM has edits that would be lost */
    REQUEST_ERR_FULL = 13,     /* code already moves as many joints as it can */
    REQUEST_ERR_IDLE = 14,     /* nothing is playing */
    REQUEST_ERR_LINE = 15,     /* bytes of the line were lost, or it is too long: nothing was done */
    REQUEST_ERR_ASKED = 16     /* Edit waits for a person to type a name or an answer about the page */
} request_status_t;

/* The words that an image adds. */
typedef struct {
    const shell_command_t *rows_P;
    uint8_t count;
} requests_table_t;

/* The parts that requests use, and the image's additions. Each image defines one instance. */
typedef struct {
    const char *name_P;                /* "play" */
    const char *can_P;                 /* what @ver appends to its common list of capabilities: ",open,save"; or NULL */
    performer_t *performer;
    servo_link_t *servos;
    page_store_t *pages;
    /* The image's own words, without '@'. Their handlers return SHELL_OK, SHELL_ERR_RANGE or _MOVING, or
     * SHELL_ERR_REPORTED after requests_error. */
    const requests_table_t *own;
    void (*where)(void);               /* prints further fields of @where, each after a space; or NULL */
    void (*serve)(void);               /* does urgent work; called between the parts of a long request */
    void (*restart)(void);             /* calls board_restart with the image's settings; does not return */
} requests_image_t;
extern const requests_image_t requests_image;

/* Runs a program's line, which begins with '@', and prints the answer line with its CR LF. Splits the line in place.
 * fault: SHELL_OK, or why the line is refused: SHELL_ERR_LOSSY or SHELL_ERR_LONG. */
void requests_line(char *line, uint8_t fault);

/* The same for a completed request in the channel (channel.h). */
void requests_answer_channel(void);

/* Runs a typed line, whose word is in requests_image.own or in `typed_P`. Programs cannot use the words of `typed_P`.
 * false: it was refused. */
bool requests_run_typed(shell_args_t *args, const shell_command_t *typed_P, uint8_t typed_count);

/* ---- @watch: periodic lines with the state of the robot ---- */

/* Whether a @now line is due, and whether it goes to the channel (channel.h). If not, the image moves its cursor to the
 * start of a line before it calls requests_print_now. */
bool requests_now_is_due(void);
bool requests_now_is_on_channel(void);
void requests_print_now(void);

/* Ends a @watch that was not requested through the channel. */
void requests_end_watch(void);

/* ---- for handlers ---- */

/* Whether a program sent the current line. */
bool requests_from_program(void);

/* The joints named by the words from `first` on, or all present joints if there are no words. Returns REQUEST_OK, or the
 * status for the handler to return: a word names no joint, or one that is not present. */
MUST_CHECK uint8_t requests_take_joints(const shell_args_t *args, uint8_t first, uint32_t *joints);

/* Prints what is wrong with which servos and returns SHELL_ERR_REPORTED. REQUEST_OK if `joints` is empty. */
uint8_t requests_servos(uint32_t joints, const char *what_P);

/* Converts a performer's status into an error with its sentence; REQUEST_OK for PERFORMER_OK. */
uint8_t requests_refusal(performer_status_t status);

/* Sets whether a program or a person sent the next line. For requests.c only. */
void requests_set_program(bool program);

/* Handlers of requests_list.c, for requests.c: the pages in flash. */
uint8_t request_list(const shell_args_t *args);
uint8_t request_page(const shell_args_t *args);
uint8_t request_dense(const shell_args_t *args);
uint8_t request_crcs(const shell_args_t *args);

/* Handlers for the images' own tables. */
uint8_t request_play(const shell_args_t *args);      /* SHELL_BOTH(RANGE_PLAYED, RANGE_CODE) */
uint8_t request_stop(const shell_args_t *args);
uint8_t request_break(const shell_args_t *args);
uint8_t request_pause(const shell_args_t *args);
uint8_t request_resume(const shell_args_t *args);
uint8_t request_on(const shell_args_t *args);
uint8_t request_off(const shell_args_t *args);

/* Switches the torque of joints one at a time and calls serve in between, every 3 ms or less. Returns the joints that
 * switched. */
uint32_t requests_switch_torque(uint32_t joints, bool on);

/* Begins an error: prints " ERR n " for a program. The caller prints the sentence. Returns SHELL_ERR_REPORTED. */
uint8_t requests_error(uint8_t status);

/* The same including the sentence, a flash text (text.h). */
uint8_t requests_refuse(uint8_t status, const char *sentence_P);

#endif
