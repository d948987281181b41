/* SPDX-License-Identifier: MIT
 * The editor's keys and modes: questions before edits are lost, keys in the table and in a line, and what stops a play;
 * edit/ORIGINAL.md section 4. */
#include "editor_stage.h"
#include "unity.h"

#include <stdio.h>
#include <string.h>
#include "bus.h"
#include "crc16.h"

#define UP "\033[A"
#define DOWN "\033[B"
#define RIGHT "\033[C"
#define LEFT "\033[D"

static uint16_t word_at(uint16_t address)
{
    return (uint16_t)(the_session.cells[address] | the_session.cells[address + 1] << 8);
}

static void change_a_cell(void)
{
    type("goto 1 3\r");
    type("set 700\r");
    TEST_ASSERT_TRUE(the_session.is_changed);
}

/* ---- questions ---- */

static void test_question_comes_before_edits_are_dropped(void)
{
    static const char *const lines[] = {"page 2\r", "next\r", "before\r", "copy 2\r", "new\r", "exit\r"};
    change_a_cell();
    for (uint8_t i = 0; i < sizeof lines / sizeof lines[0]; i++) {
        type(lines[i]);
        TEST_ASSERT_NOT_NULL_MESSAGE(strstr(message(), "Are you sure?[y/N]"), lines[i]);
        type("n");
        TEST_ASSERT_EQUAL_UINT16_MESSAGE(700, word_at(70), lines[i]);
        TEST_ASSERT_EQUAL_UINT8_MESSAGE(1, the_session.page, lines[i]);
        TEST_ASSERT_EQUAL_UINT8_MESSAGE(DIALOG_TABLE, the_dialog.mode, lines[i]);
    }
}

static void test_rest_of_a_line_that_answered_a_question_is_no_command(void)
{
    change_a_cell();
    type("page 2\r");
    fake_console_type("on 99\r");
    run_ms(500);
    TEST_ASSERT_EQUAL_UINT8(1, the_session.page);
    TEST_ASSERT_NULL(strstr(message(), "Bad Command"));
    TEST_ASSERT_EQUAL_UINT8(DIALOG_TABLE, the_dialog.mode);
}

static void test_what_was_typed_ahead_answers_no_question(void)
{
    change_a_cell();
    fake_console_type("page 2\ryes\rsave 3\r");
    run_ms(500);
    TEST_ASSERT_EQUAL_UINT8(DIALOG_ASK, the_dialog.mode);
    TEST_ASSERT_EQUAL_UINT8(1, the_session.page);
    TEST_ASSERT_EQUAL_UINT8(0xFF, flash_page(3)[0]);
    type("n");
    TEST_ASSERT_TRUE(the_session.is_changed);
}

/* D+R and U+L+R: the packets have U (UNDO), LF and CR among their bytes (REMOTE.md). */
static void test_packets_of_a_remote_are_not_keys(void)
{
    static const uint8_t packets[][6] = {{0xFF, 0x55, 0x0A, 0xF5, 0x00, 0xFF}, {0xFF, 0x55, 0x0D, 0xF2, 0x00, 0xFF}};
    change_a_cell();
    type("name\r");
    for (uint8_t i = 0; i < 20; i++) {
        fake_console_type_bytes(packets[i & 1u], sizeof packets[0]);
        run_ms(50);
    }
    fake_console_type_bytes(packets[0], 3);   /* the rest of it is lost */
    run_ms(50);
    type("wave\r");
    TEST_ASSERT_EQUAL_STRING("wave", (const char *)the_session.cells);
    TEST_ASSERT_EQUAL_UINT16(700, word_at(70));
}

static void test_empty_or_long_names_keep_the_old_one(void)
{
    type("name\r");
    type("\r");
    TEST_ASSERT_EQUAL_STRING("one", (const char *)the_session.cells);
    type("name\r");
    type("fourteen chars\r");
    TEST_ASSERT_EQUAL_STRING("one", (const char *)the_session.cells);
    TEST_ASSERT_NOT_NULL(strstr(message(), "At most 13 characters"));
    type("name\r");
    type(" \r");
    TEST_ASSERT_EQUAL_STRING("", (const char *)the_session.cells);
}

static void test_space_behind_the_end_of_a_list_switches_nothing(void)
{
    type("goto 0 1\r");
    type("list 1 2\r");
    fake_console_type("  ");
    run_ms(300);
    TEST_ASSERT_EQUAL_UINT8(0, fake_bus_servo(1)->table[24]);
}

static void test_delete_of_a_step_that_is_not_used_says_so(void)
{
    type("delete 6\r");
    TEST_ASSERT_NOT_NULL(strstr(message(), "That step is not used"));
    TEST_ASSERT_FALSE(the_session.is_changed);
}

static void test_any_key_but_y_says_no(void)
{
    static const char *const keys[] = {"n", "\r", " ", "x", "2", "\x03"};
    change_a_cell();
    for (uint8_t i = 0; i < sizeof keys / sizeof keys[0]; i++) {
        type("page 2\r");
        type(keys[i]);
        TEST_ASSERT_EQUAL_UINT8_MESSAGE(1, the_session.page, keys[i]);
        TEST_ASSERT_EQUAL_UINT16_MESSAGE(700, word_at(70), keys[i]);
    }
    type("page 2\r");
    type("Y");
    TEST_ASSERT_EQUAL_UINT8(2, the_session.page);
    TEST_ASSERT_FALSE(the_session.is_changed);
}

static void test_nobody_is_asked_when_nothing_is_lost(void)
{
    type("page 2\r");
    TEST_ASSERT_EQUAL_UINT8(2, the_session.page);
    type("copy 1\r");
    TEST_ASSERT_EQUAL_UINT16(403, word_at(70));
    TEST_ASSERT_TRUE(the_session.is_changed);
    type("undo\r");
    type("before\r");
    TEST_ASSERT_EQUAL_UINT8(1, the_session.page);
}

static void test_exit_restarts_only_after_the_question(void)
{
    change_a_cell();
    TEST_ASSERT_FALSE(restarts("exit\r"));
    TEST_ASSERT_FALSE(restarts("n"));
    TEST_ASSERT_FALSE(restarts("exit\r"));
    TEST_ASSERT_TRUE(restarts("y"));
}

static void test_save_writes_the_page_and_takes_the_mark_away(void)
{
    change_a_cell();
    type("save\r");
    TEST_ASSERT_EQUAL_STRING("save OK", message());
    TEST_ASSERT_EQUAL_MEMORY(the_session.cells, flash_page(1), PAGE_BYTES);
    TEST_ASSERT_FALSE(the_session.is_changed);
}

static uint16_t operations, operations_on_a_busy_bus;

static void note_operation(void)
{
    operations++;
    operations_on_a_busy_bus += bus_has_news();
}

/* Answers take longer than a tick, so that an answer is pending most of the time. */
static void test_save_waits_until_the_bus_is_quiet(void)
{
    fake_bus_set_latency(30);
    for (uint8_t ms = 0; ms < 16; ms++) {
        type("goto 1 3\r");
        type(ms % 2 == 0 ? "set 700\r" : "set 701\r");
        fake_console_type("save");
        run_ms(500u + ms);
        TEST_ASSERT_TRUE(bus_has_news());
        operations = operations_on_a_busy_bus = 0;
        fake_flash_on_operation(note_operation);
        type("\r");
        TEST_ASSERT_GREATER_THAN(0, operations);
        TEST_ASSERT_EQUAL(0, operations_on_a_busy_bus);
    }
}

/* ---- keys in the table ---- */

static void test_arrows_move_the_cursor_and_stop_at_the_edge(void)
{
    type(UP LEFT);
    TEST_ASSERT_EQUAL_UINT8(0, the_session.x);
    TEST_ASSERT_EQUAL_UINT8(0, the_session.y);
    type(DOWN DOWN RIGHT);
    TEST_ASSERT_EQUAL_UINT8(1, the_session.x);
    TEST_ASSERT_EQUAL_UINT8(2, the_session.y);
    type("goto 7 32\r");
    type(DOWN RIGHT);
    TEST_ASSERT_EQUAL_UINT8(7, the_session.x);
    TEST_ASSERT_EQUAL_UINT8(32, the_session.y);
}

/* On a short terminal the table omits missing joints; the header next to it keeps all rows. */
static void test_arrows_in_the_header_know_no_missing_joints(void)
{
    type("rows 24\r");   /* servos 1 to 3 are present */
    type("goto 9 7\r" RIGHT);
    TEST_ASSERT_EQUAL_UINT8(9, the_session.x);
    TEST_ASSERT_EQUAL_UINT8(7, the_session.y);
    type(UP UP DOWN);
    TEST_ASSERT_EQUAL_UINT8(6, the_session.y);
    type(LEFT);
    TEST_ASSERT_EQUAL_UINT8(3, the_session.y);   /* the last present joint above */
}

static void test_home_end_and_pages_of_rows_move_the_cursor_far(void)
{
    type("goto 3 10\r\033[F");
    TEST_ASSERT_EQUAL_UINT8(9, the_session.x);
    type("\033[H");
    TEST_ASSERT_EQUAL_UINT8(0, the_session.x);
    TEST_ASSERT_EQUAL_UINT8(10, the_session.y);
    type("\033[6~");
    TEST_ASSERT_EQUAL_UINT8(18, the_session.y);
    type("\033[6~\033[6~");
    TEST_ASSERT_EQUAL_UINT8(32, the_session.y);
    type("\033[4~");
    TEST_ASSERT_EQUAL_UINT8(7, the_session.x);   /* the row of speeds has no softness cell */
    type("\033[5~");
    TEST_ASSERT_EQUAL_UINT8(24, the_session.y);
    type("\033[5~\033[5~\033[5~\033[1~");
    TEST_ASSERT_EQUAL_UINT8(0, the_session.y);
    TEST_ASSERT_EQUAL_UINT8(0, the_session.x);
}

static void test_brackets_change_a_position_within_its_range(void)
{
    type("goto 1 3\r");
    type("]}[");
    TEST_ASSERT_EQUAL_UINT16(413, word_at(70));
    type("set 1020\r");
    type("}");
    TEST_ASSERT_EQUAL_UINT16(1020, word_at(70));
    type("set 5\r");
    type("{");
    TEST_ASSERT_EQUAL_UINT16(5, word_at(70));
}

static void test_brackets_wrap_a_byte_and_stop_at_seven_steps(void)
{
    type("goto 1 31\r");
    type("[");
    TEST_ASSERT_EQUAL_UINT8(255, the_session.cells[64 + 62]);
    type("]");
    TEST_ASSERT_EQUAL_UINT8(0, the_session.cells[64 + 62]);
    type("goto 9 9\r");
    type("}");
    TEST_ASSERT_EQUAL_UINT8(7, the_session.cells[20]);
    type("{");
    TEST_ASSERT_EQUAL_UINT8(0, the_session.cells[20]);
}

static void test_space_takes_a_position_away_and_gives_it_back(void)
{
    type("goto 1 3\r");
    type(" ");
    run_ms(200);
    TEST_ASSERT_EQUAL_STRING("????", cell(1, 3));
    TEST_ASSERT_EQUAL_HEX16(0x2000 + 403, word_at(70));
    type(" ");
    run_ms(200);
    TEST_ASSERT_EQUAL_STRING("0403", cell(1, 3));
    type("goto 1 31\r");
    type(" ");
    run_ms(200);
    TEST_ASSERT_EQUAL_UINT8(0, the_session.cells[64 + 62]);
    TEST_ASSERT_FALSE(the_session.is_changed);
}

static void test_space_on_the_work_pose_holds_and_lets_go(void)
{
    type("goto 0 2\r");
    type(" ");
    run_ms(200);
    TEST_ASSERT_EQUAL_UINT8(1, fake_bus_servo(2)->table[24]);
    TEST_ASSERT_EQUAL_UINT16(512, fake_bus_word(2, 30));
    TEST_ASSERT_EQUAL_STRING("0512", cell(0, 2));
    type(" ");
    run_ms(200);
    TEST_ASSERT_EQUAL_UINT8(0, fake_bus_servo(2)->table[24]);
    TEST_ASSERT_EQUAL_STRING("????", cell(0, 2));
}

/* ---- keys in a line ---- */

static void test_cr_lf_and_both_end_a_line_once(void)
{
    static const char *const ends[] = {"page 2\r", "page 1\n", "page 2\r\n"};
    for (uint8_t i = 0; i < sizeof ends / sizeof ends[0]; i++) {
        type(ends[i]);
        TEST_ASSERT_EQUAL_UINT8(i == 1 ? 1 : 2, the_session.page);
        TEST_ASSERT_EQUAL_UINT8(DIALOG_TABLE, the_dialog.mode);
    }
}

static void test_backspace_and_delete_take_back(void)
{
    type("page 19\x08\x7F" "2\r");
    TEST_ASSERT_EQUAL_UINT8(2, the_session.page);
}

static void test_ctrl_c_leaves_the_line_and_runs_nothing(void)
{
    type("page 2\x03");
    TEST_ASSERT_EQUAL_UINT8(DIALOG_TABLE, the_dialog.mode);
    type("\r");
    TEST_ASSERT_EQUAL_UINT8(1, the_session.page);
}

static void test_ctrl_a_recalls_the_line_before(void)
{
    type("page 2\r");
    type("page 1\r");
    type("x\x15\x01\x01\r");
    TEST_ASSERT_EQUAL_UINT8(2, the_session.page);
}

static void test_line_that_is_too_long_is_not_run(void)
{
    type("page 2");
    for (uint8_t i = 0; i < 13; i++) {
        type("          ");
    }
    type("\r");
    TEST_ASSERT_EQUAL_UINT8(1, the_session.page);
    TEST_ASSERT_EQUAL_STRING("The line is too long: nothing was done", message());
}

/* ---- a play ---- */

static uint16_t goal(void)
{
    return fake_bus_word(1, 30);
}

static void start_play(void)
{
    type("play 5\r");
    run_ms(11500);
    TEST_ASSERT_FALSE(performer_is_idle(&the_performer));
    TEST_ASSERT_EQUAL_UINT8(DIALOG_PLAY, the_dialog.mode);
}

static void test_space_and_ctrl_c_break_a_play_at_once(void)
{
    static const char *const keys[] = {" ", "\x03"};
    for (uint8_t i = 0; i < sizeof keys / sizeof keys[0]; i++) {
        start_play();
        type(keys[i]);
        TEST_ASSERT_TRUE(performer_is_idle(&the_performer));
        TEST_ASSERT_EQUAL_STRING("Page 5 step 1 repetition 1[BREAK] OK", message());
        const uint16_t stood = goal();
        run_ms(1000);
        TEST_ASSERT_EQUAL_UINT16(stood, goal());
        TEST_ASSERT_EQUAL_UINT8(1, fake_bus_servo(1)->table[24]);
    }
}

static void test_cr_and_esc_let_the_page_come_to_its_end(void)
{
    static const char *const keys[] = {"\r", "\033"};
    static const char *const shown_keys[] = {"Page 5 step 1 repetition 1[STOP]", "Page 5 step 1 repetition 1[Exit]"};
    for (uint8_t i = 0; i < sizeof keys / sizeof keys[0]; i++) {
        start_play();
        type(keys[i]);
        TEST_ASSERT_EQUAL_STRING(shown_keys[i], message());
        TEST_ASSERT_FALSE(performer_is_idle(&the_performer));
        for (uint8_t s = 0; s < 60 && !performer_is_idle(&the_performer); s++) {
            run_ms(1000);
        }
        run_ms(100);
        TEST_ASSERT_EQUAL_UINT16(600, goal());
        TEST_ASSERT_EQUAL_UINT8(DIALOG_TABLE, the_dialog.mode);
        TEST_ASSERT_NOT_NULL(strstr(message(), "OK"));
    }
}

static void test_other_keys_do_nothing_to_a_play(void)
{
    start_play();
    type("x]2y");
    TEST_ASSERT_FALSE(performer_is_idle(&the_performer));
    TEST_ASSERT_EQUAL_STRING("Page 5 step 1 repetition 1", message());
    TEST_ASSERT_FALSE(the_session.is_changed);
}

static void test_what_is_typed_behind_a_break_waits_for_the_end(void)
{
    start_play();
    type(" page 2\r");
    TEST_ASSERT_EQUAL_UINT8(2, the_session.page);
}

static void test_space_just_behind_the_end_was_meant_for_the_play(void)
{
    type("goto 1 3\r");
    start_play();
    type("  ");
    TEST_ASSERT_EQUAL_STRING("0403", cell(1, 3));
    run_ms(600);
    type(" ");
    TEST_ASSERT_EQUAL_STRING("????", cell(1, 3));
}

static void test_page_0_is_not_played(void)
{
    type("play 0\r");
    TEST_ASSERT_EQUAL_STRING("play 0 Page must be 1..127", message());
    TEST_ASSERT_TRUE(performer_is_idle(&the_performer));
}

/* ---- a program's motion while a person types ---- */

/* A program sends a request through the channel. */
static void request(const char *words)
{
    char line[100];
    (void)snprintf(line, sizeof line, "\x1E%s%04X\r", words,
                   (unsigned)crc16_bytes(CRC16_START, (const uint8_t *)words, (uint16_t)strlen(words)));
    type(line);
}

/* A program plays page 1, which ends with joint 1 at 421, while the person has typed `typed`. */
static void type_during_a_programs_play(const char *typed)
{
    request("@play 1 ");
    TEST_ASSERT_FALSE(performer_is_idle(&the_performer));
    type(typed);
    for (uint8_t s = 0; s < 20 && !performer_is_idle(&the_performer); s++) {
        run_ms(1000);
    }
    TEST_ASSERT_TRUE(performer_is_idle(&the_performer));
    TEST_ASSERT_EQUAL_UINT16(421, goal());
}

/* The rate is for this play: the end of an earlier one does not take it away. */
static void test_end_of_a_programs_play_does_not_end_the_next_one(void)
{
    type_during_a_programs_play("play");
    type(" 5 50\r");
    run_ms(1000);
    TEST_ASSERT_EQUAL_UINT8(DIALOG_PLAY, the_dialog.mode);
    TEST_ASSERT_EQUAL_UINT16(50, the_performer.shape.rate_percent);
    TEST_ASSERT_NULL(strstr(message(), "OK"));
}

static void test_write_stores_the_pose_in_which_a_programs_play_ended(void)
{
    type_during_a_programs_play("write");
    type(" 5\r");
    TEST_ASSERT_EQUAL_STRING("0421", cell(0, 1));
    TEST_ASSERT_EQUAL_UINT16(421, word_at(PAGE_AT_STEP0 + 5 * PAGE_STEP_BYTES + 2));
}

static void test_key_behind_a_list_changes_the_pose_in_which_a_programs_play_ended(void)
{
    type("goto 0 1\r");
    type("list 1 2\r");
    type_during_a_programs_play("");
    type("]");
    TEST_ASSERT_EQUAL_UINT16(422, goal());
}

/* ---- page 0 ---- */

/* Stores a trim of 50 for joint 1, and opens page 0. */
static void open_page_0_with_a_trim(void)
{
    uint8_t *page = flash_page(0);
    page_clear(page);
    page[PAGE_AT_STEPS] = 3;
    page_set_pos(page, 0, 1, 512);
    page_set_pos(page, 1, 1, 562);
    page_set_pos(page, 2, 1, 50);
    page_seal(page);
    page_store_refresh(&the_pages, 0);
    type("page 0\r");
}

static void run_to_the_end(void)
{
    for (uint8_t s = 0; s < 20 && !performer_is_idle(&the_performer); s++) {
        run_ms(1000);
    }
    run_ms(500);
    TEST_ASSERT_EQUAL_UINT8(DIALOG_TABLE, the_dialog.mode);
}

static void test_page_is_played_with_the_trim_while_page_0_is_open(void)
{
    open_page_0_with_a_trim();
    type("play 1\r");
    run_to_the_end();
    TEST_ASSERT_EQUAL_UINT16(421 + 50, goal());
    TEST_ASSERT_EQUAL_STRING("0471", cell(0, 1));   /* page 0 is edited without trim */
    request("@play 2 ");
    run_ms(500);
    type(" ");
    run_to_the_end();
    request("@play 1 ");
    run_to_the_end();
    TEST_ASSERT_EQUAL_UINT16(421 + 50, goal());
    request("@play 1 ");
    request("@play 1 ");   /* refused */
    run_to_the_end();
    TEST_ASSERT_EQUAL_UINT16(421 + 50, goal());
}

static void test_move_of_a_program_has_no_trim_while_page_0_is_open(void)
{
    open_page_0_with_a_trim();
    request("@move 90 1 1A5 ");
    run_to_the_end();
    TEST_ASSERT_EQUAL_UINT16(0x1A5, goal());
    TEST_ASSERT_EQUAL_STRING("0421", cell(0, 1));
    type("page 1\r");
    TEST_ASSERT_EQUAL_STRING("0371", cell(0, 1));
}
