/* SPDX-License-Identifier: MIT
 * cmd_check.c - CHECK finds mistakes in the stored pages: damage, links to no page, partners that cannot be blended,
 * unreachable pages, positions outside a servo's limits, steps faster than a servo. */
#include "bus_call.h"
#include "commands.h"
#include "dxl.h"
#include "page_facts.h"
#include "pgm.h"
#include "report.h"
#include "system.h"
#include "text.h"

/* The links, then the partners for blending. */
static const uint8_t link_fields[] PROGMEM = { PAGE_AT_NEXT_PAGE, PAGE_AT_EXIT_PAGE, PAGE_AT_LINKED1_PAGE,
                                               PAGE_AT_LINKED2_PAGE, PAGE_AT_BLEND_RIGHT, PAGE_AT_BLEND_LEFT };
enum { LINKS = 4, FIELDS = sizeof link_fields };

/* Kicks the watchdog: one page may print 200 lines of 9 ms each and ask 31 servos that answer late or not at all. */
static void begin_line(uint8_t page)
{
    system_kick();
    TEXT("Page ");
    text_padded(page, 3, ' ');
    TEXT(": ");
}

static void begin_step(uint8_t page, uint8_t step, uint8_t joint)
{
    begin_line(page);
    text_P_number(TEXT_P("step "), step);
    text_P_number(TEXT_P(" ID "), joint);
    text_put(' ');
}

static void check_links(uint8_t page)
{
    uint8_t own_steps = page_store_byte(page, PAGE_AT_STEPS);
    for (uint8_t i = 0; i < FIELDS; i++) {
        bool is_link = i < LINKS;
        uint8_t to = page_store_byte(page, pgm_read_byte(&link_fields[i]));
        bool good = page_store_is_good(&the_pages, to);
        uint8_t steps = good ? page_store_byte(to, PAGE_AT_STEPS) : 0;
        if (to == 0 || steps == own_steps || (is_link && steps != 0)) {
            continue;
        }
        begin_line(page);
        text_P_number(is_link ? TEXT_P("leads to page ") : TEXT_P("blends with page "), to);
        text_P(!good        ? TEXT_P(", which is not valid")
               : steps == 0 ? TEXT_P(", which has no steps")
                            : TEXT_P(", which has another number of steps"));
        text_line_end();
    }
}

static bool leads_to(uint8_t from, uint8_t page)
{
    for (uint8_t i = 0; i < FIELDS; i++) {
        if (page_store_byte(from, pgm_read_byte(&link_fields[i])) == page) {
            return true;
        }
    }
    return false;
}

static void check_reach(uint8_t page)
{
    if (page_store_byte(page, PAGE_AT_PLAY_CODE) != 0) {
        return;
    }
    for (uint16_t other = 1; other < PAGE_COUNT; other++) {
        const uint8_t from = (uint8_t)other;
        if (from != page && page_store_is_good(&the_pages, from) && leads_to(from, page)) {
            return;
        }
    }
    begin_line(page);
    TEXT("no code and no other page calls it");
    text_line_end();
}

static void check_speed(uint8_t page)
{
    page_facts_t facts;
    uint8_t steps = page_store_byte(page, PAGE_AT_STEPS);
    uint8_t supply_dv = the_servos.voltage_dv != 0 ? the_servos.voltage_dv : PAGE_FACTS_BATTERY_DV;
    uint16_t fastest_deg_s = PAGE_FACTS_FASTEST_DEG_S(supply_dv);
    for (uint8_t step = 0; step < steps; step++) {
        page_facts_step(page, step, &facts);
        uint16_t deg_s = page_facts_deg_s(&facts);
        if (deg_s > fastest_deg_s) {
            begin_step(page, step, facts.joint);
            text_P_number(TEXT_P("too fast, "), deg_s);
            TEXT(" degrees/s");
            text_line_end();
        }
    }
}

static void check_joint(uint8_t page, uint8_t joint)
{
    uint8_t limits[4];
    uint8_t steps = page_store_byte(page, PAGE_AT_STEPS);
    system_kick();
    if (bus_call_read(joint, DXL_AT_CW_LIMIT, limits, sizeof limits, NULL) != BUS_OK) {
        return;
    }
    uint16_t low = page_word(limits), high = page_word(limits + 2);
    for (uint8_t step = 0; step < steps; step++) {
        uint16_t pos = page_facts_word(page, step, joint);
        uint16_t goal = servo_link_to_servo(&the_servos, joint, pos & PAGE_POS_MAX);
        if (pos <= PAGE_POS_MAX && (goal < low || goal > high)) {
            begin_step(page, step, joint);
            TEXT("outside the servo's limits");
            text_line_end();
        }
    }
}

static void check_page(uint8_t page)
{
    page_status_t status = page_store_check(&the_pages, page);
    if (status != PAGE_OK) {
        begin_line(page);
        text_P(report_page_fault_P(status));
        text_line_end();
        return;
    }
    if (page_store_byte(page, PAGE_AT_STEPS) == 0) {
        return;
    }
    check_links(page);
    check_reach(page);
    check_speed(page);
    for (uint8_t joint = 0; joint < PAGE_JOINTS; joint++) {
        if (robot_has(joint)) {
            check_joint(page, joint);
        }
    }
}

static bool check_item(uint16_t item)
{
    const uint8_t page = (uint8_t)(item + the_dialog.list_first);
    if (item + the_dialog.list_first > the_dialog.list_last) {
        return false;
    }
    if (!performer_is_idle(&the_performer)) {   /* a program has begun a motion between two pages */
        TEXT("Something moves");
        text_line_end();
        return false;
    }
    servo_link_quiet(&the_servos);
    if (page != 0 && !session_is_empty(page)) {
        check_page(page);
    }
    return true;
}

COMMAND(cmd_check)
{
    the_dialog.list_first = (uint8_t)args->number[0];
    the_dialog.list_last = args->count > 1 ? (uint8_t)args->number[0] : PAGE_COUNT - 1u;
    return dialog_list(check_item, TEXT_P("Checked:"));
}
