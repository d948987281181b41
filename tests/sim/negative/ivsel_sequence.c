/* SPDX-License-Identifier: MIT */
#include "negative.h"

static void NOINLINE move_vectors(void)
{
    if (!WRONG) {
        MCUCR = _BV(IVCE);
    }
    MCUCR = _BV(IVSEL);
}

int main(void)
{
    console_on();
    move_vectors();
    finish();
}
