/* SPDX-License-Identifier: MIT */
#include "negative.h"

/* The test first sets the wear of this page to the limit (wrong) or one below it (right). */
static void NOINLINE erase_once_more(void)
{
    boot_page_erase(WRONG ? PAGE : PAGE + 0x100u);
    boot_spm_busy_wait();
    boot_rww_enable();
}

int main(void)
{
    console_on();
    erase_once_more();
    finish();
}
