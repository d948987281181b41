/* SPDX-License-Identifier: MIT */
#include "settings.h"
#include "crc16.h"
#include "eeprom.h"
#include "memory_map.h"

#include <stddef.h>
#include <string.h>

/* A copy has a head, the settings, and the CRC-16 of both, low byte first. Another version of the program may have written
 * fewer or more settings, because new ones are added at the end. Missing settings get their defaults. */
#define COPY_BYTES 64u
#define COPIES ((MEM_EE_SETTINGS_END - MEM_EE_SETTINGS) / COPY_BYTES)
#define MAGIC 'S'
#define LAYOUT 1u
/* A save clears the magic, writes everything after it from the end on, and the magic last. So a mixture of old and new bytes
 * never has the magic. A cleared magic reads as never written, so a first save that is cut off does not count as damage. */
#define CRC_BYTES 2u
#define BODY_BYTES_MAX (COPY_BYTES - sizeof(settings_head_t) - CRC_BYTES)
#define CRC_AT offsetof(settings_store_t, crc)
#define RECORD_BYTES (CRC_AT + CRC_BYTES)
#define SAVE_STEPS (2u * (1u + RECORD_BYTES))   /* each byte is written, then read back */
#define NO_MAGIC 0xFFu

STATIC_ASSERT(sizeof(settings_t) <= BODY_BYTES_MAX, "a record fits its place");
STATIC_ASSERT(CRC_AT == sizeof(settings_head_t) + sizeof(settings_t), "a record has no holes");
STATIC_ASSERT(COPIES >= 2u, "one copy is whole while another is being written");

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

static uint16_t copy_addr(uint8_t number)
{
    return MEM_EE_SETTINGS + number * COPY_BYTES;
}

static bool is_sound(const settings_t *settings)
{
    for (const range_t *range_P = ranges_P; range_P < ranges_P + SETTINGS_ITEMS; range_P++) {
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

typedef union {
    struct {
        settings_head_t head;
        settings_t settings;
    };
    uint8_t bytes[COPY_BYTES];   /* another version's settings may end before or behind ours */
} copy_t;

/* Reads copy `number`. Missing settings get their defaults. */
static settings_status_t load_copy(uint8_t number, copy_t *copy)
{
    eeprom_read(copy_addr(number), copy, sizeof *copy);
    const settings_head_t *head = &copy->head;
    if (head->magic == NO_MAGIC) {
        return SETTINGS_EMPTY;
    }
    if (head->magic != MAGIC || head->layout != LAYOUT || head->body_bytes > BODY_BYTES_MAX) {
        return SETTINGS_DAMAGED;
    }
    const uint8_t end = (uint8_t)(sizeof *head + head->body_bytes);
    const uint16_t crc = crc16_bytes(CRC16_START, copy, end);
    if (crc != (copy->bytes[end] | (uint16_t)copy->bytes[end + 1u] << 8)) {
        return SETTINGS_DAMAGED;
    }
    if (head->body_bytes < sizeof(settings_t)) {
        memcpy_P(copy->bytes + end, (const uint8_t *)&defaults_P + head->body_bytes, sizeof(settings_t) - head->body_bytes);
    }
    return is_sound(&copy->settings) ? SETTINGS_OK : SETTINGS_DAMAGED;
}

settings_status_t settings_load(settings_store_t *store)
{
    settings_status_t status = SETTINGS_EMPTY;
    memset(store, 0, sizeof *store);
    store->newest = COPIES - 1u;   /* so that the first save writes copy 0 */
    store->head.magic = MAGIC;
    store->head.layout = LAYOUT;
    store->head.body_bytes = sizeof store->settings;
    settings_defaults(&store->settings);
    for (uint8_t number = 0; number < COPIES; number++) {
        copy_t copy;
        const settings_status_t of_copy = load_copy(number, &copy);
        if (of_copy == SETTINGS_OK && (status != SETTINGS_OK || (int8_t)(copy.head.sequence - store->head.sequence) >= 0)) {
            store->settings = copy.settings;
            store->newest = number;
            store->head.sequence = (uint8_t)(copy.head.sequence + 1u);
        }
        status = status == SETTINGS_EMPTY || of_copy == SETTINGS_OK ? of_copy : status;
    }
    return status;
}

/* ---- saving ---- */

/* The record just written is the newest copy, which the next save spares. */
static void take_over(settings_store_t *store)
{
    store->newest = store->to;
    store->head.sequence++;
}

/* Begins to write the record as the copy behind this one. The newest copy is spared. NOINLINE: inlined, it costs 30 bytes
 * more, and Edit has fewer. */
static NOINLINE void go_on_behind(settings_store_t *store, uint8_t number)
{
    store->to = (uint8_t)((number + 1u) % COPIES);
    store->failed = store->to == store->newest;
    store->left = store->failed ? 0 : SAVE_STEPS;
}

void settings_save_start(settings_store_t *store)
{
    if (store->left == 1) {   /* the last byte of a save is being written */
        take_over(store);
    }
    const uint16_t crc = crc16_bytes(CRC16_START, store, CRC_AT);
    store->crc[0] = (uint8_t)crc;
    store->crc[1] = (uint8_t)(crc >> 8);
    go_on_behind(store, store->newest);
}

void settings_save_poll(settings_store_t *store)
{
    while (store->left != 0 && !eeprom_is_busy()) {
        const bool is_first = store->left > 2u * RECORD_BYTES;
        const uint8_t at = is_first ? 0 : (uint8_t)(store->left - 1u) / 2u;
        const uint8_t byte = is_first ? NO_MAGIC : ((const uint8_t *)store)[at];
        const uint16_t addr = copy_addr(store->to) + at;
        if (store->left % 2u == 0) {
            (void)eeprom_start(addr, byte);
        } else if (eeprom_byte(addr) != byte && !is_first) {   /* worn out. If the magic stays, the CRC tells a mixture */
            go_on_behind(store, store->to);
            continue;
        }
        if (--store->left == 0) {
            take_over(store);
        }
    }
}

void settings_save_finish(settings_store_t *store)
{
    while (store->left != 0) {
        settings_save_poll(store);
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
