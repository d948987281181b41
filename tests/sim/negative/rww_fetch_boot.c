/* SPDX-License-Identifier: MIT */
#include "negative.h"

/* Calls the application section after an erase in it, without enabling it again. The test puts a RET at 0x100. */
static void NOINLINE call_application(void)
{
    boot_page_erase(PAGE);
    boot_spm_busy_wait();
    if (!WRONG) {
        boot_rww_enable();
    }
    ((void (*)(void))(0x100 / 2))();
}

int main(void)
{
    console_on();
    call_application();
    finish();
}
