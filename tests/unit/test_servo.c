/* SPDX-License-Identifier: MIT
 * A servo with the built-in body: motion, load, heat, power, alarms. By hand: 300 degrees are 1024 units, so 1 rpm is
 * 20.48 units/s and a speed unit (0.111 rpm) 2.273 units/s. Motor of an AX-12 (servo_motor.h): A = 1.55 N m at 12 V, 1.24 at
 * the bus's 9.6 V; B = 1.5 N m / (59 rpm = 6.178 rad/s) = 0.2428 N m s; friction 0.05 N m; the rotor alone (0.003 kg m2)
 * follows with 0.003 / 0.2428 = 12.4 ms. At 9.6 V it turns (1.24 - 0.05) / 0.2428 = 4.90 rad/s = 958.6 units/s. */
#include "servo_wire.h"

static wire_t wire;
static servo_t *servo;

void setUp(void)
{
    wire_open(&wire);
    servo = servo_bus_add(wire.bus, 1, SERVO_AX12, 1000000);
}

void tearDown(void)
{
    wire_close(&wire);
}

static uint8_t put(uint8_t address, uint16_t value, uint8_t bytes)
{
    const uint8_t data[2] = {(uint8_t)value, (uint8_t)(value >> 8)};
    servo_advance(servo, wire.now);
    return servo_write(servo, address, data, bytes);
}

static uint16_t present(void)
{
    return register_of(&wire, servo, SERVO_PRESENT, 2);
}

static void test_servo_nothing_moves_at_power_on(void)
{
    wire_wait(&wire, 1000 * MS);
    TEST_ASSERT_EQUAL_UINT16(512, present());
    TEST_ASSERT_EQUAL_UINT8(0, servo->table[SERVO_TORQUE_ENABLE]);
    TEST_ASSERT_EQUAL_UINT16(512, servo_get(servo, SERVO_GOAL, 2));
}

static void test_servo_moves_at_the_moving_speed(void)
{
    put(SERVO_SPEED, 100, 2); /* 227.3 units/s */
    put(SERVO_GOAL, 1023, 2);
    wire_wait(&wire, 1000 * MS);
    TEST_ASSERT_UINT16_WITHIN(4, 512 + 224, present()); /* starting costs 12 ms */
    TEST_ASSERT_UINT16_WITHIN(1, 100, register_of(&wire, servo, SERVO_PRESENT_SPEED, 2));
    TEST_ASSERT_EQUAL_UINT8(1, servo->table[SERVO_MOVING]);
}

/* At rest nothing lowers what an earlier, higher limit allowed. */
static void test_servo_keeps_a_lower_moving_speed_from_the_first_moment(void)
{
    put(SERVO_SPEED, 200, 2);
    put(SERVO_GOAL, 700, 2);
    wire_wait(&wire, 3000 * MS);
    TEST_ASSERT_UINT16_WITHIN(1, 700, present());
    put(SERVO_SPEED, 10, 2); /* 22.7 units/s */
    put(SERVO_GOAL, 500, 2);
    wire_wait(&wire, 100 * MS);
    TEST_ASSERT_UINT16_WITHIN(2, 697, present());
}

static void test_servo_speed_0_is_as_fast_as_the_supply_allows(void)
{
    put(SERVO_GOAL, 1000, 2);
    wire_wait(&wire, 150 * MS);
    TEST_ASSERT_UINT16_WITHIN(4, 512 + 132, present()); /* 958.6 * (0.150 - 0.0124) */
    wire_wait(&wire, 600 * MS);
    TEST_ASSERT_UINT16_WITHIN(1, 1000, present());
    TEST_ASSERT_EQUAL_UINT8(0, servo->table[SERVO_MOVING]);
    servo_bus_supply(wire.bus, wire.now, 7.2); /* three quarters of 9.6 V */
    put(SERVO_GOAL, 0, 2);
    wire_wait(&wire, 200 * MS);
    TEST_ASSERT_UINT16_WITHIN(4, 1000 - 133, present()); /* (1.55 * 0.6 - 0.05) / 0.2428 = 708.9 units/s, 0.1876 s of it */
}

static void test_servo_lags_behind_a_ramp_by_slope_times_speed(void)
{
    servo_push_to(servo, wire.now, 200);
    put(SERVO_GOAL, 200, 2);
    for (uint16_t tick = 1; tick <= 60; tick++) { /* 5 units a tick of 7.8125 ms: 640 units/s = 3.272 rad/s */
        wire_wait(&wire, 125000);
        put(SERVO_GOAL, (uint16_t)(200 + 5 * tick), 2);
    }
    /* Duty (0.2428 * 3.272 + 0.05) / 1.24 = 0.681; error 1 + (0.681 - 0.0313) / 0.9687 * 32 = 22.5; plus half of the
     * step just written. */
    TEST_ASSERT_INT_WITHIN(3, 25, 500 - present());
    put(SERVO_CW_SLOPE, 128, 1);
    put(SERVO_CCW_SLOPE, 128, 1);
    for (uint16_t tick = 1; tick <= 60; tick++) {
        wire_wait(&wire, 125000);
        put(SERVO_GOAL, (uint16_t)(500 + 5 * tick), 2);
    }
    TEST_ASSERT_INT_WITHIN(6, 89, 800 - present()); /* 1 + 0.6707 * 128 + 2.5 */
}

static void test_servo_result_does_not_depend_on_who_looks(void)
{
    servo_t *twin = servo_bus_add(wire.bus, 2, SERVO_AX12, 1000000);
    const uint8_t goal[2] = {0x20, 0x03};
    servo_write(twin, SERVO_GOAL, goal, 2);
    put(SERVO_GOAL, 0x320, 2);
    for (int i = 0; i < 999; i++) {
        wire_wait(&wire, 1777);
        (void)present();
    }
    servo_advance(twin, wire.now);
    TEST_ASSERT_TRUE(twin->position == servo->position);
}

static void test_servo_without_torque_goes_where_the_hand_puts_it(void)
{
    servo_push_to(servo, wire.now, 300);
    wire_wait(&wire, 1000 * MS);
    TEST_ASSERT_EQUAL_UINT16(300, present());
    put(SERVO_TORQUE_ENABLE, 1, 1); /* the goal is unchanged, so the servo returns to it */
    wire_wait(&wire, 1000 * MS);
    TEST_ASSERT_UINT16_WITHIN(1, 512, present());
    servo_push_to(servo, wire.now, 400); /* with torque it pulls back */
    wire_wait(&wire, 1000 * MS);
    TEST_ASSERT_UINT16_WITHIN(1, 512, present());
    put(SERVO_TORQUE_ENABLE, 0, 1);
    servo_push_to(servo, wire.now, 2000); /* mechanical end */
    TEST_ASSERT_EQUAL_UINT16(1023, present());
}

static void test_servo_a_goal_switches_torque_on(void)
{
    TEST_ASSERT_EQUAL_HEX8(0, put(SERVO_GOAL, 520, 2));
    TEST_ASSERT_EQUAL_UINT8(1, servo->table[SERVO_TORQUE_ENABLE]);
}

static void test_servo_goal_outside_the_angle_limits_is_an_error_and_ends_at_the_limit(void)
{
    put(SERVO_CW_LIMIT, 200, 2);
    put(SERVO_CCW_LIMIT, 800, 2);
    TEST_ASSERT_EQUAL_HEX8(SERVO_ERR_ANGLE, put(SERVO_GOAL, 900, 2));
    wire_wait(&wire, 1000 * MS);
    TEST_ASSERT_UINT16_WITHIN(1, 800, present());
    TEST_ASSERT_EQUAL_HEX8(SERVO_ERR_ANGLE, servo->alarms);
    TEST_ASSERT_EQUAL_HEX8(0, put(SERVO_GOAL, 800, 2));
    TEST_ASSERT_EQUAL_HEX8(0, servo->alarms);
}

static void test_servo_both_limits_0_is_endless_turn(void)
{
    put(SERVO_CW_LIMIT, 0, 2);
    put(SERVO_CCW_LIMIT, 0, 2);
    put(SERVO_TORQUE_ENABLE, 1, 1);
    put(SERVO_SPEED, 1024 + 300, 2); /* bit 10: clockwise, 681 units/s */
    wire_wait(&wire, 500 * MS);
    TEST_ASSERT_UINT16_WITHIN(5, 512 - 338, present());
    wire_wait(&wire, 500 * MS); /* past 0: one turn is 1227.6 units */
    TEST_ASSERT_EQUAL_UINT16(1023, present());
    TEST_ASSERT_INT_WITHIN(8, 1060, (int)servo->position);
}

static void test_servo_blocked_for_a_second_is_overload_and_shuts_down(void)
{
    servo_bus_fault(wire.bus, wire.now, servo, SERVO_FAULT_BLOCKED, SERVO_FAULT_ALWAYS);
    put(SERVO_SPEED, 50, 2); /* even at low speed a blocked servo pushes with full torque 0.4 s later */
    put(SERVO_GOAL, 700, 2);
    wire_wait(&wire, 1300 * MS);
    TEST_ASSERT_EQUAL_UINT16(512, present());
    TEST_ASSERT_EQUAL_UINT16(1023, register_of(&wire, servo, SERVO_PRESENT_LOAD, 2));
    TEST_ASSERT_EQUAL_HEX8(0, servo->alarms);
    wire_wait(&wire, 200 * MS);
    (void)present();
    TEST_ASSERT_EQUAL_HEX8(SERVO_ERR_OVERLOAD, servo->alarms);
    TEST_ASSERT_EQUAL_UINT8(0, servo->table[SERVO_TORQUE_ENABLE]);
    TEST_ASSERT_EQUAL_UINT16(0, servo_get(servo, SERVO_TORQUE_LIMIT, 2));
}

static void test_servo_after_overload_torque_limit_and_enable_must_be_written(void)
{
    servo_bus_fault(wire.bus, wire.now, servo, SERVO_FAULT_OVERLOAD, 1);
    TEST_ASSERT_EQUAL_HEX8(SERVO_ERR_OVERLOAD, servo->alarms);
    put(SERVO_GOAL, 600, 2);
    wire_wait(&wire, 500 * MS);
    TEST_ASSERT_EQUAL_UINT16(512, present());
    put(SERVO_TORQUE_LIMIT, 1023, 2);
    TEST_ASSERT_EQUAL_HEX8(0, servo->alarms);
    put(SERVO_TORQUE_ENABLE, 1, 1);
    wire_wait(&wire, 500 * MS);
    TEST_ASSERT_UINT16_WITHIN(1, 600, present());
}

static void test_servo_load_makes_it_droop_and_shows(void)
{
    put(SERVO_GOAL, 512, 2);
    servo->outside_load = -0.5; /* gravity of half the stall torque, towards smaller positions */
    wire_wait(&wire, 1000 * MS);
    /* 0.75 N m, and friction adds or subtracts 0.05: duty 0.70 / 1.24 .. 0.80 / 1.24, which is
     * 0.0313 + (error - 1) / 32 * 0.9687. */
    TEST_ASSERT_INT_WITHIN(2, 20, 512 - present());
    TEST_ASSERT_INT_WITHIN(42, 619, register_of(&wire, servo, SERVO_PRESENT_LOAD, 2));
    servo->outside_load = 0.5;
    wire_wait(&wire, 1000 * MS);
    TEST_ASSERT_INT_WITHIN(42, 1024 + 619, register_of(&wire, servo, SERVO_PRESENT_LOAD, 2));
}

static void test_servo_each_direction_has_its_own_slope(void)
{
    put(SERVO_CCW_SLOPE, 64, 1); /* slope for pushes towards larger positions: twice as soft */
    put(SERVO_GOAL, 512, 2);
    servo->outside_load = -0.5;
    wire_wait(&wire, 1000 * MS);
    TEST_ASSERT_INT_WITHIN(3, 39, 512 - present()); /* 1 + (0.5645 .. 0.6452 - 0.0313) / 0.9687 * 64 */
    servo->outside_load = 0.5;
    wire_wait(&wire, 1000 * MS);
    TEST_ASSERT_INT_WITHIN(2, 20, present() - 512);
}

static void test_servo_long_stall_heats(void)
{
    put(SERVO_ALARM_SHUTDOWN, 0, 1);
    servo_bus_fault(wire.bus, wire.now, servo, SERVO_FAULT_BLOCKED, SERVO_FAULT_ALWAYS);
    put(SERVO_GOAL, 700, 2);
    wire_wait(&wire, 120000 * MS); /* one time constant: 30 + 86 * 0.8^2 * 0.632; 9.6 V are 0.8 of 12 */
    TEST_ASSERT_UINT16_WITHIN(1, 64, register_of(&wire, servo, SERVO_TEMPERATURE, 1));
    put(SERVO_TORQUE_ENABLE, 0, 1);
    wire_wait(&wire, 120000 * MS);
    TEST_ASSERT_UINT16_WITHIN(1, 42, register_of(&wire, servo, SERVO_TEMPERATURE, 1)); /* 30 + 34.8 * 0.368 */
}

static void test_servo_voltage_is_shown_in_tenths_and_watched(void)
{
    servo_bus_supply(wire.bus, wire.now, 11.1);
    TEST_ASSERT_EQUAL_UINT16(111, register_of(&wire, servo, SERVO_VOLTAGE, 1));
    servo_bus_supply(wire.bus, wire.now, 5.9);
    (void)present();
    TEST_ASSERT_EQUAL_HEX8(SERVO_ERR_VOLTAGE, servo->alarms);
    TEST_ASSERT_FALSE(servo->shutdown); /* mask 36 as shipped: overload and heat shut down, voltage does not */
}

static void test_servo_power_cycle_keeps_eeprom_and_loses_ram(void)
{
    put(SERVO_RETURN_DELAY, 0, 1);
    put(SERVO_MAX_TORQUE, 700, 2);
    put(SERVO_CCW_SLOPE, 64, 1);
    put(SERVO_LOCK, 1, 1);
    put(SERVO_GOAL, 600, 2);
    wire_wait(&wire, 500 * MS);
    servo_bus_power(wire.bus, wire.now, false);
    wire_wait(&wire, 500 * MS);
    servo_bus_power(wire.bus, wire.now, true);
    TEST_ASSERT_EQUAL_UINT8(0, servo->table[SERVO_RETURN_DELAY]);
    TEST_ASSERT_EQUAL_UINT16(700, servo_get(servo, SERVO_TORQUE_LIMIT, 2));
    TEST_ASSERT_EQUAL_UINT8(32, servo->table[SERVO_CCW_SLOPE]);
    TEST_ASSERT_EQUAL_UINT8(0, servo->table[SERVO_LOCK]);
    TEST_ASSERT_EQUAL_UINT8(0, servo->table[SERVO_TORQUE_ENABLE]);
    TEST_ASSERT_UINT16_WITHIN(2, 600, servo_get(servo, SERVO_GOAL, 2)); /* slope 64 stops it 1.6 units short */
}

static void test_servo_lock_leaves_only_24_to_35_open(void)
{
    TEST_ASSERT_EQUAL_HEX8(0, put(SERVO_LOCK, 1, 1));
    TEST_ASSERT_EQUAL_HEX8(SERVO_ERR_RANGE, put(SERVO_ID, 7, 1));
    TEST_ASSERT_EQUAL_HEX8(SERVO_ERR_RANGE, put(SERVO_PUNCH, 50, 2));
    TEST_ASSERT_EQUAL_HEX8(SERVO_ERR_RANGE, put(SERVO_LOCK, 0, 1));
    TEST_ASSERT_EQUAL_HEX8(0, put(SERVO_GOAL, 600, 2));
    TEST_ASSERT_EQUAL_HEX8(0, put(SERVO_TORQUE_LIMIT, 900, 2));
}
