/* SPDX-License-Identifier: MIT */
#include "negative.h"

/* Reads the busy half. */
static uint8_t NOINLINE read_application(void)
{
    boot_page_erase(PAGE);
    boot_spm_busy_wait();
    if (!WRONG) {
        boot_rww_enable();
    }
    return pgm_read_byte_far(0x0E000);
}

int main(void)
{
    console_on();
    put((char)(read_application() & 0x7F));
    finish();
}
