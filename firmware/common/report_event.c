/* SPDX-License-Identifier: MIT
 * report_event.c - the sentences about events: Play's. Edit has shorter ones of its own. */
#include "report.h"

#include "dxl.h"
#include "link.h"
#include "page_store.h"
#include "text.h"

void report_servo_errors(uint8_t errors)
{
    TEXT_NAMED(voltage, "voltage");
    TEXT_NAMED(angle, "angle limit");
    TEXT_NAMED(heat, "overheating");
    TEXT_NAMED(range, "range");
    TEXT_NAMED(checksum, "checksum");
    TEXT_NAMED(overload, "overload");
    TEXT_NAMED(instruction, "instruction");
    static const char *const names[] PROGMEM = {voltage, angle, heat, range, checksum, overload, instruction};
    bool first = true;
    for (uint8_t bit = 0; bit < sizeof names / sizeof names[0]; bit++) {
        if ((errors & (1u << bit)) != 0) {
            if (!first) {
                TEXT(", ");
            }
            first = false;
            text_P((const char *)pgm_read_ptr(&names[bit]));
        }
    }
    if (first) {
        TEXT("no error");
    }
}

void report_page(uint8_t page)
{
    char name[PAGE_NAME_BYTES];
    TEXT("page ");
    text_number(page);
    page_store_name(page, name);
    if (name[0] != '\0') {
        TEXT(" (");
        text_string(name);
        text_put(')');
    }
}

void report_voltage(uint8_t dv)
{
    text_number(dv / 10u);
    text_put('.');
    text_number(dv % 10u);
    TEXT(" V");
}

static void report_link(uint8_t to_page, uint8_t taken)
{
    switch (taken) {
    case LINK_EXIT:
        TEXT("Exit link");
        break;
    case LINK_LINKED1:
        TEXT("Link 1");
        break;
    case LINK_LINKED2:
        TEXT("Link 2");
        break;
    case LINK_ENDED:
        TEXT("No link");
        break;
    case LINK_END_OF_EXIT_LOOP:
        TEXT("The exit pages lead back to themselves");
        return;
    default:
        TEXT("Next link");
        break;
    }
    TEXT(" to ");
    if (to_page == 0) {
        TEXT("the end");
    } else {
        report_page(to_page);
    }
}

static void report_end(const performer_event_t *event)
{
    switch (event->c) {
    case PERFORMER_END_THERE:
        TEXT("The pose is reached");
        return;
    case PERFORMER_END_PAGE:
        TEXT("Ended. ");
        report_bad_page(event->a, event->b);
        return;
    case PERFORMER_END_STOPPED:
        TEXT("Stopped after ");
        break;
    case PERFORMER_END_BROKEN:
        TEXT("Broken off in ");
        break;
    case PERFORMER_END_LOOP:
        TEXT("Stopped after ");
        break;
    case PERFORMER_END_SERVO:
        TEXT("Ended for the fault of a servo in ");
        break;
    default:
        TEXT("Ended after ");
        break;
    }
    if (event->a == 0) {
        TEXT("a move");
    } else {
        report_page(event->a);
    }
}

static void report_step(const performer_event_t *event)
{
    if (event->b == 1) {
        TEXT("Playing ");
        report_page(event->a);
    } else {
        TEXT("Page ");
        text_number(event->a);
    }
    TEXT(" step ");
    text_number(event->b);
    TEXT(" repetition ");
    text_number(event->c);
}

static void report_servo(uint8_t id)
{
    TEXT("Servo ");
    text_number(id);
}

void report_event(const performer_event_t *event)
{
    switch (event->kind) {
    case PERFORMER_EV_APPROACH:
        text_P(event->a == 0 ? TEXT_P("Moving, ") : TEXT_P("Going to the first pose, "));
        text_number(event->b);
        TEXT(" s");
        break;
    case PERFORMER_EV_STEP:
        report_step(event);
        break;
    case PERFORMER_EV_LINK:
        report_link(event->a, event->b);
        break;
    case PERFORMER_EV_PAUSED:
        TEXT("Paused");
        break;
    case PERFORMER_EV_ENDED:
        report_end(event);
        break;
    case PERFORMER_EV_SILENT:
        report_servo(event->a);
        TEXT(" does not answer");
        break;
    case PERFORMER_EV_BACK:
        report_servo(event->a);
        TEXT(" answers again");
        break;
    case PERFORMER_EV_ERRORS:
        report_servo(event->a);
        TEXT(" reports ");
        report_servo_errors(event->b);
        break;
    case PERFORMER_EV_TORQUE:
        report_servo(event->a);
        TEXT(" has lost its torque");
        break;
    case PERFORMER_EV_BATTERY:
        TEXT("Battery is low: ");
        report_voltage(event->a);
        break;
    case PERFORMER_EV_HOT:
        report_servo(event->a);
        TEXT(" is hot: ");
        text_number(event->b);
        TEXT(" C");
        break;
    case PERFORMER_EV_LAYER_ENDED:
        TEXT("The layer ended after ");
        report_page(event->a);
        break;
    case PERFORMER_EV_DRIVE_LOST:
        TEXT("Nobody drives any more: stopping");
        break;
    case PERFORMER_EV_LOST:
        text_number(event->a);
        TEXT(" messages were dropped");
        break;
    default:
        break;
    }
}
