/* SPDX-License-Identifier: MIT */
#include "performer_stage.h"

#include <string.h>
#include "unity.h"

#define MAX_TICKS 5000u

uint8_t pages[PAGES][PAGE_BYTES];
servo_link_t servos;
settings_t settings;
performer_t performer;
layers_t layers;

static void read_page(void *context, uint8_t page, uint16_t offset, void *to, uint8_t count)
{
    (void)context;
    memcpy(to, &pages[page % PAGES][offset], count);
}

static uint8_t check_page(void *context, uint8_t page)
{
    (void)context;
    return (uint8_t)page_check(pages[page % PAGES]);
}

static const page_source_t source = {.context = NULL, .read = read_page, .check = check_page};

void make_page(uint8_t page, uint16_t pos, uint8_t next, uint8_t exit)
{
    page_clear(pages[page]);
    pages[page][PAGE_AT_STEPS] = 1;
    pages[page][PAGE_AT_NEXT_PAGE] = next;
    pages[page][PAGE_AT_EXIT_PAGE] = exit;
    page_set_pos(pages[page], 0, 1, pos);
    pages[page][PAGE_AT_STEP0 + PAGE_STEP_AT_SPEED] = 64;
    page_seal(pages[page]);
}

void setUp(void)
{
    for (uint8_t page = 0; page < PAGES; page++) {
        page_clear(pages[page]);
    }
    make_page(1, 612, 0, 0);
    make_page(2, 612, 2, 3); /* loops until a stop */
    make_page(3, 412, 0, 0);
    memset(&settings, 0, sizeof settings);
    settings.approach_deg_s = 60;
    settings.battery_low_dv = 100;
    settings.hot_degrees = 70;
    fake_servo_link_reset(&servos, ALL_THREE);
    performer_init(&performer, &source, &servos, &settings);
    performer_set_layers(&performer, &layers);
}

void ticks(uint16_t count)
{
    while (count-- > 0) {
        performer_tick(&performer);
        for (uint8_t i = 0; i < 4; i++) {
            performer_poll(&performer);
        }
    }
}

void reach(uint8_t state)
{
    for (uint16_t i = 0; performer.state != state; i++) {
        TEST_ASSERT_LESS_THAN_UINT16(MAX_TICKS, i);
        ticks(1);
    }
}

void start(uint8_t page, uint8_t code)
{
    TEST_ASSERT_EQUAL_UINT8(PERFORMER_OK, performer_start(&performer, page, code));
}

performer_event_t expect_event(uint8_t kind)
{
    performer_event_t event;
    while (performer_next_event(&performer, &event)) {
        if (event.kind == kind) {
            return event;
        }
    }
    TEST_FAIL_MESSAGE("the event did not come");
    return event;
}

bool has_event(uint8_t kind)
{
    performer_event_t event;
    while (performer_next_event(&performer, &event)) {
        if (event.kind == kind) {
            return true;
        }
    }
    return false;
}

uint8_t end_reason(void)
{
    return expect_event(PERFORMER_EV_ENDED).c;
}
