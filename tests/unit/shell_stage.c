/* SPDX-License-Identifier: MIT */
#include "shell_stage.h"

#include <string.h>
#include "unity.h"

shell_t shell;
char line[LINE_BYTES];
char out[256];
static char history[HISTORY_BYTES];
static uint16_t out_count;

TEXT_NAMED(name_page, "Page");
TEXT_NAMED(name_rate, "Rate");
TEXT_NAMED(name_blend, "Blend");
static const shell_range_t ranges_P[] PROGMEM = {{name_page, 1, 127}, {name_rate, 10, 400}, {name_blend, -100, 100}};

const shell_range_t *shell_range_P(uint8_t range)
{
    return &ranges_P[range - 1];
}

static void capture(char character)
{
    if (out_count < sizeof out - 1) {
        out[out_count++] = character;
        out[out_count] = '\0';
    }
}

void clear_out(void)
{
    memset(out, 0, sizeof out);
    out_count = 0;
}

void setUp(void)
{
    text_init(capture);
    shell_init(&shell, line, sizeof line, history, sizeof history);
    clear_out();
}

shell_event_t keys(const char *bytes)
{
    shell_event_t event = SHELL_TYPING;
    while (*bytes != '\0') {
        event = shell_byte(&shell, (uint8_t)*bytes++);
    }
    return event;
}

shell_args_t enter(const char *text)
{
    TEST_ASSERT_EQUAL_UINT8(SHELL_TYPING, keys(text));
    TEST_ASSERT_EQUAL_UINT8(SHELL_LINE, keys("\r"));
    shell_args_t args;
    shell_split(&shell, false, &args);
    return args;
}
