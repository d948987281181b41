/* SPDX-License-Identifier: MIT */
#include "servo_link_stage.h"

#include "dxl_packet.h"
#include "fake_system.h"
#include "fake_time.h"
#include "unity.h"

servo_link_t servos;
uint16_t goals[SERVO_LINK_JOINTS];

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

void robot(uint8_t count)
{
    for (uint8_t id = 1; id <= count; id++) {
        (void)fake_bus_add(id, BUS_RATE_1M);
    }
    servo_link_scan(&servos);
    (void)servo_link_torque_on(&servos, SERVO_LINK_ALL);
    fake_bus_clear_log();
}

void rest_of_tick(void)
{
    for (uint8_t i = 0; i < 100; i++) {
        servo_link_poll(&servos);
    }
}

void tick_with_goals(uint32_t joints)
{
    servo_link_tick(&servos);
    servo_link_goals(&servos, goals, joints);
    rest_of_tick();
}

void idle_ticks(uint8_t count)
{
    for (; count > 0; count--) {
        servo_link_tick(&servos);
        rest_of_tick();
    }
}

uint16_t logged(uint8_t instruction, const uint8_t **last)
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
