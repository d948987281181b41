/* SPDX-License-Identifier: MIT
 * hal_walker.c - a robot that swings all its joints forever and discards console input, for test_hal*.py. The test
 * reads the counters in its variables. */
#include "board.h"
#include "bus.h"
#include "console.h"
#include "crc16.h"
#include "panel.h"
#include "servo_link.h"
#include "tick.h"

#include <string.h>

/* Read by the test. */
volatile uint32_t walker_bytes;                 /* console bytes received */
volatile uint16_t walker_crc;                   /* CRC of these bytes */
volatile uint16_t walker_missed, walker_late;
volatile uint16_t walker_ticks;
volatile uint8_t walker_faults;
volatile uint8_t walker_buttons;
bus_counts_t walker_bus;

static servo_link_t servos;
static uint16_t goals[SERVO_LINK_JOINTS];

static void wave(uint16_t tick)
{
    for (uint8_t id = 0; id < SERVO_LINK_JOINTS; id++) {
        uint16_t phase = (uint16_t)((tick * 2u + id * 16u) % 512u);
        goals[id] = (uint16_t)(256u + (phase < 256u ? phase : 511u - phase));
    }
}

static void take_console(void)
{
    uint8_t byte;
    while (console_get(&byte)) {
        walker_crc = crc16_byte(walker_crc, byte);
        walker_bytes++;
        if (walker_bytes % 2u == 0) {
            (void)console_put(byte);
        }
    }
}

static void do_tick(void)
{
    servo_fault_t fault;
    wave(walker_ticks++);
    servo_link_tick(&servos);
    servo_link_goals(&servos, goals, SERVO_LINK_ALL);
    panel_tick();
    walker_buttons = panel_buttons();
    walker_missed = tick_missed();
    walker_late = servos.late;
    while (servo_link_next_fault(&servos, &fault)) {
        walker_faults++;
    }
    bus_counts(&walker_bus);
}

int main(void)
{
    uint8_t compliance[SERVO_LINK_JOINTS];
    board_start();
    servo_link_init(&servos);
    servo_link_scan(&servos);
    (void)servo_link_torque_on(&servos, SERVO_LINK_ALL);
    memset(compliance, 0x55, sizeof compliance);
    servo_link_slopes(&servos, compliance);
    walker_crc = CRC16_START;
    console_write("walking\n", 8);
    tick_forgive();
    for (;;) {
        if (tick_take()) {
            do_tick();
        }
        servo_link_poll(&servos);
        take_console();
        board_idle();
    }
}
