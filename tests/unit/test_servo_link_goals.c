/* SPDX-License-Identifier: MIT
 * Joints on the fake bus: goals, slopes, trim, servos that are deaf to SYNC WRITE. */
#include "servo_link_stage.h"

#include <string.h>
#include "dxl_packet.h"
#include "unity.h"

/* ---- goals ---- */

static void test_a_tick_is_one_sync_write_of_the_joints_asked_for(void)
{
    const uint8_t *packet = NULL;
    robot(18);
    servo_link_slopes(&servos, (const uint8_t[SERVO_LINK_JOINTS]){ 0 });
    tick_with_goals(SERVO_LINK_ALL);   /* slopes go out after the goals */
    fake_bus_clear_log();
    tick_with_goals(SERVO_LINK_BIT(3) | SERVO_LINK_BIT(18) | SERVO_LINK_BIT(25));
    TEST_ASSERT_EQUAL(1, logged(DXL_SYNC_WRITE, &packet));
    static const uint8_t expected[] = { 0xFF, 0xFF, 0xFE, 10, 0x83, 30, 2, 3, 0x2F, 0x01, 18, 0x3E, 0x01 };
    TEST_ASSERT_EQUAL_HEX8_ARRAY(expected, packet, sizeof expected);
    TEST_ASSERT_EQUAL(303, fake_bus_word(3, DXL_AT_GOAL));
}

static void test_31_joints_fit_into_one_packet_of_101_bytes(void)
{
    const uint8_t *packet = NULL;
    (void)fake_bus_add(0, BUS_RATE_1M);
    robot(30);
    tick_with_goals(SERVO_LINK_ALL);   /* slopes go out after the goals */
    fake_bus_clear_log();
    tick_with_goals(SERVO_LINK_ALL);
    TEST_ASSERT_EQUAL(1, logged(DXL_SYNC_WRITE, &packet));
    TEST_ASSERT_EQUAL(101 - 4, packet[3]);
}

static void test_joints_without_torque_or_presence_are_never_driven(void)
{
    const uint8_t *packet = NULL;
    robot(3);
    servo_link_torque_off(&servos, SERVO_LINK_BIT(2));
    fake_bus_clear_log();
    tick_with_goals(SERVO_LINK_BIT(2) | SERVO_LINK_BIT(9));
    TEST_ASSERT_EQUAL(0, logged(DXL_SYNC_WRITE, &packet));
    tick_with_goals(SERVO_LINK_ALL);
    TEST_ASSERT_EQUAL(512, fake_bus_word(2, DXL_AT_GOAL));
    TEST_ASSERT_EQUAL(0, fake_bus_servo(2)->table[DXL_AT_TORQUE_ENABLE]);
    TEST_ASSERT_EQUAL(301, fake_bus_word(1, DXL_AT_GOAL));
}

static void test_trim_is_added_and_limited(void)
{
    int16_t trim[SERVO_LINK_JOINTS] = { 0 };
    robot(4);
    trim[1] = 10;
    trim[2] = -20;
    trim[3] = 301;
    trim[4] = -301;
    servo_link_set_trim(&servos, trim);
    goals[1] = 1020;
    goals[2] = 5;
    goals[3] = 400;
    goals[4] = 400;
    tick_with_goals(SERVO_LINK_ALL);
    TEST_ASSERT_EQUAL(1023, fake_bus_word(1, DXL_AT_GOAL));
    TEST_ASSERT_EQUAL(0, fake_bus_word(2, DXL_AT_GOAL));
    TEST_ASSERT_EQUAL(400, fake_bus_word(3, DXL_AT_GOAL));
    TEST_ASSERT_EQUAL(400, fake_bus_word(4, DXL_AT_GOAL));
    goals[1] = 500;
    goals[2] = 500;
    tick_with_goals(SERVO_LINK_ALL);
    TEST_ASSERT_EQUAL(510, fake_bus_word(1, DXL_AT_GOAL));
    TEST_ASSERT_EQUAL(480, fake_bus_word(2, DXL_AT_GOAL));
    TEST_ASSERT_EQUAL(480, servo_link_to_servo(&servos, 2, 500)); /* also used by Edit and for deaf servos */
    (void)servo_link_read_pose(&servos, SERVO_LINK_ALL);
    TEST_ASSERT_EQUAL(500, servos.present_pos[1]);
    TEST_ASSERT_EQUAL(500, servos.present_pos[2]);
    servo_link_set_trim(&servos, NULL);
    tick_with_goals(SERVO_LINK_ALL);
    TEST_ASSERT_EQUAL(500, fake_bus_word(1, DXL_AT_GOAL));
}

static void test_slopes_follow_the_goals_once(void)
{
    const uint8_t *packet = NULL;
    uint8_t compliance[SERVO_LINK_JOINTS];
    memset(compliance, 0x55, sizeof compliance);
    compliance[2] = 0x17;
    compliance[3] = 0x09;   /* neither nibble is 1..7: both count as 5 */
    robot(3);
    servo_link_slopes(&servos, compliance);
    tick_with_goals(SERVO_LINK_ALL);
    TEST_ASSERT_EQUAL(2, logged(DXL_SYNC_WRITE, &packet));
    TEST_ASSERT_EQUAL(DXL_AT_GOAL, fake_bus_packet(0)[5]);
    static const uint8_t expected[] = { 0xFF, 0xFF, 0xFE, 13, 0x83, 28, 2, 1, 32, 32, 2, 2, 128, 3, 32, 32 };
    TEST_ASSERT_EQUAL_HEX8_ARRAY(expected, packet, sizeof expected);
    TEST_ASSERT_EQUAL(302, fake_bus_word(2, DXL_AT_GOAL));
    servo_link_slopes(&servos, compliance);
    fake_bus_clear_log();
    tick_with_goals(SERVO_LINK_ALL);
    TEST_ASSERT_EQUAL(1, logged(DXL_SYNC_WRITE, &packet));
    TEST_ASSERT_EQUAL(DXL_AT_GOAL, packet[5]);
}

/* Servos without goals keep their slopes and get the new ones with their first goals. */
static void test_only_slopes_that_change_are_sent_and_only_to_joints_with_goals(void)
{
    const uint8_t *packet = NULL;
    uint8_t compliance[SERVO_LINK_JOINTS];
    memset(compliance, 0x55, sizeof compliance);
    robot(3);
    servo_link_slopes(&servos, compliance);
    tick_with_goals(SERVO_LINK_ALL);
    compliance[2] = 0x33;
    compliance[3] = 0x33;
    servo_link_slopes(&servos, compliance);
    fake_bus_clear_log();
    tick_with_goals(SERVO_LINK_BIT(1) | SERVO_LINK_BIT(2));
    TEST_ASSERT_EQUAL(2, logged(DXL_SYNC_WRITE, &packet));
    TEST_ASSERT_EQUAL(11, fake_bus_packet_size(1));   /* one joint */
    TEST_ASSERT_EQUAL(8, fake_bus_servo(2)->table[DXL_AT_CW_SLOPE]);
    TEST_ASSERT_EQUAL(32, fake_bus_servo(3)->table[DXL_AT_CW_SLOPE]);
    tick_with_goals(SERVO_LINK_ALL);
    TEST_ASSERT_EQUAL(8, fake_bus_servo(3)->table[DXL_AT_CW_SLOPE]);
}

/* 31 joints: 8 bytes and 3 per joint, within the 143 that an AX-12 accepts. One servo is polled in the same tick. */
static void test_slopes_of_31_joints_are_one_packet_in_the_tick_of_their_goals(void)
{
    const uint8_t *packet = NULL;
    uint8_t compliance[SERVO_LINK_JOINTS];
    memset(compliance, 0x33, sizeof compliance);
    (void)fake_bus_add(0, BUS_RATE_1M);
    robot(30);
    servo_link_slopes(&servos, compliance);
    tick_with_goals(SERVO_LINK_ALL);
    TEST_ASSERT_EQUAL(2, logged(DXL_SYNC_WRITE, &packet));
    TEST_ASSERT_EQUAL(101, fake_bus_packet_size(0));
    TEST_ASSERT_EQUAL(101, fake_bus_packet_size(1));
    TEST_ASSERT_EQUAL(1, logged(DXL_READ, &packet));
    for (uint8_t id = 0; id < SERVO_LINK_JOINTS; id++) {
        TEST_ASSERT_EQUAL(8, fake_bus_servo(id)->table[DXL_AT_CW_SLOPE]);
        TEST_ASSERT_EQUAL(8, fake_bus_servo(id)->table[DXL_AT_CCW_SLOPE]);
    }
}

static void test_deaf_servos_get_reg_write_and_one_action(void)
{
    const uint8_t *packet = NULL;
    fake_bus_add(20, BUS_RATE_1M)->faults = FAKE_BUS_DEAF_TO_SYNC;
    fake_bus_add(21, BUS_RATE_1M)->faults = FAKE_BUS_DEAF_TO_SYNC;
    robot(2);
    tick_with_goals(SERVO_LINK_ALL);
    TEST_ASSERT_EQUAL(2, logged(DXL_REG_WRITE, &packet));
    TEST_ASSERT_EQUAL(1, logged(DXL_ACTION, &packet));
    TEST_ASSERT_EQUAL(1, logged(DXL_READ, &packet));
    TEST_ASSERT_EQUAL(320, fake_bus_word(20, DXL_AT_GOAL));
    TEST_ASSERT_EQUAL(321, fake_bus_word(21, DXL_AT_GOAL));
    TEST_ASSERT_EQUAL(302, fake_bus_word(2, DXL_AT_GOAL));
    TEST_ASSERT_EQUAL(0, servos.late);
}

static void test_deaf_servos_that_do_not_fit_into_a_tick_go_on_in_the_next(void)
{
    for (uint8_t id = 1; id <= 6; id++) {
        fake_bus_add(id, BUS_RATE_1M)->faults = FAKE_BUS_DEAF_TO_SYNC;
    }
    robot(0);
    for (uint8_t tick = 0; tick < 4; tick++) {
        servo_link_tick(&servos);
        servo_link_goals(&servos, goals, SERVO_LINK_ALL);
        for (uint8_t i = 0; i < 6; i++) {
            servo_link_poll(&servos);
        }
    }
    TEST_ASSERT_TRUE(servos.late > 0);
    for (uint8_t id = 1; id <= 6; id++) {
        TEST_ASSERT_EQUAL(300 + id, fake_bus_word(id, DXL_AT_GOAL));
    }
}
