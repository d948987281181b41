/* SPDX-License-Identifier: MIT
 * answers.c - the required answers to the requests of firmware/common/PROTOCOL.md, by that page, the memories, the
 * servos and earlier requests. Also: `@save` must write what `@data` has sent. */
#include "session.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#define CHECKSUM_AT 31u
#define WORDS 6u
#define ANY 99u
#define LATEST (8u * SECOND)       /* an answer comes by then, even if it needs all servos */
#define STILL SECOND               /* ticks without a goal: the joints have come to rest */
#define LINE_MOST 110u             /* bytes of a request that certainly fit */

enum { ERR_WORD = 1, ERR_COUNT = 2, ERR_RANGE = 3, ERR_CRC = 9, ERR_UNSAVED = 12, ERR_LINE = 15 };
enum { BOTH, PLAY, EDIT };

/* The number of words after each request, and the range of the first `numbers` of them, which are numbers. */
static const struct {
    const char *word;
    unsigned image, fewest, most, numbers;
    int low, high;
} requests[] = {
    {"ver", BOTH, 0, 0, 0, 0, 0},         {"list", BOTH, 0, 2, 2, 0, 255},       {"page", BOTH, 1, 1, 1, 0, 255},
    {"dense", BOTH, 1, 1, 1, 0, 255},     {"crcs", BOTH, 0, 2, 2, 0, 255},       {"pose", BOTH, 0, 0, 0, 0, 0},
    {"watch", BOTH, 1, 1, 0, 0, 0},       {"move", BOTH, 3, 3, 0, 0, 0},         {"torque", BOTH, 1, ANY, 0, 0, 0},
    {"play", BOTH, 1, ANY, 0, 0, 0},      {"stop", BOTH, 0, 0, 0, 0, 0},         {"break", BOTH, 0, 0, 0, 0, 0},
    {"pause", BOTH, 0, 0, 0, 0, 0},       {"resume", BOTH, 0, 0, 0, 0, 0},       {"where", BOTH, 0, 0, 0, 0, 0},
    {"rate", PLAY, 1, 1, 1, 10, 400},     {"amplitude", PLAY, 1, ANY, 1, 0, 150}, {"blend", PLAY, 1, 1, 1, -100, 100},
    {"drive", PLAY, 3, 3, 0, 0, 0},       {"layer", PLAY, 1, ANY, 0, 0, 0},      {"aim", PLAY, 2, 3, 0, 0, 0},
    {"swing", PLAY, 4, 5, 0, 0, 0},       {"free", PLAY, 0, ANY, 0, 0, 0},       {"shape", PLAY, 0, 1, 0, 0, 0},
    {"open", EDIT, 1, 1, 1, 0, 255},      {"data", EDIT, 2, 2, 0, 0, 0},         {"crc", EDIT, 0, 0, 0, 0, 0},
    {"save", EDIT, 2, 2, 0, 0, 0},        {"reset", BOTH, 0, 0, 0, 0, 0},
};

static struct {
    char line[LINE_BYTES];         /* the newest request in small letters, until it is answered */
    char first[24];                /* its first word as typed */
    char *word[WORDS];
    unsigned words;                /* including its own */
    uint32_t asked_tick;
    uint32_t mixed_until;          /* a request was made before the last one was answered */
    char shape[LINE_BYTES];        /* the user's line that changes the next values, until it is answered */
    uint32_t shape_tick;           /* when it was typed */
    bool is_driven;                /* @drive, a remote or unknown input may have changed these values */
    int rate, blend, amplitude;    /* UNSET: not known */
    uint8_t page[PAGE_BYTES];      /* the open page, if only a program has changed it */
    bool knows_page;
    uint8_t saved[PAGE_BYTES];     /* must be in page `saved_as` once the save is over */
    unsigned saved_as;             /* 0: none */
} answers;

#define UNSET 0x7FFF

static void split(void)
{
    static char words[LINE_BYTES];
    memcpy(words, answers.line + 1, sizeof words - 1);
    answers.words = 0;
    for (char *word = strtok(words, " "); word != NULL; word = strtok(NULL, " ")) {
        if (answers.words < WORDS) {
            answers.word[answers.words] = word;
        }
        answers.words++;
    }
}

/* Reads a number by PROTOCOL.md. */
static bool is_number(const char *word, int *number)
{
    char *end;
    const bool is_hex = strncmp(word, "0x", 2) == 0 || strncmp(word, "0X", 2) == 0;
    *number = (int)strtol(word, &end, is_hex ? 16 : 10);
    return end != word && *end == '\0' && strlen(word) <= 6;
}

static int argument(unsigned at)
{
    int number = 0;
    return at < answers.words && at < WORDS && is_number(answers.word[at], &number) ? number : UNSET;
}

/* ---- required answers ---- */

static void wrong(const char *answer, const char *right)
{
    session_fail("requests are answered as PROTOCOL.md says", "\"%.60s\": \"%.70s\", and right is %.70s", answers.line,
                 answer, right);
}

/* Returns the error that these words require; 0: none of the first three; -1: not known. */
static int error_of_words(void)
{
    for (unsigned i = 0; i < sizeof requests / sizeof requests[0]; i++) {
        if (strcmp(answers.word[0], requests[i].word) != 0 || requests[i].image == (session.is_edit ? PLAY : EDIT)) {
            continue;
        }
        const unsigned behind = answers.words - 1;
        if (behind < requests[i].fewest || behind > requests[i].most) {
            return ERR_COUNT;
        }
        if (requests[i].most == 2 && requests[i].numbers == 2 && behind == 1) {
            return -1;   /* half a range: not specified */
        }
        int before = requests[i].low;
        for (unsigned at = 1; at <= behind && at <= requests[i].numbers; at++) {
            const int number = argument(at);
            if (number == UNSET || number < before || number > requests[i].high) {
                return ERR_RANGE;
            }
            before = number;   /* the last number must not be below the first */
        }
        return requests[i].numbers >= behind ? 0 : -1;
    }
    return ERR_WORD;
}

static void must_be(const char *answer, const char *right)
{
    if (strcmp(answer, right) != 0) {
        wrong(answer, right);
    }
}

/* Returns the number in NAME=number, or UNSET. */
static int field(const char *answer, const char *name)
{
    char text[24];
    snprintf(text, sizeof text, " %s=", name);
    const char *at = strstr(answer, text);
    return at == NULL ? UNSET : atoi(at + strlen(text));
}

static void must_have(const char *answer, const char *name, int right)
{
    char text[40];
    if (right != UNSET && field(answer, name) != right) {
        snprintf(text, sizeof text, "%s=%d", name, right);
        wrong(answer, text);
    }
}

static void look_at_shape(const char *answer)
{
    must_have(answer, "rate", answers.rate);
    must_have(answer, "blend", answers.blend);
    must_have(answer, "amplitude", answers.amplitude);
}

static void look_at_place(const char *answer)
{
    unsigned page, step, repetition;
    const bool is_idle = strstr(answer, " state=idle ") != NULL;
    if (is_idle) {
        must_have(answer, "page", 0);
        must_have(answer, "step", 0);
    }
    if (!session.is_edit) {
        look_at_shape(answer);
    }
    if (!session.is_edit && law_place(&page, &step, &repetition)) {
        reached("@where names the play");
        if (strstr(answer, " state=playing ") == NULL) {
            wrong(answer, "state=playing");
        }
        const int answered = field(answer, "step");
        if (answered != 1 && answered != (int)step + 1) {   /* otherwise the console is about to report the next step */
            must_have(answer, "step", (int)step);
            must_have(answer, "page", (int)page);
            must_have(answer, "repetition", (int)repetition);
        }
    }
}

/* Checks ID:POSITION:TORQUE of each present servo. */
static void look_at_pose(const char *answer)
{
    unsigned id, position, torque, there = 0, known = 0;
    int length;
    if (!rules_is_well() || rules_is_searching() ||
        session.tick - session.goals_tick < STILL || session.tick - session.boot_tick < 4 * SECOND ||
        session.tick - session.pushed_tick < 2 * SECOND) {
        return;
    }
    const char *at = answer + strlen("@pose");
    for (; sscanf(at, " %u:%u:%u%n", &id, &position, &torque, &length) == 3; at += length) {
        const servo_t *servo = id < JOINTS ? session.joint[id].servo : NULL;
        char text[64] = "no such servo";
        if (servo != NULL) {
            snprintf(text, sizeof text, "%u:%d:%u", id, to_page(id, servo->position), servo->table[TORQUE_AT]);
        }
        if (servo == NULL || abs(to_page(id, servo->position) - (int)position) > 3 ||
            (servo->table[TORQUE_AT] != 0) != (torque != 0)) {
            wrong(at, text);
        }
        there++;
    }
    for (id = 0; id < JOINTS; id++) {
        known += session.joint[id].servo != NULL && session.joint[id].is_known ? 1 : 0;
    }
    if (there < known) {
        wrong(answer, "a servo more");
    }
    reached("@pose gives the pose");
}

static void look_at_page(const char *answer)
{
    static char right[LINE_BYTES];
    const uint8_t *page = page_at((unsigned)argument(1));
    int at = snprintf(right, sizeof right, "@%s %d ", answers.word[0], argument(1));
    if (answers.word[0][0] == 'p') {
        for (unsigned i = 0; i < PAGE_BYTES; i++) {
            at += snprintf(right + at, 3, "%02X", page[i]);
        }
    } else {
        for (unsigned i = 0, since = 1; i < PAGE_BYTES; i++, since++) {   /* bytes 0 and 1, then three at a time */
            right[at++] = (char)('0' + (page[i] & 63));
            if (since == 2) {
                const unsigned oldest = i >= 2 ? page[i - 2] & 0xC0u : 0;
                right[at++] = (char)('0' + ((page[i] & 0xC0u) >> 2) + ((page[i - 1] & 0xC0u) >> 4) + (oldest >> 6));
                since = UINT32_MAX;   /* 0 for the next byte */
            }
        }
    }
    snprintf(right + at, sizeof right - (size_t)at, " %04X OK", crc_of(page, PAGE_BYTES));
    must_be(answer, right);
    reached("page read by a request");
}

static void look_at_crcs(const char *answer)
{
    static char right[LINE_BYTES];
    const int first = answers.words > 1 ? argument(1) : 0, last = answers.words > 2 ? argument(2) : 255;
    int at = snprintf(right, sizeof right, "@crcs ");
    for (int page = first; page <= last && answers.words != 2; page++) {
        at += snprintf(right + at, 5, "%04X", crc_of(page_at((unsigned)page), PAGE_BYTES));
    }
    snprintf(right + at, sizeof right - (size_t)at, " OK");
    if (answers.words != 2) {
        must_be(answer, right);
    }
}

/* ---- a page from a program ---- */

static void seal(uint8_t *page)
{
    page[CHECKSUM_AT] = 0;
    page[CHECKSUM_AT] = (uint8_t)(0xFF - sum_of(page));
}

static void take_data(void)
{
    unsigned byte;
    const unsigned offset = (unsigned)argument(1);
    const char *hex = answers.word[2];
    for (unsigned i = 0; i < 32 && sscanf(hex + 2 * i, "%2x", &byte) == 1; i++) {
        answers.page[(offset + i) % PAGE_BYTES] = (uint8_t)byte;
        if (hex[2 * i + 1] == '\0' || hex[2 * i + 2] == '\0') {
            return;
        }
    }
}

static void take_page_request(const char *answer)
{
    const char *word = answers.word[0];
    const bool is_ok = strstr(answer, " OK") != NULL;
    if (strcmp(word, "open") == 0 && is_ok) {
        memcpy(answers.page, page_at((unsigned)argument(1)), PAGE_BYTES);
        answers.knows_page = argument(1) != UNSET;
    } else if (strcmp(word, "data") == 0 && is_ok) {
        take_data();
    } else if (strcmp(word, "crc") == 0 && is_ok && answers.knows_page) {
        uint8_t sealed[PAGE_BYTES];
        char right[24];
        memcpy(sealed, answers.page, PAGE_BYTES);
        seal(sealed);
        if (memcmp(sealed, answers.page, PAGE_BYTES) == 0) {
            snprintf(right, sizeof right, "@crc %04X OK", crc_of(sealed, PAGE_BYTES));
            must_be(answer, right);
        }
    } else if (strcmp(word, "save") == 0 && answers.knows_page) {
        const int crc = argument(2);
        memcpy(answers.saved, answers.page, PAGE_BYTES);
        seal(answers.saved);
        if (is_ok && (crc == UNSET || crc != crc_of(answers.saved, PAGE_BYTES))) {
            wrong(answer, "ERR 9");
        }
        answers.saved_as = is_ok ? (unsigned)argument(1) : 0;
        if (is_ok && memcmp(page_at(answers.saved_as), answers.saved, PAGE_BYTES) != 0) {
            session_fail("a page from a program is saved as it was sent", "page %u differs", answers.saved_as);
        }
        if (is_ok) {
            reached("page of a program as it was sent");
        }
    }
}

/* ---- shaping values ---- */

static void take_shape(const char *line)
{
    int a = 0;
    unsigned id;
    char more;
    line += *line == '@' ? 1 : 0;
    answers.is_driven = answers.is_driven && strcmp(line, "shape reset") != 0;
    if (answers.is_driven) {
        return;   /* such values end with the play */
    }
    if (sscanf(line, "rate %i%c", &a, &more) == 1) {
        answers.rate = a;
    } else if (sscanf(line, "blend %i%c", &a, &more) == 1) {
        answers.blend = a;
    } else if (sscanf(line, "amplitude %i %u", &a, &id) >= 1) {
        answers.amplitude = sscanf(line, "amplitude %i %u", &a, &id) == 2 ? UNSET : a;
    } else if (strcmp(line, "shape reset") == 0) {
        answers.rate = answers.amplitude = 100;
        answers.blend = 0;
    }
}

static void forget_shape(void)
{
    answers.rate = answers.blend = answers.amplitude = UNSET;
    answers.is_driven = true;
}

/* ---- events ---- */

static void look_at(const char *answer)
{
    unsigned number = 0;
    char text[24];
    const char *word = answers.word[0];
    /* Punctuation also separates words; PROTOCOL.md does not specify that. */
    const bool has_signs = strpbrk(answers.line, ",.:;") != NULL;
    const int right = has_signs ? -1 : error_of_words();
    const char *error = strstr(answer, " ERR ");
    const bool is_error = error != NULL && sscanf(error, " ERR %u", &number) == 1;
    if (number == ERR_LINE && strlen(answers.line) > LINE_MOST) {
        return;
    }
    snprintf(text, sizeof text, "ERR %d", right);
    if ((right > 0 && (!is_error || (int)number != right)) || (right == 0 && is_error && number <= ERR_RANGE)) {
        wrong(answer, right > 0 ? text : "no such error");
    }
    if (right > 0) {
        reached("request refused for its words");
    }
    take_page_request(answer);
    if (is_error) {
        return;
    }
    if (strcmp(word, "page") == 0 || strcmp(word, "dense") == 0) {
        look_at_page(answer);
    } else if (strcmp(word, "crcs") == 0) {
        look_at_crcs(answer);
    } else if (strcmp(word, "list") == 0 && answers.words != 2) {
        views_list(answer, answers.words > 1 ? argument(1) : 0, answers.words > 2 ? argument(2) : (int)PAGES - 1);
    } else if (strcmp(word, "where") == 0) {
        look_at_place(answer);
    } else if (strcmp(word, "shape") == 0 && answers.words == 1) {
        look_at_shape(answer);
    } else if (strcmp(word, "pose") == 0) {
        look_at_pose(answer);
    } else if (strcmp(word, "ver") == 0) {
        must_have(answer, "pages", 256);
        must_have(answer, "joints", 31);
        must_have(answer, "line", LINE_MOST);
    } else {
        take_shape(answers.line);
    }
}

void answers_printed(const char *line)
{
    if (strcmp(line, " OK") == 0) {
        take_shape(answers.shape);
        answers.shape[0] = '\0';
    }
    const bool is_echo = strcasecmp(line, answers.line) == 0;   /* after noise it may appear without a prompt */
    if (answers.line[0] == '\0' || line[0] != '@' || strncmp(line, "@now ", 5) == 0 || is_echo) {
        return;
    }
    static char answer[LINE_BYTES];
    const size_t length = strlen(answers.word[0]);
    if (strncasecmp(line + 1, answers.word[0], length) == 0 && line[1 + length] == ' ') {
        if (length + 1 < sizeof answers.first && strncmp(line, answers.first, length + 1) != 0) {
            wrong(line, "the same word");
        }
        snprintf(answer, sizeof answer, "@%s%s", answers.word[0], line + 1 + length);
        look_at(answer);
        answers.line[0] = '\0';
    }
}

/* A line has been typed. */
void answers_typed(const char *line)
{
    if (answers.line[0] != '\0' && session.tick - answers.asked_tick < SECOND) {
        answers.mixed_until = session.tick + 2 * SECOND;   /* unclear which request is answered next */
        answers.knows_page = false;
        forget_shape();
    }
    answers.line[0] = '\0';
    const bool is_early = answers.shape[0] != '\0' && session.tick - session.boot_tick < 4 * SECOND;
    if (!session.typed_is_known || is_early) {   /* early: both lines are answered once the program has started */
        forget_shape();
    }
    if (!session.typed_is_known || line[0] != '@') {
        snprintf(answers.shape, sizeof answers.shape, "%s", line);
        answers.shape_tick = session.tick;
        answers.knows_page = answers.knows_page && line[0] == '\0';
        if (strncmp(line, "settings", 8) == 0 || strncmp(line, "drive", 5) == 0) {
            forget_shape();   /* the remote may steer */
        }
        return;
    }
    if (strncmp(line, "@drive", 6) == 0) {
        forget_shape();
    }
    if (session.tick < answers.mixed_until) {
        answers.knows_page = false;
        return;
    }
    snprintf(answers.line, sizeof answers.line, "%s", line);
    memcpy(answers.first, session.typed, sizeof answers.first);
    split();
    answers.asked_tick = session.tick;
    if (answers.words == 0) {
        answers.line[0] = '\0';
    }
}

/* In Play an answer always comes. In Edit a user's question may have taken the line. */
void answers_tick(void)
{
    if (answers.line[0] != '\0' && (session.is_edit || !rules_is_well() || strncmp(answers.line, "@reset", 6) == 0)) {
        answers.asked_tick = session.tick;
    } else if (answers.line[0] != '\0' && session.tick - answers.asked_tick > LATEST) {
        wrong("nothing", "an answer");
    }
}

void answers_boot(void)
{
    const bool is_open = answers.shape[0] != '\0' && session.tick - answers.shape_tick < SECOND;
    answers.line[0] = answers.shape[0] = '\0';
    answers.knows_page = answers.is_driven = false;
    answers.rate = answers.amplitude = 100;
    answers.blend = 0;
    if (is_open) {
        forget_shape();   /* the new program may find the line typed at the power cut */
    }
}
