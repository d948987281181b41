/* SPDX-License-Identifier: MIT
 * The maker's data sheet against the servo model, measured as on a bench: a brake on the shaft sets its speed and reads
 * its torque. The gears take 0.05 N m of the motor's torque (the sheet gives figures of the shaft). */
#include "servo_wire.h"

#define GEARS_NM 0.05
#define RPM (2 * 3.14159265358979 / 60)
#define UNITS_PER_RADIAN (1024 / 300.0 * 180 / 3.14159265358979)

typedef struct {
    double angle, speed, torque; /* angle and speed as the test sets them, torque as read */
    int steps;
} brake_t;

static wire_t wire;
static brake_t brake;

static void brake_look(void *context, servo_shaft_t *shafts, int count)
{
    const brake_t *self = context;
    TEST_ASSERT_EQUAL_INT(1, count);
    shafts[0].angle_rad = self->angle;
    shafts[0].speed_rad_s = self->speed;
}

static void brake_step(void *context, servo_shaft_t *shafts, int count)
{
    brake_t *self = context;
    self->torque = shafts[0].torque_nm;
    self->steps++;
    brake_look(context, shafts, count);
}

void setUp(void)
{
    wire_open(&wire);
    brake = (brake_t){0};
}

void tearDown(void)
{
    wire_close(&wire);
}

static servo_t *on_the_brake(servo_model_t model, double volts)
{
    servo_t *servo = servo_bus_add(wire.bus, 1, model, 1000000);
    const servo_body_t body = {&brake, brake_look, brake_step};
    servo_bus_supply(wire.bus, wire.now, volts);
    servo_bus_body(wire.bus, wire.now, &body);
    return servo;
}

static void put(servo_t *servo, uint8_t address, uint16_t value, uint8_t bytes)
{
    const uint8_t data[2] = {(uint8_t)value, (uint8_t)(value >> 8)};
    TEST_ASSERT_EQUAL_HEX8(0, servo_write(servo, address, data, bytes));
}

/* Torque of the shaft at this speed, far enough from the goal for full duty. */
static double shaft_nm(servo_t *servo, double rpm)
{
    put(servo, SERVO_GOAL, 1000, 2);
    brake.speed = rpm * RPM;
    wire_wait(&wire, 10 * MS); /* the servo gets the speed one step later */
    return brake.torque - GEARS_NM;
}

static void test_ax12_stalls_at_1_5_nm_and_turns_at_59_rpm_at_12_v(void)
{
    servo_t *servo = on_the_brake(SERVO_AX12, 12);
    TEST_ASSERT_FLOAT_WITHIN(0.001, 1.5, shaft_nm(servo, 0));
    TEST_ASSERT_FLOAT_WITHIN(0.001, 0, shaft_nm(servo, 59));
    TEST_ASSERT_FLOAT_WITHIN(0.001, 0.75, shaft_nm(servo, 29.5));
}

static void test_ax12_goes_with_the_supply(void)
{
    servo_t *servo = on_the_brake(SERVO_AX12, 9.6); /* 0.8 of 12 V */
    TEST_ASSERT_FLOAT_WITHIN(0.02, 1.2, shaft_nm(servo, 0));
    TEST_ASSERT_FLOAT_WITHIN(0.02, 0, shaft_nm(servo, 47)); /* maker's data sheet */
    servo_bus_supply(wire.bus, wire.now, 11.1);
    TEST_ASSERT_FLOAT_WITHIN(0.02, 1.3875, shaft_nm(servo, 0));
    TEST_ASSERT_FLOAT_WITHIN(0.02, 0, shaft_nm(servo, 54.6));
}

static void test_ax18_stalls_at_1_8_nm_and_turns_at_97_rpm_at_12_v(void)
{
    servo_t *servo = on_the_brake(SERVO_AX18, 12);
    TEST_ASSERT_EQUAL_UINT16(18, servo_get(servo, SERVO_MODEL, 2));
    put(servo, SERVO_TORQUE_LIMIT, 1023, 2); /* shipped with 983 */
    TEST_ASSERT_FLOAT_WITHIN(0.001, 1.8, shaft_nm(servo, 0));
    TEST_ASSERT_FLOAT_WITHIN(0.001, 0, shaft_nm(servo, 97));
}

static void test_torque_limit_bounds_the_torque(void)
{
    servo_t *servo = on_the_brake(SERVO_AX12, 12);
    put(servo, SERVO_TORQUE_LIMIT, 512, 2);
    TEST_ASSERT_FLOAT_WITHIN(0.001, 1.55 * 512 / 1023 - GEARS_NM, shaft_nm(servo, 0));
}

static void test_slope_margin_and_punch_make_the_torque_of_an_error(void)
{
    servo_t *servo = on_the_brake(SERVO_AX12, 12);
    put(servo, SERVO_CCW_SLOPE, 64, 1);
    put(servo, SERVO_CCW_MARGIN, 2, 1);
    put(servo, SERVO_PUNCH, 64, 2);
    put(servo, SERVO_GOAL, 514, 2);
    wire_wait(&wire, 10 * MS);
    TEST_ASSERT_FLOAT_WITHIN(1e-6, 0, brake.torque); /* inside the margin */
    put(servo, SERVO_GOAL, 515, 2);
    wire_wait(&wire, 10 * MS);
    TEST_ASSERT_FLOAT_WITHIN(0.001, 1.55 * (64 / 1023.0 + 1 / 64.0 * (1 - 64 / 1023.0)), brake.torque);
    put(servo, SERVO_GOAL, 512 + 34, 2); /* 32 of 64 units beyond the margin */
    wire_wait(&wire, 10 * MS);
    TEST_ASSERT_FLOAT_WITHIN(0.001, 1.55 * (64 / 1023.0 + 0.5 * (1 - 64 / 1023.0)), brake.torque);
    put(servo, SERVO_GOAL, 512 - 33, 2); /* negative direction: slope 32, margin 1 as shipped */
    wire_wait(&wire, 10 * MS);
    TEST_ASSERT_FLOAT_WITHIN(0.001, -1.55, brake.torque);
}

static void test_on_target_it_brakes_and_limp_it_does_not(void)
{
    servo_t *servo = on_the_brake(SERVO_AX12, 12);
    put(servo, SERVO_GOAL, 512, 2);
    brake.speed = 59 * RPM; /* forced through its goal */
    wire_wait(&wire, 10 * MS);
    TEST_ASSERT_FLOAT_WITHIN(0.001, -1.5, brake.torque);
    put(servo, SERVO_TORQUE_ENABLE, 0, 1);
    wire_wait(&wire, 10 * MS);
    TEST_ASSERT_FLOAT_WITHIN(1e-6, 0, brake.torque);
}

/* At a tenth of its full speed, against half of the stall torque, it still turns at the moving speed. */
static void test_moving_speed_holds_against_a_load(void)
{
    servo_t *servo = on_the_brake(SERVO_AX12, 12);
    put(servo, SERVO_ALARM_SHUTDOWN, 0, 1); /* no shutdown by heat */
    put(servo, SERVO_SPEED, 53, 2);         /* 5.88 rpm */
    brake.speed = 5.88 * RPM * 0.99;
    put(servo, SERVO_GOAL, 1000, 2);
    wire_wait(&wire, 40000 * MS);
    TEST_ASSERT_TRUE(brake.torque > 0.75); /* slightly too slow for long, so the torque increases */
    brake.speed = 5.88 * RPM * 1.2;
    wire_wait(&wire, 5000 * MS);
    TEST_ASSERT_TRUE(brake.torque < 0); /* too fast, so it brakes */
}

static void test_heat_goes_with_the_square_of_the_torque(void)
{
    servo_t *servo = on_the_brake(SERVO_AX12, 12);
    put(servo, SERVO_ALARM_SHUTDOWN, 0, 1);
    put(servo, SERVO_TORQUE_LIMIT, 512, 2);
    TEST_ASSERT_FLOAT_WITHIN(0.01, 0.7257, shaft_nm(servo, 0));
    wire_wait(&wire, 600000 * MS);
    TEST_ASSERT_FLOAT_WITHIN(0.3, 30 + 86 * 0.25, servo->temperature_c); /* half the stall torque, a quarter of its heat */
}

static void test_full_duty_without_motion_for_a_second_is_overload(void)
{
    servo_t *servo = on_the_brake(SERVO_AX12, 12);
    put(servo, SERVO_GOAL, 1000, 2);
    wire_wait(&wire, 990 * MS);
    TEST_ASSERT_EQUAL_HEX8(0, servo->alarms);
    wire_wait(&wire, 20 * MS);
    TEST_ASSERT_EQUAL_HEX8(SERVO_ERR_OVERLOAD, servo->alarms);
    TEST_ASSERT_FLOAT_WITHIN(1e-6, 0, brake.torque + 1.55 * servo->output); /* the torque is cut at the next step */
}

static void test_body_is_stepped_1024_times_a_second_and_shows_in_the_registers(void)
{
    servo_t *servo = on_the_brake(SERVO_AX12, 12);
    wire_wait(&wire, 1000 * MS);
    TEST_ASSERT_EQUAL_INT(1024, brake.steps);
    brake.angle = -100 / UNITS_PER_RADIAN;
    brake.speed = 10 * RPM;
    wire_wait(&wire, 1 * MS);
    TEST_ASSERT_EQUAL_UINT16(412, register_of(&wire, servo, SERVO_PRESENT, 2));
    TEST_ASSERT_UINT16_WITHIN(1, 90, register_of(&wire, servo, SERVO_PRESENT_SPEED, 2)); /* 10 / 0.111 */
    TEST_ASSERT_EQUAL_UINT8(1, servo->table[SERVO_MOVING]);
    servo_push_to(servo, wire.now, 900); /* no effect: the body sets the angle */
    TEST_ASSERT_EQUAL_UINT16(412, register_of(&wire, servo, SERVO_PRESENT, 2));
}

static void test_blocked_in_a_body_the_shaft_is_held_as_by_a_hand(void)
{
    servo_t *servo = on_the_brake(SERVO_AX12, 12);
    wire_wait(&wire, 5 * MS);
    servo_bus_fault(wire.bus, wire.now, servo, SERVO_FAULT_BLOCKED, SERVO_FAULT_ALWAYS);
    brake.angle = 0.01; /* limp servo with a blocked horn that is bent: torque back to the blocked position */
    wire_wait(&wire, 5 * MS);
    TEST_ASSERT_FLOAT_WITHIN(0.001, -1.0, brake.torque);
}

static void test_without_its_body_a_servo_goes_on_from_where_it_stands(void)
{
    servo_t *servo = on_the_brake(SERVO_AX12, 12);
    brake.angle = 100 / UNITS_PER_RADIAN;
    wire_wait(&wire, 5 * MS);
    servo_bus_body(wire.bus, wire.now, NULL);
    TEST_ASSERT_EQUAL_UINT16(612, register_of(&wire, servo, SERVO_PRESENT, 2));
    put(servo, SERVO_GOAL, 700, 2);
    wire_wait(&wire, 1000 * MS);
    TEST_ASSERT_UINT16_WITHIN(1, 700, register_of(&wire, servo, SERVO_PRESENT, 2));
}
