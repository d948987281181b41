/* SPDX-License-Identifier: MIT
 * Play as a whole; fuzz_image.h describes the input. Flash must not change (an erased journal needs no recovery),
 * EEPROM only in the settings. */
#include "fuzz_image.h"
#include "fake_eeprom.h"
#include "fake_flash.h"
#include "linker/memory_map.h"
#include "trap.h"

#include <string.h>

#define main image_main
#include "firmware/play/main.c"
#undef main

const char *fuzz_image_last_words(unsigned k)
{
    static const char *const words[] = {"\x15\r", "version\r"};
    return k < 2 ? words[k] : NULL;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static uint8_t before[MEM_BOOT_END];
    fake_flash_reset();
    fuzz_image_pages();
    memcpy(before, fake_flash_bytes(), sizeof before);
    if (fuzz_image_run(data, size)) {
        ASSERT(strstr(fuzz_image_said(), "Motion512") != NULL);
    }
    ASSERT(memcmp(before, fake_flash_bytes(), sizeof before) == 0);
    for (unsigned i = MEM_EE_SETTINGS_END; i < MEM_EEPROM_BYTES; i++) {
        ASSERT(fake_eeprom_bytes()[i] == 0xFF);
    }
    return 0;
}
