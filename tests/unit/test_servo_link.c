/* SPDX-License-Identifier: MIT
 * Joints on the fake bus: search, goals, slopes, health, trim, torque. */
#include "bus.h"
#include "dxl_packet.h"
#include "fake_bus.h"
#include "fake_system.h"
#include "fake_time.h"
#include "servo_link.h"
#include "unity.h"

#include <string.h>

static servo_link_t servos;
static uint16_t goals[SERVO_LINK_JOINTS];

void setUp(void)
{
    fake_bus_reset();
    fake_time_reset();
    fake_system_reset();
    servo_link_init(&servos);
    for (uint8_t id = 0; id < SERVO_LINK_JOINTS; id++) {
        goals[id] = (uint16_t)(300u + id);
    }
}

void tearDown(void)
{
}

/* A robot of `count` servos from ID 1 on, searched, torque on, log empty. */
static void robot(uint8_t count)
{
    for (uint8_t id = 1; id <= count; id++) {
        (void)fake_bus_add(id, BUS_RATE_1M);
    }
    servo_link_scan(&servos);
    (void)servo_link_torque_on(&servos, SERVO_LINK_ALL);
    fake_bus_clear_log();
}

/* The rest of a tick: the main loop goes round often. */
static void rest_of_tick(void)
{
    for (uint8_t i = 0; i < 100; i++) {
        servo_link_poll(&servos);
    }
}

static void tick_with_goals(uint32_t joints)
{
    servo_link_tick(&servos);
    servo_link_goals(&servos, goals, joints);
    rest_of_tick();
}

static void idle_ticks(uint8_t count)
{
    for (; count > 0; count--) {
        servo_link_tick(&servos);
        rest_of_tick();
    }
}

/* Packets in the log with this instruction, and the last of them. */
static uint16_t logged(uint8_t instruction, const uint8_t **last)
{
    uint16_t count = 0;
    for (uint16_t i = 0; i < fake_bus_sent(); i++) {
        if (fake_bus_packet(i)[4] == instruction) {
            count++;
            *last = fake_bus_packet(i);
        }
    }
    return count;
}

/* ---- search ---- */

static void test_scan_tells_fast_slow_and_absent_apart(void)
{
    (void)fake_bus_add(0, BUS_RATE_1M);
    (void)fake_bus_add(7, BUS_RATE_1M);
    (void)fake_bus_add(30, BUS_RATE_1M);
    (void)fake_bus_add(5, BUS_RATE_57142);
    (void)fake_bus_add(31, BUS_RATE_1M);
    servo_link_scan(&servos);
    TEST_ASSERT_EQUAL_HEX32(SERVO_LINK_BIT(0) | SERVO_LINK_BIT(7) | SERVO_LINK_BIT(30), servos.present);
    TEST_ASSERT_EQUAL_HEX32(SERVO_LINK_BIT(5), servos.slow);
    TEST_ASSERT_EQUAL(BUS_RATE_1M, bus_rate());
    TEST_ASSERT_EQUAL(512, servos.present_pos[7]);
    TEST_ASSERT_EQUAL_HEX16(SERVO_LINK_NO_POSE, servos.present_pos[5]);
    TEST_ASSERT_EQUAL_HEX32(0, servos.torque);
    TEST_ASSERT_TRUE(fake_system_kicks() > 60);
}

static void test_scan_changes_nothing_in_a_servo(void)
{
    uint8_t before[2][FAKE_BUS_TABLE_BYTES];
    (void)fake_bus_add(3, BUS_RATE_1M);
    fake_servo_t *other = fake_bus_add(4, BUS_RATE_1M);
    other->table[DXL_AT_TORQUE_ENABLE] = 1;
    memcpy(before[0], fake_bus_servo(3)->table, FAKE_BUS_TABLE_BYTES);
    memcpy(before[1], other->table, FAKE_BUS_TABLE_BYTES);
    servo_link_scan(&servos);
    TEST_ASSERT_EQUAL_MEMORY(before[0], fake_bus_servo(3)->table, FAKE_BUS_TABLE_BYTES);
    TEST_ASSERT_EQUAL_MEMORY(before[1], other->table, FAKE_BUS_TABLE_BYTES);
}

static void test_scan_finds_the_deaf_and_the_taciturn(void)
{
    fake_bus_add(1, BUS_RATE_1M)->faults = FAKE_BUS_DEAF_TO_SYNC;
    fake_bus_add(2, BUS_RATE_1M)->table[DXL_AT_RETURN_LEVEL] = 1;
    fake_bus_add(3, BUS_RATE_1M)->table[DXL_AT_RETURN_LEVEL] = 0;
    (void)fake_bus_add(4, BUS_RATE_1M);
    servo_link_scan(&servos);
    TEST_ASSERT_EQUAL_HEX32(SERVO_LINK_BIT(1), servos.no_sync);
    TEST_ASSERT_EQUAL_HEX32(SERVO_LINK_BIT(2), servos.no_reply);
    TEST_ASSERT_EQUAL_HEX32(SERVO_LINK_BIT(3), servos.mute);
    TEST_ASSERT_EQUAL_HEX32(SERVO_LINK_BIT(1) | SERVO_LINK_BIT(2) | SERVO_LINK_BIT(4), servos.present);
}

static void test_slow_servos_move_on_request_only(void)
{
    (void)fake_bus_add(5, BUS_RATE_57142);
    (void)fake_bus_add(6, BUS_RATE_57142);
    servo_link_scan(&servos);
    TEST_ASSERT_EQUAL(BUS_RATE_57142, fake_bus_servo(5)->table[DXL_AT_BAUD]);
    TEST_ASSERT_EQUAL_HEX32(SERVO_LINK_BIT(5), servo_link_fast_baud(&servos, SERVO_LINK_BIT(5) | SERVO_LINK_BIT(9)));
    TEST_ASSERT_EQUAL(BUS_RATE_1M, fake_bus_servo(5)->table[DXL_AT_BAUD]);
    TEST_ASSERT_EQUAL(BUS_RATE_57142, fake_bus_servo(6)->table[DXL_AT_BAUD]);
    TEST_ASSERT_EQUAL_HEX32(SERVO_LINK_BIT(5), servos.present);
    TEST_ASSERT_EQUAL_HEX32(SERVO_LINK_BIT(6), servos.slow);
}

static void test_fast_answers_writes_the_return_delay_of_those_named(void)
{
    robot(3);
    TEST_ASSERT_EQUAL_HEX32(SERVO_LINK_BIT(2), servo_link_fast_answers(&servos, SERVO_LINK_BIT(2) | SERVO_LINK_BIT(9)));
    TEST_ASSERT_EQUAL(0, fake_bus_servo(2)->table[DXL_AT_RETURN_DELAY]);
    TEST_ASSERT_EQUAL(250, fake_bus_servo(1)->table[DXL_AT_RETURN_DELAY]);
}

/* ---- goals ---- */

static void test_a_tick_is_one_sync_write_of_the_joints_asked_for(void)
{
    const uint8_t *packet = NULL;
    robot(18);
    servo_link_slopes(&servos, (const uint8_t[SERVO_LINK_JOINTS]){ 0 });
    tick_with_goals(SERVO_LINK_ALL);   /* the first one also carries slopes */
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
    for (uint8_t i = 0; i < 3; i++) {
        tick_with_goals(SERVO_LINK_ALL);   /* slopes follow */
    }
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
    TEST_ASSERT_EQUAL_HEX32(SERVO_LINK_BIT(3), servo_link_set_trim(&servos, trim));
    goals[1] = 1020;
    goals[2] = 5;
    goals[3] = 400;
    tick_with_goals(SERVO_LINK_ALL);
    TEST_ASSERT_EQUAL(1023, fake_bus_word(1, DXL_AT_GOAL));
    TEST_ASSERT_EQUAL(0, fake_bus_word(2, DXL_AT_GOAL));
    TEST_ASSERT_EQUAL(400, fake_bus_word(3, DXL_AT_GOAL));
    goals[1] = 500;
    goals[2] = 500;
    tick_with_goals(SERVO_LINK_ALL);
    TEST_ASSERT_EQUAL(510, fake_bus_word(1, DXL_AT_GOAL));
    TEST_ASSERT_EQUAL(480, fake_bus_word(2, DXL_AT_GOAL));
    TEST_ASSERT_EQUAL(480, servo_link_to_servo(&servos, 2, 500)); /* by which Edit and the deaf are moved */
    (void)servo_link_read_pose(&servos, SERVO_LINK_ALL);
    TEST_ASSERT_EQUAL(500, servos.present_pos[1]);
    TEST_ASSERT_EQUAL(500, servos.present_pos[2]);
    TEST_ASSERT_EQUAL_HEX32(0, servo_link_set_trim(&servos, NULL));
    tick_with_goals(SERVO_LINK_ALL);
    TEST_ASSERT_EQUAL(500, fake_bus_word(1, DXL_AT_GOAL));
}

static void test_slopes_go_with_the_goals_once(void)
{
    const uint8_t *packet = NULL;
    uint8_t compliance[SERVO_LINK_JOINTS];
    memset(compliance, 0x55, sizeof compliance);
    compliance[2] = 0x17;
    compliance[3] = 0x09;   /* neither nibble is 1..7: both count as 5 */
    robot(3);
    servo_link_slopes(&servos, compliance);
    tick_with_goals(SERVO_LINK_ALL);
    TEST_ASSERT_EQUAL(1, logged(DXL_SYNC_WRITE, &packet));
    TEST_ASSERT_EQUAL(DXL_AT_CW_SLOPE, packet[5]);
    TEST_ASSERT_EQUAL(4, packet[6]);
    TEST_ASSERT_EQUAL(32, fake_bus_servo(1)->table[DXL_AT_CW_SLOPE]);
    TEST_ASSERT_EQUAL(2, fake_bus_servo(2)->table[DXL_AT_CW_SLOPE]);
    TEST_ASSERT_EQUAL(128, fake_bus_servo(2)->table[DXL_AT_CCW_SLOPE]);
    TEST_ASSERT_EQUAL(32, fake_bus_servo(3)->table[DXL_AT_CW_SLOPE]);
    TEST_ASSERT_EQUAL(32, fake_bus_servo(3)->table[DXL_AT_CCW_SLOPE]);
    TEST_ASSERT_EQUAL(302, fake_bus_word(2, DXL_AT_GOAL));
    servo_link_slopes(&servos, compliance);
    fake_bus_clear_log();
    tick_with_goals(SERVO_LINK_ALL);
    TEST_ASSERT_EQUAL(1, logged(DXL_SYNC_WRITE, &packet));
    TEST_ASSERT_EQUAL(DXL_AT_GOAL, packet[5]);
}

static void test_slopes_of_more_than_27_joints_follow_in_packets_of_their_own(void)
{
    const uint8_t *packet = NULL;
    uint8_t compliance[SERVO_LINK_JOINTS];
    memset(compliance, 0x33, sizeof compliance);
    robot(28);
    servo_link_slopes(&servos, compliance);
    tick_with_goals(SERVO_LINK_ALL);
    TEST_ASSERT_EQUAL(1, logged(DXL_SYNC_WRITE, &packet));
    TEST_ASSERT_EQUAL(DXL_AT_GOAL, packet[5]);
    TEST_ASSERT_EQUAL(328, fake_bus_word(28, DXL_AT_GOAL));
    tick_with_goals(SERVO_LINK_ALL);
    TEST_ASSERT_EQUAL(3, logged(DXL_SYNC_WRITE, &packet));
    TEST_ASSERT_EQUAL(DXL_AT_CW_SLOPE, packet[5]);
    TEST_ASSERT_EQUAL(2, packet[6]);
    TEST_ASSERT_EQUAL(8, fake_bus_servo(15)->table[DXL_AT_CCW_SLOPE]);
    TEST_ASSERT_EQUAL(32, fake_bus_servo(16)->table[DXL_AT_CCW_SLOPE]);
    tick_with_goals(SERVO_LINK_ALL);
    TEST_ASSERT_EQUAL(5, logged(DXL_SYNC_WRITE, &packet));
    TEST_ASSERT_EQUAL(8, fake_bus_servo(28)->table[DXL_AT_CCW_SLOPE]);
    fake_bus_clear_log();
    tick_with_goals(SERVO_LINK_ALL);
    TEST_ASSERT_EQUAL(1, logged(DXL_SYNC_WRITE, &packet));
}

static void test_27_joints_with_slopes_are_within_the_servos_143_bytes(void)
{
    robot(27);
    servo_link_slopes(&servos, (const uint8_t[SERVO_LINK_JOINTS]){ 0 });
    servo_link_tick(&servos);
    servo_link_goals(&servos, goals, SERVO_LINK_ALL);
    rest_of_tick();
    TEST_ASSERT_EQUAL(143, fake_bus_packet_size(0));
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
    idle_ticks(4);   /* 1, then 2 three times */
    TEST_ASSERT_TRUE(servo_link_next_fault(&servos, &fault));
    TEST_ASSERT_EQUAL(2, fault.id);
    TEST_ASSERT_EQUAL(SERVO_FAULT_SILENT, fault.kind);
}

/* It may have lost its power meanwhile. */
static void test_servo_that_is_back_gets_its_slopes_again(void)
{
    uint8_t compliance[SERVO_LINK_JOINTS];
    memset(compliance, 0x33, sizeof compliance);
    robot(3);
    servo_link_slopes(&servos, compliance);
    tick_with_goals(SERVO_LINK_ALL);
    fake_bus_servo(2)->faults = FAKE_BUS_SILENT;
    idle_ticks(10);
    fake_bus_servo(2)->table[DXL_AT_CW_SLOPE] = 32;
    fake_bus_servo(2)->faults = 0;
    idle_ticks(10);
    TEST_ASSERT_EQUAL_HEX32(0, servos.silent);
    tick_with_goals(SERVO_LINK_ALL);
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
    fake_bus_set_word(2, DXL_AT_TORQUE_LIMIT, 0);   /* what a shutdown does */
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

/* ---- torque ---- */

static void test_torque_on_makes_the_present_pose_the_goal_first(void)
{
    robot(3);
    servo_link_torque_off(&servos, SERVO_LINK_BIT(2));
    TEST_ASSERT_EQUAL(0, fake_bus_servo(2)->table[DXL_AT_TORQUE_ENABLE]);
    fake_bus_set_word(2, DXL_AT_PRESENT, 700);   /* moved by hand */
    TEST_ASSERT_EQUAL_HEX32(SERVO_LINK_BIT(2), servo_link_torque_on(&servos, SERVO_LINK_BIT(2)));
    TEST_ASSERT_EQUAL(700, fake_bus_word(2, DXL_AT_GOAL));
    TEST_ASSERT_EQUAL(1, fake_bus_servo(2)->table[DXL_AT_TORQUE_ENABLE]);
    TEST_ASSERT_EQUAL(700, servos.present_pos[2]);
}

static void test_torque_on_leaves_those_alone_that_hold_already(void)
{
    robot(1);
    fake_bus_set_word(1, DXL_AT_GOAL, 600);
    fake_bus_set_word(1, DXL_AT_PRESENT, 590);   /* sags under load */
    TEST_ASSERT_EQUAL_HEX32(SERVO_LINK_BIT(1), servo_link_torque_on(&servos, SERVO_LINK_ALL));
    TEST_ASSERT_EQUAL(600, fake_bus_word(1, DXL_AT_GOAL));
}

static void test_servo_that_does_not_tell_its_pose_stays_off(void)
{
    robot(2);
    servo_link_torque_off(&servos, SERVO_LINK_ALL);
    fake_bus_servo(1)->faults = FAKE_BUS_BAD_CHECKSUM;
    TEST_ASSERT_EQUAL_HEX32(SERVO_LINK_BIT(2), servo_link_torque_on(&servos, SERVO_LINK_ALL));
    TEST_ASSERT_EQUAL(0, fake_bus_servo(1)->table[DXL_AT_TORQUE_ENABLE]);
}

static void test_torque_off_reaches_the_deaf_too(void)
{
    fake_bus_add(20, BUS_RATE_1M)->faults = FAKE_BUS_DEAF_TO_SYNC;
    robot(2);
    TEST_ASSERT_EQUAL(1, fake_bus_servo(20)->table[DXL_AT_TORQUE_ENABLE]);
    servo_link_torque_off(&servos, SERVO_LINK_ALL);
    TEST_ASSERT_EQUAL(0, fake_bus_servo(20)->table[DXL_AT_TORQUE_ENABLE]);
    TEST_ASSERT_EQUAL(0, fake_bus_servo(1)->table[DXL_AT_TORQUE_ENABLE]);
    TEST_ASSERT_EQUAL_HEX32(0, servos.torque);
}

static void test_full_speed_takes_back_a_speed_limit(void)
{
    robot(2);
    fake_bus_set_word(1, DXL_AT_SPEED, 100);
    servo_link_full_speed(&servos, SERVO_LINK_BIT(1));
    TEST_ASSERT_EQUAL(0, fake_bus_word(1, DXL_AT_SPEED));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_scan_tells_fast_slow_and_absent_apart);
    RUN_TEST(test_scan_changes_nothing_in_a_servo);
    RUN_TEST(test_scan_finds_the_deaf_and_the_taciturn);
    RUN_TEST(test_slow_servos_move_on_request_only);
    RUN_TEST(test_fast_answers_writes_the_return_delay_of_those_named);
    RUN_TEST(test_a_tick_is_one_sync_write_of_the_joints_asked_for);
    RUN_TEST(test_31_joints_fit_into_one_packet_of_101_bytes);
    RUN_TEST(test_joints_without_torque_or_presence_are_never_driven);
    RUN_TEST(test_trim_is_added_and_limited);
    RUN_TEST(test_slopes_go_with_the_goals_once);
    RUN_TEST(test_slopes_of_more_than_27_joints_follow_in_packets_of_their_own);
    RUN_TEST(test_27_joints_with_slopes_are_within_the_servos_143_bytes);
    RUN_TEST(test_deaf_servos_get_reg_write_and_one_action);
    RUN_TEST(test_deaf_servos_that_do_not_fit_into_a_tick_go_on_in_the_next);
    RUN_TEST(test_one_servo_a_tick_is_asked_in_turn);
    RUN_TEST(test_silent_servo_is_named_once_within_a_second_and_when_it_is_back);
    RUN_TEST(test_two_lost_answers_are_no_fault);
    RUN_TEST(test_third_lost_answer_in_a_row_is_a_fault);
    RUN_TEST(test_servo_that_is_back_gets_its_slopes_again);
    RUN_TEST(test_servo_with_wrong_checksums_counts_as_silent);
    RUN_TEST(test_errors_are_named_when_they_come_when_they_go_and_when_they_come_again);
    RUN_TEST(test_torque_that_goes_off_by_itself_is_named_and_not_driven);
    RUN_TEST(test_voltage_and_temperature_are_those_of_the_last_round);
    RUN_TEST(test_live_poses_come_with_the_polls);
    RUN_TEST(test_quiet_keeps_the_bus_free_until_the_next_tick);
    RUN_TEST(test_torque_on_makes_the_present_pose_the_goal_first);
    RUN_TEST(test_torque_on_leaves_those_alone_that_hold_already);
    RUN_TEST(test_servo_that_does_not_tell_its_pose_stays_off);
    RUN_TEST(test_torque_off_reaches_the_deaf_too);
    RUN_TEST(test_full_speed_takes_back_a_speed_limit);
    return UNITY_END();
}
