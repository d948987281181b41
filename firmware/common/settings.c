/* SPDX-License-Identifier: MIT */
#include "settings.h"
#include "crc16.h"
#include "eeprom.h"
#include "memory_map.h"
#include "settings_parts.h"

#include <stddef.h>
#include <string.h>

/* One copy is this head, the settings, and the CRC-16 of both, low byte first. A program of another version may have
 * written fewer settings or more, because new ones are added at the end. Settings that a record lacks get defaults. */
typedef struct {
    uint8_t magic;
    uint8_t layout;
    uint8_t sequence;
    uint8_t body_bytes;
} head_t;

#define COPY_BYTES 64u
#define MAGIC 'S'
#define LAYOUT 1u
/* A save clears the magic, writes everything behind it, and writes the magic last. So no mixture of old and new bytes ever
 * has the magic. */
#define CRC_BYTES 2u
#define BODY_BYTES_MAX (COPY_BYTES - sizeof(head_t) - CRC_BYTES)
#define RECORD_BYTES (sizeof(head_t) + sizeof(settings_t) + CRC_BYTES)
#define SAVE_STEPS (RECORD_BYTES + 1u)
#define NO_MAGIC 0x00u

STATIC_ASSERT(sizeof(settings_t) <= BODY_BYTES_MAX, "a record fits its place");
STATIC_ASSERT(MEM_EE_SETTINGS + 2u * COPY_BYTES <= MEM_EE_SETTINGS_END, "two copies fit");

#define ITEM(id, field, low, high) { offsetof(settings_t, field), low, high }
const settings_range_t settings_ranges_P[SETTINGS_ITEMS] PROGMEM = {
    ITEM(law, law, 0, 1),
    ITEM(remote, remote_mode, 0, SETTINGS_REMOTE_DRIVE),
    ITEM(approach, approach_deg_s, 0, 240),
    ITEM(fault, fault_rule, 0, SETTINGS_FAULT_LIMP),
    ITEM(low, battery_low_dv, 0, 200),
    ITEM(hot, hot_degrees, 0, 100),
    ITEM(neutral, neutral, 0, 1),
    ITEM(flow, flow, 0, 1),
    ITEM(fast, fast_line, 0, 1),
    ITEM(talk, talk, 0, 1),
    ITEM(centre, centre_page, 0, 127),
    ITEM(drive, drive_ds, 0, 250),
};

#define NONE SETTINGS_NO_PARTNER
static const settings_t defaults_P PROGMEM = {
    .approach_deg_s = 60, .fault_rule = SETTINGS_FAULT_HOLD, .battery_low_dv = 90, .hot_degrees = 70, .flow = 1, .talk = 1,
    .pair = {
        NONE, 2, 1, 4, 3, 6, 5, 8, 7, 10, 9, 12, 11, 14, 13, 16, 15, 18, 17,   /* IDs 0 to 18 */
        NONE, NONE, NONE, NONE, NONE, NONE, NONE, NONE, NONE, NONE, NONE, NONE,
    },
    .centre_page = 1, .drive_ds = 10,
};

/* NOINLINE: it would be copied three times. */
NOINLINE void settings_defaults(settings_t *settings)
{
    memcpy_P(settings, &defaults_P, sizeof *settings);
}

/* ---- loading ---- */

static uint16_t copy_addr(uint8_t copy)
{
    return (uint16_t)(MEM_EE_SETTINGS + copy * COPY_BYTES);
}

static bool is_sound(const settings_t *settings)
{
    for (uint8_t i = 0; i < SETTINGS_ITEMS; i++) {
        const settings_range_t *range_P = &settings_ranges_P[i];
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

/* Reads one copy. false: not a good record. *magic is its first byte in either case. */
static bool load_copy(uint8_t copy, uint8_t *magic, uint8_t *sequence, settings_t *settings)
{
    uint8_t bytes[COPY_BYTES];
    head_t head;
    eeprom_read(copy_addr(copy), bytes, sizeof bytes);
    memcpy(&head, bytes, sizeof head);
    *magic = head.magic;
    *sequence = head.sequence;
    if (head.magic != MAGIC || head.layout != LAYOUT || head.body_bytes > BODY_BYTES_MAX) {
        return false;
    }
    const uint8_t crc_at = (uint8_t)(sizeof head + head.body_bytes);
    const uint16_t crc = crc16_bytes(CRC16_START, bytes, crc_at);
    settings_defaults(settings);
    memcpy(settings, bytes + sizeof head, head.body_bytes < sizeof *settings ? head.body_bytes : sizeof *settings);
    return bytes[crc_at] == (uint8_t)crc && bytes[crc_at + 1u] == (uint8_t)(crc >> 8) && is_sound(settings);
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
        uint8_t magic, sequence;
        if (load_copy(copy, &magic, &sequence, &loaded)) {
            if (status != SETTINGS_OK || (int8_t)(uint8_t)(sequence - store->sequence) > 0) {
                *settings = loaded;
                store->copy = copy;
                store->sequence = sequence;
            }
            status = SETTINGS_OK;
        } else if (status == SETTINGS_EMPTY && magic != 0xFF) {
            status = SETTINGS_DAMAGED;
        }
    }
    return status;
}

/* ---- saving ---- */

void settings_save_start(settings_store_t *store)
{
    store->at = 0;
    store->saving = true;
}

/* Byte `at` of the record to write. NOINLINE: else the record would lie on the stack of the main loop for good. */
static NOINLINE uint8_t byte_to_save(const settings_store_t *store, const settings_t *settings, uint8_t at)
{
    const head_t head = { MAGIC, LAYOUT, (uint8_t)(store->sequence + 1u), sizeof *settings };
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
    uint8_t copy = (uint8_t)(1u - store->copy);
    if (!store->saving || eeprom_is_busy()) {
        return store->saving;
    }
    if (store->at == SAVE_STEPS) {
        store->copy = copy;
        store->sequence++;
        store->saving = false;
        return false;
    }
    const uint8_t at = store->at == RECORD_BYTES ? 0 : store->at;   /* the magic is written last */
    uint8_t byte = store->at == 0 ? (uint8_t)NO_MAGIC : byte_to_save(store, settings, at);
    if (eeprom_start((uint16_t)(copy_addr(copy) + at), byte)) {
        store->at++;
    }
    return true;
}

void settings_save_finish(settings_store_t *store, const settings_t *settings)
{
    while (settings_save_poll(store, settings)) {
        eeprom_wait();
    }
}

void settings_save(settings_store_t *store, const settings_t *settings)
{
    settings_save_start(store);
    settings_save_finish(store, settings);
}

/* ---- by name ---- */

uint8_t settings_value(const settings_t *settings, const settings_item_t *item)
{
    return ((const uint8_t *)settings)[item->range.offset];
}

bool settings_set(settings_t *settings, const settings_item_t *item, uint16_t value)
{
    if (value < item->range.low || value > item->range.high) {
        return false;
    }
    ((uint8_t *)settings)[item->range.offset] = (uint8_t)value;
    return true;
}

static void unpair(settings_t *settings, uint8_t joint)
{
    uint8_t partner = settings->pair[joint];
    if (partner < SETTINGS_JOINTS) {
        settings->pair[partner] = SETTINGS_NO_PARTNER;
    }
    settings->pair[joint] = SETTINGS_NO_PARTNER;
}

bool settings_pair(settings_t *settings, uint8_t a, uint8_t b)
{
    if (a >= SETTINGS_JOINTS || b >= SETTINGS_JOINTS) {
        return false;
    }
    unpair(settings, a);
    unpair(settings, b);
    if (a != b) {
        settings->pair[a] = b;
        settings->pair[b] = a;
    }
    return true;
}
