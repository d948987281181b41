/* SPDX-License-Identifier: MIT
 * Joints on the fake bus: search, torque. */
#include "servo_link_stage.h"

#include <string.h>
#include "dxl_packet.h"
#include "fake_system.h"
#include "unity.h"

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

/* On a PC each servo that is not there costs the adapter's waiting time. */
static void test_scan_pings_nobody_once_the_program_is_to_end(void)
{
    (void)fake_bus_add(7, BUS_RATE_1M);
    fake_system_ask_to_end();
    servo_link_scan(&servos);
    TEST_ASSERT_EQUAL_HEX32(0, servos.present);
    for (uint16_t i = 0; i < fake_bus_sent(); i++) {
        TEST_ASSERT_NOT_EQUAL(DXL_PING, fake_bus_packet(i)[4]);
    }
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
    TEST_ASSERT_EQUAL_HEX32(SERVO_LINK_BIT(1) | SERVO_LINK_BIT(2) | SERVO_LINK_BIT(4), servos.present);
}

/* In endless turn a goal is a speed: the servo would turn on and on. */
static void test_servo_in_endless_turn_is_named_and_left_alone(void)
{
    (void)fake_bus_add(4, BUS_RATE_1M);
    memset(&fake_bus_add(5, BUS_RATE_1M)->table[DXL_AT_CW_LIMIT], 0, 4);
    servo_link_scan(&servos);
    TEST_ASSERT_EQUAL_HEX32(SERVO_LINK_BIT(4), servos.present);
    TEST_ASSERT_EQUAL_HEX32(SERVO_LINK_BIT(5), servos.endless);
    TEST_ASSERT_EQUAL_HEX32(SERVO_LINK_BIT(4), servo_link_torque_on(&servos, SERVO_LINK_ALL));
    TEST_ASSERT_EQUAL(0, fake_bus_servo(5)->table[DXL_AT_TORQUE_ENABLE]);
}

static void test_slow_servos_are_named_and_left_alone(void)
{
    (void)fake_bus_add(5, BUS_RATE_57142);
    (void)fake_bus_add(6, BUS_RATE_57142);
    servo_link_scan(&servos);
    TEST_ASSERT_EQUAL(BUS_RATE_57142, fake_bus_servo(5)->table[DXL_AT_BAUD]);
    TEST_ASSERT_EQUAL(BUS_RATE_57142, fake_bus_servo(6)->table[DXL_AT_BAUD]);
    TEST_ASSERT_EQUAL_HEX32(0, servos.present);
    TEST_ASSERT_EQUAL_HEX32(SERVO_LINK_BIT(5) | SERVO_LINK_BIT(6), servos.slow);
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

/* Its goal would be at the limit, at full speed. Gears have play: a few units beyond the limit are no leap. */
static void test_servo_outside_its_angle_limits_stays_off(void)
{
    static const struct {
        uint16_t pos;
        bool is_held;
    } cases[] = {{383, false}, {384, true}, {400, true}, {616, true}, {617, false}, {1023, false}, {500, true}};
    fake_bus_add(1, BUS_RATE_1M);
    fake_bus_set_word(1, DXL_AT_CW_LIMIT, 400);
    fake_bus_set_word(1, DXL_AT_CCW_LIMIT, 600);
    servo_link_init(&servos);
    servo_link_scan(&servos);
    for (uint8_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const uint32_t held = cases[i].is_held ? SERVO_LINK_BIT(1) : 0;
        uint16_t pos;
        servo_link_torque_off(&servos, SERVO_LINK_ALL);
        fake_bus_set_word(1, DXL_AT_PRESENT, cases[i].pos);
        fake_bus_set_word(1, DXL_AT_GOAL, 512);
        TEST_ASSERT_EQUAL_HEX32(held, servo_link_torque_on(&servos, SERVO_LINK_ALL));
        TEST_ASSERT_EQUAL_HEX32(held ^ SERVO_LINK_BIT(1), servos.outside);
        TEST_ASSERT_EQUAL(cases[i].is_held, servo_link_engage(&servos, 1, &pos));
        TEST_ASSERT_EQUAL(cases[i].is_held, fake_bus_servo(1)->table[DXL_AT_TORQUE_ENABLE]);
        TEST_ASSERT_EQUAL(cases[i].is_held ? cases[i].pos : 512, fake_bus_word(1, DXL_AT_GOAL));
    }
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

static int16_t engaged_at(uint8_t id)
{
    uint16_t pos;
    TEST_ASSERT_TRUE(servo_link_engage(&servos, id, &pos));
    return (int16_t)pos;
}

/* The position that it returns as a goal is where the servo stands, also where the trim puts it outside the pages' range. */
static void test_engage_knows_where_a_trimmed_servo_stands(void)
{
    static const struct {
        int16_t trim, page_pos;
        uint16_t servo_pos;
    } cases[] = { { -100, 1110, 1010 }, { -300, 1323, 1023 }, { 150, -130, 20 }, { 300, -300, 0 }, { 20, 480, 500 } };
    robot(1);
    for (uint8_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        int16_t trim[SERVO_LINK_JOINTS] = { [1] = cases[i].trim };
        servo_link_set_trim(&servos, trim);
        fake_bus_set_word(1, DXL_AT_PRESENT, cases[i].servo_pos);
        TEST_ASSERT_EQUAL_INT16(cases[i].page_pos, engaged_at(1));
        TEST_ASSERT_EQUAL(cases[i].servo_pos, servo_link_to_servo(&servos, 1, (uint16_t)cases[i].page_pos));
        TEST_ASSERT_EQUAL(servo_link_limited((uint16_t)cases[i].page_pos), servos.present_pos[1]);
    }
}

static void test_engage_takes_back_a_speed_limit(void)
{
    robot(2);
    fake_bus_set_word(1, DXL_AT_SPEED, 100);
    (void)engaged_at(1);
    TEST_ASSERT_EQUAL(0, fake_bus_word(1, DXL_AT_SPEED));
}

/* Lifting the speed limit first would let the servo leap towards the far goal. */
static void test_engage_stops_a_servo_that_a_single_move_still_drives(void)
{
    const uint8_t *write;
    for (uint8_t level = 1; level <= 2; level++) {
        setUp();
        fake_bus_add(1, BUS_RATE_1M)->table[DXL_AT_RETURN_LEVEL] = level;
        robot(0);
        fake_bus_set_word(1, DXL_AT_GOAL, 900);
        fake_bus_set_word(1, DXL_AT_SPEED, 100);
        fake_bus_set_word(1, DXL_AT_PRESENT, 415);
        TEST_ASSERT_EQUAL(415, engaged_at(1));
        TEST_ASSERT_EQUAL(415, fake_bus_word(1, DXL_AT_GOAL));
        TEST_ASSERT_EQUAL(0, fake_bus_word(1, DXL_AT_SPEED));
        TEST_ASSERT_EQUAL(415, servos.present_pos[1]);
        TEST_ASSERT_EQUAL(1, logged(DXL_WRITE, &write));   /* both at the same time */
    }
}

static void test_engage_leaves_a_servo_without_a_speed_limit_where_it_is(void)
{
    robot(1);
    fake_bus_set_word(1, DXL_AT_GOAL, 600);
    fake_bus_set_word(1, DXL_AT_PRESENT, 590);   /* sags under load */
    TEST_ASSERT_EQUAL(590, engaged_at(1));
    TEST_ASSERT_EQUAL(600, fake_bus_word(1, DXL_AT_GOAL));
}

/* The play before has just ended. When the first goal comes, the servo is no longer where it was read. */
static void test_engage_begins_at_the_goal_of_a_servo_that_lags_behind(void)
{
    const int16_t trim[SERVO_LINK_JOINTS] = { [1] = 30 };
    robot(1);
    servo_link_set_trim(&servos, trim);
    fake_bus_set_word(1, DXL_AT_GOAL, 600);
    fake_bus_set_word(1, DXL_AT_PRESENT, 550);
    fake_bus_set_word(1, DXL_AT_PRESENT_SPEED, 1024 + 70);
    TEST_ASSERT_EQUAL(570, engaged_at(1));
    TEST_ASSERT_EQUAL(600, fake_bus_word(1, DXL_AT_GOAL));
}

/* ---- WRITEs that the servo did not obey ---- */

/* A limp servo at 300 with the old goal 512. */
static void limp_at_300(uint8_t return_level)
{
    fake_bus_add(1, BUS_RATE_1M);
    fake_bus_servo(1)->table[DXL_AT_RETURN_LEVEL] = return_level;
    servo_link_init(&servos);
    servo_link_scan(&servos);
    TEST_ASSERT_EQUAL_HEX32(SERVO_LINK_BIT(1), servos.present);
    fake_bus_set_word(1, DXL_AT_PRESENT, 300);
}

static void test_torque_stays_off_when_the_goal_cannot_be_set(void)
{
    for (uint8_t level = 1; level <= 2; level++) {
        setUp();
        limp_at_300(level);
        fake_bus_servo(1)->mishear_next = 3;   /* every try to set the goal; torque enable would arrive */
        TEST_ASSERT_EQUAL_HEX32(0, servo_link_torque_on(&servos, SERVO_LINK_ALL));
        TEST_ASSERT_EQUAL(0, fake_bus_servo(1)->table[DXL_AT_TORQUE_ENABLE]);
        TEST_ASSERT_EQUAL(300, fake_bus_word(1, DXL_AT_PRESENT));
        TEST_ASSERT_EQUAL_HEX32(0, servos.silent);   /* it does answer */
    }
}

static void test_goal_that_arrives_at_the_second_try_is_enough(void)
{
    for (uint8_t level = 1; level <= 2; level++) {
        setUp();
        limp_at_300(level);
        fake_bus_servo(1)->mishear_next = 1;
        TEST_ASSERT_EQUAL_HEX32(SERVO_LINK_BIT(1), servo_link_torque_on(&servos, SERVO_LINK_ALL));
        TEST_ASSERT_EQUAL(300, fake_bus_word(1, DXL_AT_GOAL));
        TEST_ASSERT_EQUAL(1, fake_bus_servo(1)->table[DXL_AT_TORQUE_ENABLE]);
    }
}

static void test_servo_that_answers_no_write_is_read_back(void)
{
    const uint8_t goal[2] = { 0x58, 0x02 };
    limp_at_300(1);
    fake_bus_servo(1)->mishear_next = 2;
    TEST_ASSERT_TRUE(servo_link_write(&servos, 1, DXL_AT_GOAL, goal, 2));
    TEST_ASSERT_EQUAL(0x258, fake_bus_word(1, DXL_AT_GOAL));
    fake_bus_servo(1)->mishear_next = 3;
    TEST_ASSERT_FALSE(servo_link_write(&servos, 1, DXL_AT_SPEED, goal, 2));
}

static void test_torque_off_and_engage_name_who_did_not_obey(void)
{
    robot(2);
    fake_bus_servo(2)->mishear_next = 3;
    TEST_ASSERT_EQUAL_HEX32(SERVO_LINK_BIT(1), servo_link_torque_off(&servos, SERVO_LINK_ALL));
    fake_bus_servo(1)->mishear_next = 3;
    uint16_t pos;
    TEST_ASSERT_FALSE(servo_link_engage(&servos, 1, &pos));
    (void)engaged_at(2);
}
