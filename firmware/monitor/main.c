/* SPDX-License-Identifier: MIT
 * main.c - Monitor: the image for setting up servos. Lines in, packets out; nothing moves by itself. */
#include "board.h"
#include "console.h"
#include "monitor.h"
#include "report.h"
#include "system.h"
#include "text.h"

static shell_t shell;
static char line[112], history[96];

static void put(char character)
{
    console_write(&character, 1);
}

static void take(uint8_t byte)
{
    shell_event_t event = shell_byte(&shell, byte);
    if (event == SHELL_TYPING) {
        return;
    }
    text_line_end();
    if (event == SHELL_LINE) {
        monitor_line(&shell);
    } else {
        shell_print_refusal(shell.fault);
        text_line_end();
    }
    shell_clear(&shell);
    monitor_prompt();
}

int main(void)
{
    uint8_t byte;
    board_start();
    text_init(put);
    console_set_flow(true);
    shell_init(&shell, line, sizeof line, history, sizeof history);
    monitor_init();
    text_line_end();
    report_failed_assert();
    TEXT("Motion512 Monitor. HELP lists the words, EXIT restarts.");
    text_line_end();
    monitor_prompt();
    for (;;) {
        system_kick();
        if (console_get(&byte)) {
            shell_lose(&shell, console_lost());
            take(byte);
        } else {
            board_idle();
        }
    }
}
