/* SPDX-License-Identifier: MIT
 * Edit as a whole; fuzz_image.h describes the input. Flash may change only in the journal and the motions, EEPROM
 * only in the settings and the loader's bytes. Afterwards every page is as valid as before, or better. */
#include "fuzz_image.h"
#include "fake_eeprom.h"
#include "fake_flash.h"
#include "linker/memory_map.h"
#include "page.h"
#include "trap.h"

#include <stdbool.h>
#include <string.h>

#define main image_main
#include "firmware/edit/main.c"
#undef main

/* Leaves any mode: Ctrl-C ends plays and lines, ESC lists and questions, Ctrl-U CR a program's line. Then sends a
   request. */
const char *fuzz_image_last_words(unsigned k)
{
    static const char *const words[] = {"\x03", "\x1B", "\x15\r", "\x03", "@where\r"};
    return k < 5 ? words[k] : NULL;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static uint8_t before[MEM_BOOT_END];
    fake_flash_reset();
    fuzz_image_pages();
    memcpy(before, fake_flash_bytes(), sizeof before);
    if (fuzz_image_run(data, size)) {
        ASSERT(strstr(fuzz_image_said(), "OK") != NULL);
    }
    const uint8_t *after = fake_flash_bytes();
    ASSERT(memcmp(before, after, MEM_JOURNAL_START) == 0);
    ASSERT(memcmp(before + MEM_BOOT_START, after + MEM_BOOT_START, MEM_BOOT_END - MEM_BOOT_START) == 0);
    for (unsigned at = MEM_MOTION_START; at < MEM_MOTION_END; at += PAGE_BYTES) {
        ASSERT(memcmp(before + at, after + at, PAGE_BYTES) == 0 || page_check(after + at) != PAGE_ERR_CHECKSUM);
    }
    for (unsigned i = MEM_EE_SETTINGS_END; i < MEM_EE_LOADER; i++) {
        ASSERT(fake_eeprom_bytes()[i] == 0xFF);
    }
    return 0;
}
