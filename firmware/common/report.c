/* SPDX-License-Identifier: MIT */
#include "report.h"

#include "dxl.h"
#include "link.h"
#include "page_store.h"
#include "text.h"

void report_page_fault(uint8_t page_status)
{
    switch (page_status) {
    case PAGE_OK:
        TEXT("nothing");
        break;
    case PAGE_ERR_CHECKSUM:
        TEXT("checksum is wrong");
        break;
    case PAGE_ERR_STEPS:
        TEXT("more than 7 steps");
        break;
    case PAGE_ERR_SCHEDULE:
        TEXT("unknown schedule");
        break;
    case PAGE_ERR_SPEED:
        TEXT("page speed is 0");
        break;
    case PAGE_ERR_LINK:
        TEXT("a link is above 127");
        break;
    case PAGE_ERR_POSITION:
        TEXT("a position is above 1023");
        break;
    default:
        TEXT("no action");
        break;
    }
}

/* "Page 9 is damaged: checksum is wrong". */
static void report_bad_page(uint8_t page, uint8_t fault)
{
    TEXT("Page ");
    text_number(page);
    if (fault == PAGE_EMPTY || page_store_is_erased(page)) {
        TEXT(" is empty");
        return;
    }
    TEXT(" is damaged: ");
    report_page_fault(fault);
}

void report_refusal(performer_status_t status, uint8_t page, uint8_t fault)
{
    switch (status) {
    case PERFORMER_OK:
        break;
    case PERFORMER_ERR_RANGE:
        TEXT("Page must be 1..127");
        break;
    case PERFORMER_ERR_PAGE:
    case PERFORMER_ERR_EMPTY:
        report_bad_page(page, fault);
        break;
    case PERFORMER_ERR_BUSY:
        TEXT("Busy: stop what is playing first");
        break;
    case PERFORMER_ERR_NO_SERVOS:
        TEXT("No servo answers: check power and cable, then search again");
        break;
    case PERFORMER_ERR_LAW:
        TEXT("This image has no classic law: set law 0");
        break;
    default:
        TEXT("All servos were switched off: switch them on first");
        break;
    }
}

void report_servo_errors(uint8_t errors)
{
    static const char voltage[] PROGMEM = "voltage", angle[] PROGMEM = "angle limit", heat[] PROGMEM = "overheating",
                      range[] PROGMEM = "range", checksum[] PROGMEM = "checksum", overload[] PROGMEM = "overload",
                      instruction[] PROGMEM = "instruction";
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

void report_joints(uint32_t joints)
{
    bool first = true;
    for (uint8_t id = 0; id < PAGE_JOINTS; id++) {
        if ((joints & servo_link_bit(id)) == 0) {
            continue;
        }
        uint8_t last = id;
        while (last + 1u < PAGE_JOINTS && (joints & servo_link_bit(last + 1u)) != 0) {
            last++;
        }
        if (!first) {
            text_put(' ');
        }
        first = false;
        text_number(id);
        if (last > id) {
            text_put('-');
            text_number(last);
        }
        id = last;
    }
    if (first) {
        TEXT("none");
    }
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
        text_P(event->a == 0 ? PSTR("Moving, ") : PSTR("Going to the first pose, "));
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
    case PERFORMER_EV_LOST:
        text_number(event->a);
        TEXT(" messages were dropped");
        break;
    default:
        break;
    }
}
