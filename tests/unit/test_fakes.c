/* SPDX-License-Identifier: MIT
 * The fakes themselves, which must be as strict as the chip (tests/fake). */
#include "bus.h"
#include "bus_call.h"
#include "clock.h"
#include "console.h"
#include "dxl_packet.h"
#include "eeprom.h"
#include "fake_bus.h"
#include "fake_console.h"
#include "fake_eeprom.h"
#include "fake_panel.h"
#include "fake_system.h"
#include "fake_time.h"
#include "panel.h"
#include "system.h"
#include "tick.h"
#include "unity.h"

#include <setjmp.h>
#include <string.h>

static jmp_buf somewhere;

void setUp(void)
{
    fake_bus_reset();
    fake_console_reset();
    fake_eeprom_reset();
    fake_panel_reset();
    fake_system_reset();
    fake_time_reset();
}

void tearDown(void)
{
}

/* ---- EEPROM ---- */

static void test_eeprom_is_erased_busy_after_a_write_and_wears(void)
{
    TEST_ASSERT_EQUAL_HEX8(0xFF, eeprom_byte(0xFFF));
    TEST_ASSERT_TRUE(eeprom_start(5, 0x42));
    TEST_ASSERT_TRUE(eeprom_is_busy());
    TEST_ASSERT_FALSE(eeprom_start(6, 1));
    eeprom_wait();
    TEST_ASSERT_EQUAL_HEX8(0x42, eeprom_byte(5));
    TEST_ASSERT_EQUAL_HEX8(0xFF, eeprom_byte(6));
    TEST_ASSERT_EQUAL(1, fake_eeprom_wear(5));
    TEST_ASSERT_TRUE(eeprom_start(5, 0x42));   /* same value: no write, no wear */
    TEST_ASSERT_FALSE(eeprom_is_busy());
    TEST_ASSERT_EQUAL(1, fake_eeprom_wear(5));
}

static void test_eeprom_power_cut_leaves_old_torn_or_new(void)
{
    static const struct {
        int torn;
        uint8_t then;
    } cases[] = { { -1, 0xFF }, { 0x99, 0x99 }, { 256, 0x42 } };
    for (uint8_t i = 0; i < 3; i++) {
        fake_eeprom_reset();
        if (setjmp(somewhere) == 0) {
            fake_eeprom_cut(2, cases[i].torn, &somewhere);
            (void)eeprom_start(1, 1);
            eeprom_wait();
            (void)eeprom_start(2, 0x42);
            TEST_FAIL_MESSAGE("the power stayed on");
        }
        TEST_ASSERT_EQUAL_HEX8(1, eeprom_byte(1));
        TEST_ASSERT_EQUAL_HEX8(cases[i].then, eeprom_byte(2));
    }
}

/* ---- console ---- */

static void test_console_ring_drops_what_does_not_fit(void)
{
    uint8_t byte;
    console_counts_t counts;
    for (uint16_t i = 0; i < 260; i++) {
        const uint8_t in = (uint8_t)i;
        fake_console_type_bytes(&in, 1);
    }
    console_counts(&counts);
    TEST_ASSERT_EQUAL(5, counts.ring_full);
    TEST_ASSERT_EQUAL(255, console_waiting());
    TEST_ASSERT_TRUE(console_get(&byte));
    TEST_ASSERT_EQUAL(0, byte);
}

static void test_console_output_obeys_its_room(void)
{
    fake_console_set_room(2);
    TEST_ASSERT_TRUE(console_put('a'));
    TEST_ASSERT_TRUE(console_put('b'));
    TEST_ASSERT_FALSE(console_put('c'));
    console_write("def", 3);
    TEST_ASSERT_EQUAL_STRING("abdef", fake_console_output());
}

static void test_console_holds_only_under_flow_control(void)
{
    console_xoff();
    TEST_ASSERT_FALSE(fake_console_is_held());
    console_set_flow(true);
    console_xoff();
    console_xoff();
    console_xon();
    TEST_ASSERT_TRUE(fake_console_is_held()); /* holds nest */
    console_xon();
    TEST_ASSERT_FALSE(fake_console_is_held());
}

/* ---- time ---- */

static void test_ticks_not_taken_are_missed_unless_forgiven(void)
{
    fake_time_ticks(3);
    TEST_ASSERT_TRUE(tick_is_due());
    TEST_ASSERT_TRUE(tick_take());
    TEST_ASSERT_FALSE(tick_take());
    TEST_ASSERT_EQUAL(2, tick_missed());
    fake_time_ticks(5);
    tick_forgive();
    TEST_ASSERT_FALSE(tick_take());
    TEST_ASSERT_EQUAL(2, tick_missed());
}

static void test_clock_and_tick_run_together(void)
{
    uint16_t since = clock_now();
    clock_wait_us(7813);
    TEST_ASSERT_EQUAL(1, tick_now());
    TEST_ASSERT_TRUE(clock_is_past(clock_now(), since, 15624));
}

/* ---- bus ---- */

static void test_fake_servo_reads_and_writes_its_table(void)
{
    uint8_t bytes[2], error = 9;
    const uint8_t goal[3] = { DXL_AT_GOAL, 0x34, 0x02 };
    (void)fake_bus_add(4, BUS_RATE_1M);
    TEST_ASSERT_EQUAL(BUS_OK, bus_call_ping(4, 1, &error));
    TEST_ASSERT_EQUAL(0, error);
    TEST_ASSERT_EQUAL(BUS_OK, bus_call(4, DXL_WRITE, goal, sizeof goal, 0, 1, NULL));
    TEST_ASSERT_EQUAL_HEX16(0x0234, fake_bus_word(4, DXL_AT_GOAL));
    TEST_ASSERT_EQUAL(1, fake_bus_servo(4)->table[DXL_AT_TORQUE_ENABLE]);
    TEST_ASSERT_EQUAL(BUS_OK, bus_call_read(4, DXL_AT_PRESENT, bytes, 2, NULL));
    TEST_ASSERT_EQUAL_HEX8(0x34, bytes[0]);
    TEST_ASSERT_EQUAL(BUS_ERR_TIMEOUT, bus_call_ping(5, 1, NULL));
}

static void test_fake_servo_hears_only_its_own_rate(void)
{
    (void)fake_bus_add(4, BUS_RATE_57142);
    TEST_ASSERT_EQUAL(BUS_ERR_TIMEOUT, bus_call_ping(4, 1, NULL));
    bus_set_rate(BUS_RATE_57142);
    TEST_ASSERT_EQUAL(BUS_OK, bus_call_ping(4, 1, NULL));
}

static void test_fake_servo_faults_and_retries(void)
{
    bus_counts_t counts;
    fake_servo_t *servo = fake_bus_add(4, BUS_RATE_1M);
    servo->fail_next = 2;
    TEST_ASSERT_EQUAL(BUS_OK, bus_call_ping(4, 3, NULL));
    bus_counts(&counts);
    TEST_ASSERT_EQUAL(2, counts.retries);
    servo->faults = FAKE_BUS_BAD_CHECKSUM;
    TEST_ASSERT_EQUAL(BUS_ERR_CHECKSUM, bus_call_ping(4, 2, NULL));
    servo->faults = FAKE_BUS_WRONG_ID;
    TEST_ASSERT_EQUAL(BUS_ERR_WRONG_ID, bus_call_ping(4, 1, NULL));
    servo->faults = FAKE_BUS_SILENT;
    TEST_ASSERT_EQUAL(BUS_ERR_TIMEOUT, bus_call_ping(4, 1, NULL));
}

static void test_fake_servo_keeps_a_reg_write_until_action(void)
{
    static const uint8_t params[] = { DXL_AT_GOAL, 0x10, 0x01 };
    (void)fake_bus_add(4, BUS_RATE_1M);
    TEST_ASSERT_EQUAL(BUS_OK, bus_call(4, DXL_REG_WRITE, params, 3, 0, 1, NULL));
    TEST_ASSERT_EQUAL(512, fake_bus_word(4, DXL_AT_GOAL));
    TEST_ASSERT_EQUAL(BUS_OK, bus_call(DXL_BROADCAST, DXL_ACTION, NULL, 0, BUS_NO_ANSWER, 1, NULL));
    TEST_ASSERT_EQUAL_HEX16(0x0110, fake_bus_word(4, DXL_AT_GOAL));
}

static void test_fake_bus_takes_its_time_and_one_packet_only(void)
{
    bus_answer_t answer;
    (void)fake_bus_add(4, BUS_RATE_1M);
    fake_bus_set_latency(2);
    TEST_ASSERT_EQUAL(BUS_PENDING, bus_start_read(4, DXL_AT_MODEL, 2, 1));
    TEST_ASSERT_EQUAL(BUS_ERR_BUSY, bus_submit(6, 0, 1));
    TEST_ASSERT_EQUAL(BUS_PENDING, bus_poll(&answer));
    TEST_ASSERT_EQUAL(BUS_PENDING, bus_poll(&answer));
    TEST_ASSERT_EQUAL(BUS_OK, bus_poll(&answer));
    TEST_ASSERT_EQUAL(12, answer.params[0]);
    TEST_ASSERT_EQUAL(1, fake_bus_sent());
    TEST_ASSERT_EQUAL_HEX8(DXL_READ, fake_bus_packet(0)[4]);
}

/* ---- panel, system ---- */

static void test_panel_debounces_and_is_absent_on_a_cm2(void)
{
    fake_panel_press(PANEL_UP);
    panel_tick();
    panel_tick();
    TEST_ASSERT_EQUAL(0, panel_buttons());
    panel_tick();
    TEST_ASSERT_EQUAL(PANEL_UP, panel_buttons());
    panel_set(PANEL_LED_PLAY, true);
    TEST_ASSERT_EQUAL_HEX8(PANEL_LED_PLAY | PANEL_LED_POWER, panel_lit());
    fake_panel_set_there(false);
    panel_set(PANEL_LED_PLAY, true);
    TEST_ASSERT_EQUAL_HEX8(0, panel_lit());
    TEST_ASSERT_EQUAL(0, panel_buttons_now());
}

static void test_restart_goes_where_the_test_says(void)
{
    if (setjmp(somewhere) == 0) {
        fake_system_on_restart(&somewhere);
        system_restart();
    }
    system_watchdog_on();
    system_kick();
    TEST_ASSERT_TRUE(fake_system_watchdog());
    TEST_ASSERT_EQUAL(1, fake_system_kicks());
    TEST_ASSERT_EQUAL(SYSTEM_RESET_POWER_ON, system_reset_cause());
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_eeprom_is_erased_busy_after_a_write_and_wears);
    RUN_TEST(test_eeprom_power_cut_leaves_old_torn_or_new);
    RUN_TEST(test_console_ring_drops_what_does_not_fit);
    RUN_TEST(test_console_output_obeys_its_room);
    RUN_TEST(test_console_holds_only_under_flow_control);
    RUN_TEST(test_ticks_not_taken_are_missed_unless_forgiven);
    RUN_TEST(test_clock_and_tick_run_together);
    RUN_TEST(test_fake_servo_reads_and_writes_its_table);
    RUN_TEST(test_fake_servo_hears_only_its_own_rate);
    RUN_TEST(test_fake_servo_faults_and_retries);
    RUN_TEST(test_fake_servo_keeps_a_reg_write_until_action);
    RUN_TEST(test_fake_bus_takes_its_time_and_one_packet_only);
    RUN_TEST(test_panel_debounces_and_is_absent_on_a_cm2);
    RUN_TEST(test_restart_goes_where_the_test_says);
    return UNITY_END();
}
