/* SPDX-License-Identifier: MIT
 * replies.c - complete replies of Play, by firmware/play/README.md, firmware/common/PROTOCOL.md and the words of
 * `help`. Between a line and the next prompt comes the requested output, if any, and one final line: " OK", or a
 * sentence with the reason for a refusal. A request is answered by one line. */
#include "session.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define ANY 99u
#define PAGE_STEPS_AT 20u
enum { JUST_OK, A_WORD, FIELDS, A_LINE, LINES };   /* the output before or beside the OK */

/* The words that a user can type, how many words may follow, and the output of a correct line. */
static const struct {
    const char *word, *other;
    unsigned fewest, most;
    int alone, with;               /* output without and with words after it */
} words[] = {
    {"play", "p", 1, ANY, JUST_OK, JUST_OK}, {"stop", "s", 0, 0, JUST_OK, 0},     {"break", "b", 0, 0, JUST_OK, 0},
    {"pause", "", 0, 0, JUST_OK, 0},         {"resume", "", 0, 0, JUST_OK, 0},    {"rate", "", 1, 1, JUST_OK, JUST_OK},
    {"amplitude", "", 1, ANY, 0, JUST_OK},   {"blend", "", 1, 1, 0, JUST_OK},     {"drive", "", 3, 3, 0, JUST_OK},
    {"layer", "", 1, ANY, 0, JUST_OK},       {"aim", "", 2, 3, 0, JUST_OK},       {"swing", "", 4, 5, 0, JUST_OK},
    {"free", "", 0, ANY, JUST_OK, JUST_OK},  {"shape", "", 0, 1, FIELDS, JUST_OK}, {"code", "", 1, 1, 0, JUST_OK},
    {"on", "", 0, ANY, JUST_OK, JUST_OK},    {"off", "", 0, ANY, JUST_OK, JUST_OK}, {"list", "", 0, 0, LINES, 0},
    {"status", "", 0, 0, LINES, 0},          {"servos", "", 0, 1, LINES, A_LINE}, {"faults", "", 0, 0, LINES, 0},
    {"law", "", 0, 1, A_WORD, JUST_OK},      {"remote", "", 0, 1, A_WORD, JUST_OK}, {"settings", "", 0, 2, LINES, JUST_OK},
    {"version", "", 0, 0, A_LINE, 0},        {"help", "?", 0, 1, LINES, A_LINE},
};
#define WORDS (sizeof words / sizeof words[0])

static struct {
    char asked[LINE_BYTES];        /* the newest line in small letters, until it is answered */
    char shown[LINE_BYTES];        /* the line as the console shows it */
    bool is_asked, is_open;        /* is_open: its answer has begun */
    unsigned lines;
    char first[LINE_BYTES], last[LINE_BYTES];
    unsigned servos, helped;       /* lines of this kind */
} replies;

static void wrong(const char *right)
{
    session_fail("Play answers as its pages say", "\"%.60s\": %u lines, \"%.50s\" .. \"%.50s\"; right is %s", replies.asked,
                 replies.lines, replies.first, replies.last, right);
}

static void must_be(bool is_right, const char *right)
{
    if (!is_right) {
        wrong(right);
    }
}

/* ---- numbers ---- */

static bool is_number(const char *word, int *number)
{
    char *end;
    *number = (int)strtol(word, &end, 10);
    return *word != '\0' && *end == '\0' && strlen(word) <= 5;
}

/* Returns whether a line with these words must be refused for its numbers. */
static bool is_out_of_range(const char *word, unsigned behind, const char *const *at)
{
    static const struct {
        const char *word;
        unsigned place;
        int low, high;
    } ranges[] = {
        {"rate", 1, 10, 400},   {"amplitude", 1, 0, 150}, {"blend", 1, -100, 100}, {"drive", 1, -100, 100},
        {"drive", 2, 10, 400},  {"drive", 3, 0, 150},     {"aim", 2, 0, 1023},     {"aim", 3, 1, 360},
        {"swing", 4, 125, 30000}, {"swing", 5, 0, 359},   {"code", 1, 0, 255},
    };
    for (unsigned i = 0; i < sizeof ranges / sizeof ranges[0]; i++) {
        int number;
        if (strcmp(word, ranges[i].word) == 0 && ranges[i].place <= behind && is_number(at[ranges[i].place - 1], &number) &&
            (number < ranges[i].low || number > ranges[i].high)) {
            return true;
        }
    }
    return false;
}

/* ---- checks of single words ---- */

/* Without servos nothing plays, nor does a page that is damaged or has no steps. */
static void look_at_play(const char *page_word, bool is_ok)
{
    int page;
    char right[48];
    if (!is_number(page_word, &page)) {
        return;
    }
    if (page <= 0 || page >= (int)PAGES) {
        must_be(!is_ok, "a refusal");
        return;
    }
    if (!page_is_good((unsigned)page) && strncmp(replies.last, "Page ", 5) == 0) {
        snprintf(right, sizeof right, "Page %d is ", page);
        must_be(strncmp(replies.last, right, strlen(right)) == 0, right);
    }
    must_be(!is_ok || (page_is_good((unsigned)page) && page_at((unsigned)page)[PAGE_STEPS_AT] > 0), "a refusal");
}

/* Checks "18 servos: 1-18" against the present servos. */
static void look_at_count(const char *line)
{
    unsigned count, right = 0;
    must_be(sscanf(line, "%u servos: ", &count) == 1, "how many servos");
    for (unsigned id = 0; id < JOINTS; id++) {
        right += session.joint[id].servo != NULL ? 1 : 0;
    }
    must_be(count <= right && (count == right || !rules_is_well()), "another number of servos");
}

static void look_at_shown(const char *word, const char *second, int shows)
{
    if (shows == JUST_OK) {
        must_be(replies.lines == 1 && strcmp(replies.last, " OK") == 0, "one line");
        return;
    }
    if (shows == FIELDS) {
        must_be(replies.lines == 1 && strncmp(replies.last, " rate=", 6) == 0, "the fields in one line");
        return;
    }
    must_be(strcmp(replies.last, " OK") == 0, "an OK in the last line");
    must_be(shows == LINES ? replies.lines > 1 : replies.lines == 2, shows == LINES ? "more lines" : "two lines");
    if (shows == A_WORD) {
        const char *choice = word[0] == 'l' ? "exact classic" : "latch hold drive";
        must_be(replies.first[0] != '\0' && strstr(choice, replies.first) != NULL, choice);
    } else if (strcmp(word, "servos") == 0 && second[0] != '\0') {
        look_at_count(replies.first);
    } else if (strcmp(word, "servos") == 0) {
        must_be(replies.lines == replies.servos + 2, "a line for each servo, their number, OK");
    } else if (strcmp(word, "help") == 0 || strcmp(word, "?") == 0) {
        must_be(second[0] == '\0' ? replies.helped == WORDS && replies.lines == WORDS + 1 : replies.helped == 1,
                "a line for each word");
    }
    reached("whole answer of Play");
}

static void look_at_request(void)
{
    const size_t length = strlen(replies.last);
    must_be(replies.lines == 1, "one answer line");
    must_be(strstr(replies.last, " ERR ") != NULL || (length >= 3 && strcmp(replies.last + length - 3, " OK") == 0),
            "OK or ERR at its end");
}

static void look(void)
{
    char copy[LINE_BYTES];
    const char *word[8] = {"", "", "", "", "", "", "", ""};
    unsigned count = 0;
    memcpy(copy, replies.asked, sizeof copy);
    for (char *at = strtok(copy, " ,.:;"); at != NULL; at = strtok(NULL, " ,.:;"), count++) {
        word[count < 8 ? count : 7] = at;
    }
    if (count == 0 || replies.lines == 0 || strstr(replies.last, ": nothing was done") != NULL ||
        strcmp(replies.last, "Stopping all the same") == 0) {
        return;
    }
    if (replies.asked[0] == '@') {
        look_at_request();
        return;
    }
    const size_t length = strlen(replies.last);
    const bool is_ok = length >= 3 && strcmp(replies.last + length - 3, " OK") == 0;
    for (unsigned i = 0; i < WORDS; i++) {
        if (strcmp(word[0], words[i].word) != 0 && strcmp(word[0], words[i].other) != 0) {
            continue;
        }
        const unsigned behind = count - 1;
        const bool is_wrong = behind < words[i].fewest || behind > words[i].most ||
                              (count <= 8 && is_out_of_range(words[i].word, behind, word + 1));
        must_be(!is_wrong || !is_ok, "a refusal");
        must_be(strncmp(replies.last, "Unknown word", 12) != 0 || words[i].word[0] == 'h', "a word that is known");
        if (words[i].word[0] == 'p' && words[i].word[1] == 'l' && behind == 1) {
            look_at_play(word[1], is_ok);
        }
        if (is_ok) {
            look_at_shown(words[i].word, word[1], behind == 0 ? words[i].alone : words[i].with);
        } else {
            must_be(replies.lines == 1, "one line that refuses");
        }
        return;
    }
    must_be(!is_ok && replies.lines == 1, "a refusal of an unknown word");
}

/* ---- events ---- */

/* typed: as it was. line: in small letters. */
void replies_typed(const char *typed, const char *line)
{
    const bool is_mixed = replies.is_asked || !session.typed_is_known;   /* unclear whose answer comes next */
    replies.is_asked = !is_mixed && line[0] != '\0';
    replies.is_open = false;
    snprintf(replies.asked, sizeof replies.asked, "%s", line);
    snprintf(replies.shown, sizeof replies.shown, "] %s", typed);
}

void replies_printed(const char *line)
{
    unsigned id;
    if (!replies.is_open) {
        const size_t length = strlen(replies.shown);
        const bool is_echo = strncmp(line, replies.shown, length) == 0;
        replies.is_open = replies.is_asked && is_echo && strspn(line + length, " ") == strlen(line + length);
        replies.lines = replies.servos = replies.helped = 0;
        return;
    }
    if (strncmp(line, "@now ", 5) == 0) {   /* it interrupted the typed line, which is shown again */
        replies.is_open = false;
        return;
    }
    snprintf(replies.last, sizeof replies.last, "%s", line);
    if (replies.lines++ == 0) {
        snprintf(replies.first, sizeof replies.first, "%s", line);
    }
    replies.servos += sscanf(line, "%u position", &id) == 1 && strstr(line, "position") != NULL ? 1 : 0;
    for (unsigned i = 0; i < WORDS; i++) {
        const size_t length = strlen(words[i].word);
        replies.helped += strncmp(line, words[i].word, length) == 0 && line[length] == ' ' && strlen(line) > 16 ? 1 : 0;
    }
}

/* The console's line is "] ", a prompt. */
void replies_prompt(void)
{
    if (replies.is_open) {
        replies.is_open = replies.is_asked = false;
        look();
    }
}

void replies_boot(void)
{
    replies.is_open = replies.is_asked = false;
}
