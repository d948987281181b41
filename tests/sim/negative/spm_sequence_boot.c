/* SPDX-License-Identifier: MIT */
#include "negative.h"

/* SPM must follow SPMCSR within four cycles. */
static void NOINLINE late_erase(void)
{
    __asm__ volatile("sts %0, %1\n\t nop\n\t nop\n\t nop\n\t nop\n\t nop\n\t spm\n\t"
                     : : "i"(_SFR_MEM_ADDR(SPMCSR)), "r"((uint8_t)(_BV(PGERS) | _BV(SPMEN))), "z"(PAGE));
}

static void NOINLINE timely_erase(void)
{
    __asm__ volatile("sts %0, %1\n\t nop\n\t nop\n\t nop\n\t nop\n\t spm\n\t"
                     : : "i"(_SFR_MEM_ADDR(SPMCSR)), "r"((uint8_t)(_BV(PGERS) | _BV(SPMEN))), "z"(PAGE));
}

int main(void)
{
    console_on();
    if (WRONG) {
        late_erase();
    } else {
        timely_erase();
    }
    boot_spm_busy_wait();
    finish();
}
