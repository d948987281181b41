/* SPDX-License-Identifier: MIT */
#include "prompt.h"

#include "block.h"
#include "button.h"
#include "memory.h"
#include "parse.h"
#include "stk500.h"
#include "print.h"
#include "uart.h"
#include "words.h"

#include <avr/wdt.h>

#define LINE_BYTES 80
#define SYNC_TICKS UART_TICKS(20)   /* between the two bytes of a sync */
#define LF_TICKS UART_TICKS(2)      /* CR LF from one write() of a PC */

enum { BACKSPACE = 8, ESC = 27, CR = 13, LF = 10 };

static char line[LINE_BYTES];
static uint8_t length;
static bool is_binary;    /* the line has bytes that nobody types, so it is not a command */
static bool was_released; /* START has been up since the prompt appeared */

static void prompt(void)
{
    PUT("\r\n - ");
    length = 0;
    is_binary = false;
    was_released = false;
    memory_app_came = false;
}

static void __attribute__((noinline)) run_line(void)
{
    parse_t parsed;
    line[length] = 0;
    if (is_binary) {
        line[0] = 1;
    }
    parse_status_t status = parse_line(line, &parsed);
    if (*parsed.word != 0) {
        words_run(&parsed, status);
    }
    prompt();
}

/* true: the byte began a binary protocol, and its session is over. */
static bool is_protocol(uint8_t byte)
{
    if (byte == FRAME_REQUEST) {
        block_session();
        return true;
    }
    if (byte == PROMPT_SYNC_1 && length == 0 && uart_wait_for(PROMPT_SYNC_2, SYNC_TICKS)) {
        stk500_session();
        return true;
    }
    return false;
}

static void edit_line(uint8_t byte)
{
    if (byte == 0 || byte == ESC) {
        return;
    }
    if (byte == BACKSPACE) {
        if (length > 0) {
            PUT("\b \b");
            length--;
        }
    } else if (length < LINE_BYTES - 1) {
        is_binary |= (byte < ' ' && byte != '\t') || byte > '~';
        line[length++] = byte;
        uart_put(byte);
    }
}

/* START at the prompt means GO, unless it has been down since before the prompt appeared. */
static void watch_start(void)
{
    button_t start = button_look();
    if (start == BUTTON_UP) {
        was_released = true;
    } else if (start == BUTTON_DOWN && was_released) {
        PUT("GO");
        words_go(0, false);
        prompt();
    }
}

void prompt_run(bool stk500)
{
    if (stk500) {
        stk500_session();
    } else {
        PUT("\r\n\n SYSTEM O.K. (Motion512 Boot loader V1.00)");
    }
    prompt();
    for (;;) {
        wdt_reset();
        watch_start();
        if (!uart_has()) {
            continue;
        }
        uint8_t byte = uart_next();
        if (is_protocol(byte)) {
            prompt();
        } else if (byte == CR || byte == LF) {
            if (byte == CR) {
                (void)uart_wait_for(LF, LF_TICKS);
            }
            run_line();
        } else {
            edit_line(byte);
        }
    }
}
