/* SPDX-License-Identifier: MIT
 * The screen as a terminal shows it: the frame of edit/ORIGINAL.md section 3. Only changes are sent, and only when the
 * console has room. */
#include "editor_stage.h"
#include "unity.h"

#include <string.h>
#include "console.h"

/* Number of screen positions written in these columns, without the command row. */
static uint16_t written_in(uint8_t first_column, uint8_t last_column)
{
    uint16_t count = 0;
    for (uint8_t row = 1; row < COMMAND_ROW; row++) {
        for (uint8_t column = first_column; column <= last_column; column++) {
            count = (uint16_t)(count + was_written(row, column));
        }
    }
    return count;
}

static uint16_t written_places(void)
{
    return written_in(1, TERMINAL_COLUMNS);
}

/* ---- the frame ---- */

static void test_frame_stands_cell_by_cell_where_the_original_has_it(void)
{
    TEST_ASSERT_EQUAL_STRING("Dynamixel  0(0x00)[", shown(1, 1, 19));
    TEST_ASSERT_EQUAL_STRING("Dynamixel 15(0x0F)[", shown(16, 1, 19));
    TEST_ASSERT_EQUAL_STRING("Dynamixel 30(0x1e)[", shown(31, 1, 19));
    TEST_ASSERT_EQUAL_STRING("one", shown(1, 65, 3));
    TEST_ASSERT_EQUAL_STRING("PageNumber:0001", shown(2, 65, 15));
    TEST_ASSERT_EQUAL_STRING("Addr:0000E200", shown(3, 65, 13));
    TEST_ASSERT_EQUAL_STRING("   PauseTime       [000]", shown(32, 1, 24));
    TEST_ASSERT_EQUAL_STRING("[X:00,Y:00,A:0512]", shown(33, 61, 18));
    TEST_ASSERT_EQUAL_STRING("STP7  STP0 STP1 STP2 STP3 STP4 STP5 STP6    Go Step:", shown(34, 20, 52));
    TEST_ASSERT_EQUAL_STRING("] _", shown(35, 1, 3));
    for (uint8_t step = 0; step < 3; step++) {
        TEST_ASSERT_EQUAL_STRING(step == 0 ? "0403" : step == 1 ? "0413" : "0423", shown(4, (uint8_t)(26 + 5 * step), 4));
    }
    TEST_ASSERT_EQUAL_STRING("085", shown(31, 61, 3));
}

static void test_values_of_the_header_stand_behind_their_labels(void)
{
    static const struct { uint8_t row; const char *text; } header[] = {
        {5, "PlayCount:001"}, {10, "Page Step:003"}, {11, "ControlCode:000"}, {12, "Page Speed:032"}, {14, "Accel Time:032"},
        {15, "Link to Next:000"}, {16, "Link to Exit:000"}, {17, "Linked Page1:000"}, {18, "Page1Remocon:000"},
        {19, "Linked Page2:000"}, {20, "Page2Remocon:000"}};
    for (uint8_t i = 0; i < sizeof header / sizeof header[0]; i++) {
        const uint8_t length = (uint8_t)strlen(header[i].text);
        TEST_ASSERT_EQUAL_STRING(header[i].text, shown(header[i].row, (uint8_t)(80 - length), length));
    }
}

static void test_marker_stands_behind_the_last_step(void)
{
    for (uint8_t steps = 0; steps <= 7; steps++) {
        char line[] = "step 0\r";
        line[5] = (char)('0' + steps);
        type(line);
        for (uint8_t n = 0; n <= 7; n++) {
            TEST_ASSERT_EQUAL(n == steps, shown(17, (uint8_t)(25 + 5 * n), 1)[0] == '|');
        }
    }
}

static void test_cursor_rests_on_its_cell(void)
{
    static const struct { const char *line; uint8_t row, column; const char *xya; } places[] = {
        {"goto 0 0\r", 1, 20, "00,Y:00,A:0512"}, {"goto 1 3\r", 4, 26, "01,Y:03,A:0070"},
        {"goto 1 4\r", 5, 26, "01,Y:04,A:0072"}, {"goto 7 30\r", 31, 56, "07,Y:30,A:0508"},
        {"goto 8 5\r", 6, 61, "08,Y:05,A:0037"}, {"goto 9 9\r", 10, 77, "09,Y:09,A:0020"},
        {"goto 2 31\r", 32, 32, "02,Y:31,A:0190"},
        {"goto 0 32\r", 33, 21, "00,Y:32,A:0575"}};
    for (uint8_t i = 0; i < sizeof places / sizeof places[0]; i++) {
        type(places[i].line);
        TEST_ASSERT_EQUAL_UINT8_MESSAGE(places[i].row, cursor_row, places[i].line);
        TEST_ASSERT_EQUAL_UINT8_MESSAGE(places[i].column, cursor_column, places[i].line);
        TEST_ASSERT_EQUAL_STRING(places[i].xya, shown(33, 64, 14));
    }
}

/* ---- output to the terminal ---- */

/* Pages 1 and 2 differ only in STP0 of joint 3, page speed, name, number and address. */
static void test_page_change_sends_the_cells_that_differ_and_no_other(void)
{
    type("page 2\r");
    TEST_ASSERT_EQUAL_STRING("0503", cell(1, 3));
    TEST_ASSERT_EQUAL_STRING("two", shown(1, 65, 3));
    TEST_ASSERT_EQUAL_STRING("0002", shown(2, 76, 4));
    TEST_ASSERT_EQUAL_STRING("0000E400", shown(3, 70, 8));
    TEST_ASSERT_EQUAL_STRING("040", shown(12, 77, 3));
    TEST_ASSERT_EQUAL_UINT16(4, written_in(25, 63));
    TEST_ASSERT_TRUE(was_written(4, 26) && was_written(4, 29));
    TEST_ASSERT_EQUAL_UINT16(0, written_in(1, 24));
    for (uint8_t row = 4; row < COMMAND_ROW; row++) {
        TEST_ASSERT_EQUAL(row == 12, was_written(row, 77));
    }
    TEST_ASSERT_LESS_THAN_UINT32(200, sent());
}

static void test_cell_that_is_set_is_sent_alone(void)
{
    type("goto 1 3\r");
    clear_sent();
    type("set 700\r");
    TEST_ASSERT_EQUAL_STRING("0700", cell(1, 3));
    TEST_ASSERT_EQUAL_STRING("* unsaved", shown(34, 1, 9));
    TEST_ASSERT_EQUAL_UINT16(4 + 9, written_places());
}

static void test_unsaved_mark_goes_with_the_change(void)
{
    type("goto 1 3\r");
    type("]");
    TEST_ASSERT_EQUAL_STRING("* unsaved", shown(34, 1, 9));
    type("[");
    TEST_ASSERT_EQUAL_STRING("         ", shown(34, 1, 9));
}

static void test_nothing_is_sent_while_nothing_changes(void)
{
    run_ms(3000);
    TEST_ASSERT_EQUAL_UINT32(0, sent());
}

static void test_re_sends_everything_again(void)
{
    type("re\r");
    run_ms(2000);
    TEST_ASSERT_GREATER_THAN_UINT16(31 * (19 + 4 + 1 + 7 * 4 + 3), written_places());
    test_frame_stands_cell_by_cell_where_the_original_has_it();
}

static void test_limp_joint_shows_where_it_is_moved_by_hand(void)
{
    fake_bus_set_word(2, 36, 337);
    run_ms(500);
    TEST_ASSERT_EQUAL_STRING("Dynamixel  2(0337)[????]", shown(3, 1, 24));
    TEST_ASSERT_EQUAL_UINT16(6, written_places());   /* (0337) */
}

/* ---- room ---- */

/* While the line accepts nothing, keys still take effect, and a cell that changes twice is sent once. */
static void test_keys_do_not_wait_for_the_screen(void)
{
    type("goto 1 3\r");
    clear_sent();
    fake_console_type("]]}");
    for (uint8_t turn = 0; turn < 50; turn++) {
        fake_console_set_room(0);
        TEST_ASSERT_FALSE(editor_turn());
    }
    TEST_ASSERT_EQUAL_UINT16(415, the_session.cells[70] | the_session.cells[71] << 8);
    TEST_ASSERT_EQUAL(0, fake_console_output_count());
    run_ms(500);
    TEST_ASSERT_EQUAL_STRING("0415", cell(1, 3));
    TEST_ASSERT_LESS_THAN_UINT32(60, sent());
}

/* ---- command row ---- */

static void test_line_is_cut_at_the_end_of_its_row(void)
{
    char line[101];
    memset(line, 'x', 100);
    line[100] = '\0';
    type(line);
    TEST_ASSERT_EQUAL_STRING("xxx ", shown(COMMAND_ROW, 77, 4));   /* the last column would make the terminal scroll */
    TEST_ASSERT_EQUAL_STRING("    ", shown(COMMAND_ROW + 1, 1, 4));
    TEST_ASSERT_EQUAL_UINT16(0, written_places());
}

static void test_message_stays_behind_the_line_and_goes_with_the_next(void)
{
    type("nonsense with words\r");
    TEST_ASSERT_EQUAL_STRING("nonsense with words Bad Command", message());
    type("h");
    TEST_ASSERT_EQUAL_STRING("h", message());
}

/* ---- short terminals ---- */

static void test_short_terminal_has_rows_for_joints_that_are_there(void)
{
    type("rows 24\r");
    run_ms(2000);
    TEST_ASSERT_EQUAL_STRING("Dynamixel  1", shown(1, 1, 12));
    TEST_ASSERT_EQUAL_STRING("Dynamixel  3", shown(3, 1, 12));
    TEST_ASSERT_EQUAL_STRING("            ", shown(4, 1, 12));
    TEST_ASSERT_EQUAL_STRING("   PauseTime", shown(21, 1, 12));
    TEST_ASSERT_EQUAL_STRING("] ", shown(24, 1, 2));
    TEST_ASSERT_EQUAL_STRING("Page2Remocon:000", shown(20, 64, 16));
    for (uint8_t row = 25; row <= TERMINAL_ROWS; row++) {
        TEST_ASSERT_EQUAL_STRING("    ", shown(row, 1, 4));
    }
}
