/* SPDX-License-Identifier: MIT
 * The words of the editor and how it reads them and their numbers; edit/ORIGINAL.md sections 5 and 6 with the
 * differences of issue 3. */
#include "editor_stage.h"
#include "unity.h"

#include <stdio.h>
#include <string.h>
#include "commands.h"

static const char *page_number(void)
{
    return shown(2, 76, 4);
}

/* Types a line and returns the editor's answer. */
static const char *answer(const char *line)
{
    static char text[100];
    char typed[100];
    (void)snprintf(typed, sizeof typed, "%s\r", line);
    type(typed);
    const char *row = message();
    TEST_ASSERT_EQUAL_MEMORY_MESSAGE(line, row, strlen(line), row);
    (void)snprintf(text, sizeof text, "%s", row + strlen(line));
    return text[0] == ' ' ? text + 1 : text;
}

/* ---- words ---- */

static bool is_known(const char *word)
{
    shell_args_t args = {.words = word, .count = 1};
    return shell_find(commands_table_P, commands_count, &args, 0) != NULL;
}

static void test_every_word_of_the_original_is_there(void)
{
    static const char *const words[] = {
        "page", "p", "next", "n", "before", "b", "copy", "new", "save", "sav", "exit", "name", "step", "s", "go", "g",
        "write", "w", "insert", "i", "delete", "d", "move", "mirror", "m", "set", "goto", "on", "off", "play", "time",
        "speed", "re", "hex", "dec", "mon", "monitor"};
    for (uint8_t i = 0; i < sizeof words / sizeof words[0]; i++) {
        TEST_ASSERT_TRUE_MESSAGE(is_known(words[i]), words[i]);
    }
}

static void test_what_was_asked_for_is_there_too(void)
{
    static const char *const words[] = {"help", "?", "list", "undo", "redo", "swap", "take", "paste", "pairs", "rows"};
    for (uint8_t i = 0; i < sizeof words / sizeof words[0]; i++) {
        TEST_ASSERT_TRUE_MESSAGE(is_known(words[i]), words[i]);
    }
}

static void test_word_must_be_whole_or_its_abbreviation(void)
{
    static const char *const words[] = {"pag", "pages", "pa", "sa", "wr", "ins", "x", "run", "pagepage"};
    for (uint8_t i = 0; i < sizeof words / sizeof words[0]; i++) {
        TEST_ASSERT_FALSE_MESSAGE(is_known(words[i]), words[i]);
    }
    TEST_ASSERT_EQUAL_STRING("Bad Command", answer("pag 2"));
    TEST_ASSERT_EQUAL_STRING("0001", page_number());
}

static void test_no_word_has_two_meanings(void)
{
    for (uint8_t i = 0; i < commands_count; i++) {
        char word[20];
        uint8_t length = 0;
        for (; commands_table_P[i].text[length] != ' '; length++) {
            word[length] = commands_table_P[i].text[length];
        }
        word[length] = '\0';
        shell_args_t args = {.words = word, .count = 1};
        TEST_ASSERT_EQUAL_PTR_MESSAGE(&commands_table_P[i], shell_find(commands_table_P, commands_count, &args, 0), word);
    }
}

static void test_case_does_not_matter_and_five_characters_part_words(void)
{
    static const char *const lines[] = {"PAGE 2\r", "P 1\r", "page,2\r", "page.:;, 1\r", "p   2\r"};
    for (uint8_t i = 0; i < sizeof lines / sizeof lines[0]; i++) {
        type(lines[i]);
        TEST_ASSERT_EQUAL_STRING_MESSAGE(i % 2 == 0 ? "0002" : "0001", page_number(), lines[i]);
    }
}

/* ---- numbers ---- */

static void test_number_out_of_range_is_told_with_its_range(void)
{
    static const struct { const char *line, *answer; } wrong[] = {
        {"page 128", "Page must be 0..127"}, {"copy 128", "Page must be 0..127"}, {"save 300", "Page must be 0..127"},
        {"step 8", "Step must be 0..7"}, {"go 7", "Step must be 0..6"}, {"write 7", "Step must be 0..6"},
        {"mirror 7", "Step must be 0..6"}, {"insert 9", "Step must be 0..6"}, {"move 0 8", "Step must be 0..7"},
        {"goto 10 0", "X must be 0..9"}, {"goto 0 33", "Y must be 0..32"}};
    for (uint8_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        TEST_ASSERT_EQUAL_STRING(wrong[i].answer, answer(wrong[i].line));
        TEST_ASSERT_FALSE(the_session.is_changed);
    }
    TEST_ASSERT_EQUAL_STRING("0001", page_number());
}

static void test_number_counts_only_as_a_whole_word(void)
{
    static const char *const lines[] = {"page 2x", "page x", "page 0b1", "page -1", "page 65538", "page 0x"};
    for (uint8_t i = 0; i < sizeof lines / sizeof lines[0]; i++) {
        TEST_ASSERT_EQUAL_STRING_MESSAGE("Page must be 0..127", answer(lines[i]), lines[i]);
        TEST_ASSERT_EQUAL_STRING_MESSAGE("0001", page_number(), lines[i]);
    }
}

static void test_numbers_may_be_hexadecimal(void)
{
    type("page 0x02\r");
    TEST_ASSERT_EQUAL_STRING("0002", page_number());
    type("hex\r");
    type("page 10\r");
    TEST_ASSERT_EQUAL_UINT8(16, the_session.page);
    TEST_ASSERT_EQUAL_STRING("0010", page_number());
    type("dec\r");
    type("page 10\r");
    TEST_ASSERT_EQUAL_UINT8(10, the_session.page);
}

static void test_wrong_count_of_words_is_an_invalid_parameter(void)
{
    static const char *const lines[] = {"page", "page 1 2", "copy", "step", "go", "move 1", "move 1 2 3", "insert", "set",
                                        "goto 1", "mirror", "undo 1"};
    for (uint8_t i = 0; i < sizeof lines / sizeof lines[0]; i++) {
        TEST_ASSERT_EQUAL_STRING_MESSAGE("Invalid Parameter", answer(lines[i]), lines[i]);
    }
    TEST_ASSERT_FALSE(the_session.is_changed);
}

static void test_count_is_looked_at_before_the_range(void)
{
    type("page 2 200\r");
    TEST_ASSERT_EQUAL_STRING("page 2 200 Invalid Parameter", message());
    TEST_ASSERT_EQUAL_STRING("0001", page_number());
}

static void test_empty_line_does_nothing(void)
{
    type("\r");   /* opens it */
    TEST_ASSERT_EQUAL_UINT8(DIALOG_LINE, the_dialog.mode);
    type("  \r");
    TEST_ASSERT_EQUAL_UINT8(DIALOG_TABLE, the_dialog.mode);
    TEST_ASSERT_EQUAL_STRING("", message());
}

/* ---- help ---- */

static void test_help_of_one_command_is_its_line(void)
{
    TEST_ASSERT_EQUAL_STRING("goto        x y  moves the cursor", answer("help goto"));
    TEST_ASSERT_EQUAL_STRING("No such command: HELP", answer("help got"));
}

static void test_help_of_each_command_fits_into_the_row(void)
{
    for (uint8_t i = 0; i < commands_count; i++) {
        char word[40], line[50];
        (void)sscanf(commands_table_P[i].text, "%39s", word);
        (void)snprintf(line, sizeof line, "help %s", word);
        (void)answer(line);
        TEST_ASSERT_LESS_OR_EQUAL_UINT8_MESSAGE(SCREEN_COLUMNS, the_screen.line_column, word);
    }
}

/* ---- the gate ---- */

/* The commands that, according to the spec, change nothing a play uses: viewing, the cursor, and release. */
static bool is_harmless(const char *word)
{
    static const char *const words[] = {"off", "take", "pairs", "monitor", "goto", "list",
                                        "help", "re", "rows", "hex", "dec"};
    for (uint8_t i = 0; i < sizeof words / sizeof words[0]; i++) {
        if (strcmp(words[i], word) == 0) {
            return true;
        }
    }
    return false;
}

static void test_while_something_moves_every_other_word_is_refused(void)
{
    type("@play 5\r");
    run_ms(500);
    TEST_ASSERT_FALSE(performer_is_idle(&the_performer));
    const session_t before = the_session;
    for (uint8_t i = 0; i < commands_count; i++) {
        char word[40];
        uint8_t length = 0;
        for (; commands_table_P[i].text[length] != ' '; length++) {
            word[length] = commands_table_P[i].text[length];
        }
        word[length] = '\0';
        if (!is_harmless(word)) {
            static const char *const numbers[] = {"", "1", "1 1"};
            shell_clear(&the_dialog.shell);
            (void)snprintf(the_dialog.line, DIALOG_LINE_BYTES, "%s %s", word, numbers[commands_table_P[i].args >> 4 & 7]);
            the_dialog.shell.length = (uint8_t)strlen(the_dialog.line);
            shell_args_t args;
            shell_split(&the_dialog.shell, false, &args);
            const bool moving = !performer_is_idle(&the_performer);
            TEST_ASSERT_EQUAL_UINT8_MESSAGE(
                SHELL_ERR_MOVING, shell_run(commands_table_P, commands_count, &args, moving), word);
        }
    }
    TEST_ASSERT_EQUAL_MEMORY(before.cells, the_session.cells, sizeof before.cells);
}

static void test_what_is_harmless_is_allowed_while_something_moves(void)
{
    for (uint8_t i = 0; i < commands_count; i++) {
        char word[40];
        (void)sscanf(commands_table_P[i].text, "%39s", word);
        TEST_ASSERT_EQUAL_MESSAGE(is_harmless(word), (commands_table_P[i].args & SHELL_STILL) == 0, word);
    }
}
