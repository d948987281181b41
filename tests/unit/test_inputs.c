/* SPDX-License-Identifier: MIT
 * Play's inputs: what remote, panel and typed text request from the performer. */
#include <stdio.h>
#include <string.h>
#include "console.h"
#include "fake_console.h"
#include "fake_panel.h"
#include "inputs_stage.h"
#include "panel.h"
#include "unity.h"

/* ---- remote ---- */

/* All buttons are released, and for so long that no button counts as held. */
static void let_go(void)
{
    remote(0);
    ticks(INPUTS_RELEASE_TICKS);
}

static void test_inputs_code_starts_its_page(void)
{
    remote(16);
    TEST_ASSERT_EQUAL_STRING("start 5 16;", told);
}

static void test_inputs_code_goes_to_what_is_playing(void)
{
    performer.state = PERFORMER_PLAY;
    remote(4);
    remote(0);
    TEST_ASSERT_EQUAL_STRING("code 4 0;code 0 0;", told);
}

static void test_inputs_release_starts_nothing(void)
{
    remote(0);
    TEST_ASSERT_EQUAL_STRING("", told);
}

static void test_inputs_code_of_no_page_is_refused_once_while_held(void)
{
    inputs_refusal_t refusal;
    remote(2);
    TEST_ASSERT_TRUE(inputs_next_refusal(&inputs, &refusal));
    TEST_ASSERT_TRUE(refusal.no_page);
    TEST_ASSERT_EQUAL_UINT8(2, refusal.code);
    remote(2);
    TEST_ASSERT_FALSE(inputs_next_refusal(&inputs, &refusal));
    remote(0);
    remote(2);
    TEST_ASSERT_TRUE(inputs_next_refusal(&inputs, &refusal));
}

static void test_inputs_refused_start_says_which_page_and_why(void)
{
    inputs_refusal_t refusal;
    start_status = PERFORMER_ERR_PAGE;
    performer.fault_page = 5;
    performer.fault = PAGE_ERR_CHECKSUM;
    remote(16);
    TEST_ASSERT_TRUE(inputs_next_refusal(&inputs, &refusal));
    TEST_ASSERT_FALSE(refusal.no_page);
    TEST_ASSERT_EQUAL_UINT8(5, refusal.page);
    TEST_ASSERT_EQUAL_UINT8(PERFORMER_ERR_PAGE, refusal.status);
    TEST_ASSERT_EQUAL_UINT8(PAGE_ERR_CHECKSUM, refusal.fault);
}

static void test_inputs_stop_counts_when_it_is_pressed(void)
{
    performer.state = PERFORMER_PLAY;
    remote(512);
    remote(512);
    TEST_ASSERT_EQUAL_STRING("code 255 0;", told);
    let_go();
    remote(512 + 1);
    TEST_ASSERT_EQUAL_STRING("code 255 0;code 0 0;code 255 0;", told);
}

static void test_inputs_two_quick_presses_of_a_stop_are_two(void)
{
    performer.state = PERFORMER_PLAY;
    remote(512);
    ticks(6);
    remote(0);
    ticks(6);
    remote(512);
    remote(512);
    TEST_ASSERT_EQUAL_STRING("code 255 0;code 0 0;code 255 0;", told);
}

static void test_inputs_stop_when_idle_stops_what_code_moves(void)
{
    remote(512);
    TEST_ASSERT_EQUAL_STRING("stop 0 0;", told);
}

static void test_inputs_button_5_pauses_and_resumes(void)
{
    performer.state = PERFORMER_PLAY;
    remote(256);
    remote(256);
    TEST_ASSERT_EQUAL_STRING("pause 0 0;", told);
    let_go();
    memset(told, 0, sizeof told);
    remote(256);
    TEST_ASSERT_EQUAL_STRING("resume 0 0;", told);
}

static void test_inputs_latch_mode_outlives_silence(void)
{
    performer.state = PERFORMER_PLAY;
    remote(1);
    ticks(200);
    TEST_ASSERT_EQUAL_STRING("code 1 0;", told);
}

static void test_inputs_hold_mode_hears_silence_after_500_ms(void)
{
    performer.link.mode = LINK_HOLD;
    performer.state = PERFORMER_PLAY;
    remote(1);
    ticks(63);
    TEST_ASSERT_EQUAL_STRING("code 1 0;", told);
    ticks(1);
    TEST_ASSERT_EQUAL_STRING("code 1 0;code 0 0;", told);
    ticks(200);
    TEST_ASSERT_EQUAL_STRING("code 1 0;code 0 0;", told);
}

static void test_inputs_hold_mode_repeated_packets_keep_it_alive(void)
{
    performer.link.mode = LINK_HOLD;
    performer.state = PERFORMER_PLAY;
    for (uint8_t i = 0; i < 10; i++) {
        remote(1);
        ticks(40);
    }
    TEST_ASSERT_NULL(strstr(told, "code 0"));
}

static void test_inputs_hold_mode_never_heard_remote_is_not_missed(void)
{
    performer.link.mode = LINK_HOLD;
    performer.state = PERFORMER_PLAY;
    ticks(200);
    TEST_ASSERT_EQUAL_STRING("", told);
}

static void test_inputs_stop_after_a_lost_release_counts_again(void)
{
    performer.state = PERFORMER_PLAY;
    remote(512);
    ticks(64); /* no packet for 500 ms: all buttons count as released */
    remote(512);
    TEST_ASSERT_EQUAL_STRING("code 255 0;code 255 0;", told);
}

/* ---- a button press starts a play ---- */

/* Ends a play or a stop while the button stays down. */
static void end_play(void)
{
    performer.state = PERFORMER_IDLE;
    memset(told, 0, sizeof told);
}

static void hold(uint16_t buttons, uint8_t packets)
{
    while (packets-- > 0) {
        remote(buttons);
        ticks(6);
    }
}

static void test_inputs_held_button_does_not_start_again_what_has_ended(void)
{
    hold(1, 3);
    end_play();
    hold(1, 20);
    TEST_ASSERT_EQUAL_STRING("", told);
    let_go();
    remote(1);
    TEST_ASSERT_EQUAL_STRING("start 2 1;", told);
}

static void test_inputs_play_that_fails_before_the_next_packet_is_not_started_again(void)
{
    hold(1, 1);
    end_play();
    hold(1, 20);
    TEST_ASSERT_EQUAL_STRING("", told);
}

static void test_inputs_silence_makes_the_same_button_a_press(void)
{
    const uint8_t modes[] = {LINK_LATCH, LINK_HOLD, LINK_DRIVE};
    for (uint8_t i = 0; i < sizeof modes; i++) {
        setUp();
        performer.link.mode = modes[i];
        hold(1, 3);
        end_play();
        remote(1);
        ticks(63);
        remote(1);
        TEST_ASSERT_EQUAL_STRING("", told);
        ticks(64);
        remote(1);
        TEST_ASSERT_EQUAL_STRING("start 2 1;", told);
    }
}

static void test_inputs_another_code_is_a_press(void)
{
    hold(1, 3);
    end_play();
    remote(16);
    TEST_ASSERT_EQUAL_STRING("start 5 16;", told);
    end_play();
    hold(16, 3);
    remote(1);
    TEST_ASSERT_EQUAL_STRING("start 2 1;", told);
}

static void test_inputs_start_does_not_make_a_held_button_a_press(void)
{
    hold(1, 3);
    fake_panel_press(PANEL_START);
    ticks(5);
    end_play();
    hold(1, 20);
    fake_panel_press(0);
    hold(1, 20);
    TEST_ASSERT_EQUAL_STRING("", told);
}

static void test_inputs_button_6_does_not_make_a_held_button_a_press(void)
{
    hold(1, 3);
    remote(512 + 1);
    end_play();
    hold(1, 20);
    TEST_ASSERT_EQUAL_STRING("", told);
}

static void test_inputs_fingers_that_leave_a_fist_start_nothing(void)
{
    hold(1, 3);
    remote(255);
    end_play();
    remote(127);
    remote(17);
    hold(16, 3);
    TEST_ASSERT_EQUAL_STRING("", told);
    remote(1);
    TEST_ASSERT_EQUAL_STRING("start 2 1;", told);
}

static void test_inputs_fingers_that_leave_a_chord_after_a_stop_start_nothing(void)
{
    hold(1, 3);
    hold(1 + 4, 3);
    end_play();
    hold(1, 20);
    TEST_ASSERT_EQUAL_STRING("", told);
}

static void test_inputs_fingers_that_leave_a_chord_do_not_call_back_a_play_that_is_stopping(void)
{
    hold(1, 3);
    hold(1 + 4, 3);
    performer.link.stopping = true;
    memset(told, 0, sizeof told);
    hold(1 + 4, 3);
    hold(1, 20);
    TEST_ASSERT_EQUAL_STRING("", told);
    let_go();
    remote(1);
    TEST_ASSERT_EQUAL_STRING("code 0 0;code 1 0;", told);
}

static void test_inputs_steering_is_no_press(void)
{
    performer.link.mode = LINK_DRIVE;
    performer.state = PERFORMER_PLAY;
    partner = 3;
    hold(1 + 4, 3);   /* L steers, so the play gets code 1 */
    end_play();
    partner = 0;
    hold(1 + 4, 20);
    TEST_ASSERT_EQUAL_STRING("", told);
}

static void test_inputs_button_held_before_a_play_may_start_nothing_behind_it(void)
{
    hold(2, 1);       /* no page has this code */
    performer.state = PERFORMER_PLAY;   /* started by page number */
    hold(2, 3);
    end_play();
    hold(2, 20);
    TEST_ASSERT_EQUAL_STRING("", told);
}

/* ---- two remotes on one channel ---- */

/* One remote sends `a` every 47 ms, the other one `b` between its packets. */
static void both_hold(uint16_t a, uint16_t b, uint8_t packets)
{
    while (packets-- > 0) {
        remote(b);
        ticks(3);
        remote(a);
        ticks(3);
    }
}

/* The first remote's button goes on, the other one lets go, and the first one lets go and presses again at last. */
static void expect_nothing_until_released(uint16_t a)
{
    memset(told, 0, sizeof told);
    remote(0);
    ticks(3);
    hold(a, 20);
    TEST_ASSERT_NULL_MESSAGE(strstr(told, "start"), told);
    TEST_ASSERT_NULL_MESSAGE(strstr(told, "code 1"), told);
    performer.state = PERFORMER_IDLE;
    hold(a, 20);
    TEST_ASSERT_NULL_MESSAGE(strstr(told, "start"), told);
    let_go();
    hold(a, 1);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(told, "start 2 1;"), told);
}

static void test_inputs_stop_of_one_remote_outlives_the_thumb_on_the_other(void)
{
    const uint8_t modes[] = {LINK_LATCH, LINK_HOLD};
    for (uint8_t i = 0; i < sizeof modes; i++) {
        for (uint8_t packets = 1; packets <= 6; packets += 5) {
            setUp();
            performer.link.mode = modes[i];
            hold(1, 3);
            performer.link.stopping = true;
            memset(told, 0, sizeof told);
            both_hold(1, 512, packets);
            TEST_ASSERT_EQUAL_STRING("code 255 0;", told);
            expect_nothing_until_released(1);
        }
    }
}

static void test_inputs_stop_of_one_remote_starts_nothing_that_the_other_holds(void)
{
    for (uint8_t since_start = 0; since_start < 2; since_start++) {
        setUp();
        if (since_start) {
            inputs_init(&inputs, &performer, &pages);
        } else {
            performer.state = PERFORMER_PLAY;
        }
        hold(1, 3);
        performer.state = PERFORMER_IDLE;
        memset(told, 0, sizeof told);
        both_hold(1, 512, 6);
        TEST_ASSERT_EQUAL_STRING("stop 0 0;", told);
        expect_nothing_until_released(1);
    }
}

static void test_inputs_button_that_comes_down_while_another_remote_stops_is_no_press(void)
{
    performer.state = PERFORMER_PLAY;
    hold(512, 3);
    performer.link.stopping = true;
    memset(told, 0, sizeof told);
    both_hold(1, 512, 6);
    TEST_ASSERT_EQUAL_STRING("", told);
    expect_nothing_until_released(1);
}

static void test_inputs_stop_of_one_remote_outlives_a_lost_packet_of_the_other(void)
{
    hold(1, 3);
    performer.link.stopping = true;
    both_hold(1, 512, 3);
    memset(told, 0, sizeof told);
    remote(0);
    ticks(10);   /* 13 since the last packet with the button: 100 ms */
    remote(1);
    TEST_ASSERT_EQUAL_STRING("code 0 0;", told);
}

static void test_inputs_button_counts_as_released_after_100_ms(void)
{
    hold(1, 1);
    end_play();
    remote(0);
    ticks(7);    /* 13 since the last packet with the button */
    remote(1);
    TEST_ASSERT_EQUAL_STRING("", told);
    let_go();
    remote(1);
    TEST_ASSERT_EQUAL_STRING("start 2 1;", told);
}

static void test_inputs_pause_of_one_remote_is_one_pause(void)
{
    performer.state = PERFORMER_PLAY;
    hold(1, 3);
    memset(told, 0, sizeof told);
    both_hold(1, 256, 6);
    TEST_ASSERT_NOT_NULL(strstr(told, "pause"));
    TEST_ASSERT_NULL(strstr(told, "resume"));
}

static void test_inputs_hold_mode_release_of_one_remote_is_a_stop_in_spite_of_the_other(void)
{
    performer.link.mode = LINK_HOLD;
    hold(1, 3);
    both_hold(1, 4, 3);
    memset(told, 0, sizeof told);
    remote(0);
    TEST_ASSERT_EQUAL_STRING("code 0 0;", told);
    performer.link.stopping = true;
    expect_nothing_until_released(1);
}

/* ---- a stop, or the end of a play, outlives every thumb ---- */

typedef enum { ON_REMOTE, ON_PANEL } thumb_t;

static void thumb_down(thumb_t thumb, uint8_t buttons)
{
    if (thumb == ON_PANEL) {
        fake_panel_press(buttons);
    } else {
        remote(buttons);
    }
    ticks(5);
}

static void typed_stop(uint8_t held)
{
    performer_stop(&performer);
}

static void typed_code(uint8_t held)
{
    inputs_code(&inputs, LINK_CODE_STOP);
}

static void remote_stop(uint8_t held)
{
    remote((uint16_t)(512 | held));
    ticks(1);
    remote(held);
}

static void panel_stop(uint8_t held)
{
    fake_panel_press(PANEL_START | held);
    ticks(5);
    fake_panel_press(held);
    ticks(5);
}

static void play_ends(uint8_t held)
{
    ticks(1);
}

static const struct {
    const char *name;
    void (*act)(uint8_t held); /* held: the buttons of the same device that stay down */
} stops[] = {{"a typed stop", typed_stop}, {"a typed code", typed_code}, {"button 6", remote_stop}, {"Start", panel_stop},
             {"the end of a play", play_ends}};

/* Two buttons go down while `is_playing`, or else before a play; it ends or is stopped; then one of them is let go. */
static void expect_rest(thumb_t thumb, uint8_t stop, bool is_playing, bool plays)
{
    char label[80];
    snprintf(label, sizeof label, "thumb on the %s, %s, %s", thumb == ON_PANEL ? "panel" : "remote", stops[stop].name,
             !plays ? "nothing plays" : is_playing ? "down in the play" : "down before the play");
    setUp();
    performer.state = is_playing ? PERFORMER_PLAY : PERFORMER_IDLE;
    thumb_down(thumb, PANEL_UP | PANEL_LEFT);
    performer.state = plays ? PERFORMER_PLAY : PERFORMER_IDLE;
    ticks(10);
    const thumb_t device = stops[stop].act == panel_stop ? ON_PANEL : ON_REMOTE;
    stops[stop].act(thumb == device ? PANEL_UP | PANEL_LEFT : 0);
    performer.state = PERFORMER_IDLE;
    ticks(10);
    memset(told, 0, sizeof told);
    thumb_down(thumb, PANEL_UP);   /* page 2 has its code */
    TEST_ASSERT_EQUAL_STRING_MESSAGE("", told, label);
    thumb_down(thumb, 0);
    ticks(INPUTS_RELEASE_TICKS);
    thumb_down(thumb, PANEL_UP);
    TEST_ASSERT_EQUAL_STRING_MESSAGE("start 2 1;", told, label);
}

static void test_inputs_no_button_that_is_let_go_after_a_stop_starts_a_play(void)
{
    STATIC_ASSERT(PANEL_UP == 1 && PANEL_LEFT == 4, "the arrows are the remote's first buttons");
    for (uint8_t stop = 0; stop < sizeof stops / sizeof stops[0]; stop++) {
        for (uint8_t thumb = ON_REMOTE; thumb <= ON_PANEL; thumb++) {
            expect_rest((thumb_t)thumb, stop, true, true);
            expect_rest((thumb_t)thumb, stop, false, true);
            if (stops[stop].act != play_ends) {
                expect_rest((thumb_t)thumb, stop, false, false);
            }
        }
    }
}

/* Restarts the program, as MODE or power-on does. */
static void start_anew(void)
{
    inputs_init(&inputs, &performer, &pages);
    memset(told, 0, sizeof told);
}

static void test_inputs_button_held_at_the_start_is_no_press(void)
{
    const uint8_t modes[] = {LINK_LATCH, LINK_HOLD, LINK_DRIVE};
    for (uint8_t i = 0; i < sizeof modes; i++) {
        setUp();
        performer.link.mode = modes[i];
        start_anew();
        hold(1, 100);
        TEST_ASSERT_EQUAL_STRING("", told);
        let_go();
        remote(1);
        TEST_ASSERT_EQUAL_STRING("start 2 1;", told);
    }
}

static void test_inputs_another_code_after_the_start_is_a_press(void)
{
    start_anew();
    hold(1, 3);
    remote(16);
    TEST_ASSERT_EQUAL_STRING("start 5 16;", told);
}

static void test_inputs_fingers_that_leave_a_chord_held_at_the_start_start_nothing(void)
{
    start_anew();
    hold(1 + 4, 3);
    hold(1, 20);
    TEST_ASSERT_EQUAL_STRING("", told);
}

static void test_inputs_silence_is_counted_from_the_start(void)
{
    start_anew();
    ticks(63);
    remote(1);
    TEST_ASSERT_EQUAL_STRING("", told);
    start_anew();
    ticks(64);
    remote(1);
    TEST_ASSERT_EQUAL_STRING("start 2 1;", told);
}

static void test_inputs_remote_that_says_nothing_is_held_after_the_start_is_believed(void)
{
    start_anew();
    remote(0);
    remote(1);
    TEST_ASSERT_EQUAL_STRING("start 2 1;", told);
}

static void test_inputs_pause_and_stop_held_at_the_start_are_no_press(void)
{
    start_anew();
    hold(256, 3);
    performer.state = PERFORMER_PLAY;   /* started by page number */
    memset(told, 0, sizeof told);
    hold(256, 3);
    TEST_ASSERT_EQUAL_STRING("", told);
    start_anew();
    performer.state = PERFORMER_IDLE;
    hold(512, 3);
    performer.state = PERFORMER_PLAY;
    memset(told, 0, sizeof told);
    hold(512, 3);
    TEST_ASSERT_EQUAL_STRING("", told);
}

static void test_inputs_hold_mode_does_not_miss_a_remote_that_was_not_heard_since_the_start(void)
{
    for (uint8_t code = LINK_CODE_NONE; code <= 1; code++) {
        setUp();
        performer.link.mode = LINK_HOLD;
        start_anew();
        performer.state = PERFORMER_PLAY;   /* started by page number, or by a typed code */
        performer.link.held_code = code;
        ticks(200);
        TEST_ASSERT_EQUAL_STRING("", told);
    }
}

/* A play that is called by number begins in hold mode. */
static void type_play(void)
{
    performer.link.mode = LINK_HOLD;
    performer.state = PERFORMER_PLAY;
    performer.link.held_code = LINK_CODE_NONE;
    memset(told, 0, sizeof told);
}

static void test_inputs_a_typed_hold_play_does_not_hear_a_button_from_before(void)
{
    hold(2, 3);
    type_play();
    hold(2, 3);
    hold(0, 3);
    TEST_ASSERT_EQUAL_STRING("", told);
    remote(4);
    remote(0);
    TEST_ASSERT_EQUAL_STRING("code 4 0;code 0 0;", told);
}

static void test_inputs_a_typed_hold_play_does_not_miss_a_button_from_before(void)
{
    hold(2, 3);
    type_play();
    ticks(200);
    TEST_ASSERT_EQUAL_STRING("", told);
}

static void test_inputs_a_typed_hold_play_hears_silence_after_a_press(void)
{
    hold(2, 3);
    type_play();
    hold(2 + 4, 1);
    ticks(64);
    TEST_ASSERT_EQUAL_STRING("code 6 0;code 0 0;", told);
}

static void test_inputs_a_typed_latch_play_hears_a_button_from_before(void)
{
    hold(2, 3);
    type_play();
    performer.link.mode = LINK_LATCH;
    remote(2);
    TEST_ASSERT_EQUAL_STRING("code 2 0;", told);
}

static void test_inputs_typed_code_is_always_a_press(void)
{
    inputs_code(&inputs, 1);
    end_play();
    inputs_code(&inputs, 1);
    TEST_ASSERT_EQUAL_STRING("start 2 1;", told);
}

static void test_inputs_arrow_left_of_a_chord_starts_nothing_after_start(void)
{
    fake_panel_press(PANEL_UP);
    ticks(5);
    fake_panel_press(PANEL_UP | PANEL_LEFT);
    ticks(5);
    fake_panel_press(PANEL_UP | PANEL_LEFT | PANEL_START);
    ticks(5);
    end_play();
    fake_panel_press(PANEL_UP | PANEL_LEFT);
    ticks(5);
    fake_panel_press(PANEL_UP);
    ticks(5);
    TEST_ASSERT_EQUAL_STRING("", told);
}

/* ---- panel ---- */

static void test_inputs_arrows_are_codes(void)
{
    fake_panel_press(PANEL_UP);
    ticks(5);
    TEST_ASSERT_EQUAL_STRING("start 2 1;", told);
    fake_panel_press(0);
    ticks(5);
    TEST_ASSERT_EQUAL_STRING("start 2 1;code 0 0;", told);
}

static void test_inputs_start_button_stops_what_is_playing(void)
{
    fake_panel_press(PANEL_START);
    ticks(5);
    fake_panel_press(0);
    ticks(5);
    TEST_ASSERT_EQUAL_STRING("stop 0 0;", told);
    performer.state = PERFORMER_PLAY;
    fake_panel_press(PANEL_START);
    ticks(50);
    TEST_ASSERT_EQUAL_STRING("stop 0 0;code 255 0;", told);
}

static void test_inputs_button_held_at_power_on_is_no_press(void)
{
    fake_panel_press(PANEL_UP);
    panel_init();
    inputs_init(&inputs, &performer, &pages);
    ticks(50);
    TEST_ASSERT_EQUAL_STRING("", told);
    fake_panel_press(0);
    ticks(5);
    fake_panel_press(PANEL_UP);
    ticks(5);
    TEST_ASSERT_EQUAL_STRING("start 2 1;", told);
}

/* A jammed arrow must not take away the stop. A START that is held itself counts after it was up. */
static void test_inputs_start_button_stops_under_an_arrow_held_since_power_on(void)
{
    for (uint8_t held = PANEL_UP; held <= (PANEL_UP | PANEL_START); held += PANEL_START) {
        setUp();
        fake_panel_press(held);
        panel_init();
        inputs_init(&inputs, &performer, &pages);
        performer.state = PERFORMER_PLAY;
        ticks(5);
        fake_panel_press(PANEL_UP | PANEL_LEFT);
        ticks(5);
        TEST_ASSERT_EQUAL_STRING("", told);
        fake_panel_press(PANEL_UP | PANEL_START);
        ticks(50);
        TEST_ASSERT_EQUAL_STRING("code 255 0;", told);
        fake_panel_press(0);
        ticks(5);
        TEST_ASSERT_EQUAL_STRING("code 255 0;", told);
    }
}

/* ---- typed text ---- */

static void typed(char text[128])
{
    uint8_t byte, count = 0;
    while (inputs_get(&inputs, &byte)) {
        text[count++] = (char)byte;
    }
    text[count] = '\0';
}

static void test_inputs_text_and_packets_are_told_apart(void)
{
    char text[128];
    fake_console_type("sta");
    remote(16);
    fake_console_type("tus\r");
    inputs_take(&inputs);
    typed(text);
    TEST_ASSERT_EQUAL_STRING("status\r", text);
    TEST_ASSERT_EQUAL_STRING("start 5 16;", told);
}

static void test_inputs_flood_loses_text_but_no_packet(void)
{
    for (uint8_t i = 0; i < 5; i++) {
        fake_console_type("0123456789012345678901234567890123456789");
        inputs_take(&inputs);
    }
    remote(16);
    TEST_ASSERT_EQUAL_STRING("start 5 16;", told);
    TEST_ASSERT_EQUAL_UINT16(200 - INPUTS_TYPED_BYTES, inputs.lost);
    uint8_t byte, count = 0;
    while (inputs_get(&inputs, &byte)) {
        count++;
    }
    TEST_ASSERT_EQUAL_UINT8(INPUTS_TYPED_BYTES, count);
}

/* The shell's input: characters, and (n) where n bytes were lost. */
static void typed_with_holes(char text[256])
{
    uint8_t byte;
    text[0] = '\0';
    while (inputs_get(&inputs, &byte)) {
        const bool hole = byte >= INPUTS_HOLE;
        snprintf(text + strlen(text), 8, hole ? "(%d)" : "%c", hole ? byte - INPUTS_HOLE : byte);
    }
}

static void test_inputs_tell_where_the_line_has_lost_bytes(void)
{
    char text[256];
    fake_console_type("@rc -1");
    fake_console_lose(3);
    fake_console_type("reset\r");
    inputs_take(&inputs);
    typed_with_holes(text);
    TEST_ASSERT_EQUAL_STRING("@rc -1(3)reset\r", text);
}

static void test_inputs_tell_where_a_full_ring_has_lost_bytes(void)
{
    char text[256];
    for (uint8_t i = 0; i < INPUTS_TYPED_BYTES; i++) {
        fake_console_type("x");
    }
    fake_console_type("00\r@");   /* lost: no room */
    inputs_take(&inputs);
    uint8_t byte;
    TEST_ASSERT_TRUE(inputs_get(&inputs, &byte));
    fake_console_type("r");         /* room for one byte, but not for this one and the loss mark before it */
    inputs_take(&inputs);
    typed_with_holes(text);
    fake_console_type("eset\r");
    inputs_take(&inputs);
    typed_with_holes(text);
    TEST_ASSERT_EQUAL_STRING("(5)eset\r", text);
    TEST_ASSERT_EQUAL_UINT16(5, inputs.lost);
}

static void test_inputs_tell_the_pc_to_wait_and_to_go_on(void)
{
    char text[128];
    console_set_flow(true);
    fake_console_type("012345678901234567890123456789012345678901234567");
    inputs_take(&inputs);
    TEST_ASSERT_TRUE(fake_console_is_held());
    typed(text);
    inputs_take(&inputs);
    TEST_ASSERT_FALSE(fake_console_is_held());
}

static void test_inputs_unfinished_packet_does_not_swallow_text(void)
{
    char text[128];
    static const uint8_t torn[] = {0xFF, 0x55, 0x10};
    fake_console_type_bytes(torn, sizeof torn);
    inputs_take(&inputs);
    ticks(INPUTS_QUIET_TICKS);
    fake_console_type("help\r");
    inputs_take(&inputs);
    typed(text);
    TEST_ASSERT_EQUAL_STRING("help\r", text);
}
