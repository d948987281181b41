/* SPDX-License-Identifier: MIT
 * Joints on the fake bus: silent, hot and without torque, and recovery. */
#include "servo_link_stage.h"

#include <string.h>
#include "dxl_packet.h"
#include "unity.h"

/* ---- health ---- */

static void test_one_servo_a_tick_is_asked_in_turn(void)
{
    const uint8_t *packet = NULL;
    bool asked[4] = { false };
    robot(3);
    for (uint8_t tick = 0; tick < 3; tick++) {
        fake_bus_clear_log();
        tick_with_goals(SERVO_LINK_ALL);
        TEST_ASSERT_EQUAL(1, logged(DXL_READ, &packet));
        asked[packet[2]] = true;
    }
    TEST_ASSERT_TRUE(asked[1] && asked[2] && asked[3]);
}

static void test_silent_servo_is_named_once_within_a_second_and_when_it_is_back(void)
{
    servo_fault_t fault;
    robot(18);
    fake_bus_servo(7)->faults = FAKE_BUS_SILENT;
    idle_ticks(18 + 2);
    TEST_ASSERT_TRUE(servo_link_next_fault(&servos, &fault));
    TEST_ASSERT_EQUAL(7, fault.id);
    TEST_ASSERT_EQUAL(SERVO_FAULT_SILENT, fault.kind);
    TEST_ASSERT_EQUAL_HEX32(SERVO_LINK_BIT(7), servos.silent);
    TEST_ASSERT_EQUAL_HEX32(0, servo_link_drivable(&servos) & SERVO_LINK_BIT(7));
    idle_ticks(60);
    TEST_ASSERT_FALSE(servo_link_next_fault(&servos, &fault));
    fake_bus_servo(7)->faults = 0;
    idle_ticks(19);
    TEST_ASSERT_TRUE(servo_link_next_fault(&servos, &fault));
    TEST_ASSERT_EQUAL(SERVO_FAULT_BACK, fault.kind);
    TEST_ASSERT_EQUAL_HEX32(0, servos.silent);
    TEST_ASSERT_FALSE(servo_link_next_fault(&servos, &fault));
}

static void test_two_lost_answers_are_no_fault(void)
{
    servo_fault_t fault;
    robot(3);
    fake_bus_servo(2)->fail_next = 2;
    idle_ticks(20);
    TEST_ASSERT_FALSE(servo_link_next_fault(&servos, &fault));
    TEST_ASSERT_EQUAL_HEX32(0, servos.silent);
}

static void test_third_lost_answer_in_a_row_is_a_fault(void)
{
    servo_fault_t fault;
    robot(3);
    fake_bus_servo(2)->fail_next = 3;
    idle_ticks(4);   /* servo 1, then servo 2 three times */
    TEST_ASSERT_TRUE(servo_link_next_fault(&servos, &fault));
    TEST_ASSERT_EQUAL(2, fault.id);
    TEST_ASSERT_EQUAL(SERVO_FAULT_SILENT, fault.kind);
}

static void test_joint_that_does_not_tell_its_pose_is_silent_until_it_is_heard(void)
{
    servo_fault_t fault;
    robot(3);
    fake_bus_servo(2)->faults = FAKE_BUS_SILENT;
    TEST_ASSERT_EQUAL_HEX32(SERVO_LINK_BIT(1) | SERVO_LINK_BIT(3), servo_link_read_pose(&servos, SERVO_LINK_ALL));
    TEST_ASSERT_EQUAL_HEX32(SERVO_LINK_BIT(2), servos.silent);
    TEST_ASSERT_FALSE(servo_link_next_fault(&servos, &fault));   /* the caller of the read knows */
    fake_bus_servo(2)->faults = 0;
    idle_ticks(3);
    TEST_ASSERT_TRUE(servo_link_next_fault(&servos, &fault));
    TEST_ASSERT_EQUAL(2, fault.id);
    TEST_ASSERT_EQUAL(SERVO_FAULT_BACK, fault.kind);
    TEST_ASSERT_EQUAL_HEX32(0, servos.silent);
}

static void test_joint_lost_while_it_is_asked_again_does_not_keep_the_others_waiting(void)
{
    const uint8_t *packet = NULL;
    bool asked[4] = { false };
    robot(3);
    fake_bus_servo(2)->faults = FAKE_BUS_SILENT;
    do {
        fake_bus_clear_log();
        idle_ticks(1);
    } while (logged(DXL_READ, &packet) != 1 || packet[2] != 2);
    servo_link_lost(&servos, 2);
    for (uint8_t tick = 0; tick < 3; tick++) {
        fake_bus_clear_log();
        idle_ticks(1);
        TEST_ASSERT_EQUAL(1, logged(DXL_READ, &packet));
        asked[packet[2]] = true;
    }
    TEST_ASSERT_TRUE(asked[1] && asked[3]);
}

/* An answer takes longer than a tick: goals still go out, one servo is polled at a time, and none is reported lost. */
static void test_late_answers_keep_neither_goals_nor_servos_back(void)
{
    const uint8_t *packet = NULL;
    servo_fault_t fault;
    robot(18);
    tick_with_goals(SERVO_LINK_ALL);   /* and slopes */
    fake_bus_clear_log();
    fake_bus_set_adapter(true);
    fake_bus_set_latency(250);   /* polls; a tick has about 200 */
    for (uint8_t tick = 0; tick < 100; tick++) {
        tick_with_goals(SERVO_LINK_ALL);
    }
    TEST_ASSERT_EQUAL(100, logged(DXL_SYNC_WRITE, &packet));
    TEST_ASSERT_TRUE(logged(DXL_READ, &packet) >= 30);
    TEST_ASSERT_EQUAL(0, servos.late);
    TEST_ASSERT_EQUAL(0, fake_bus_waited());
    TEST_ASSERT_FALSE(servo_link_next_fault(&servos, &fault));
    TEST_ASSERT_EQUAL_HEX32(0, servos.silent);
}

/* The same with a servo that is really silent. */
static void test_servo_that_is_silent_behind_late_answers_is_named(void)
{
    servo_fault_t fault;
    robot(3);
    fake_bus_set_adapter(true);
    fake_bus_set_latency(250);
    fake_bus_servo(2)->faults = FAKE_BUS_SILENT;
    idle_ticks(30);
    TEST_ASSERT_TRUE(servo_link_next_fault(&servos, &fault));
    TEST_ASSERT_EQUAL(2, fault.id);
    TEST_ASSERT_EQUAL_HEX32(SERVO_LINK_BIT(2), servos.silent);
}

/* The servo loses its power and its slopes, and answers again after `silent_ticks`. */
static void servo_gets_its_slopes_again(uint8_t silent_ticks)
{
    uint8_t compliance[SERVO_LINK_JOINTS];
    memset(compliance, 0x33, sizeof compliance);
    robot(3);
    servo_link_slopes(&servos, compliance);
    tick_with_goals(SERVO_LINK_ALL);
    fake_bus_servo(2)->faults = FAKE_BUS_SILENT;
    idle_ticks(silent_ticks);
    fake_bus_servo(2)->table[DXL_AT_CCW_SLOPE] = 32;
    fake_bus_servo(2)->faults = 0;
    idle_ticks(10);
    TEST_ASSERT_EQUAL_HEX32(0, servos.silent);
    tick_with_goals(SERVO_LINK_ALL);
    TEST_ASSERT_EQUAL(8, fake_bus_servo(2)->table[DXL_AT_CCW_SLOPE]);
}

static void test_servo_that_is_back_gets_its_slopes_again(void)
{
    servo_gets_its_slopes_again(10);
}

static void test_servo_that_forgot_its_slopes_before_it_was_missed_gets_them_again(void)
{
    servo_gets_its_slopes_again(0);
}

/* A command reads the pose of a silent servo before its poll does. */
static void test_servo_that_a_command_has_found_again_gets_its_slopes(void)
{
    uint8_t compliance[SERVO_LINK_JOINTS];
    memset(compliance, 0x33, sizeof compliance);
    robot(3);
    servo_link_slopes(&servos, compliance);
    tick_with_goals(SERVO_LINK_ALL);
    servo_link_lost(&servos, 2);
    fake_bus_servo(2)->table[DXL_AT_CW_SLOPE] = 32;
    servo_link_quiet(&servos);
    uint16_t pos;
    TEST_ASSERT_TRUE(servo_link_engage(&servos, 2, &pos));
    for (uint8_t tick = 0; tick < 4; tick++) {
        tick_with_goals(SERVO_LINK_ALL);
    }
    TEST_ASSERT_EQUAL(8, fake_bus_servo(2)->table[DXL_AT_CW_SLOPE]);
}

static void test_servo_with_wrong_checksums_counts_as_silent(void)
{
    servo_fault_t fault;
    robot(3);
    fake_bus_servo(2)->faults = FAKE_BUS_BAD_CHECKSUM;
    idle_ticks(8);
    TEST_ASSERT_TRUE(servo_link_next_fault(&servos, &fault));
    TEST_ASSERT_EQUAL(SERVO_FAULT_SILENT, fault.kind);
}

static void test_errors_are_named_when_they_come_when_they_go_and_when_they_come_again(void)
{
    servo_fault_t fault;
    robot(3);
    fake_bus_servo(2)->error = DXL_ERR_OVERLOAD | DXL_ERR_RANGE;
    idle_ticks(3);
    TEST_ASSERT_TRUE(servo_link_next_fault(&servos, &fault));
    TEST_ASSERT_EQUAL(2, fault.id);
    TEST_ASSERT_EQUAL(SERVO_FAULT_ERRORS, fault.kind);
    TEST_ASSERT_EQUAL_HEX8(DXL_ERR_OVERLOAD, fault.errors);
    idle_ticks(9);
    TEST_ASSERT_FALSE(servo_link_next_fault(&servos, &fault));
    fake_bus_servo(2)->error = 0;
    idle_ticks(3);
    TEST_ASSERT_EQUAL(0, servos.errors[2]);
    TEST_ASSERT_TRUE(servo_link_next_fault(&servos, &fault));
    TEST_ASSERT_EQUAL(SERVO_FAULT_ERRORS, fault.kind);
    TEST_ASSERT_EQUAL_HEX8(0, fault.errors);
    TEST_ASSERT_FALSE(servo_link_next_fault(&servos, &fault));
    fake_bus_servo(2)->error = DXL_ERR_HEAT;
    idle_ticks(3);
    TEST_ASSERT_TRUE(servo_link_next_fault(&servos, &fault));
    TEST_ASSERT_EQUAL_HEX8(DXL_ERR_HEAT, fault.errors);
}

static void test_torque_that_goes_off_by_itself_is_named_and_not_driven(void)
{
    servo_fault_t fault;
    robot(3);
    fake_bus_set_word(1, DXL_AT_TORQUE_LIMIT, 256);   /* weak, but on, as servo 3 is: only one byte is 0 */
    fake_bus_set_word(2, DXL_AT_TORQUE_LIMIT, 0);     /* what a shutdown does */
    fake_bus_set_word(3, DXL_AT_TORQUE_LIMIT, 255);
    idle_ticks(3);
    TEST_ASSERT_TRUE(servo_link_next_fault(&servos, &fault));
    TEST_ASSERT_EQUAL(2, fault.id);
    TEST_ASSERT_EQUAL(SERVO_FAULT_TORQUE, fault.kind);
    TEST_ASSERT_EQUAL_HEX32(SERVO_LINK_BIT(1) | SERVO_LINK_BIT(3), servo_link_drivable(&servos));
    TEST_ASSERT_EQUAL_HEX32(SERVO_LINK_BIT(2), servo_link_torque_on(&servos, SERVO_LINK_BIT(2)));
    TEST_ASSERT_EQUAL(1023, fake_bus_word(2, DXL_AT_TORQUE_LIMIT));
}

static void test_voltage_and_temperature_are_those_of_the_last_round(void)
{
    robot(3);
    fake_bus_servo(2)->table[DXL_AT_VOLTAGE] = 88;
    fake_bus_servo(3)->table[DXL_AT_TEMPERATURE] = 71;
    idle_ticks(7);
    TEST_ASSERT_EQUAL(88, servos.voltage_dv);
    TEST_ASSERT_EQUAL(71, servos.hottest_degrees);
    TEST_ASSERT_EQUAL(3, servos.hottest_id);
    fake_bus_servo(2)->table[DXL_AT_VOLTAGE] = 99;
    idle_ticks(7);
    TEST_ASSERT_EQUAL(96, servos.voltage_dv);
}

static void test_live_poses_come_with_the_polls(void)
{
    robot(3);
    servo_link_torque_off(&servos, SERVO_LINK_ALL);
    fake_bus_set_word(2, DXL_AT_PRESENT, 777);
    idle_ticks(3);
    TEST_ASSERT_EQUAL(777, servos.present_pos[2]);
}

static void test_quiet_keeps_the_bus_free_until_the_next_tick(void)
{
    robot(3);
    servo_link_tick(&servos);
    servo_link_quiet(&servos);
    fake_bus_clear_log();
    rest_of_tick();
    TEST_ASSERT_EQUAL(0, fake_bus_sent());
    idle_ticks(1);
    TEST_ASSERT_EQUAL(1, fake_bus_sent());
}
