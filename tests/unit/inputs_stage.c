/* SPDX-License-Identifier: MIT */
#include "inputs_stage.h"

#include <stdio.h>
#include <string.h>
#include "fake_console.h"
#include "fake_panel.h"
#include "panel.h"
#include "unity.h"

inputs_t inputs;
performer_t performer;
page_store_t pages;
char told[128];
uint8_t start_status, partner;

/* ---- performer and page store, as far as inputs uses them ---- */

static void note(const char *word, int a, int b)
{
    char text[32];
    snprintf(text, sizeof text, "%s %d %d;", word, a, b);
    strncat(told, text, sizeof told - strlen(told) - 1);
}

performer_status_t performer_start(performer_t *p, uint8_t page, uint8_t code)
{
    note("start", page, code);
    if (start_status == PERFORMER_OK) {
        p->state = PERFORMER_PLAY;
        p->link.held_code = code;
    }
    return (performer_status_t)start_status;
}

void performer_code(performer_t *p, uint8_t code)
{
    note("code", code, 0);
    if (code == LINK_CODE_STOP) {
        p->since_stop_ticks = 0;
    } else {
        p->link.held_code = code;
    }
}

void performer_stop(performer_t *p)
{
    note("stop", 0, 0);
    p->since_stop_ticks = 0;
}

bool performer_pause(performer_t *p)
{
    if (p->state != PERFORMER_PLAY) {
        return false;
    }
    note("pause", 0, 0);
    p->state = PERFORMER_APPROACH; /* anything but PLAY */
    return true;
}

bool performer_resume(performer_t *p)
{
    note("resume", 0, 0);
    p->state = PERFORMER_PLAY;
    return true;
}

uint8_t page_store_find_code(const page_store_t *store, uint8_t code)
{
    (void)store;
    return code == 16 ? 5 : code == 1 ? 2 : 0;
}

static void read_page(void *context, uint8_t page, uint16_t offset, void *to, uint8_t count)
{
    (void)context;
    (void)page;
    (void)offset;
    memset(to, 0, count);
    ((uint8_t *)to)[0] = partner;
}

static const page_source_t source = {.read = read_page};

/* ---- for the tests ---- */

void setUp(void)
{
    fake_console_reset();
    fake_panel_reset();
    panel_init();
    memset(&performer, 0, sizeof performer);
    memset(told, 0, sizeof told);
    performer.source = &source;
    performer.since_stop_ticks = UINT8_MAX;
    shape_init(&performer.shape);
    partner = 0;
    start_status = PERFORMER_OK;
    inputs_init(&inputs, &performer, &pages);
    ticks(INPUTS_SILENCE_TICKS);   /* no button is held at the start */
}

void remote(uint16_t buttons)
{
    const uint8_t low = (uint8_t)buttons, high = (uint8_t)(buttons >> 8);
    const uint8_t packet[] = {0xFF, 0x55, low, (uint8_t)~low, high, (uint8_t)~high};
    fake_console_type_bytes(packet, sizeof packet);
    inputs_take(&inputs);
}

void ticks(uint8_t count)
{
    while (count-- > 0) {
        performer.since_stop_ticks = (uint8_t)(performer.since_stop_ticks + (performer.since_stop_ticks < UINT8_MAX));
        panel_tick();
        inputs_tick(&inputs);
        inputs_take(&inputs);
    }
}
