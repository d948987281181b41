/* SPDX-License-Identifier: MIT
 * commands_ask.c - what handlers ask of a line: numbers and joints, and how they refuse it. */
#include "commands_parts.h"

#include "pgm.h"
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

/* A whole word as a number, with or without a minus. false: none, or too large to have a sign. */
static bool parse_signed(const char *word, int16_t *number)
{
    const bool negative = word[0] == '-';
    uint16_t size;
    if (!shell_parse(word + (negative ? 1 : 0), false, &size) || size > INT16_MAX) {
        return false;
    }
    *number = negative ? (int16_t)-(int16_t)size : (int16_t)size;
    return true;
}

bool commands_numbers(const play_t *play, const shell_args_t *args, uint8_t first, const commands_range_t *ranges_P,
                      uint8_t count, int16_t values[])
{
    for (uint8_t i = 0; i < count && first + i < args->count; i++) {
        commands_range_t range;
        memcpy_P(&range, &ranges_P[i], sizeof range);
        if (parse_signed(shell_word(args, (uint8_t)(first + i)), &values[i]) && values[i] >= range.min &&
            values[i] <= range.max) {
            continue;
        }
        (void)commands_error(play, REQUEST_ERR_RANGE);
        text_P(range.what_P);
        TEXT(" must be ");
        text_signed(range.min);
        TEXT("..");
        text_signed(range.max);
        return false;
    }
    return true;
}

TEXT_NAMED(id_text, "ID");
static const commands_range_t id_range[] PROGMEM = { { id_text, 0, SERVO_LINK_JOINTS - 1 } };

bool commands_ids(const play_t *play, const shell_args_t *args, uint8_t first, uint32_t *joints)
{
    *joints = 0;
    for (uint8_t i = first; i < args->count; i++) {
        int16_t id;
        if (!commands_numbers(play, args, i, id_range, 1, &id)) {
            return false;
        }
        servo_link_put(joints, (uint8_t)id, true);
    }
    return true;
}

bool commands_joints(const play_t *play, const shell_args_t *args, uint8_t first, uint32_t *joints)
{
    if (!commands_ids(play, args, first, joints)) {
        return false;
    }
    const uint32_t absent = *joints & ~play->servos.present;
    if (args->count <= first) {
        *joints = play->servos.present;
    }
    if (absent == 0 && *joints != 0) {
        return true;
    }
    (void)commands_error(play, REQUEST_ERR_SERVOS);
    if (absent != 0) {
        TEXT("Servo ");
        report_joints(absent);
        TEXT(" is not there");
    } else {
        report_refusal(PERFORMER_ERR_NO_SERVOS, 0, 0);
    }
    return false;
}
