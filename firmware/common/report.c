/* SPDX-License-Identifier: MIT */
#include "report.h"

#include "page_store.h"
#include "system.h"
#include "text.h"

const char *report_page_fault_P(uint8_t page_status)
{
    TEXT_NAMED(nothing, "nothing");
    TEXT_NAMED(checksum, "checksum is wrong");
    TEXT_NAMED(steps, "more than 7 steps");
    TEXT_NAMED(schedule, "unknown schedule");
    TEXT_NAMED(speed, "page speed is 0");
    TEXT_NAMED(position, "position above 1023");
    TEXT_NAMED(action, "no action");
    static const char *const faults[] PROGMEM = {
        [PAGE_OK] = nothing, [PAGE_ERR_CHECKSUM] = checksum, [PAGE_ERR_STEPS] = steps, [PAGE_ERR_SCHEDULE] = schedule,
        [PAGE_ERR_SPEED] = speed, [PAGE_ERR_POSITION] = position, [PAGE_EMPTY] = action,
    };
    return pgm_read_ptr(&faults[page_status]);
}

void report_bad_page(uint8_t page, uint8_t fault)
{
    text_P_number(TEXT_P("Page "), page);
    const bool is_erased = page_store_is_erased(page);
    if (fault == PAGE_EMPTY || is_erased) {
        text_P(is_erased || page_store_byte(page, PAGE_AT_STEPS) == 0 ? TEXT_P(" is empty") : TEXT_P(" has PlayCount 0"));
        return;
    }
    TEXT(" is damaged: ");
    text_P(report_page_fault_P(fault));
}

void report_refusal(performer_status_t status, uint8_t page, uint8_t fault)
{
    switch (status) {
    case PERFORMER_OK:
        break;
    case PERFORMER_ERR_RANGE:
        text_P_number(TEXT_P("Page must be 1.."), PAGE_COUNT - 1u);
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
        TEXT("Edit has no classic law: in Play say law exact");
        break;
    default:
        TEXT("The servos were switched off: switch them on first");
        break;
    }
}

void report_failed_assert(void)
{
    uint16_t line;
    uint32_t address;
    if (system_take_failed_assert(&line, &address)) {
        text_P_number(TEXT_P("Failed: line "), line);
        TEXT(", 0x");
        text_hex((uint16_t)address, 4);   /* an application ends below 0xC000 */
        TEXT(". Report it. ");
    }
}

void report_version(const app_record_t *record)
{
    for (uint8_t i = 0; i < sizeof record->version; i++) {
        if (i > 0) {
            text_put('.');
        }
        text_number(record->version[i]);
    }
}

const char *report_board_P(const app_record_t *record)
{
    return record->board == APP_RECORD_CM2 ? TEXT_P("cm2") : record->board == APP_RECORD_PC ? TEXT_P("pc") : TEXT_P("cm5");
}

const char *report_outside_P(void)
{
    return TEXT_P("Outside its angle limits, move it by hand");
}

const char *report_disobedience_P(const servo_link_t *servos, uint32_t *joints)
{
    const uint32_t outside = *joints & servos->outside;
    if (outside == 0) {
        return TEXT_P("Not obeyed");
    }
    *joints = outside;
    return report_outside_P();
}

void report_joints(uint32_t joints)
{
    if (joints == 0) {
        TEXT("none");
    }
    while (joints != 0) {
        const uint8_t first = servo_link_lowest(&joints);
        uint8_t last = first;
        for (uint8_t id = first; servo_link_has(&joints, id); id++) {
            servo_link_put(&joints, id, false);
            last = id;
        }
        text_number(first);
        if (last != first) {
            text_put('-');
            text_number(last);
        }
        if (joints != 0) {
            text_put(' ');
        }
    }
}
