/* SPDX-License-Identifier: MIT */
#include "robot.h"

#include <string.h>
#include "bus_call.h"
#include "dxl.h"
#include "parts.h"
#include "tick.h"

robot_t the_robot;

enum { DISTANCE_PER_SPEED = 4 };

static void fail(uint8_t joint)
{
    servo_link_put(&the_robot.failed, joint, true);
}

/* Reads a word of the servo as a page position. */
static bool read_pos(uint8_t joint, uint8_t at, uint16_t *pos)
{
    uint8_t bytes[2];
    if (bus_call_read(joint, at, bytes, sizeof bytes, NULL) != BUS_OK) {
        servo_link_lost(&the_servos, joint);
        fail(joint);
        return false;
    }
    *pos = servo_link_to_page(&the_servos, joint, page_word(bytes));
    return true;
}

bool robot_has(uint8_t joint)
{
    return servo_link_has(&the_servos.present, joint);
}

static bool is_held(uint8_t joint)
{
    return robot_has(joint) && servo_link_has(&the_servos.torque, joint);
}

static void read_joint(uint8_t joint)
{
    uint16_t pos;
    bool held = is_held(joint);
    if (read_pos(joint, held ? DXL_AT_GOAL : DXL_AT_PRESENT, &pos)) {
        session_set_pose(joint, held ? pos : pos | PAGE_POS_TORQUE_OFF);
    }
}

void robot_read(void)
{
    servo_link_quiet(&the_servos);
    for (uint8_t joint = 0; joint < PAGE_JOINTS; joint++) {
        if (robot_has(joint)) {
            read_joint(joint);
        }
    }
}

void robot_follow(void)
{
    uint32_t off = the_servos.present & ~the_servos.torque;   /* shifted: bit 0 is the current joint */
    for (uint8_t joint = 0; off != 0; joint++, off >>= 1) {
        uint16_t pos = the_servos.present_pos[joint];
        if ((off & 1u) != 0 && pos != SERVO_LINK_NO_POSE) {
            session_set_pose(joint, pos | PAGE_POS_TORQUE_OFF);
        }
    }
}

/* NOINLINE saves 30 bytes. */
static NOINLINE void show_goal(uint8_t joint)
{
    session_set_pose(joint, servo_link_limited(the_performer.goal_pos[joint]));
}

void robot_follow_play(bool is_shown)
{
    uint8_t joint = (uint8_t)(the_robot.shown + 1u) % PAGE_JOINTS;
    the_robot.shown = joint;
    the_robot.played |= the_performer.joints;
    if (is_shown && servo_link_has(&the_performer.joints, joint)) {
        show_goal(joint);
        the_session.marks[joint] |= MARK_LABEL;
    }
}

void robot_end_play(void)
{
    for (uint8_t joint = 0; joint < PAGE_JOINTS; joint++) {
        if (servo_link_has(&the_robot.played, joint)) {
            show_goal(joint);
        }
    }
    the_robot.played = 0;
    robot_read();
    robot_trim_play();
}

void robot_set_trim(void)
{
    int16_t trim_pos[PAGE_JOINTS];
    the_robot.raw = the_session.page == 0 && performer_page(&the_performer) == 0;
    bool trimmed = !the_robot.raw && page_store_trim(&the_pages, trim_pos);
    servo_link_set_trim(&the_servos, trimmed ? trim_pos : NULL);
    servo_link_read_pose(&the_servos, the_servos.present);
    robot_read();
}

void robot_trim_play(void)
{
    if (the_session.page == 0) {
        robot_set_trim();
    }
}

void robot_open_page(uint8_t page)
{
    session_open(page);
    if ((page == 0) != the_robot.raw) {
        robot_set_trim();
    }
}

void robot_serve(void)
{
    if (tick_take()) {
        performer_tick(&the_performer);
    }
    performer_poll(&the_performer);
}

void robot_init(void)
{
    the_robot.failed = 0;
    robot_set_trim();
}

static void write_goal(uint8_t joint, uint16_t present, uint16_t pos)
{
    uint16_t distance = pos > present ? pos - present : present - pos;
    uint16_t speed = distance / DISTANCE_PER_SPEED;
    uint16_t goal = servo_link_to_servo(&the_servos, joint, pos);
    if (speed < ROBOT_SLOWEST) {
        speed = ROBOT_SLOWEST;
    }
    uint8_t bytes[4] = { (uint8_t)goal, (uint8_t)(goal >> 8), (uint8_t)speed, (uint8_t)(speed >> 8) };
    if (!servo_link_write(&the_servos, joint, DXL_AT_GOAL, bytes, sizeof bytes)) {
        fail(joint);
        read_joint(joint);   /* its goal is still the old one */
    }
}

void robot_move(uint8_t joint, uint16_t pos)
{
    uint16_t present;
    session_set_pose(joint, pos);
    if (!robot_has(joint)) {
        return;
    }
    servo_link_quiet(&the_servos);
    if (!is_held(joint) && performer_on(&the_performer, servo_link_bit(joint)) == 0) {
        fail(joint);
        read_joint(joint);
        return;
    }
    if (read_pos(joint, DXL_AT_PRESENT, &present)) {
        write_goal(joint, present, pos);
    }
}

uint32_t robot_send(const uint8_t step[PAGE_STEP_BYTES])
{
    uint32_t missing = 0, off = 0;
    for (uint8_t joint = 0; joint < PAGE_JOINTS; joint++) {
        uint16_t word = page_word(&step[2 * joint]);
        if (!robot_has(joint)) {
            session_set_pose(joint, word);
        } else if (cell_is_position(word)) {
            robot_move(joint, word);
        } else if (cell_is_off(word)) {
            servo_link_put(&off, joint, true);
        } else {
            servo_link_put(&missing, joint, true);
        }
    }
    if (off != 0) {
        robot_switch(off, false);
    }
    return missing;
}

void robot_switch(uint32_t joints, bool on)
{
    joints &= the_servos.present;
    const uint32_t done = on ? performer_on(&the_performer, joints) : performer_off(&the_performer, joints);
    the_robot.failed |= joints & ~done;
    robot_read();
}
