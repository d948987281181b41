/* SPDX-License-Identifier: MIT
 * requests.h - the line protocol for programs: one request line, one answer line, the same in Play and in Edit. The words
 * that a person types in Play go the same way.
 * Knows no screen and no prompt: words in, text out (text.h). Main loop only. RAM: 5 bytes.
 *
 * Every word of a program begins with '@', so that it can be no word of a person, and so does every answer line:
 *
 *     @where                                       what the program sends
 *     @where state=idle page=0 ... OK              what it gets: the word, fields, OK
 *     @play 300
 *     @play ERR 3 Page must be 1..127              or the word, ERR, a number, a sentence
 *
 * A person types the word without '@' and gets ` OK` or the sentence alone.
 *
 * A program reads lines and ignores those that do not begin with '@' (echo, prompt, status lines). After @watch, lines
 * that begin with @now come by themselves. firmware/edit/PROTOCOL.md is the manual, with every request. */
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
    REQUEST_ERR_RANGE = 3,     /* a number is none, or out of range */
    REQUEST_ERR_BUSY = 4,      /* not while something moves */
    REQUEST_ERR_PAGE = 5,      /* the page is damaged */
    REQUEST_ERR_EMPTY = 6,     /* the page has no action */
    REQUEST_ERR_SERVOS = 7,    /* no servo answers */
    REQUEST_ERR_RELEASED = 8,  /* torque was switched off by hand */
    REQUEST_ERR_CRC = 9,       /* the CRC does not fit: nothing was changed */
    REQUEST_ERR_IMAGE = 10,    /* not in this image */
    REQUEST_ERR_SAVE = 11,     /* the page could not be saved */
    REQUEST_ERR_UNSAVED = 12,  /* the page in RAM has edits that would be lost */
    REQUEST_ERR_FULL = 13,     /* code moves as many joints as it can */
    REQUEST_ERR_IDLE = 14      /* nothing is playing */
} request_status_t;

/* What requests work on, and what an image adds: the one instance stands in its main.c. */
typedef struct {
    const char *name_P;                /* "play" */
    const char *can_P;                 /* what @ver names besides what all can, ",open,save"; or NULL */
    performer_t *performer;
    servo_link_t *servos;
    page_store_t *pages;
    /* Words of this image alone, without '@'. Their handlers get `context` and return a request_status_t, REQUEST_SAID
     * behind requests_error, or SHELL_ERR_RANGE. */
    void *context;
    const shell_command_t *own_P;
    uint8_t own_count;
    void (*where)(void);               /* further fields of @where, each with a blank in front; or NULL */
    void (*serve)(void);               /* what may not wait, between the parts of a request that takes long */
    void (*restart)(void);             /* board_restart with the image's settings: does not return */
} requests_image_t;
extern const requests_image_t requests_image;

/* true when the line is a program's: its first word begins with '@'. */
bool requests_are(const shell_args_t *args);

/* Runs such a line and prints the answer line with its CR LF. */
void requests_run(shell_args_t *args);

/* The same for a line that a person has typed: a word of the image's own table or of this one, which is for persons only. */
void requests_run_typed(shell_args_t *args, const shell_command_t *typed_P, uint8_t typed_count);

/* ---- @watch: the robot, as it is, every so many milliseconds ---- */

/* A @now line is due: the image puts its cursor to the start of a line and calls requests_print_now. */
bool requests_now_is_due(void);
void requests_print_now(void);
void requests_end_watch(void);

/* ---- for handlers ---- */

/* A program sent the line that runs. */
bool requests_of_program(void);

/* The joints that the words from `first` on name, or all that are present when there are none. They have to be there: else
 * the status to return. */
MUST_CHECK uint8_t requests_take_joints(const shell_args_t *args, uint8_t first, uint32_t *joints);

/* Says which servos did not answer; REQUEST_OK when there are none. */
uint8_t requests_no_answer(uint32_t joints);

/* A performer's refusal as an error, with its sentence; REQUEST_OK for PERFORMER_OK. */
uint8_t requests_refusal(performer_status_t status);

/* Handlers of words that both images have (requests_motion.c), for their tables. */
uint8_t request_play(void *context, const shell_args_t *args);      /* SHELL_BOTH(RANGE_PLAYED, RANGE_CODE) */
uint8_t request_stop(void *context, const shell_args_t *args);
uint8_t request_break(void *context, const shell_args_t *args);
uint8_t request_pause(void *context, const shell_args_t *args);
uint8_t request_resume(void *context, const shell_args_t *args);
uint8_t request_on(void *context, const shell_args_t *args);
uint8_t request_off(void *context, const shell_args_t *args);

/* Switches the torque of joints one at a time, so that nothing else waits for longer than 3 ms. Returns those that are as
 * they should be. */
uint32_t requests_switch_torque(uint32_t joints, bool on);

enum { REQUEST_SAID = 100 };   /* failed, and the error has been printed */

/* Begins an error; the sentence has to follow. A program gets " ERR n " in front of it. Returns REQUEST_SAID. */
uint8_t requests_error(uint8_t status);

#endif
