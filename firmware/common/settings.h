/* SPDX-License-Identifier: MIT
 * settings.h - the user's settings in EEPROM: four copies with sequence number and CRC, written in turn, so that a power
 * cut during a save leaves either the old or the new settings, and a copy with a worn-out byte is passed over.
 * Main loop only. RAM: one settings_store_t, the caller's.
 * EEPROM: MEM_EE_SETTINGS.. (four copies of 64 bytes), far from the loader's bytes. */
#ifndef SETTINGS_H
#define SETTINGS_H

#include <stdbool.h>
#include <stdint.h>
#include "compiler.h"
#include "pgm.h"
#include "target.h"

#define SETTINGS_JOINTS 31u
#define SETTINGS_NO_PARTNER 0xFFu

/* What happens when a servo falls silent or reports overload, overheating or angle error during a play. */
enum {
    SETTINGS_FAULT_HOLD = 0,  /* default: all joints slow down and stop, with torque on */
    SETTINGS_FAULT_EXIT = 1,  /* soft stop through the exit page; in a pause as `hold`, so that nothing begins to move */
    SETTINGS_FAULT_LIMP = 2   /* the faulty joint's torque goes off, the play continues without it */
};

/* How a code of the remote acts. */
enum {
    SETTINGS_REMOTE_LATCH = 0, /* default: a code stays in force until another one arrives (link_mode_t) */
    SETTINGS_REMOTE_HOLD = 1,  /* a code is in force while its button is held; releasing it stops the play */
    SETTINGS_REMOTE_DRIVE = 2  /* as latch, but L and R steer while a page with partners is playing */
};

/* The neutral positions of MIRROR: 512, or step 1 of page 1 if that page is valid. */
enum { SETTINGS_NEUTRAL_512 = 0, SETTINGS_NEUTRAL_PAGE1 = 1 };

/* Every setting except the pairs is a byte and has a row here: name in the shell, field, lowest value, highest value,
 * default, meaning. The rows are in the order of the record in EEPROM. Add new ones at the very end, so that older records
 * stay readable. */
#define SETTINGS_FIRST(ROW) \
    ROW(law, law, 0, 1, 0, "0 exact, 1 classic") \
    ROW(remote, remote_mode, 0, SETTINGS_REMOTE_DRIVE, SETTINGS_REMOTE_LATCH, "0 latch, 1 hold, 2 drive") \
    ROW(approach, approach_deg_s, 0, 240, 60, "degrees/s, 0 = off") \
    ROW(fault, fault_rule, 0, SETTINGS_FAULT_LIMP, SETTINGS_FAULT_HOLD, "0 hold, 1 exit page, 2 go on without it") \
    ROW(low, battery_low_dv, 0, 200, 90, "battery warning, 0.1 V, 0 = off") \
    ROW(hot, hot_degrees, 0, 100, 70, "servo warning, degrees C, 0 = off") \
    ROW(neutral, neutral, 0, SETTINGS_NEUTRAL_PAGE1, SETTINGS_NEUTRAL_512, "MIRROR about 0: 512, 1: page 1") \
    ROW(flow, flow, 0, 1, 1, "1 = XON/XOFF") \
    ROW(fast, fast_line, 0, 1, 0, "1 = 117,647 baud after start; remote and m512 need 0") \
    ROW(talk, talk, 0, 1, 1, "1 = status lines while playing")
#define SETTINGS_ADDED(ROW) \
    ROW(centre, centre_page, 0, TARGET_MOTION_PAGES - 1u, 1, "amplitude is about step 1 of this page, 0 = off") \
    ROW(drive, drive_ds, 0, 250, 10, "0.1 s without @drive until the stop, 0 = never")
#define SETTINGS_ROWS(ROW) SETTINGS_FIRST(ROW) SETTINGS_ADDED(ROW)

/* The record in EEPROM. */
#define SETTINGS_FIELD(name, field, low, high, first, meaning) uint8_t field;
typedef struct {
    SETTINGS_FIRST(SETTINGS_FIELD)
    uint8_t pair[SETTINGS_JOINTS]; /* partner of each joint for MIRROR, or SETTINGS_NO_PARTNER; default 1-2, 3-4 .. 17-18 */
    SETTINGS_ADDED(SETTINGS_FIELD)
} settings_t;
#define SETTINGS_ITEMS (sizeof(settings_t) - SETTINGS_JOINTS)

typedef enum {
    SETTINGS_OK = 0,
    SETTINGS_EMPTY,      /* never saved; the defaults are in force */
    SETTINGS_DAMAGED     /* no copy is valid; the defaults are in force */
} settings_status_t;

typedef struct {
    uint8_t magic;
    uint8_t layout;
    uint8_t sequence;
    uint8_t body_bytes;
} settings_head_t;

/* The settings and the state of a save. */
typedef struct {
    settings_head_t head;    /* of the next save; head, settings and CRC are as in EEPROM */
    settings_t settings;     /* read and changed by the caller, the rest is not */
    uint8_t crc[2];
    uint8_t left;            /* steps of the save to do; 0: none */
    bool failed;             /* the EEPROM did not take the last save: its newest copy is older. The caller clears this */
    uint8_t newest;          /* number of the newest copy */
    uint8_t to;              /* number of the copy to write */
} settings_store_t;

void settings_defaults(settings_t *settings);

/* Loads the newer valid copy, or the defaults. A copy with a field out of range counts as damaged. NOINLINE: inlined, its
 * records would stay on the stack during the rest of the start-up. */
settings_status_t settings_load(settings_store_t *store) NOINLINE;

/* Begins to save. Then call settings_save_poll regularly: it begins to write at most one byte and never blocks. A save takes
 * 8.5 ms for each of about 50 bytes that changes. Each is read back. If one is worn out, the next copy is written instead.
 * If the settings change meanwhile, start again. */
void settings_save_start(settings_store_t *store);
void settings_save_poll(settings_store_t *store);

/* Blocks until a save in progress is done, up to 0.45 s, and as much again for each copy with a worn-out byte. Nothing may
 * be moving. */
void settings_save_finish(settings_store_t *store);

/* A setting by name, for a line shell. */
typedef struct {
    const char *name;        /* flash */
    const char *meaning;     /* flash, one line with the unit */
    uint8_t offset;          /* within settings_t */
    uint8_t low, high;       /* its range */
} settings_item_t;

/* Item `index` 0..SETTINGS_ITEMS-1, copied from flash. */
void settings_item(uint8_t index, settings_item_t *item);

/* The values of `law` and of `remote` as words: lists in flash of NUL-terminated words, with an empty word at the end.
 * settings_word_P returns word `value` of such a list. */
extern const char settings_laws_P[], settings_remotes_P[];
const char *settings_word_P(const char *words_P, uint8_t value);

uint8_t settings_value(const settings_t *settings, const settings_item_t *item);

/* false: out of range (low..high), nothing changed. */
MUST_CHECK bool settings_set(settings_t *settings, const settings_item_t *item, uint16_t value);

/* Makes a and b (0..30) partners; a == b: no partner. Former partners lose theirs. */
void settings_pair(settings_t *settings, uint8_t a, uint8_t b);

#endif
