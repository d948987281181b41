/* SPDX-License-Identifier: MIT
 * The journal's recovery with any contents of its area. Input: slots (bit k: slot k's record gets its CRCs), mishaps
 * (bit 0: power cut; bit 1: a page cannot be written), a sequence number, record bytes and data seed of each slot,
 * then the details of the mishaps. */
#include "fuzz.h"
#include "fake_flash.h"
#include "firmware/common/crc16.h"
#include "firmware/common/journal.h"
#include "linker/memory_map.h"
#include "trap.h"

#include <setjmp.h>
#include <stdbool.h>
#include <string.h>

#define RECORD_BYTES 12u

static uint8_t before[MEM_BOOT_END];

static void put16(uint8_t *at, uint16_t value)
{
    at[0] = (uint8_t)value;
    at[1] = (uint8_t)(value >> 8);
}

/* Good records have the numbers of consecutive saves, in any order: a journal's own numbers lie within its slots. */
static void make_slot(uint8_t slot, bool good, uint16_t sequence, fuzz_t *fuzz)
{
    uint8_t *data = fake_flash_bytes() + MEM_JOURNAL_START + 768u * slot, *record = data + 512;
    fuzz_bytes(fuzz, record, RECORD_BYTES);
    const uint8_t seed = fuzz_byte(fuzz);
    for (unsigned i = 0; i < 512; i++) {
        data[i] = (uint8_t)(seed * i + (i >> 3));
    }
    if (good) {
        record[0] = 'M';
        record[1] = 'J';
        record[5] = 1;
        put16(&record[2], (uint16_t)(sequence + record[2] % JOURNAL_SLOTS));
        put16(&record[6], crc16_bytes(CRC16_START, data, 512));
        put16(&record[8], crc16_bytes(CRC16_START, record, 8));
    }
}

/* Outside the journal, only the two flash pages of at most one motion page may differ. They must hold a slot's data. */
static void must_be_one_page(void)
{
    const uint8_t *now = fake_flash_bytes();
    ASSERT(memcmp(before, now, MEM_JOURNAL_START) == 0);
    ASSERT(memcmp(before + MEM_BOOT_START, now + MEM_BOOT_START, 0x2000) == 0);
    unsigned changed = 0;
    for (unsigned page = 0; page < 128; page++) {
        const unsigned at = MEM_MOTION_START + 512 * page;
        bool known = false;
        if (memcmp(before + at, now + at, 512) == 0) {
            continue;
        }
        for (unsigned slot = 0; slot < JOURNAL_SLOTS; slot++) {
            known |= memcmp(now + at, before + MEM_JOURNAL_START + 768 * slot, 512) == 0;
        }
        ASSERT(known);
        changed++;
    }
    ASSERT(changed <= 1);
}

static void must_save(uint8_t page)
{
    static uint8_t data[512];
    for (unsigned i = 0; i < sizeof data; i++) {
        data[i] = (uint8_t)(i * 7 + page);
    }
    ASSERT(journal_save(page, data) == FLASH_OK);
    ASSERT(memcmp(fake_flash_bytes() + MEM_MOTION_START + 512u * page, data, 512) == 0);
    uint8_t work[JOURNAL_TARGET_BYTES];
    ASSERT(journal_recover(work) == JOURNAL_CLEAN);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    fuzz_t fuzz = {data, data + size};
    uint8_t work[JOURNAL_TARGET_BYTES];
    jmp_buf cut;
    fake_flash_reset();
    const uint8_t good = fuzz_byte(&fuzz), mishaps = fuzz_byte(&fuzz);
    const uint16_t sequence = fuzz_word(&fuzz);
    for (uint8_t slot = 0; slot < JOURNAL_SLOTS; slot++) {
        make_slot(slot, (good & 1u << slot % 8) != 0, sequence, &fuzz);
    }
    memcpy(before, fake_flash_bytes(), sizeof before);
    if ((mishaps & 1) != 0) {
        const uint8_t operation = (uint8_t)(1 + fuzz_byte(&fuzz) % 6);
        const fake_flash_phase_t phase = (fake_flash_phase_t)(fuzz_byte(&fuzz) % 3);
        fake_flash_cut(operation, phase, fuzz_byte(&fuzz), &cut);
    }
    if ((mishaps & 2) != 0) {
        const uint16_t page = fuzz_word(&fuzz);
        fake_flash_break(page % 0x1E0, (uint8_t)(1 + fuzz_byte(&fuzz) % 3));
    }
    volatile bool whole = false;
    if (setjmp(cut) == 0) {
        whole = journal_recover(work) != JOURNAL_FAILED;
    }
    fake_flash_cut(0, FAKE_FLASH_BEFORE, 0, NULL);
    fake_flash_break(0, 0);
    if (!whole) {
        whole = journal_recover(work) != JOURNAL_FAILED;
    }
    must_be_one_page();
    ASSERT(whole);
    const uint32_t operations = fake_flash_ops();
    ASSERT(journal_recover(work) == JOURNAL_CLEAN);
    /* Only a torn mark is completed, and only once. */
    ASSERT(journal_recover(work) == JOURNAL_CLEAN && fake_flash_ops() <= operations + 1);
    must_save(fuzz_byte(&fuzz) & 127);
    return 0;
}
