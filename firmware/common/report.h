/* SPDX-License-Identifier: MIT
 * report.h - prints events and errors as sentences, in the same words in Play and in Edit.
 * Knows no console (text.h) and no command. Main loop only. No RAM of its own. No function ends the line. */
#ifndef REPORT_H
#define REPORT_H

#include <stdint.h>
#include "app_record.h"
#include "page.h"
#include "performer.h"

/* What is wrong with a page (page_status_t): "checksum is wrong", "more than 7 steps". In flash, at most 19 characters. */
const char *report_page_fault_P(uint8_t page_status) NOINLINE;

/* "Page 9 is damaged: checksum is wrong", "Page 9 is empty". */
void report_bad_page(uint8_t page, uint8_t fault);

/* Why a play did not start: report_bad_page, "Busy: stop what is playing first". Prints nothing for PERFORMER_OK. */
void report_refusal(performer_status_t status, uint8_t page, uint8_t fault);

/* "Failed: line 47, 0x2468. Report it. ", once after a failed ASSERT (trap.h) restarted the program; otherwise nothing.
 * The second number is the byte address of the call, for avr-addr2line. */
void report_failed_assert(void);

/* The version in an image's record: "1.0.0". */
void report_version(const app_record_t *record);

/* The board of the record: "cm5". */
const char *report_board_P(const app_record_t *record);

/* Why joints did not obey, for a list of them: "Not obeyed", or, if some stand outside their angle limits, what to do; then
 * only those remain in *joints. In flash. */
const char *report_disobedience_P(const servo_link_t *servos, uint32_t *joints) NOINLINE;

/* "Outside its angle limits, move it by hand". */
const char *report_outside_P(void);

/* The joints of a mask: "1-18 20", or "none". */
void report_joints(uint32_t joints);

/* ---- report_event.c, linked by Play only ---- */

/* The bits of servo_fault_t.errors: "overload, overheating"; 0: "no error". */
void report_servo_errors(uint8_t errors);

/* "page 12 (walk)". */
void report_page(uint8_t page);

/* "11.3 V". */
void report_voltage(uint8_t dv);

/* One sentence for an event. */
void report_event(const performer_event_t *event);

#endif
