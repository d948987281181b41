/* SPDX-License-Identifier: MIT
 * requests_answer.c - helpers for handlers: errors, and the joints that a line names. */
#include "requests.h"

#include "ranges.h"
#include "report.h"
#include "text.h"

static bool for_program;

void requests_set_program(bool program)
{
    for_program = program;
}

bool requests_from_program(void)
{
    return for_program;
}

uint8_t requests_error(uint8_t status)
{
    if (for_program) {
        text_P_number(TEXT_P(" ERR "), status);
        text_put(' ');
    }
    return SHELL_ERR_REPORTED;
}

uint8_t requests_refuse(uint8_t status, const char *sentence_P)
{
    const uint8_t reported = requests_error(status);
    text_P(sentence_P);
    return reported;
}

uint8_t requests_servos(uint32_t joints, const char *what_P)
{
    if (joints == 0) {
        return REQUEST_OK;
    }
    (void)requests_refuse(REQUEST_ERR_SERVOS, what_P);
    TEXT(": ID ");
    report_joints(joints);
    return SHELL_ERR_REPORTED;
}

uint8_t requests_take_joints(const shell_args_t *args, uint8_t first, uint32_t *joints)
{
    const uint32_t present = requests_image.servos->present;
    *joints = args->count > first ? 0 : present;
    if (!ranges_take_joints(args, first, joints)) {
        return SHELL_ERR_RANGE;
    }
    return *joints == 0 ? requests_refusal(PERFORMER_ERR_NO_SERVOS)
                        : requests_servos(*joints & ~present, TEXT_P("No answer"));
}

uint8_t requests_refusal(performer_status_t status)
{
    static const uint8_t numbers[] PROGMEM = {
        [PERFORMER_OK] = REQUEST_OK,
        [PERFORMER_ERR_RANGE] = REQUEST_ERR_RANGE,
        [PERFORMER_ERR_PAGE] = REQUEST_ERR_PAGE,
        [PERFORMER_ERR_EMPTY] = REQUEST_ERR_EMPTY,
        [PERFORMER_ERR_BUSY] = REQUEST_ERR_BUSY,
        [PERFORMER_ERR_NO_SERVOS] = REQUEST_ERR_SERVOS,
        [PERFORMER_ERR_RELEASED] = REQUEST_ERR_RELEASED,
        [PERFORMER_ERR_LAW] = REQUEST_ERR_IMAGE,
    };
    const performer_t *performer = requests_image.performer;
    if (status == PERFORMER_OK) {
        return REQUEST_OK;
    }
    (void)requests_error(pgm_read_byte(&numbers[status]));
    report_refusal(status, performer->fault_page, performer->fault);
    return SHELL_ERR_REPORTED;
}
