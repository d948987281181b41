/* SPDX-License-Identifier: MIT */
#include "negative.h"

/* A call into the application section that was erased somewhere and not enabled again. A RET stands at 0x100: the
 * test puts it there. */
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
