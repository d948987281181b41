/* SPDX-License-Identifier: MIT
 * Play's inputs: what remote, panel and typed text ask of the performer, which here only writes down what it is told. */
#include "inputs.h"

#include <stdio.h>
#include <string.h>
#include "console.h"
#include "fake_console.h"
#include "fake_panel.h"
#include "panel.h"
#include "unity.h"

static inputs_t inputs;
static performer_t performer;
static page_store_t pages;
static settings_t settings;
static char told[128]; /* what the performer was told: "start 5 by 16;" */
static uint8_t start_status;

/* ---- the performer and the page store, as far as inputs know them ---- */

static void note(const char *word, int a, int b)
{
    char text[32];
    snprintf(text, sizeof text, "%s %d %d;", word, a, b);
    strncat(told, text, sizeof told - strlen(told) - 1);
}

bool performer_is_idle(const performer_t *p)
{
    return p->state == PERFORMER_IDLE;
}

performer_status_t performer_start(performer_t *p, uint8_t page, uint8_t code)
{
    note("start", page, code);
    if (start_status == PERFORMER_OK) {
        p->state = PERFORMER_PLAY;
    }
    return (performer_status_t)start_status;
}

void performer_code(performer_t *p, uint8_t code)
{
    (void)p;
    note("code", code, 0);
}

bool performer_pause(performer_t *p)
{
    if (p->state != PERFORMER_PLAY) {
        return false;
    }
    note("pause", 0, 0);
    p->state = PERFORMER_APPROACH_PAUSED;
    return true;
}

bool performer_resume(performer_t *p)
{
    note("resume", 0, 0);
    p->state = PERFORMER_PLAY;
    return true;
}

uint8_t page_store_find_code(const page_store_t *store, uint8_t code)
{
    (void)store;
    return code == 16 ? 5 : code == 1 ? 2 : 0;
}

static uint8_t partner; /* of the page that plays */

static void read_page(void *context, uint8_t page, uint16_t offset, void *to, uint8_t count)
{
    (void)context;
    (void)page;
    (void)offset;
    memset(to, 0, count);
    ((uint8_t *)to)[0] = partner;
}

static const page_source_t source = {.read = read_page};

/* ---- helpers ---- */

void setUp(void)
{
    fake_console_reset();
    fake_panel_reset();
    panel_init();
    memset(&performer, 0, sizeof performer);
    memset(&settings, 0, sizeof settings);
    memset(told, 0, sizeof told);
    performer.source = &source;
    shape_init(&performer.shape);
    partner = 0;
    start_status = PERFORMER_OK;
    inputs_init(&inputs, &performer, &pages, &settings);
    inputs_tick(&inputs);
}

void tearDown(void) {}

static void remote(uint16_t buttons)
{
    const uint8_t low = (uint8_t)buttons, high = (uint8_t)(buttons >> 8);
    const uint8_t packet[] = {0xFF, 0x55, low, (uint8_t)~low, high, (uint8_t)~high};
    fake_console_type_bytes(packet, sizeof packet);
    inputs_take(&inputs);
}

static void ticks(uint8_t count)
{
    while (count-- > 0) {
        panel_tick();
        inputs_tick(&inputs);
        inputs_take(&inputs);
    }
}

static void typed(char text[128])
{
    uint8_t byte, count = 0;
    while (inputs_get(&inputs, &byte)) {
        text[count++] = (char)byte;
    }
    text[count] = '\0';
}

/* ---- remote ---- */

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
    remote(0);
    remote(512 + 1);
    TEST_ASSERT_EQUAL_STRING("code 255 0;code 0 0;code 255 0;", told);
}

static void test_inputs_stop_when_idle_starts_nothing(void)
{
    remote(512);
    TEST_ASSERT_EQUAL_STRING("", told);
}

static void test_inputs_button_5_pauses_and_resumes(void)
{
    performer.state = PERFORMER_PLAY;
    remote(256);
    remote(256);
    TEST_ASSERT_EQUAL_STRING("pause 0 0;", told);
    remote(0);
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
    settings.remote_mode = LINK_HOLD;
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
    settings.remote_mode = LINK_HOLD;
    performer.state = PERFORMER_PLAY;
    for (uint8_t i = 0; i < 10; i++) {
        remote(1);
        ticks(40);
    }
    TEST_ASSERT_NULL(strstr(told, "code 0"));
}

static void test_inputs_hold_mode_never_heard_remote_is_not_missed(void)
{
    settings.remote_mode = LINK_HOLD;
    performer.state = PERFORMER_PLAY;
    ticks(200);
    TEST_ASSERT_EQUAL_STRING("", told);
}

static void test_inputs_stop_after_a_lost_release_counts_again(void)
{
    performer.state = PERFORMER_PLAY;
    remote(512);
    ticks(64); /* heard nothing for 500 ms: nothing is held any more */
    remote(512);
    TEST_ASSERT_EQUAL_STRING("code 255 0;code 255 0;", told);
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
    TEST_ASSERT_EQUAL_STRING("", told);
    performer.state = PERFORMER_PLAY;
    fake_panel_press(PANEL_START);
    ticks(50);
    TEST_ASSERT_EQUAL_STRING("code 255 0;", told);
}

static void test_inputs_button_held_at_power_on_is_no_press(void)
{
    fake_panel_press(PANEL_UP);
    panel_init();
    inputs_init(&inputs, &performer, &pages, &settings);
    ticks(50);
    TEST_ASSERT_EQUAL_STRING("", told);
    fake_panel_press(0);
    ticks(5);
    fake_panel_press(PANEL_UP);
    ticks(5);
    TEST_ASSERT_EQUAL_STRING("start 2 1;", told);
}

/* ---- typed text ---- */

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

/* ---- remote drive ---- */

/* A hand that holds `buttons` for `count` ticks: the remote repeats its packet. */
static void hold(uint16_t buttons, uint8_t count)
{
    for (; count > 0; count--) {
        if (count % 8u == 0) {
            remote(buttons);
        }
        ticks(1);
    }
}

static void drive_mode(uint8_t partner_page)
{
    settings.remote_mode = SETTINGS_REMOTE_DRIVE;
    partner = partner_page;
    performer.state = PERFORMER_PLAY;
    performer.page = 4;
}

static void test_inputs_left_and_right_steer_to_the_full_in_a_second_and_back(void)
{
    drive_mode(6);
    hold(REMOTE_RIGHT, 64);
    TEST_ASSERT_INT_WITHIN(6, 50, performer.shape.blend_percent);
    hold(REMOTE_RIGHT, 72);
    TEST_ASSERT_EQUAL_INT8(100, performer.shape.blend_percent);
    hold(0, 64);
    TEST_ASSERT_INT_WITHIN(6, 50, performer.shape.blend_percent);
    hold(0, 72);
    TEST_ASSERT_EQUAL_INT8(0, performer.shape.blend_percent);
    hold(REMOTE_LEFT, 136);
    TEST_ASSERT_EQUAL_INT8(-100, performer.shape.blend_percent);
    ticks(200); /* the remote falls silent: nothing is held any more */
    TEST_ASSERT_EQUAL_INT8(0, performer.shape.blend_percent);
}

static void test_inputs_what_steers_is_no_part_of_the_code(void)
{
    drive_mode(6);
    remote(REMOTE_UP | REMOTE_LEFT);
    remote(REMOTE_BUTTON1 | REMOTE_RIGHT);
    TEST_ASSERT_EQUAL_STRING("code 1 0;code 16 0;", told);
}

static void test_inputs_page_without_partners_is_not_steered(void)
{
    drive_mode(0);
    hold(REMOTE_LEFT, 16);
    TEST_ASSERT_EQUAL_INT8(0, performer.shape.blend_percent);
    TEST_ASSERT_EQUAL_STRING("code 4 0;code 4 0;", told);
}

static void test_inputs_only_the_setting_drive_steers(void)
{
    drive_mode(6);
    settings.remote_mode = SETTINGS_REMOTE_LATCH;
    hold(REMOTE_LEFT, 8);
    TEST_ASSERT_EQUAL_INT8(0, performer.shape.blend_percent);
    TEST_ASSERT_EQUAL_STRING("code 4 0;", told);
}

static void test_inputs_nobody_steers_leaves_the_blend_alone(void)
{
    drive_mode(6);
    TEST_ASSERT_EQUAL(SHAPE_OK, shape_set_blend(&performer.shape, 40));
    hold(REMOTE_UP, 64);
    TEST_ASSERT_EQUAL_INT8(40, performer.shape.blend_percent);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_inputs_code_starts_its_page);
    RUN_TEST(test_inputs_code_goes_to_what_is_playing);
    RUN_TEST(test_inputs_release_starts_nothing);
    RUN_TEST(test_inputs_code_of_no_page_is_refused_once_while_held);
    RUN_TEST(test_inputs_refused_start_says_which_page_and_why);
    RUN_TEST(test_inputs_stop_counts_when_it_is_pressed);
    RUN_TEST(test_inputs_stop_when_idle_starts_nothing);
    RUN_TEST(test_inputs_button_5_pauses_and_resumes);
    RUN_TEST(test_inputs_latch_mode_outlives_silence);
    RUN_TEST(test_inputs_hold_mode_hears_silence_after_500_ms);
    RUN_TEST(test_inputs_hold_mode_repeated_packets_keep_it_alive);
    RUN_TEST(test_inputs_hold_mode_never_heard_remote_is_not_missed);
    RUN_TEST(test_inputs_stop_after_a_lost_release_counts_again);
    RUN_TEST(test_inputs_left_and_right_steer_to_the_full_in_a_second_and_back);
    RUN_TEST(test_inputs_what_steers_is_no_part_of_the_code);
    RUN_TEST(test_inputs_page_without_partners_is_not_steered);
    RUN_TEST(test_inputs_only_the_setting_drive_steers);
    RUN_TEST(test_inputs_nobody_steers_leaves_the_blend_alone);
    RUN_TEST(test_inputs_arrows_are_codes);
    RUN_TEST(test_inputs_start_button_stops_what_is_playing);
    RUN_TEST(test_inputs_button_held_at_power_on_is_no_press);
    RUN_TEST(test_inputs_text_and_packets_are_told_apart);
    RUN_TEST(test_inputs_flood_loses_text_but_no_packet);
    RUN_TEST(test_inputs_tell_the_pc_to_wait_and_to_go_on);
    RUN_TEST(test_inputs_unfinished_packet_does_not_swallow_text);
    return UNITY_END();
}
