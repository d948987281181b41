/* SPDX-License-Identifier: MIT
 * settings.h - the user's settings, kept in EEPROM: two copies with sequence number and CRC, written in turn, so that a
 * power cut during a save leaves the old or the new settings and nothing else.
 * Main loop only. RAM: settings_t 43 bytes and settings_store_t 4 bytes; 120 of stack, both the caller's.
 * EEPROM: MEM_EE_SETTINGS.. (two copies of 64 bytes), far from the loader's bytes. */
#ifndef SETTINGS_H
#define SETTINGS_H

#include <stdbool.h>
#include <stdint.h>
#include "compiler.h"
#include "pgm.h"

#define SETTINGS_JOINTS 31u
#define SETTINGS_NO_PARTNER 0xFFu

/* What happens when a servo falls silent or reports overload, overheating or angle error during a play. */
enum {
    SETTINGS_FAULT_HOLD = 0,  /* default: all joints slow down and stop, with torque on */
    SETTINGS_FAULT_EXIT = 1,  /* soft stop through the exit page */
    SETTINGS_FAULT_LIMP = 2   /* the faulty joint's torque goes off, the play goes on without it */
};

/* How a code of the remote acts. */
enum {
    SETTINGS_REMOTE_LATCH = 0, /* default: a code stays in force until another one comes (link_mode_t) */
    SETTINGS_REMOTE_HOLD = 1,  /* while the button is held; letting go stops the play */
    SETTINGS_REMOTE_DRIVE = 2  /* as latch, but L and R steer while a page with partners plays */
};

/* The neutral positions of MIRROR: 512, or step 1 of page 1 if that page is valid. */
enum { SETTINGS_NEUTRAL_512 = 0, SETTINGS_NEUTRAL_PAGE1 = 1 };

/* All fields are bytes, so that the struct is the record in EEPROM. Defaults in brackets. */
typedef struct {
    uint8_t law;                 /* player_law_t [0, exact] */
    uint8_t remote_mode;         /* SETTINGS_REMOTE_ [latch] */
    uint8_t approach_deg_s;      /* 0..240 [60]; 0 = no approach: the first step starts where the robot stands */
    uint8_t fault_rule;          /* SETTINGS_FAULT_ [hold] */
    uint8_t battery_low_dv;      /* 0.1 V, 0 = no warning [90]; as the servos measure it */
    uint8_t hot_degrees;         /* degrees C that cause a warning, 0 = no warning [70] */
    uint8_t neutral;             /* SETTINGS_NEUTRAL_ [0] */
    uint8_t flow;                /* 1: XON/XOFF to the PC when the input ring runs low [1] */
    uint8_t fast_line;           /* 1: the console changes to 117,647 baud after start [0] */
    uint8_t talk;                /* 1: status lines while playing [1] */
    uint8_t pair[SETTINGS_JOINTS]; /* partner of each joint for MIRROR [1-2, 3-4 .. 17-18], SETTINGS_NO_PARTNER: none */
    uint8_t centre_page;         /* its first step is the centre of `amplitude`; 0: no joint is scaled [1] */
    uint8_t drive_ds;            /* 0.1 s without @drive that stop the play, 0 = never [10] */
    /* Add new settings here, at the end, so that older records stay readable. */
} settings_t;

typedef enum {
    SETTINGS_OK = 0,
    SETTINGS_EMPTY,      /* never saved; the defaults are in force */
    SETTINGS_DAMAGED     /* no copy is valid; the defaults are in force */
} settings_status_t;

/* The state of a save. */
typedef struct {
    uint8_t copy;        /* the copy loaded or written last */
    uint8_t sequence;
    uint8_t at;          /* next byte of the record to write */
    bool saving;
} settings_store_t;

void settings_defaults(settings_t *settings);

/* Loads the newer valid copy, or the defaults. A copy with a field out of range counts as damaged. */
settings_status_t settings_load(settings_store_t *store, settings_t *settings);

/* Begins to save. Then call settings_save_poll until it returns false: it writes at most one byte and never blocks; about 50
 * calls, 8.5 ms for each byte that changes. If `settings` change meanwhile, start again. */
void settings_save_start(settings_store_t *store);
bool settings_save_poll(settings_store_t *store, const settings_t *settings);   /* true: not done yet */

/* Blocks until the save under way is done, up to 0.45 s. Not while something moves. */
void settings_save_finish(settings_store_t *store, const settings_t *settings);

/* Starts a save and blocks until it is done. */
void settings_save(settings_store_t *store, const settings_t *settings);

/* Settings by name, for the shell: all but the pairs. */
typedef struct {
    uint8_t offset;          /* within settings_t */
    uint8_t low, high;       /* its range */
} settings_range_t;

typedef struct {
    const char *name;        /* flash */
    const char *meaning;     /* flash, one line with the unit */
    settings_range_t range;
} settings_item_t;

#define SETTINGS_ITEMS 12u

/* Item `index` 0..SETTINGS_ITEMS-1, copied from flash. settings_names.c: linked by Play only. */
void settings_item(uint8_t index, settings_item_t *item);

/* The values of `law` and of `remote` as words: lists in flash of words with their NULs, an empty one at the end.
 * settings_word_P returns word `value` of such a list. settings_names.c as well. */
extern const char settings_laws_P[], settings_remotes_P[];
const char *settings_word_P(const char *words_P, uint8_t value);

uint8_t settings_value(const settings_t *settings, const settings_item_t *item);

/* false: out of range (low..high), nothing changed. */
MUST_CHECK bool settings_set(settings_t *settings, const settings_item_t *item, uint16_t value);

/* Makes a and b (0..30) partners; a == b: no partner. Former partners are left without one. false: out of range. */
MUST_CHECK bool settings_pair(settings_t *settings, uint8_t a, uint8_t b);

#endif
