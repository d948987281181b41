/* SPDX-License-Identifier: MIT */
#include "editor_stage.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>
#include "bus.h"
#include "console.h"
#include "fake_eeprom.h"
#include "fake_system.h"
#include "fake_time.h"
#include "frame.h"
#include "memory_map.h"
#include "page_service.h"
#include "text.h"
#include "unity.h"

enum { TURN_HALF_US = 1000, TURNS_A_TICK_MAX = 1000, ROOM_A_TURN = 3 };   /* 57,600 baud: 5.8 bytes a ms */

page_store_t the_pages;
servo_link_t the_servos;
performer_t the_performer;
settings_t the_settings;
settings_store_t the_settings_store;

/* ---- page_service.h: our loader is installed; fake_flash does the writes ---- */

page_service_kind_t page_service_kind(void)
{
    return PAGE_SERVICE_OURS;
}

bool page_service_post(uint8_t motion_page, const uint8_t data[512])
{
    (void)data;
    return motion_page < PAGE_COUNT;
}

/* ---- the terminal ---- */

uint8_t cursor_row, cursor_column;
static char screen[TERMINAL_ROWS][TERMINAL_COLUMNS];
static bool written[TERMINAL_ROWS][TERMINAL_COLUMNS];
static uint32_t sent_count;
static char sequence[16];       /* ESC and what follows it, or empty */

static void put_on_terminal(char character)
{
    TEST_ASSERT_TRUE_MESSAGE(cursor_row >= 1 && cursor_row <= TERMINAL_ROWS, "written outside of the screen");
    if (cursor_column <= TERMINAL_COLUMNS) {
        screen[cursor_row - 1][cursor_column - 1] = character;
        written[cursor_row - 1][cursor_column - 1] = true;
        cursor_column++;
    }
}

static void obey_sequence(void)
{
    char *end;
    const long first = strtol(sequence + 2, &end, 10);
    const long second = *end == ';' ? strtol(end + 1, &end, 10) : 0;
    const uint8_t row = (uint8_t)(first < 1 ? 1 : first > TERMINAL_ROWS ? TERMINAL_ROWS : first);
    const uint8_t column = (uint8_t)(second < 1 ? 1 : second > TERMINAL_COLUMNS ? TERMINAL_COLUMNS : second);
    switch (*end) {
    case 'H':
        cursor_row = row;
        cursor_column = column;
        break;
    case 'C':
        cursor_column = (uint8_t)(cursor_column + (first < 1 ? 1 : first));
        break;
    case 'K':
        memset(&screen[cursor_row - 1][cursor_column - 1], ' ', (size_t)(TERMINAL_COLUMNS + 1 - cursor_column));
        break;
    case 'J':
        memset(screen, ' ', sizeof screen);
        break;
    case 'n':
        fake_console_type("\033[36;80R");
        break;
    default:
        TEST_FAIL_MESSAGE(sequence + 1);
    }
}

static void hear(char character)
{
    const size_t length = strlen(sequence);
    if (length > 0) {
        TEST_ASSERT_TRUE(length < sizeof sequence - 1);
        sequence[length] = character;
        sequence[length + 1] = '\0';
        if (length > 1 && isalpha((unsigned char)character)) {
            obey_sequence();
            sequence[0] = '\0';
        }
    } else if (character == '\033') {
        strcpy(sequence, "\033");
    } else if (character == '\r') {
        cursor_column = 1;
    } else if (character == '\n') {
        TEST_ASSERT_TRUE_MESSAGE(cursor_row < TERMINAL_ROWS, "the screen scrolls");
        cursor_row++;
    } else if (character == '\b') {
        cursor_column--;
    } else if ((unsigned char)character >= ' ') {
        put_on_terminal(character);
    }
}

static void take_output(void)
{
    const size_t count = fake_console_output_count();
    const char *bytes = fake_console_output();
    sent_count += (uint32_t)count;
    for (size_t i = 0; i < count; i++) {
        hear(bytes[i]);
    }
    fake_console_clear();
}

void clear_sent(void)
{
    memset(written, 0, sizeof written);
    sent_count = 0;
}

uint32_t sent(void)
{
    return sent_count;
}

bool was_written(uint8_t row, uint8_t column)
{
    return written[row - 1][column - 1];
}

const char *shown(uint8_t row, uint8_t column, uint8_t count)
{
    static char texts[2][TERMINAL_COLUMNS + 1];
    static uint8_t turn;
    char *text = texts[turn ^= 1];
    memcpy(text, &screen[row - 1][column - 1], count);
    text[count] = '\0';
    return text;
}

const char *message(void)
{
    static char text[TERMINAL_COLUMNS + 1];
    strcpy(text, shown(COMMAND_ROW, 3, TERMINAL_COLUMNS - 2));
    for (size_t length = strlen(text); length > 0 && text[length - 1] == ' '; length--) {
        text[length - 1] = '\0';
    }
    return text;
}

const char *cell(uint8_t x, uint8_t y)
{
    const bool is_position = y < PAGE_JOINTS && x <= PAGE_STEPS;
    return shown((uint8_t)(y + 1u), frame_cell_column(x, y), is_position ? 4 : 3);
}

/* ---- time ---- */

void run_ms(uint32_t ms)
{
    for (uint32_t turn = 0; turn < ms * 2000u / TURN_HALF_US; turn++) {
        fake_time_half_us(TURN_HALF_US);
        const uint8_t room = console_room();
        fake_console_set_room((uint8_t)(room + ROOM_A_TURN < CONSOLE_TX_BYTES ? room + ROOM_A_TURN : CONSOLE_TX_BYTES));
        for (uint16_t i = 0; editor_turn(); i++) {
            TEST_ASSERT_TRUE_MESSAGE(i < TURNS_A_TICK_MAX, "the editor does not come to rest");
            take_output();
        }
        take_output();
    }
}

void type(const char *text)
{
    fake_console_type(text);
    run_ms(500);
}

bool restarts(const char *text)
{
    jmp_buf restarted;
    fake_system_on_restart(&restarted);
    if (setjmp(restarted) != 0) {
        return true;
    }
    type(text);
    return false;
}

/* ---- the robot ---- */

uint8_t *flash_page(uint8_t page)
{
    return fake_flash_bytes() + MEM_MOTION_START + PAGE_BYTES * page;
}

static uint8_t *store(uint8_t number, const char *name, uint8_t steps)
{
    uint8_t *page = flash_page(number);
    page_clear(page);
    strcpy((char *)page, name);
    page[PAGE_AT_STEPS] = steps;
    for (uint8_t step = 0; step < steps; step++) {
        for (uint8_t joint = 1; joint <= 3; joint++) {
            page_set_pos(page, step, joint, (uint16_t)(400u + 10u * step + joint));
        }
        page[PAGE_AT_STEP0 + PAGE_STEP_BYTES * step + PAGE_STEP_AT_SPEED] = 20;
    }
    return page;
}

static void store_pages(void)
{
    page_seal(store(1, "one", 3));
    uint8_t *page = store(2, "two", 3);
    page[PAGE_AT_SPEED] = 40;
    page_set_pos(page, 0, 3, 503);
    page_seal(page);
    page = store(5, "slow", 2);
    page_set_pos(page, 1, 1, 600);
    page[PAGE_AT_STEP0 + PAGE_STEP_AT_SPEED] = page[PAGE_AT_STEP0 + PAGE_STEP_BYTES + PAGE_STEP_AT_SPEED] = 255;
    page[PAGE_AT_SPEED] = 128;
    page_seal(page);
}

static void put(char character)
{
    editor_put(character);
}

void setUp(void)
{
    fake_flash_reset();
    fake_eeprom_reset();
    fake_time_reset();
    fake_system_reset();
    fake_console_reset();
    fake_bus_reset();
    memset(screen, ' ', sizeof screen);
    cursor_row = cursor_column = 1;
    sequence[0] = '\0';
    store_pages();
    for (uint8_t id = 1; id <= 3; id++) {
        (void)fake_bus_add(id, BUS_RATE_1M);
    }
    page_store_init(&the_pages);
    (void)settings_load(&the_settings_store, &the_settings);
    text_init(put);
    servo_link_init(&the_servos);
    servo_link_scan(&the_servos);
    performer_init(&the_performer, &the_pages.source, &the_servos, &the_settings);
    editor_init(NULL);
    run_ms(2000);
    clear_sent();
}
