/* SPDX-License-Identifier: MIT
 * requests.h - the line protocol for programs: one request line, one answer line, the same in Play and in Edit.
 * Knows no screen and no prompt: words in, text out (text.h). Main loop only. RAM: 4 bytes.
 *
 * Every word of a program begins with '@', so that it can be no word of a person, and so does every answer line:
 *
 *     @where                                       what the program sends
 *     @where state=idle page=0 ... OK              what it gets: the word, fields, OK
 *     @play 300
 *     @play ERR 3 Page must be 1..127              or the word, ERR, a number, a sentence
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
    const shell_command_t *own_P;      /* requests of this image alone; their handlers return a request_status_t, */
    uint8_t own_count;                 /* REQUEST_SAID behind requests_error, or REQUEST_OK */
    /* More requests, as words of a person behind the '@': says its error itself. SHELL_ERR_UNKNOWN: none. NULL: there are
     * none. */
    uint8_t (*more)(const shell_args_t *args);
    void (*where)(void);               /* further fields of @where, each with a blank in front; or NULL */
    void (*serve)(void);               /* what may not wait, between the parts of a request that takes long */
    void (*restart)(void);             /* board_restart with the image's settings: does not return */
} requests_image_t;
extern const requests_image_t requests_image;

/* true when the line is for requests_run: its first word begins with '@'. */
bool requests_are(const shell_args_t *args);

/* Runs the line and prints the answer line with its CR LF. */
void requests_run(shell_args_t *args);

/* ---- @watch: the robot, as it is, every so many milliseconds ---- */

/* A @now line is due: the image puts its cursor to the start of a line and calls requests_print_now. */
bool requests_now_is_due(void);
void requests_print_now(void);
void requests_end_watch(void);

/* ---- for handlers ---- */

/* Switches the torque of joints one at a time, so that nothing else waits for longer than 3 ms. Returns those that are as
 * they should be. */
uint32_t requests_switch_torque(uint32_t joints, bool on);

enum { REQUEST_SAID = 100 };   /* failed, and the error has been printed */

/* " ERR n ": the sentence has to follow. Returns REQUEST_SAID. */
uint8_t requests_error(uint8_t status);

#endif
