/* SPDX-License-Identifier: MIT
 * machine.h - the line commands for programs: one request line, one answer line, the same in Play and in Edit.
 * Knows no screen and no prompt: words in, text out (text.h). Main loop only. Caller-owned; RAM: 12 bytes.
 *
 * Every word of a program begins with '@', so that it can be no word of a person, and so does every answer line:
 *
 *     @where                                       what the program sends
 *     @where state=idle page=0 ... OK              what it gets: the word, fields, OK
 *     @play 300
 *     @play ERR 3 Page must be 0..127              or the word, ERR, a number, a sentence
 *
 * A program reads lines and ignores those that do not begin with '@' (echo, prompt, status lines). The commands:
 *
 *     @ver                       image, board, version, limits, what it can do
 *     @list [first last]         the pages that are not empty
 *     @page n                    512 bytes in hex and their CRC-16
 *     @pose                      present position and torque of all servos
 *     @move deg_s id digits      to a pose, ramped, within a speed: three hex digits or --- for id, id + 1, ...
 *     @torque on|off [id ...]
 *     @play n [code]  @stop  @break  @pause  @resume
 *     @where                     state, page, step, repetition, code, voltage, faults
 *     @reset                     restarts the controller (no answer but the loader's start), unless something plays
 *     @rate percent  @amplitude percent [id ...]  @blend percent  @drive blend rate amplitude  @layer n|off [id ...]
 *     @aim id pos [deg_s]  @swing id centre amplitude ms [phase]  @free [id ...]  @shape [reset]       Play only
 *     @open n  @data offset hex  @crc  @save n crc      a page in: images with a page in RAM only
 *
 * firmware/edit/PROTOCOL.md is the manual with examples. */
#ifndef MACHINE_H
#define MACHINE_H

#include <stdbool.h>
#include <stdint.h>
#include "page_store.h"
#include "performer.h"
#include "servo_link.h"
#include "shell.h"

/* Error numbers. They never change their meaning. */
typedef enum {
    MACHINE_OK = 0,
    MACHINE_ERR_WORD = 1,      /* no such command */
    MACHINE_ERR_COUNT = 2,     /* too few or too many words */
    MACHINE_ERR_RANGE = 3,     /* a number is none, or out of range */
    MACHINE_ERR_BUSY = 4,      /* not while something plays */
    MACHINE_ERR_PAGE = 5,      /* the page is damaged */
    MACHINE_ERR_EMPTY = 6,     /* the page has no action */
    MACHINE_ERR_SERVOS = 7,    /* no servo answers */
    MACHINE_ERR_RELEASED = 8,  /* torque was switched off by hand */
    MACHINE_ERR_CRC = 9,       /* the CRC does not fit: nothing was changed */
    MACHINE_ERR_IMAGE = 10,    /* not in this image */
    MACHINE_ERR_SAVE = 11,     /* the page could not be saved */
    MACHINE_ERR_UNSAVED = 12,  /* the page in RAM has edits that would be lost */
    MACHINE_ERR_FULL = 13,     /* code moves as many joints as it can */
    MACHINE_ERR_IDLE = 14      /* nothing is playing */
} machine_status_t;

/* What an image adds. NULL is allowed for service, and for ram_page: then there is no page in RAM, open, changed and
 * save are not used and the commands for it are MACHINE_ERR_IMAGE. */
typedef struct {
    const char *name_P;                                    /* "play" */
    /* What may not wait, between the parts of a command that takes long. */
    void (*service)(void *context);
    /* The 512 bytes of the page in RAM. */
    uint8_t *(*ram_page)(void *context);
    /* Loads page n into RAM, and after @data has changed it: tells the image to show it. */
    machine_status_t (*open)(void *context, uint8_t page);
    void (*changed)(void *context);
    /* Saves the page in RAM as page n. */
    machine_status_t (*save)(void *context, uint8_t page);
    /* board_restart with the image's settings: does not come back. Never NULL. */
    void (*restart)(void *context);
    /* More requests than those above: as shell_run, the answer's word and OK are printed around it. NULL: none. */
    uint8_t (*more)(void *context, const shell_args_t *args);
    /* Further fields of @where, each with a blank in front. NULL: none. */
    void (*where)(void *context);
    void *context;
} machine_image_t;

typedef struct {
    performer_t *performer;
    servo_link_t *servos;
    page_store_t *pages;
    const machine_image_t *image;
} machine_t;

void machine_init(machine_t *machine, performer_t *performer, servo_link_t *servos, page_store_t *pages,
                  const machine_image_t *image);

/* true when the line is for machine_run: its first word begins with '@'. */
bool machine_is_for(const shell_args_t *args);

/* Runs the line and prints the answer line with its CR LF. */
machine_status_t machine_run(machine_t *machine, const shell_args_t *args);

#endif
