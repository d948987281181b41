/* SPDX-License-Identifier: MIT
 * The performer: stop, break, pause, and the effect of remote codes. */
#include "performer_stage.h"
#include "unity.h"

/* ---- stop, break, pause ---- */

static void test_performer_stop_goes_through_the_exit_page(void)
{
    start(2, 0);
    reach(PERFORMER_PLAY);
    ticks(10);
    performer_stop(&performer);
    reach(PERFORMER_IDLE);
    TEST_ASSERT_EQUAL_UINT16(412, fake_servo_link.goal_pos[1]);
    /* Links are decided when the last step begins: the current page's link was taken before the stop. */
    TEST_ASSERT_EQUAL_UINT8(LINK_NEXT, expect_event(PERFORMER_EV_LINK).b);
    TEST_ASSERT_EQUAL_UINT8(LINK_EXIT, expect_event(PERFORMER_EV_LINK).b);
    TEST_ASSERT_EQUAL_UINT8(PERFORMER_END_STOPPED, end_reason());
}

static void test_performer_second_stop_within_a_second_is_a_break(void)
{
    make_page(2, 612, 2, 2); /* its exit link leads back to itself */
    pages[2][PAGE_AT_STEP0 + PAGE_STEP_AT_SPEED] = 255;
    page_seal(pages[2]);
    start(2, 0);
    reach(PERFORMER_PLAY);
    ticks(10);
    performer_stop(&performer);
    ticks(127);
    TEST_ASSERT_FALSE(performer_is_idle(&performer));
    performer_stop(&performer);
    ticks(40); /* ACCEL_TIME is 32 */
    TEST_ASSERT_TRUE(performer_is_idle(&performer));
    TEST_ASSERT_EQUAL_UINT8(PERFORMER_END_BROKEN, end_reason());
}

static void test_performer_second_stop_after_a_second_is_a_stop(void)
{
    make_page(2, 612, 2, 3);
    pages[2][PAGE_AT_STEP0 + PAGE_STEP_AT_SPEED] = 255;
    page_seal(pages[2]);
    start(2, 0);
    reach(PERFORMER_PLAY);
    ticks(10);
    performer_stop(&performer);
    ticks(129);
    performer_stop(&performer);
    reach(PERFORMER_IDLE);
    TEST_ASSERT_EQUAL_UINT8(PERFORMER_END_STOPPED, end_reason());
}

static void test_performer_break_slows_down_and_holds(void)
{
    make_page(1, 912, 0, 0);
    settings.approach_deg_s = 0;
    start(1, 0);
    reach(PERFORMER_PLAY);
    ticks(32);
    uint16_t last = fake_servo_link.goal_pos[1];
    performer_break(&performer);
    uint16_t last_step = 100;
    while (!performer_is_idle(&performer)) {
        ticks(1);
        const uint16_t step = (uint16_t)(fake_servo_link.goal_pos[1] - last);
        TEST_ASSERT_LESS_OR_EQUAL_UINT16(last_step + 1, step); /* slowing down, never moving back */
        last = fake_servo_link.goal_pos[1];
        last_step = step;
    }
    TEST_ASSERT_EQUAL_UINT8(PERFORMER_END_BROKEN, end_reason());
    TEST_ASSERT_EQUAL_HEX32(ALL_THREE, servos.torque);
}

static void test_performer_stop_during_the_approach_ends_there(void)
{
    start(1, 0);
    reach(PERFORMER_APPROACH);
    ticks(10);
    performer_stop(&performer);
    ticks(40);
    TEST_ASSERT_TRUE(performer_is_idle(&performer));
    TEST_ASSERT_LESS_THAN_UINT16(612, fake_servo_link.goal_pos[1]);
    TEST_ASSERT_EQUAL_UINT8(PERFORMER_END_BROKEN, end_reason());
}

static void test_performer_break_while_getting_ready_moves_nothing(void)
{
    start(1, 0);
    performer_poll(&performer);
    performer_break(&performer);
    ticks(10);
    TEST_ASSERT_TRUE(performer_is_idle(&performer));
    TEST_ASSERT_EQUAL_UINT16(0, fake_servo_link.frames);
}

static void test_performer_pause_holds_and_resume_goes_on(void)
{
    make_page(1, 912, 0, 0);
    settings.approach_deg_s = 0;
    start(1, 0);
    reach(PERFORMER_PLAY);
    ticks(20);
    TEST_ASSERT_TRUE(performer_pause(&performer));
    ticks(60);
    TEST_ASSERT_TRUE(performer_is_paused(&performer));
    (void)expect_event(PERFORMER_EV_PAUSED);
    const uint16_t held = fake_servo_link.goal_pos[1];
    ticks(200);
    TEST_ASSERT_EQUAL_UINT16(held, fake_servo_link.goal_pos[1]);
    TEST_ASSERT_TRUE(performer_resume(&performer));
    reach(PERFORMER_IDLE);
    TEST_ASSERT_EQUAL_UINT16(912, fake_servo_link.goal_pos[1]);
    TEST_ASSERT_EQUAL_UINT8(PERFORMER_END_DONE, end_reason());
}

static void test_performer_pause_during_the_approach(void)
{
    start(1, 0);
    reach(PERFORMER_APPROACH);
    ticks(10);
    TEST_ASSERT_TRUE(performer_pause(&performer));
    ticks(60);
    TEST_ASSERT_EQUAL_UINT8(PERFORMER_APPROACH, performer.state);
    TEST_ASSERT_TRUE(performer_is_paused(&performer));
    (void)expect_event(PERFORMER_EV_PAUSED);
    TEST_ASSERT_FALSE(performer_pause(&performer));
    const uint16_t held = fake_servo_link.goal_pos[1];
    ticks(200);
    TEST_ASSERT_EQUAL_UINT16(held, fake_servo_link.goal_pos[1]);
    TEST_ASSERT_TRUE(performer_resume(&performer));
    reach(PERFORMER_IDLE);
    TEST_ASSERT_EQUAL_UINT8(PERFORMER_END_DONE, end_reason());
    TEST_ASSERT_EQUAL_UINT16(612, fake_servo_link.goal_pos[1]);
}

static void test_performer_stop_ends_a_pause(void)
{
    start(2, 0);
    reach(PERFORMER_PLAY);
    ticks(10);
    TEST_ASSERT_TRUE(performer_pause(&performer));
    ticks(100);
    performer_stop(&performer);
    reach(PERFORMER_IDLE);
    TEST_ASSERT_EQUAL_UINT8(PERFORMER_END_STOPPED, end_reason());
}

static void test_performer_idle_has_nothing_to_stop(void)
{
    performer_stop(&performer);
    performer_break(&performer);
    performer_code(&performer, 5);
    TEST_ASSERT_FALSE(performer_pause(&performer));
    TEST_ASSERT_FALSE(performer_resume(&performer));
    TEST_ASSERT_FALSE(has_event(PERFORMER_EV_ENDED));
}

static void stop_by_code(performer_t *p)
{
    performer_code(p, LINK_CODE_STOP);
}

static void all_off(performer_t *p)
{
    (void)performer_off(p, ALL_THREE);
}

/* Seen by who looks between the stop and the next tick, and by who looks once a tick; for two ticks at most. */
static void expect_just_stopped(const char *name)
{
    TEST_ASSERT_TRUE_MESSAGE(performer_was_just_stopped(&performer), name);
    performer_tick(&performer);
    TEST_ASSERT_TRUE_MESSAGE(performer_was_just_stopped(&performer), name);
    performer_tick(&performer);
    TEST_ASSERT_FALSE_MESSAGE(performer_was_just_stopped(&performer), name);
}

static void test_performer_notes_every_stop_whatever_moves(void)
{
    static const struct {
        const char *name;
        void (*act)(performer_t *);
        bool is_for_idle;
    } stops[] = {{"stop", performer_stop, true}, {"break", performer_break, true}, {"off", all_off, true},
                 {"code 255", stop_by_code, false}};
    for (uint8_t i = 0; i < sizeof stops / sizeof stops[0]; i++) {
        setUp();
        ticks(10);
        TEST_ASSERT_FALSE(performer_was_just_stopped(&performer));
        if (stops[i].is_for_idle) {
            stops[i].act(&performer);
            expect_just_stopped(stops[i].name);
        }
        TEST_ASSERT_EQUAL_HEX32(ALL_THREE, performer_on(&performer, ALL_THREE));
        start(2, 0);
        reach(PERFORMER_PLAY);
        TEST_ASSERT_FALSE(performer_was_just_stopped(&performer));
        stops[i].act(&performer);
        expect_just_stopped(stops[i].name);
    }
}

static void test_performer_off_of_one_joint_is_no_stop(void)
{
    start(2, 0);
    reach(PERFORMER_PLAY);
    (void)performer_off(&performer, SERVO_LINK_BIT(2));
    TEST_ASSERT_FALSE(performer_was_just_stopped(&performer));
    performer_stop(&performer);
    reach(PERFORMER_IDLE);
    TEST_ASSERT_EQUAL_UINT8(PERFORMER_END_STOPPED, end_reason());   /* not a break, as by a second stop */
}

static void test_performer_end_follows_no_link(void)
{
    start(2, 0);
    reach(PERFORMER_PLAY);
    ticks(10);
    performer_stop_without_exit(&performer);
    reach(PERFORMER_IDLE);
    TEST_ASSERT_EQUAL_UINT16(612, fake_servo_link.goal_pos[1]);
    TEST_ASSERT_EQUAL_UINT8(PERFORMER_END_STOPPED, end_reason());
}

/* ---- codes ---- */

static void test_performer_code_takes_the_linked_page(void)
{
    make_page(2, 612, 2, 0);
    pages[2][PAGE_AT_LINKED1_PAGE] = 3;
    pages[2][PAGE_AT_LINKED1_CODE] = 4;
    page_seal(pages[2]);
    start(2, 1);
    reach(PERFORMER_PLAY);
    ticks(10);
    performer_code(&performer, 4);
    performer_code(&performer, 0); /* latch mode: a release changes nothing */
    reach(PERFORMER_IDLE);
    while (true) {
        const performer_event_t event = expect_event(PERFORMER_EV_LINK);
        if (event.b == LINK_LINKED1) {
            TEST_ASSERT_EQUAL_UINT8(3, event.a);
            return;
        }
    }
}

static void test_performer_hold_mode_stops_when_the_hand_lets_go(void)
{
    settings.remote_mode = LINK_HOLD;
    start(2, 1);
    reach(PERFORMER_PLAY);
    ticks(10);
    performer_code(&performer, 0);
    reach(PERFORMER_IDLE);
    TEST_ASSERT_EQUAL_UINT8(PERFORMER_END_STOPPED, end_reason());
}

static void test_performer_play_keeps_the_mode_of_its_start(void)
{
    for (uint8_t mode = 0; mode <= SETTINGS_REMOTE_DRIVE; mode++) {
        setUp();
        settings.remote_mode = mode;
        start(2, 1);
        reach(PERFORMER_PLAY);
        settings.remote_mode = mode == LINK_LATCH ? LINK_HOLD : LINK_LATCH;
        ticks(10);
        TEST_ASSERT_EQUAL_UINT8(mode, performer.link.mode);
    }
}

static void test_performer_hold_mode_let_go_during_the_approach(void)
{
    settings.remote_mode = LINK_HOLD;
    start(2, 1);
    reach(PERFORMER_APPROACH);
    performer_code(&performer, 0);
    ticks(40);
    TEST_ASSERT_TRUE(performer_is_idle(&performer));
}

static void test_performer_stop_code_twice_is_a_break(void)
{
    start(2, 1);
    reach(PERFORMER_PLAY);
    ticks(5);
    performer_code(&performer, 255);
    TEST_ASSERT_FALSE(performer_is_idle(&performer));
    performer_code(&performer, 255);
    ticks(40);
    TEST_ASSERT_EQUAL_UINT8(PERFORMER_END_BROKEN, end_reason());
}
