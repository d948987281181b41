/* SPDX-License-Identifier: MIT */
#include "negative.h"

/* The word bits of Z must be zero for a page write. (An erase ignores them.) */
static void NOINLINE write_unaligned(void)
{
    boot_page_erase(PAGE + 0x22);
    boot_spm_busy_wait();
    boot_page_fill(PAGE, 0x1234);
    boot_page_write(WRONG ? PAGE + 2 : PAGE);
    boot_spm_busy_wait();
    boot_rww_enable();
}

int main(void)
{
    console_on();
    write_unaligned();
    finish();
}
