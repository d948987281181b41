/* SPDX-License-Identifier: MIT
 * report_event.c - Play's sentences for events. Edit has shorter ones of its own. */
#include "report.h"

#include "compiler.h"
#include "dxl.h"
#include "link.h"
#include "page_store.h"
#include "text.h"

void report_servo_errors(uint8_t errors)
{
    TEXT_NAMED(voltage, "voltage");
    TEXT_NAMED(angle, "angle limit");
    TEXT_NAMED(heat, "overheating");
    TEXT_NAMED(overload, "overload");
    static const struct {
        uint8_t bit;
        const char *name_P;
    } names[] PROGMEM = {
        {DXL_ERR_VOLTAGE, voltage}, {DXL_ERR_ANGLE, angle}, {DXL_ERR_HEAT, heat}, {DXL_ERR_OVERLOAD, overload}};
    bool first = true;
    for (uint8_t i = 0; i < ARRAY_COUNT(names); i++) {
        if ((errors & pgm_read_byte(&names[i].bit)) != 0) {
            if (!first) {
                TEXT(", ");
            }
            first = false;
            text_P((const char *)pgm_read_ptr(&names[i].name_P));
        }
    }
    if (first) {
        TEXT("no error");
    }
}

void report_page(uint8_t page)
{
    char name[PAGE_NAME_BYTES];
    text_P_number(TEXT_P("page "), page);
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

/* ---- one function per sentence or group of sentences ---- */

static void report_servo(uint8_t id, const char *what_P)
{
    text_P_number(TEXT_P("Servo "), id);
    text_P(what_P);
}

static void report_start(uint8_t page, uint8_t seconds)
{
    text_P_number(page == 0 ? TEXT_P("Moving, ") : TEXT_P("Going to the first pose, "), seconds);
    TEXT(" s");
}

static void report_step(uint8_t page, uint8_t step, uint8_t repetition)
{
    if (step == 1) {
        TEXT("Playing ");
        report_page(page);
    } else {
        text_P_number(TEXT_P("Page "), page);
    }
    text_P_number(TEXT_P(" step "), step);
    text_P_number(TEXT_P(" repetition "), repetition);
}

static void report_link(uint8_t link_page, uint8_t link_taken)
{
    TEXT_NAMED(next, "Next link to ");
    TEXT_NAMED(exit, "Exit link to ");
    TEXT_NAMED(linked1, "Link 1 to ");
    TEXT_NAMED(linked2, "Link 2 to ");
    TEXT_NAMED(none, "No link to ");
    static const char *const names[] PROGMEM = {
        [LINK_NEXT] = next, [LINK_EXIT] = exit, [LINK_LINKED1] = linked1, [LINK_LINKED2] = linked2, [LINK_ENDED] = none,
    };
    if (link_taken == LINK_END_OF_EXIT_LOOP) {
        TEXT("The exit pages lead back to themselves");
        return;
    }
    text_P(pgm_read_ptr(&names[link_taken]));
    if (link_page == 0) {
        TEXT("the end");
    } else {
        report_page(link_page);
    }
}

static void report_end(uint8_t page, uint8_t fault, uint8_t reason)
{
    switch (reason) {
    case PERFORMER_END_PAGE:
        TEXT("Ended. ");
        report_bad_page(page, fault);
        return;
    case PERFORMER_END_THERE:
        TEXT("The pose is reached");
        return;
    case PERFORMER_END_DONE:
        TEXT("Ended after ");
        break;
    case PERFORMER_END_BROKEN:
        TEXT("Broken off in ");
        break;
    case PERFORMER_END_SERVO:
        TEXT("Ended for the fault of a servo in ");
        break;
    default:
        TEXT("Stopped after ");
        break;
    }
    if (page == 0) {
        TEXT("a move");
    } else {
        report_page(page);
    }
}

void report_event(const performer_event_t *event)
{
    const uint8_t a = event->a;
    switch (event->kind) {
    case PERFORMER_EV_APPROACH:
        report_start(a, event->b);
        break;
    case PERFORMER_EV_STEP:
        report_step(a, event->b, event->c);
        break;
    case PERFORMER_EV_LINK:
        report_link(a, event->b);
        break;
    case PERFORMER_EV_PAUSED:
        TEXT("Paused");
        break;
    case PERFORMER_EV_ENDED:
        report_end(a, event->b, event->c);
        break;
    case PERFORMER_EV_SILENT: report_servo(a, TEXT_P(" does not answer")); break;
    case PERFORMER_EV_BACK: report_servo(a, TEXT_P(" answers again")); break;
    case PERFORMER_EV_ERRORS:
        report_servo(a, TEXT_P(" reports "));
        report_servo_errors(event->b);
        break;
    case PERFORMER_EV_TORQUE: report_servo(a, TEXT_P(" has lost its torque")); break;
    case PERFORMER_EV_UNREADY:
        report_servo(a, event->b != 0 ? TEXT_P(" is outside its angle limits: move it by hand") : TEXT_P(" does not obey"));
        break;
    case PERFORMER_EV_HOT:
        report_servo(a, TEXT_P(" is hot: "));
        text_number(event->b);
        TEXT(" C");
        break;
    case PERFORMER_EV_COOL:
        TEXT("No servo is hot any more");
        break;
    case PERFORMER_EV_BATTERY:
        TEXT("Battery is low: ");
        report_voltage(a);
        break;
    case PERFORMER_EV_LAYER_ENDED:
        TEXT("The layer ended after ");
        report_page(a);
        break;
    case PERFORMER_EV_TICKS_LATE:
        TEXT("The computer came 0.1 s late: breaking off");
        break;
    case PERFORMER_EV_BUS_LOST:
        TEXT("The servo adapter is gone: plug it in, then on");
        break;
    case PERFORMER_EV_DRIVE_LOST:
        TEXT("Nobody drives any more: stopping");
        break;
    default:
        text_number(a);
        TEXT(" messages were dropped");
        break;
    }
}
