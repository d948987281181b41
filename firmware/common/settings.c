/* SPDX-License-Identifier: MIT */
#include "settings.h"
#include "crc16.h"
#include "eeprom.h"
#include "memory_map.h"
#include "settings_parts.h"

#include <stddef.h>
#include <string.h>

/* One copy. Bytes only on the AVR, so the struct is the record: no padding on either machine. */
typedef struct {
    uint8_t magic;
    uint8_t layout;
    uint8_t sequence;
    uint8_t body_bytes;
    settings_t body;
    uint8_t crc[2];         /* CRC-16 of all before, low byte first */
} record_t;

#define COPY_BYTES 64u
#define MAGIC 'S'
#define LAYOUT 1u
/* A save goes: magic away, everything behind it, magic back; so no mixture of old and new ever carries the magic. */
#define SAVE_STEPS (sizeof(record_t) + 1u)
#define NO_MAGIC 0x00u

STATIC_ASSERT(sizeof(record_t) == 4u + sizeof(settings_t) + 2u && sizeof(record_t) <= COPY_BYTES, "a record fits its place");
STATIC_ASSERT(MEM_EE_SETTINGS + 2u * COPY_BYTES <= MEM_EE_SETTINGS_END, "two copies fit");

#define ITEM(id, field, low, high) { offsetof(settings_t, field), low, high }
const settings_range_t settings_ranges_P[SETTINGS_ITEMS] PROGMEM = {
    ITEM(law, law, 0, 1),
    ITEM(remote, remote_mode, 0, 1),
    ITEM(approach, approach_deg_s, 0, 240),
    ITEM(fault, fault_rule, 0, SETTINGS_FAULT_LIMP),
    ITEM(low, battery_low_dv, 0, 200),
    ITEM(hot, hot_degrees, 0, 100),
    ITEM(neutral, neutral, 0, 1),
    ITEM(flow, flow, 0, 1),
    ITEM(fast, fast_line, 0, 1),
    ITEM(talk, talk, 0, 1),
};

void settings_defaults(settings_t *settings)
{
    memset(settings, 0, sizeof *settings);
    settings->approach_deg_s = 60;
    settings->fault_rule = SETTINGS_FAULT_HOLD;
    settings->battery_low_dv = 90;
    settings->hot_degrees = 70;
    settings->flow = 1;
    settings->talk = 1;
    for (uint8_t joint = 0; joint < SETTINGS_JOINTS; joint++) {
        uint8_t partner = joint & 1u ? (uint8_t)(joint + 1u) : (uint8_t)(joint - 1u);
        settings->pair[joint] = joint >= 1u && joint <= 18u ? partner : SETTINGS_NO_PARTNER;
    }
}

/* ---- loading ---- */

static uint16_t copy_addr(uint8_t copy)
{
    return (uint16_t)(MEM_EE_SETTINGS + copy * COPY_BYTES);
}

static bool is_sound(const settings_t *settings)
{
    settings_range_t item;
    for (uint8_t i = 0; i < SETTINGS_ITEMS; i++) {
        memcpy_P(&item, &settings_ranges_P[i], sizeof item);
        uint8_t value = ((const uint8_t *)settings)[item.offset];
        if (value < item.low || value > item.high) {
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

static void seal(record_t *record)
{
    uint16_t crc = crc16_bytes(CRC16_START, record, offsetof(record_t, crc));
    record->crc[0] = (uint8_t)crc;
    record->crc[1] = (uint8_t)(crc >> 8);
}

/* Reads one copy; false when it is not a good record of this layout. */
static bool load_copy(uint8_t copy, record_t *record)
{
    uint8_t crc[2];
    eeprom_read(copy_addr(copy), record, sizeof *record);
    memcpy(crc, record->crc, sizeof crc);
    seal(record);
    return record->magic == MAGIC && record->layout == LAYOUT && record->body_bytes == sizeof record->body
        && memcmp(crc, record->crc, sizeof crc) == 0 && is_sound(&record->body);
}

settings_status_t settings_load(settings_store_t *store, settings_t *settings)
{
    record_t record;
    settings_status_t status = SETTINGS_EMPTY;
    store->saving = false;
    store->copy = 1;
    store->sequence = 0;
    settings_defaults(settings);
    for (uint8_t copy = 0; copy < 2u; copy++) {
        if (load_copy(copy, &record)) {
            if (status != SETTINGS_OK || (int8_t)(uint8_t)(record.sequence - store->sequence) > 0) {
                *settings = record.body;
                store->copy = copy;
                store->sequence = record.sequence;
            }
            status = SETTINGS_OK;
        } else if (status == SETTINGS_EMPTY && record.magic != 0xFF) {
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

/* Byte `at` of the record to write. Not inlined: the main loop would keep the record's bytes of stack for ever. */
static NOINLINE uint8_t byte_to_save(const settings_store_t *store, const settings_t *settings, uint8_t at)
{
    record_t record = { MAGIC, LAYOUT, (uint8_t)(store->sequence + 1u), sizeof *settings, *settings, { 0, 0 } };
    seal(&record);
    return ((const uint8_t *)&record)[at];
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
    uint8_t at = (uint8_t)(store->at % sizeof(record_t));
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
