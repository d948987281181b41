/* SPDX-License-Identifier: MIT
 * commands_ask.c - what handlers ask of a line: numbers and joints, and how they refuse it. */
#include "commands_parts.h"

#include "text.h"

uint8_t commands_error(const play_t *play, uint8_t number)
{
    if (play->program_asks) {
        TEXT(" ERR ");
        text_number(number);
        text_put(' ');
    }
    return number;
}

uint8_t commands_sentence(const play_t *play, uint8_t number, const char *sentence_P)
{
    (void)commands_error(play, number);
    text_P(sentence_P);
    return number;
}

bool commands_number(const play_t *play, const shell_args_t *args, uint8_t index, const char *what_P, uint16_t min,
                     uint16_t max, uint16_t *value)
{
    uint16_t number;
    if (shell_parse(shell_word(args, index), false, &number) && number >= min && number <= max) {
        *value = number;
        return true;
    }
    (void)commands_error(play, REQUEST_ERR_RANGE);
    shell_print_range(what_P, min, max, false);
    return false;
}

bool commands_signed(const play_t *play, const shell_args_t *args, uint8_t index, const char *what_P, int16_t size_max,
                     int16_t *value)
{
    const char *word = shell_word(args, index);
    const bool negative = word[0] == '-';
    uint16_t size;
    if (shell_parse(word + (negative ? 1 : 0), false, &size) && size <= (uint16_t)size_max) {
        *value = negative ? (int16_t)-(int16_t)size : (int16_t)size;
        return true;
    }
    (void)commands_error(play, REQUEST_ERR_RANGE);
    text_P(what_P);
    TEXT(" must be -");
    text_number((uint16_t)size_max);
    TEXT("..");
    text_number((uint16_t)size_max);
    return false;
}

bool commands_joints(const play_t *play, const shell_args_t *args, uint8_t first, uint32_t *joints)
{
    *joints = args->count <= first ? play->servos.present : 0;
    for (uint8_t i = first; i < args->count; i++) {
        uint16_t id;
        if (!commands_number(play, args, i, TEXT_P("ID"), 0, SERVO_LINK_JOINTS - 1u, &id)) {
            return false;
        }
        if (!servo_link_has(&play->servos.present, (uint8_t)id)) {
            (void)commands_error(play, REQUEST_ERR_SERVOS);
            TEXT("Servo ");
            text_number(id);
            TEXT(" is not there");
            return false;
        }
        servo_link_put(joints, (uint8_t)id, true);
    }
    if (*joints == 0) {
        (void)commands_error(play, REQUEST_ERR_SERVOS);
        report_refusal(PERFORMER_ERR_NO_SERVOS, 0, 0);
        return false;
    }
    return true;
}
