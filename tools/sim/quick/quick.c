/* SPDX-License-Identifier: MIT */
#include "quick.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define STEPS_PER_TICK 8u /* of 1/1024 s */
#define SLOPES_AND_GOAL 4
#define DEFAULT_NIBBLE 5

struct quick {
    uint8_t image[QUICK_IMAGE_BYTES];
    uint8_t status[PAGE_COUNT];
    page_source_t source;
    player_t player;
    player_joint_t joint[PAGE_JOINTS];
    link_t link;
    shape_t shape;
    servo_bus_t *bus;
    uint64_t now_cycles;
    uint16_t goal_pos[PAGE_JOINTS];
    uint16_t sent_pos[PAGE_JOINTS];
    uint64_t load_steps;
    quick_load_t *sums; /* torque and its square are sums, not yet divided */
    int sums_count;
};

static void read_page(void *context, uint8_t page, uint16_t offset, void *to, uint8_t count)
{
    const quick_t *quick = context;
    memcpy(to, quick->image + page * PAGE_BYTES + offset, count);
}

static uint8_t check_page(void *context, uint8_t page)
{
    return ((const quick_t *)context)->status[page];
}

quick_t *quick_new(const uint8_t *image)
{
    quick_t *quick = calloc(1, sizeof *quick);
    servo_bus_t *bus = servo_bus_new();
    if (!quick || !bus) {
        free(quick);
        servo_bus_free(bus);
        return NULL;
    }
    quick->bus = bus;
    memcpy(quick->image, image, QUICK_IMAGE_BYTES);
    for (unsigned page = 0; page < PAGE_COUNT; page++) {
        quick->status[page] = (uint8_t)page_check(quick->image + page * PAGE_BYTES);
    }
    quick->source = (page_source_t){.context = quick, .read = read_page, .check = check_page};
    player_init(&quick->player, &quick->source, quick->joint);
    link_init(&quick->link, LINK_LATCH);
    return quick;
}

void quick_free(quick_t *quick)
{
    if (quick) {
        servo_bus_free(quick->bus);
        free(quick->sums);
        free(quick);
    }
}

servo_bus_t *quick_bus(quick_t *quick) { return quick->bus; }
uint64_t quick_now(const quick_t *quick) { return quick->now_cycles; }
int quick_page(const quick_t *quick) { return player_is_moving(&quick->player) ? quick->player.now.page : 0; }
int quick_step(const quick_t *quick) { return player_is_moving(&quick->player) ? quick->player.now.step : 0; }
int quick_fault(const quick_t *quick) { return quick->player.fault; }
int quick_goal(const quick_t *quick, uint8_t joint) { return joint < PAGE_JOINTS ? quick->goal_pos[joint] : -1; }

static uint8_t joint_of(const servo_t *servo)
{
    return servo->table[SERVO_ID];
}

/* ---- to the servos ---- */

static uint8_t slope(uint8_t nibble)
{
    return (uint8_t)(1u << (nibble >= 1 && nibble <= 7 ? nibble : DEFAULT_NIBBLE));
}

/* Sends slopes and goal, as the firmware's frames do. High nibble: clockwise, low nibble: counterclockwise. */
static void send_goals(quick_t *quick, uint32_t joints)
{
    const uint8_t *compliance = quick->image + quick->player.now.page * PAGE_BYTES + PAGE_AT_COMPLIANCE;
    for (int i = 0; i < quick->bus->count; i++) {
        servo_t *servo = quick->bus->servos[i];
        const uint8_t joint = joint_of(servo);
        if (joint < PAGE_JOINTS && joints >> joint & 1) {
            const uint16_t goal = quick->goal_pos[joint];
            const uint8_t data[SLOPES_AND_GOAL] = {slope(compliance[joint] >> 4), slope(compliance[joint] & 15),
                                                   (uint8_t)goal, (uint8_t)(goal >> 8)};
            servo_write(servo, SERVO_CW_SLOPE, data, SLOPES_AND_GOAL);
        }
    }
}

void quick_torque_on(quick_t *quick)
{
    const uint8_t on = 1;
    for (int i = 0; i < quick->bus->count; i++) {
        servo_t *servo = quick->bus->servos[i];
        servo_advance(servo, quick->now_cycles);
        const uint16_t present = servo_get(servo, SERVO_PRESENT, 2);
        const uint8_t data[2] = {(uint8_t)present, (uint8_t)(present >> 8)};
        servo_write(servo, SERVO_GOAL, data, 2);
        servo_write(servo, SERVO_TORQUE_ENABLE, &on, 1);
        if (joint_of(servo) < PAGE_JOINTS) {
            quick->goal_pos[joint_of(servo)] = quick->sent_pos[joint_of(servo)] = present;
        }
    }
}

/* ---- playing ---- */

int quick_start(quick_t *quick, uint8_t page, int law)
{
    uint32_t present = 0;
    for (int i = 0; i < quick->bus->count; i++) {
        const uint8_t joint = joint_of(quick->bus->servos[i]);
        present |= joint < PAGE_JOINTS ? (uint32_t)1 << joint : 0;
    }
    quick_load_t *sums = realloc(quick->sums, (size_t)(quick->bus->count + 1) * sizeof *sums);
    if (!sums) {
        return PLAYER_ERR_BUSY;
    }
    quick->sums = sums;
    quick->sums_count = quick->bus->count;
    quick->load_steps = 0;
    memset(sums, 0, (size_t)(quick->bus->count + 1) * sizeof *sums);
    link_call(&quick->link, 0);
    return (int)player_start(&quick->player, &quick->link, page, (player_law_t)law, quick->goal_pos, present);
}

void quick_shape(quick_t *quick, const shape_t *shape)
{
    quick->shape = *shape;
    quick->player.shape = &quick->shape;
}

void quick_keys(quick_t *quick, uint8_t code)
{
    link_code(&quick->link, code);
}

static void count_loads(quick_t *quick)
{
    quick->load_steps++;
    for (int i = 0; i < quick->sums_count; i++) {
        const servo_t *servo = quick->bus->servos[i];
        quick->sums[i].torque_nm += fabs(servo->motor_nm);
        quick->sums[i].torque2_nm2 += servo->motor_nm * servo->motor_nm;
        quick->sums[i].most_degrees_c = fmax(quick->sums[i].most_degrees_c, servo->temperature_c);
    }
}

static void count_goals(quick_t *quick)
{
    for (int i = 0; i < quick->sums_count; i++) {
        const uint8_t joint = joint_of(quick->bus->servos[i]);
        if (joint < PAGE_JOINTS) {
            const double way = abs(quick->goal_pos[joint] - quick->sent_pos[joint]);
            quick->sums[i].most_units_per_tick = fmax(quick->sums[i].most_units_per_tick, way);
            quick->sent_pos[joint] = quick->goal_pos[joint];
        }
    }
}

/* One step of the body. Without a body, it updates the servos to the same moment. */
static void pass_step(quick_t *quick)
{
    quick->now_cycles += SERVO_STEP_CYCLES;
    servo_bus_advance(quick->bus, quick->now_cycles);
    for (int i = 0; i < quick->bus->count; i++) {
        servo_advance(quick->bus->servos[i], quick->now_cycles);
    }
    count_loads(quick);
}

bool quick_run(quick_t *quick, uint32_t ticks)
{
    for (; ticks > 0; ticks--) {
        const uint8_t events = player_is_moving(&quick->player) ? player_tick(&quick->player, &quick->link) : 0;
        pass_step(quick);
        if (events & PLAYER_EV_OUTPUT) {
            player_goals(&quick->player, UINT32_MAX, quick->goal_pos);
            send_goals(quick, quick->player.joints);
            count_goals(quick);
        }
        for (unsigned step = 1; step < STEPS_PER_TICK; step++) {
            pass_step(quick);
        }
    }
    return player_is_moving(&quick->player);
}

quick_load_t quick_load(const quick_t *quick, int index)
{
    quick_load_t load = {0};
    if (index >= 0 && index < quick->sums_count && quick->load_steps > 0) {
        load = quick->sums[index];
        load.torque_nm /= (double)quick->load_steps;
        load.torque2_nm2 /= (double)quick->load_steps;
    }
    return load;
}
