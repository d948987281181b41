/* SPDX-License-Identifier: MIT
 * kept.c - the stored settings, by firmware/common/settings.h and firmware/play/README.md: four copies in EEPROM,
 * each with a sequence number and a CRC, written in turn. A save writes the next copy with the next number. After a
 * power cut the settings are old or new. Play must show the newest copy, and that must be what was set. */
#include "session.h"

#include <stdio.h>
#include <string.h>

#include "linker/memory_map.h"

#define COPIES 4u
#define COPY_BYTES 64u
#define HEAD_BYTES 4u              /* S, layout, sequence number, length of the settings */
#define CRC_BYTES 2u
#define SURE (2u * SECOND)         /* the program saves within half a second after the OK */
#define SETTLED 64u                /* ticks without a write, or at rest: the save is over and certain */
#define BEGUN (4u * SECOND)        /* a requested play has reported its start */
#define LONG_PAUSE (20u * SECOND)  /* of a page; no goals are sent in it */

/* In the order of their bytes. The partners of 31 joints follow `talk`. */
static const struct {
    const char *name;
    unsigned at, first;            /* its byte; its default */
} items[] = {
    {"law", 0, 0},     {"remote", 1, 0},  {"approach", 2, 60},    {"fault", 3, 0},
    {"low", 4, 90},    {"hot", 5, 70},    {"neutral", 6, 0},      {"flow", 7, 1},
    {"fast", 8, 0},    {"talk", 9, 1},    {"centre", 10 + 31, 1}, {"drive", 11 + 31, 10},
};
#define ITEMS (sizeof items / sizeof items[0])

static struct {
    uint8_t copy[COPIES][COPY_BYTES];   /* as they were when last valid */
    int newest;                    /* of the valid copies; -1: none */
    uint8_t sure[COPY_BYTES];      /* the newest copy that a power cut cannot revert */
    bool is_sure;                  /* `sure` is valid */
    bool is_started;
    uint32_t write_tick;
    uint32_t search_tick;
    bool has_changed;              /* since the last tick */
    bool has_written;              /* since the last save that was over */
    int item, value;               /* set by the newest line; -1: none */
    bool is_set;                   /* the line has been answered */
    uint32_t line_tick;            /* the last line that may set something */
    bool is_view;                  /* `settings` was typed and is not yet answered */
} kept;

static const uint8_t *copy_at(unsigned copy)
{
    return simtime_memory(MACHINE_EEPROM) + MEM_EE_SETTINGS + copy * COPY_BYTES;
}

static bool is_whole(const uint8_t *at)
{
    const unsigned end = HEAD_BYTES + at[3];
    if (at[0] != 'S' || end + CRC_BYTES > COPY_BYTES) {
        return false;
    }
    const uint16_t crc = crc_of(at, end);
    return at[end] == (uint8_t)crc && at[end + 1] == crc >> 8;
}

/* Sequence numbers wrap at 256. */
static int newest_copy(void)
{
    int newest = -1;
    for (unsigned copy = 0; copy < COPIES; copy++) {
        if (is_whole(copy_at(copy)) && (newest < 0 || (int8_t)(copy_at(copy)[2] - copy_at((unsigned)newest)[2]) > 0)) {
            newest = (int)copy;
        }
    }
    return newest;
}

static int value_of(unsigned item)
{
    const int newest = newest_copy();
    const bool has_it = newest >= 0 && copy_at((unsigned)newest)[3] > items[item].at;
    return (int)(has_it ? copy_at((unsigned)newest)[HEAD_BYTES + items[item].at] : items[item].first);
}

/* ---- copies ---- */

static void note_copies(void)
{
    for (unsigned copy = 0; copy < COPIES; copy++) {
        memcpy(kept.copy[copy], copy_at(copy), COPY_BYTES);
    }
    kept.newest = newest_copy();
}

/* A copy has become valid: a save is done. */
static void look_at_save(unsigned copy)
{
    const uint8_t *at = copy_at(copy);
    reached("settings saved");
    if (kept.newest < 0) {
        return;
    }
    const uint8_t last = kept.copy[kept.newest][2];
    if (copy != ((unsigned)kept.newest + 1) % COPIES || at[2] != (uint8_t)(last + 1)) {
        session_fail("settings are saved in turn", "copy %u as number %u behind copy %d with number %u", copy, at[2],
                     kept.newest, last);
    }
}

/* Two saves may be over within a tick, after a search. So the oldest copy comes first. */
static void look_at_copies(void)
{
    const int newest = newest_copy();
    for (unsigned i = 1; i <= COPIES; i++) {
        const unsigned copy = ((unsigned)newest + i) % COPIES;   /* none is whole: any order will do */
        const bool is_other = memcmp(copy_at(copy), kept.copy[copy], COPY_BYTES) != 0;
        if (is_whole(copy_at(copy)) && is_other) {
            look_at_save(copy);
            memcpy(kept.copy[copy], copy_at(copy), COPY_BYTES);
            kept.newest = (int)copy;
        }
    }
}

/* A save that is over has left a valid copy. */
static void look_whether_whole(void)
{
    for (unsigned copy = 0; copy < COPIES; copy++) {
        if (memcmp(copy_at(copy), kept.copy[copy], COPY_BYTES) != 0) {
            session_fail("settings are saved whole", "copy %u is damaged", copy);
        }
    }
}

void kept_write(void)
{
    kept.has_written = true;
    kept.has_changed = true;
    kept.write_tick = session.tick;
}

/* Called when the program first prints after a start. The settings must be the certain ones, or those of a save that
 * was in progress. */
void kept_started(void)
{
    const int newest = newest_copy();
    if (kept.is_sure) {
        const uint8_t *at = newest < 0 ? NULL : copy_at((unsigned)newest);
        const int later = at == NULL ? -1 : (int8_t)(at[2] - kept.sure[2]);
        if (at == NULL || later < 0 || (later == 0 && memcmp(at, kept.sure, HEAD_BYTES + at[3] + CRC_BYTES) != 0)) {
            session_fail("settings are old or new", "number %u was sure, the newest of now is %d", kept.sure[2],
                         at == NULL ? -1 : at[2]);
        }
    }
    note_copies();
    kept.is_started = true;
}

/* ---- settings typed and shown ---- */

static int item_of(const char *name)
{
    for (unsigned i = 0; i < ITEMS; i++) {
        if (strcmp(items[i].name, name) == 0) {
            return (int)i;
        }
    }
    return -1;
}

void kept_typed(const char *line)
{
    char name[12] = "", more;
    kept.is_view = strcmp(line, "settings") == 0;
    if (!session.typed_is_known || strncmp(line, "settings ", 9) == 0 || strncmp(line, "law ", 4) == 0 ||
        strncmp(line, "remote ", 7) == 0) {
        const bool is_one = sscanf(line, "settings %11[a-z] %d%c", name, &kept.value, &more) == 2;
        kept.item = session.typed_is_known && is_one && long_ago(kept.line_tick, SECOND) ? item_of(name) : -1;
        kept.is_set = false;
        kept.line_tick = session.tick;
    }
}

void kept_printed(const char *line)
{
    char name[12];
    int value;
    if (strcmp(line, " OK") == 0) {
        kept.is_set = kept.item >= 0;
        kept.is_view = false;
    } else if (strstr(line, "settings were damaged") != NULL && kept.is_sure) {
        /* An interrupted first save leaves the defaults, which were in force. The program then reports damage. */
        session_fail("settings are old or new", "\"%s\"", line);
    } else if (kept.is_view && sscanf(line, "%11[a-z] %d  (", name, &value) == 2) {
        const int item = item_of(name);
        if (item >= 0 && long_ago(kept.line_tick, SURE) && long_ago(session.late_tick, SURE)) {
            reached("setting shown as it is kept");
            if (value != value_of((unsigned)item)) {
                session_fail("settings are those that are kept", "\"%s\", kept is %d", line, value_of((unsigned)item));
            }
        }
    } else if (kept.item >= 0 && !kept.is_set && line[0] != ']') {
        kept.item = -1;   /* refused, or another message came first */
    }
}

void kept_tick(void)
{
    if (kept.has_changed) {
        kept.has_changed = false;
        look_at_copies();
    }
    kept.search_tick = rules_is_searching() ? session.tick : kept.search_tick;   /* a save waits for its end */
    if (kept.is_started && kept.has_written && long_ago(kept.write_tick, SURE) && long_ago(kept.search_tick, SURE) &&
        long_ago(session.late_tick, SURE)) {
        kept.has_written = false;
        look_whether_whole();
    }
    if (kept.item >= 0 && kept.is_set && session.tick - kept.line_tick > SURE && long_ago(kept.search_tick, SURE)) {
        reached("setting kept as it was set");
        if (long_ago(session.late_tick, SURE) && value_of((unsigned)kept.item) != kept.value) {
            session_fail("settings are kept as they were set", "%s is %d, set was %d", items[kept.item].name,
                         value_of((unsigned)kept.item), kept.value);
        }
        kept.item = -1;
    }
    /* By then the program has had time to complete the save. */
    const uint32_t stands = presses_are_at_rest() && long_ago(session.asked_tick, BEGUN) ? SETTLED : LONG_PAUSE;
    if (kept.is_started && long_ago(kept.write_tick, SETTLED) && long_ago(session.goals_tick, stands) && kept.newest >= 0) {
        kept.is_sure = true;
        memcpy(kept.sure, kept.copy[kept.newest], COPY_BYTES);
    }
}

int kept_value(const char *setting)
{
    return value_of((unsigned)item_of(setting));
}

void kept_boot(void)
{
    if (session.boots == 0) {
        memset(&kept, 0, sizeof kept);
        kept.newest = -1;
    }
    kept.item = -1;
    kept.is_view = kept.has_changed = kept.has_written = kept.is_started = false;
    kept.line_tick = session.tick;
}
