/* SPDX-License-Identifier: MIT
 * Injected faults, as a controller on the wire sees them. */
#include "servo_wire.h"

static wire_t wire;
static servo_t *one;

void setUp(void)
{
    wire_open(&wire);
    one = servo_bus_add(wire.bus, 1, SERVO_AX12, 1000000);
    (void)servo_bus_add(wire.bus, 2, SERVO_AX12, 1000000);
    wire.now = MS;
}

void tearDown(void)
{
    wire_close(&wire);
}

#define PING_1 0xFF, 0xFF, 0x01, 0x02, 0x01, 0xFB
#define PING_2 0xFF, 0xFF, 0x02, 0x02, 0x01, 0xFA
#define FINE_1 0xFF, 0xFF, 0x01, 0x02, 0x00, 0xFC
#define FINE_2 0xFF, 0xFF, 0x02, 0x02, 0x00, 0xFB

static void fault(servo_fault_t kind, uint32_t answers)
{
    servo_bus_fault(wire.bus, wire.now, one, kind, answers);
}

static void test_servo_fault_silent_obeys_without_answering_for_so_many_answers(void)
{
    fault(SERVO_FAULT_SILENT, 2);
    ASK(&wire, 0xFF, 0xFF, 0x01, 0x04, 0x03, 0x19, 0x01, 0xDD);
    EXPECT_SILENCE(&wire);
    TEST_ASSERT_EQUAL_UINT8(1, one->table[SERVO_LED]);
    ASK(&wire, PING_1);
    EXPECT_SILENCE(&wire);
    ASK(&wire, PING_1);
    EXPECT_ANSWER(&wire, FINE_1);
}

static void test_servo_fault_dead_is_unplugged_and_comes_back_limp(void)
{
    ASK(&wire, 0xFF, 0xFF, 0x01, 0x05, 0x03, 0x1E, 0x00, 0x03, 0xD5);
    fault(SERVO_FAULT_DEAD, SERVO_FAULT_ALWAYS);
    ASK(&wire, PING_1);
    EXPECT_SILENCE(&wire);
    fault(SERVO_FAULT_DEAD, 0);
    ASK(&wire, PING_1);
    EXPECT_ANSWER(&wire, FINE_1);
    TEST_ASSERT_EQUAL_UINT8(0, one->table[SERVO_TORQUE_ENABLE]);
}

static void test_servo_fault_duplicate_spoils_the_answer_until_cleared(void)
{
    fault(SERVO_FAULT_DUPLICATE, SERVO_FAULT_ALWAYS);
    ASK(&wire, PING_1);
    const uint8_t clean[] = {FINE_1};
    TEST_ASSERT_FALSE(wire.count == 6 && wire.bad == 0 && memcmp(clean, wire.heard, 6) == 0);
    TEST_ASSERT_GREATER_THAN_INT(0, wire.count);
    fault(SERVO_FAULT_DUPLICATE, 0);
    ASK(&wire, PING_1);
    EXPECT_ANSWER(&wire, FINE_1);
}

static void test_servo_fault_checksum_is_wrong_once(void)
{
    fault(SERVO_FAULT_CHECKSUM, 1);
    ASK(&wire, PING_1);
    TEST_ASSERT_EQUAL_INT(6, wire.count);
    TEST_ASSERT_NOT_EQUAL_HEX8(0xFC, wire.heard[5]);
    ASK(&wire, PING_1);
    EXPECT_ANSWER(&wire, FINE_1);
}

static void test_servo_fault_noise_goes_before_the_answer(void)
{
    fault(SERVO_FAULT_NOISE, 1);
    ASK(&wire, PING_1);
    const uint8_t clean[] = {FINE_1};
    TEST_ASSERT_EQUAL_INT(8, wire.count);
    TEST_ASSERT_EQUAL_HEX8_ARRAY(clean, wire.heard + 2, 6);
}

static void test_servo_fault_late_answers_after_20_ms_more(void)
{
    fault(SERVO_FAULT_LATE, 1);
    SEND(&wire, PING_1);
    wire_wait(&wire, 20 * MS + 500 * US);
    EXPECT_SILENCE(&wire);
    wire_wait(&wire, 60 * US);
    EXPECT_ANSWER(&wire, FINE_1);
}

static void test_servo_fault_short_ends_in_the_middle(void)
{
    fault(SERVO_FAULT_SHORT, 1);
    ASK(&wire, PING_1);
    EXPECT_ANSWER(&wire, 0xFF, 0xFF, 0x01);
}

static void test_servo_fault_two_talkers_spoil_the_answer_of_another(void)
{
    fault(SERVO_FAULT_TWO_TALKERS, SERVO_FAULT_ALWAYS);
    ASK(&wire, PING_2);
    const uint8_t clean[] = {FINE_2};
    TEST_ASSERT_FALSE(wire.count == 6 && wire.bad == 0 && memcmp(clean, wire.heard, 6) == 0);
    TEST_ASSERT_GREATER_THAN_UINT64(0, wire.bus->collisions);
    fault(SERVO_FAULT_TWO_TALKERS, 0);
    ASK(&wire, PING_2);
    EXPECT_ANSWER(&wire, FINE_2);
}

static void test_servo_fault_alarms_show_in_the_error_byte_and_cut_torque(void)
{
    one->table[SERVO_TORQUE_ENABLE] = 1;
    fault(SERVO_FAULT_OVERHEATING, SERVO_FAULT_ALWAYS);
    ASK(&wire, PING_1);
    EXPECT_ANSWER(&wire, 0xFF, 0xFF, 0x01, 0x02, 0x04, 0xF8);
    TEST_ASSERT_EQUAL_UINT8(0, one->table[SERVO_TORQUE_ENABLE]);
    TEST_ASSERT_EQUAL_UINT8(85, one->table[SERVO_TEMPERATURE]);
    fault(SERVO_FAULT_OVERHEATING, 0);
    fault(SERVO_FAULT_LOW_VOLTAGE, SERVO_FAULT_ALWAYS);
    ASK(&wire, PING_1);
    EXPECT_ANSWER(&wire, 0xFF, 0xFF, 0x01, 0x02, 0x01, 0xFB);
    fault(SERVO_FAULT_LOW_VOLTAGE, 0);
    fault(SERVO_FAULT_OVERLOAD, 1);
    ASK(&wire, PING_1);
    EXPECT_ANSWER(&wire, 0xFF, 0xFF, 0x01, 0x02, 0x20, 0xDC);
    fault(SERVO_FAULT_OVERLOAD, 0);
    fault(SERVO_FAULT_ANGLE_LIMIT, SERVO_FAULT_ALWAYS);
    ASK(&wire, PING_1);
    EXPECT_ANSWER(&wire, 0xFF, 0xFF, 0x01, 0x02, 0x02, 0xFA);
}

static void test_servo_fault_stray_bytes_in_the_middle_of_an_answer_spoil_it(void)
{
    const uint8_t stray[] = {0x00, 0x00};
    SEND(&wire, PING_1);
    wire_wait(&wire, 523 * US); /* low 523..532 and 533..542 us: over the stop bits at 529 and 539 */
    servo_bus_noise(wire.bus, wire.now, stray, 2, 1000000);
    wire_wait(&wire, MS);
    TEST_ASSERT_EQUAL_INT(6, wire.count); /* of two bytes at once only the first is received */
    TEST_ASSERT_EQUAL_INT(2, wire.bad);
}

static void test_servo_fault_names_are_found(void)
{
    for (int kind = 0; kind < SERVO_FAULTS; kind++) {
        TEST_ASSERT_EQUAL_INT(kind, servo_fault_by_name(servo_fault_name((servo_fault_t)kind)));
    }
    TEST_ASSERT_EQUAL_INT(SERVO_FAULT_TWO_TALKERS, servo_fault_by_name("two_talkers"));
    TEST_ASSERT_EQUAL_INT(SERVO_FAULTS, servo_fault_by_name("tired"));
    TEST_ASSERT_EQUAL_INT(SERVO_FAULTS, servo_fault_by_name("silen"));
}
