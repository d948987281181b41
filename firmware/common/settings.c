/* SPDX-License-Identifier: MIT */
#include "settings.h"
#include "crc16.h"
#include "eeprom.h"
#include "memory_map.h"

#include <stddef.h>
#include <string.h>

/* One copy: magic, layout, sequence, body length, body, CRC-16 of all that (low byte first). */
#define COPY_BYTES 64u
#define MAGIC 'S'
#define LAYOUT 1u
#define HEAD_BYTES 4u
#define BODY_END (HEAD_BYTES + sizeof(settings_t))
#define RECORD_BYTES (BODY_END + 2u)
/* A save goes: magic away, everything behind it, magic back; so no mixture of old and new ever carries the magic. */
#define SAVE_STEPS (RECORD_BYTES + 1u)
#define NO_MAGIC 0x00u

STATIC_ASSERT(RECORD_BYTES <= COPY_BYTES, "a record fits its place");
STATIC_ASSERT(MEM_EE_SETTINGS + 2u * COPY_BYTES <= MEM_EE_SETTINGS_END, "two copies fit");

#define NAME(id, text) static const char name_##id[] PROGMEM = #id; static const char meaning_##id[] PROGMEM = text
NAME(law, "0 exact, 1 classic");
NAME(remote, "0 latch, 1 hold: releasing the buttons stops");
NAME(approach, "degrees/s on the way to a page's first pose, 0 = off");
NAME(fault, "when a servo fails: 0 hold, 1 exit page, 2 go on without it");
NAME(low, "warn below this voltage, 0.1 V, 0 = never");
NAME(hot, "warn at this temperature, degrees C, 0 = never");
NAME(neutral, "middle of MIRROR: 0 = 512, 1 = first step of page 1");
NAME(flow, "1: XON/XOFF to the PC when input runs over");
NAME(fast, "1: 117,647 baud after start");
NAME(talk, "1: status lines while playing");

#define ITEM(id, field, low, high) { name_##id, meaning_##id, offsetof(settings_t, field), low, high }
static const settings_item_t items[SETTINGS_ITEMS] PROGMEM = {
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
    settings_item_t item;
    for (uint8_t i = 0; i < SETTINGS_ITEMS; i++) {
        settings_item(i, &item);
        uint8_t value = settings_value(settings, &item);
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

/* Reads one copy; false when it is not a good record of this layout. */
static bool load_copy(uint8_t copy, uint8_t *sequence, settings_t *settings)
{
    uint8_t head[HEAD_BYTES], sum[2];
    uint16_t addr = copy_addr(copy);
    eeprom_read(addr, head, HEAD_BYTES);
    eeprom_read((uint16_t)(addr + HEAD_BYTES), settings, sizeof *settings);
    eeprom_read((uint16_t)(addr + BODY_END), sum, 2);
    uint16_t crc = crc16_bytes(crc16_bytes(CRC16_START, head, HEAD_BYTES), settings, sizeof *settings);
    *sequence = head[2];
    return head[0] == MAGIC && head[1] == LAYOUT && head[3] == sizeof *settings && sum[0] == (uint8_t)crc
        && sum[1] == (uint8_t)(crc >> 8) && is_sound(settings);
}

static bool is_erased(void)
{
    for (uint16_t i = 0; i < 2u * COPY_BYTES; i++) {
        if (eeprom_byte((uint16_t)(MEM_EE_SETTINGS + i)) != 0xFF) {
            return false;
        }
    }
    return true;
}

settings_status_t settings_load(settings_store_t *store, settings_t *settings)
{
    uint8_t sequence[2];
    bool good[2];
    store->saving = false;
    good[1] = load_copy(1, &sequence[1], settings);
    good[0] = load_copy(0, &sequence[0], settings);
    if (!good[0] && !good[1]) {
        store->copy = 1;
        store->sequence = 0;
        settings_defaults(settings);
        return is_erased() ? SETTINGS_EMPTY : SETTINGS_DAMAGED;
    }
    bool second_is_newer = (int8_t)(uint8_t)(sequence[1] - sequence[0]) > 0;
    store->copy = good[1] && (!good[0] || second_is_newer) ? 1 : 0;
    store->sequence = sequence[store->copy];
    if (store->copy == 1) {
        (void)load_copy(1, &sequence[1], settings);
    }
    return SETTINGS_OK;
}

/* ---- saving ---- */

void settings_save_start(settings_store_t *store)
{
    store->at = 0;
    store->saving = true;
}

/* Byte `at` of the record that is being written. */
static uint8_t record_byte(settings_store_t *store, const settings_t *settings, uint8_t at)
{
    const uint8_t head[HEAD_BYTES] = { MAGIC, LAYOUT, (uint8_t)(store->sequence + 1u), sizeof *settings };
    if (at == BODY_END) {
        store->crc = crc16_bytes(crc16_bytes(CRC16_START, head, HEAD_BYTES), settings, sizeof *settings);
    }
    if (at >= BODY_END) {
        return (uint8_t)(at == BODY_END ? store->crc : store->crc >> 8);
    }
    return at < HEAD_BYTES ? head[at] : ((const uint8_t *)settings)[at - HEAD_BYTES];
}

bool settings_save_poll(settings_store_t *store, const settings_t *settings)
{
    if (!store->saving || eeprom_is_busy()) {
        return store->saving;
    }
    uint8_t copy = (uint8_t)(1u - store->copy);
    if (store->at == SAVE_STEPS) {
        store->copy = copy;
        store->sequence++;
        store->saving = false;
        return false;
    }
    uint8_t at = store->at % RECORD_BYTES;
    uint8_t byte = store->at == 0 ? NO_MAGIC : record_byte(store, settings, at);
    if (eeprom_start((uint16_t)(copy_addr(copy) + at), byte)) {
        store->at++;
    }
    return true;
}

void settings_save(settings_store_t *store, const settings_t *settings)
{
    settings_save_start(store);
    do {
        eeprom_wait();
    } while (settings_save_poll(store, settings));
}

/* ---- by name ---- */

void settings_item(uint8_t index, settings_item_t *item)
{
    memcpy_P(item, &items[index], sizeof *item);
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
