/* SPDX-License-Identifier: MIT */
#include "settings.h"
#include "crc16.h"
#include "eeprom.h"
#include "memory_map.h"

#include <stddef.h>
#include <string.h>

/* A copy has this head, the settings, and the CRC-16 of both, low byte first. Another version of the program may have
 * written fewer or more settings, because new ones are added at the end. Missing settings get their defaults. */
typedef struct {
    uint8_t magic;
    uint8_t layout;
    uint8_t sequence;
    uint8_t body_bytes;
} head_t;

#define COPY_BYTES 64u
#define MAGIC 'S'
#define LAYOUT 1u
/* A save clears the magic, writes everything after it, and writes the magic last. So a mixture of old and new bytes never
 * has the magic. A cleared magic reads as never written, so a first save that is cut off does not count as damage. */
#define CRC_BYTES 2u
#define BODY_BYTES_MAX (COPY_BYTES - sizeof(head_t) - CRC_BYTES)
#define RECORD_BYTES (sizeof(head_t) + sizeof(settings_t) + CRC_BYTES)
#define SAVE_STEPS (RECORD_BYTES + 1u)
#define NO_MAGIC 0xFFu

STATIC_ASSERT(sizeof(settings_t) <= BODY_BYTES_MAX, "a record fits its place");
STATIC_ASSERT(MEM_EE_SETTINGS + 2u * COPY_BYTES <= MEM_EE_SETTINGS_END, "two copies fit");

typedef struct {
    uint8_t offset, low, high;
} range_t;
#define RANGE(name, field, low, high, first, meaning) { offsetof(settings_t, field), low, high },
static const range_t ranges_P[SETTINGS_ITEMS] PROGMEM = { SETTINGS_ROWS(RANGE) };

#define NONE SETTINGS_NO_PARTNER
#define AT_FIRST(name, field, low, high, first, meaning) .field = (first),
static const settings_t defaults_P PROGMEM = {
    SETTINGS_ROWS(AT_FIRST)
    .pair = {
        NONE, 2, 1, 4, 3, 6, 5, 8, 7, 10, 9, 12, 11, 14, 13, 16, 15, 18, 17,   /* IDs 0 to 18 */
        NONE, NONE, NONE, NONE, NONE, NONE, NONE, NONE, NONE, NONE, NONE, NONE,
    },
};

void settings_defaults(settings_t *settings)
{
    memcpy_P(settings, &defaults_P, sizeof *settings);
}

/* ---- loading ---- */

static uint16_t copy_addr(uint8_t copy)
{
    return MEM_EE_SETTINGS + copy * COPY_BYTES;
}

static bool is_sound(const settings_t *settings)
{
    for (uint8_t i = 0; i < SETTINGS_ITEMS; i++) {
        const range_t *range_P = &ranges_P[i];
        const uint8_t value = ((const uint8_t *)settings)[pgm_read_byte(&range_P->offset)];
        if (value < pgm_read_byte(&range_P->low) || value > pgm_read_byte(&range_P->high)) {
            return false;
        }
    }
    for (uint8_t joint = 0; joint < SETTINGS_JOINTS; joint++) {
        if (settings->pair[joint] >= SETTINGS_JOINTS && settings->pair[joint] != SETTINGS_NO_PARTNER) {
            return false;
        }
    }
    return true;
}

/* Reads one copy. Missing settings get their defaults. */
static settings_status_t load_copy(uint8_t copy, uint8_t *sequence, settings_t *settings)
{
    struct {
        head_t head;
        uint8_t rest[COPY_BYTES - sizeof(head_t)];
    } record;
    eeprom_read(copy_addr(copy), &record, sizeof record);
    const uint8_t bytes = record.head.body_bytes;
    if (record.head.magic == NO_MAGIC) {
        return SETTINGS_EMPTY;
    }
    if (record.head.magic != MAGIC || record.head.layout != LAYOUT || bytes > BODY_BYTES_MAX) {
        return SETTINGS_DAMAGED;
    }
    const uint16_t crc = crc16_bytes(CRC16_START, &record, sizeof record.head + bytes);
    *sequence = record.head.sequence;
    settings_defaults(settings);
    memcpy(settings, record.rest, bytes < sizeof *settings ? bytes : sizeof *settings);
    return crc == (record.rest[bytes] | (uint16_t)record.rest[bytes + 1u] << 8) && is_sound(settings) ? SETTINGS_OK
                                                                                                     : SETTINGS_DAMAGED;
}

settings_status_t settings_load(settings_store_t *store, settings_t *settings)
{
    settings_status_t status = SETTINGS_EMPTY;
    store->saving = false;
    store->copy = 1;
    store->sequence = 0;
    settings_defaults(settings);
    for (uint8_t copy = 0; copy < 2u; copy++) {
        settings_t loaded;
        uint8_t sequence;
        const settings_status_t of_copy = load_copy(copy, &sequence, &loaded);
        if (of_copy == SETTINGS_OK && (status != SETTINGS_OK || (int8_t)(sequence - store->sequence) > 0)) {
            *settings = loaded;
            store->copy = copy;
            store->sequence = sequence;
        }
        status = status == SETTINGS_EMPTY || of_copy == SETTINGS_OK ? of_copy : status;
    }
    return status;
}

/* ---- saving ---- */

void settings_save_start(settings_store_t *store)
{
    store->at = 0;
    store->saving = true;
}

/* Byte `at` of the record to write. NOINLINE: inlined, the record would stay on the stack of the main loop. */
static NOINLINE uint8_t byte_to_save(const settings_store_t *store, const settings_t *settings, uint8_t at)
{
    const head_t head = { MAGIC, LAYOUT, store->sequence + 1u, sizeof *settings };
    if (at < sizeof head) {
        return ((const uint8_t *)&head)[at];
    }
    if (at < sizeof head + sizeof *settings) {
        return ((const uint8_t *)settings)[at - sizeof head];
    }
    const uint16_t crc = crc16_bytes(crc16_bytes(CRC16_START, &head, sizeof head), settings, sizeof *settings);
    return (uint8_t)(at == sizeof head + sizeof *settings ? crc : crc >> 8);
}

bool settings_save_poll(settings_store_t *store, const settings_t *settings)
{
    uint8_t copy = 1u - store->copy;
    if (!store->saving || eeprom_is_busy()) {
        return store->saving;
    }
    if (store->at == SAVE_STEPS) {
        store->saving = false;
        return false;
    }
    const uint8_t at = store->at == RECORD_BYTES ? 0 : store->at;   /* the magic is written last */
    uint8_t byte = store->at == 0 ? NO_MAGIC : byte_to_save(store, settings, at);
    if (eeprom_start(copy_addr(copy) + at, byte) && ++store->at == SAVE_STEPS) {
        store->copy = copy;   /* from here on a new save goes to the other one, after this byte */
        store->sequence++;
    }
    return true;
}

void settings_save_finish(settings_store_t *store, const settings_t *settings)
{
    while (settings_save_poll(store, settings)) {
        eeprom_wait();
    }
}

/* ---- by name; the linker drops unused texts ---- */

#define NAME(name, field, low, high, first, meaning) \
    static const char name_of_##field[] PROGMEM = #name; \
    static const char meaning_of_##field[] PROGMEM = meaning;
SETTINGS_ROWS(NAME)

#define TEXTS(name, field, low, high, first, meaning) { name_of_##field, meaning_of_##field },
static const struct {
    const char *name, *meaning;
} texts_P[SETTINGS_ITEMS] PROGMEM = { SETTINGS_ROWS(TEXTS) };

void settings_item(uint8_t index, settings_item_t *item)
{
    range_t range;
    memcpy_P(&range, &ranges_P[index], sizeof range);
    *item = (settings_item_t){ pgm_read_ptr(&texts_P[index].name), pgm_read_ptr(&texts_P[index].meaning), range.offset,
                               range.low, range.high };
}

const char settings_laws_P[] PROGMEM = "exact\0classic\0";
const char settings_remotes_P[] PROGMEM = "latch\0hold\0drive\0";

const char *settings_word_P(const char *words_P, uint8_t value)
{
    for (; value > 0; value--) {
        words_P += strlen_P(words_P) + 1;
    }
    return words_P;
}

uint8_t settings_value(const settings_t *settings, const settings_item_t *item)
{
    return ((const uint8_t *)settings)[item->offset];
}

bool settings_set(settings_t *settings, const settings_item_t *item, uint16_t value)
{
    if (value < item->low || value > item->high) {
        return false;
    }
    ((uint8_t *)settings)[item->offset] = (uint8_t)value;
    return true;
}

void settings_pair(settings_t *settings, uint8_t a, uint8_t b)
{
    for (uint8_t joint = 0; joint < SETTINGS_JOINTS; joint++) {
        const uint8_t partner = settings->pair[joint];
        if (joint == a || joint == b || partner == a || partner == b) {
            settings->pair[joint] = SETTINGS_NO_PARTNER;
        }
    }
    if (a != b) {
        settings->pair[a] = b;
        settings->pair[b] = a;
    }
}
