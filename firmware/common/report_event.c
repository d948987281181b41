/* SPDX-License-Identifier: MIT
 * report_event.c - Play's sentences for events. Edit has shorter ones of its own. */
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

/* Prints a part of the event where a sentence has one of these characters. */
static void report_part(char part, const performer_event_t *event)
{
    switch (part) {
    case '#':
        text_number(event->a);
        break;
    case '%':
        text_number(event->b);
        break;
    case '^':
        text_number(event->c);
        break;
    case '@': /* the page that played */
        if (event->a == 0) {
            TEXT("a move");
        } else {
            report_page(event->a);
        }
        break;
    case '$': /* the page that follows */
        if (event->a == 0) {
            TEXT("the end");
        } else {
            report_page(event->a);
        }
        break;
    case '!':
        report_bad_page(event->a, event->b);
        break;
    case '~':
        report_voltage(event->a);
        break;
    case '*':
        report_servo_errors(event->b);
        break;
    default:
        text_put(part);
        break;
    }
}

TEXT_NAMED(approach, "Going to the first pose, % s");
TEXT_NAMED(step, "Page # step % repetition ^");
TEXT_NAMED(paused, "Paused");
TEXT_NAMED(silent, "Servo # does not answer");
TEXT_NAMED(back, "Servo # answers again");
TEXT_NAMED(reports, "Servo # reports *");
TEXT_NAMED(limp, "Servo # has lost its torque");
TEXT_NAMED(battery, "Battery is low: ~");
TEXT_NAMED(hot, "Servo # is hot: % C");
TEXT_NAMED(layer, "The layer ended after @");
TEXT_NAMED(driver, "Nobody drives any more: stopping");
TEXT_NAMED(lost, "# messages were dropped");
TEXT_NAMED(next_link, "Next link to $");
TEXT_NAMED(exit_link, "Exit link to $");
TEXT_NAMED(linked1, "Link 1 to $");
TEXT_NAMED(linked2, "Link 2 to $");
TEXT_NAMED(loop, "The exit pages lead back to themselves");
TEXT_NAMED(no_link, "No link to $");
TEXT_NAMED(ended_after, "Ended after @");
TEXT_NAMED(stopped, "Stopped after @");
TEXT_NAMED(broken, "Broken off in @");
TEXT_NAMED(bad_page, "Ended. !");
TEXT_NAMED(for_servo, "Ended for the fault of a servo in @");
TEXT_NAMED(there, "The pose is reached");
TEXT_NAMED(moving, "Moving, % s");
TEXT_NAMED(playing, "Playing @ step % repetition ^");

static const char *const of_kind[] PROGMEM = {
    [PERFORMER_EV_APPROACH] = approach, [PERFORMER_EV_STEP] = step, [PERFORMER_EV_PAUSED] = paused,
    [PERFORMER_EV_SILENT] = silent, [PERFORMER_EV_BACK] = back, [PERFORMER_EV_ERRORS] = reports,
    [PERFORMER_EV_TORQUE] = limp, [PERFORMER_EV_BATTERY] = battery, [PERFORMER_EV_HOT] = hot,
    [PERFORMER_EV_LAYER_ENDED] = layer, [PERFORMER_EV_DRIVE_LOST] = driver, [PERFORMER_EV_LOST] = lost,
};
static const char *const of_link[] PROGMEM = {
    [LINK_NEXT] = next_link, [LINK_EXIT] = exit_link, [LINK_LINKED1] = linked1, [LINK_LINKED2] = linked2,
    [LINK_END_OF_EXIT_LOOP] = loop, [LINK_ENDED] = no_link,
};
static const char *const of_end[] PROGMEM = {
    [PERFORMER_END_DONE] = ended_after, [PERFORMER_END_STOPPED] = stopped, [PERFORMER_END_BROKEN] = broken,
    [PERFORMER_END_LOOP] = stopped, [PERFORMER_END_PAGE] = bad_page, [PERFORMER_END_SERVO] = for_servo,
    [PERFORMER_END_THERE] = there,
};

static const char *sentence_P(const performer_event_t *event)
{
    const char *const *row = &of_kind[event->kind];
    if (event->kind == PERFORMER_EV_LINK) {
        row = &of_link[event->b];
    } else if (event->kind == PERFORMER_EV_ENDED) {
        row = &of_end[event->c];
    } else if (event->kind == PERFORMER_EV_APPROACH && event->a == 0) {
        return moving;
    } else if (event->kind == PERFORMER_EV_STEP && event->b == 1) {
        return playing;
    }
    return pgm_read_ptr(row);
}

void report_event(const performer_event_t *event)
{
    text_reader_t reader;
    text_open_P(&reader, sentence_P(event));
    for (char character; (character = text_next(&reader)) != '\0';) {
        report_part(character, event);
    }
}
