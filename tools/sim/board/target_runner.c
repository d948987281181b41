/* SPDX-License-Identifier: MIT
 * target_runner IMAGE.hex [SECONDS] - runs a Unity program of build/firmware/tests on the strict board and shows its
 * console. Exit status 0: the program printed "target: done, 0 failed" and the board found no violation; 1: a test
 * failed, or the program ended or hung without that line; 2: it could not be run. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "board.h"
#include "board_ports.h"

#define LIMIT_SECONDS 120u /* simulated; far above the longest test */
#define DONE "target: done, "

static void show(void *context, uint64_t now_cycles, uint8_t byte, bool bad)
{
    (void)context;
    (void)now_cycles;
    putchar(bad ? '?' : byte);
}

static bool said(const board_t *board, const char *text)
{
    size_t count;
    const uint8_t *output = board_console_output(board, &count);
    size_t length = strlen(text);
    for (size_t i = 0; count >= length && i <= count - length; i++) {
        if (memcmp(output + i, text, length) == 0) {
            return true;
        }
    }
    return false;
}

static int judge(board_t *board, board_stop_t stop, unsigned seconds)
{
    const violation_t *violation = board_violation(board);
    if (stop == BOARD_STOP_TEXT) {
        board_run(board, 10 * BOARD_CYCLES_PER_MS); /* the rest of the line */
        putchar('\n');
        return said(board, DONE "0 failed") ? 0 : 1;
    }
    if (violation->kind != VIOLATION_NONE) {
        printf("\nviolation %s at cycle %llu, pc 0x%05X in %s: %s\n", violation_name(violation->kind),
               (unsigned long long)violation->cycle, (unsigned)violation->pc, violation->function, violation->text);
    } else {
        printf("\nno \"" DONE "\" within %u simulated seconds\n", seconds);
    }
    return 1;
}

int main(int count, char **arguments)
{
    unsigned seconds = count > 2 ? (unsigned)strtoul(arguments[2], NULL, 10) : LIMIT_SECONDS;
    if (count < 2 || seconds == 0) {
        fprintf(stderr, "usage: target_runner IMAGE.hex [SECONDS]\n");
        return 2;
    }
    board_t *board = board_new(BOARD_CM5, 1);
    if (!board || !board_load(board, arguments[1], 0)) {
        fprintf(stderr, "target_runner: %s\n", board ? board_error(board) : "no simulated ATmega128");
        board_free(board);
        return 2;
    }
    board_on_console(board, show, NULL);
    board_power_on(board);
    board_stop_on_text(board, DONE);
    int status = judge(board, board_run(board, (uint64_t)seconds * 1000 * BOARD_CYCLES_PER_MS), seconds);
    board_free(board);
    return status;
}
