/* SPDX-License-Identifier: MIT */
#include "negative.h"

#ifndef SECOND
#define SECOND 0x4321
#endif

static void NOINLINE write_word(uint16_t word)
{
    boot_page_fill(PAGE, word);
    boot_page_write(PAGE);
    boot_spm_busy_wait();
}

/* Writes ones where the flash has zeros: only an erase can do that. */
static void NOINLINE overwrite(void)
{
    write_word(0x1234);
    if (!WRONG) {
        boot_page_erase(PAGE);
        boot_spm_busy_wait();
    }
    write_word(SECOND);
    boot_rww_enable();
}

int main(void)
{
    console_on();
    overwrite();
    finish();
}
