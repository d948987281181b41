/* SPDX-License-Identifier: MIT */
#include "button.h"

#include "uart.h"
#include BOOT_PORTS_H

#include <stdbool.h>

#define STEADY_TICKS UART_TICKS(10)

static bool was_pressed;       /* at the last look */
static uint16_t changed_ticks; /* clock of its last change */

button_t button_look(void)
{
    bool is_pressed = PORTS_START_PRESSED();
    if (is_pressed != was_pressed) {
        was_pressed = is_pressed;
        changed_ticks = uart_clock();
    }
    if (uart_since(changed_ticks) < STEADY_TICKS) {
        return BUTTON_BOUNCING;
    }
    return is_pressed ? BUTTON_DOWN : BUTTON_UP;
}
