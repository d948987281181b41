/* SPDX-License-Identifier: MIT
 * machine_motion.c - requests that move something. */
#include "machine_parts.h"

#include "bound.h"
#include "text.h"

#define SPEED_MAX_DEG_S 360u

static bool id_number(const shell_args_t *args, uint8_t index, uint16_t *id)
{
    return machine_number(args, index, TEXT_P("ID"), 0, SERVO_LINK_JOINTS - 1, id);
}

/* Fills to_pos and returns the joints that the digits name, three for each; 0: they are not as they must be. */
static uint32_t parse_pose(uint8_t id, const char *digits, uint16_t to_pos[PAGE_JOINTS])
{
    uint32_t joints = 0;
    for (; *digits != '\0'; digits += 3, id++) {
        if (id >= PAGE_JOINTS || digits[1] == '\0') {
            return 0;
        }
        if (digits[0] == '-' && digits[1] == '-' && digits[2] == '-') {
            continue;
        }
        uint16_t pos = 0;
        for (uint8_t i = 0; i < 3; i++) {
            const uint8_t digit = shell_digit(digits[i]);
            if (digit > 15) {
                return 0;
            }
            pos = (uint16_t)(pos << 4 | digit);
        }
        if (pos > PAGE_POS_MAX) {
            return 0;
        }
        to_pos[id] = pos;
        servo_link_put(&joints, id, true);
    }
    return joints;
}

uint8_t machine_do_move(void *context, const shell_args_t *args)
{
    machine_t *machine = context;
    uint16_t to_pos[PAGE_JOINTS] = {0};
    uint16_t deg_s, id;
    if (!machine_number(args, 1, TEXT_P("Degrees/s"), 1, SPEED_MAX_DEG_S, &deg_s) || !id_number(args, 2, &id)) {
        return MACHINE_ERR_RANGE;
    }
    const uint32_t joints = parse_pose((uint8_t)id, shell_word(args, 3), to_pos);
    if (joints == 0) {
        return machine_says(MACHINE_ERR_RANGE, TEXT_P("Positions must be 000..3FF or ---, up to ID 30"));
    }
    return machine_refusal(performer_move(MACHINE_PERFORMER(machine), to_pos, joints, deg_s), 0, 0);
}

/* One joint at a time, so that nothing else waits for longer than 3 ms. Returns those that are as they should be. */
static uint32_t switch_each(machine_t *machine, uint32_t joints, bool on)
{
    uint32_t done = 0;
    for (uint8_t id = 0; id < SERVO_LINK_JOINTS; id++) {
        const uint32_t joint = joints & servo_link_bit(id);
        if (joint != 0) {
            if (on) {
                done |= performer_on(MACHINE_PERFORMER(machine), joint);
            } else {
                performer_off(MACHINE_PERFORMER(machine), joint);
                done |= joint;
            }
            machine_serve(machine);
        }
    }
    return done;
}

uint8_t machine_do_torque(void *context, const shell_args_t *args)
{
    machine_t *machine = context;
    const bool on = shell_word_is(args, 1, PSTR("on"));
    uint32_t joints = args->count == 2 ? MACHINE_SERVOS(machine)->present : 0;
    if (!on && !shell_word_is(args, 1, PSTR("off"))) {
        return machine_says(MACHINE_ERR_RANGE, TEXT_P("Say on or off"));
    }
    for (uint8_t i = 2; i < args->count; i++) {
        uint16_t id;
        if (!id_number(args, i, &id)) {
            return MACHINE_ERR_RANGE;
        }
        servo_link_put(&joints, (uint8_t)id, true);
    }
    if (on && !performer_is_idle(MACHINE_PERFORMER(machine))) {
        return machine_refusal(PERFORMER_ERR_BUSY, 0, 0);
    }
    if ((joints & MACHINE_SERVOS(machine)->present) != joints || joints == 0 ||
        switch_each(machine, joints, on) != joints) {
        return machine_says(MACHINE_ERR_SERVOS, TEXT_P("Not all of these servos answer"));
    }
    return MACHINE_OK;
}

uint8_t machine_do_play(void *context, const shell_args_t *args)
{
    machine_t *machine = context;
    uint16_t page, code = LINK_CODE_NONE;
    if (!machine_page_number(args, 1, 1, &page) ||
        (args->count == 3 && !machine_number(args, 2, TEXT_P("Code"), 0, LINK_CODE_STOP - 1, &code))) {
        return MACHINE_ERR_RANGE;
    }
    const performer_status_t status = performer_start(MACHINE_PERFORMER(machine), (uint8_t)page, (uint8_t)code);
    return machine_refusal(status, MACHINE_PERFORMER(machine)->fault_page, MACHINE_PERFORMER(machine)->fault);
}

/* These four say OK also when there is nothing to do: a program asks @where. */
uint8_t machine_do_stop(void *context, const shell_args_t *args)
{
    machine_t *machine = context;
    (void)args;
    performer_stop(MACHINE_PERFORMER(machine));
    return MACHINE_OK;
}

uint8_t machine_do_break(void *context, const shell_args_t *args)
{
    machine_t *machine = context;
    (void)args;
    performer_break(MACHINE_PERFORMER(machine));
    return MACHINE_OK;
}

uint8_t machine_do_pause(void *context, const shell_args_t *args)
{
    machine_t *machine = context;
    (void)args;
    (void)performer_pause(MACHINE_PERFORMER(machine));
    return MACHINE_OK;
}

uint8_t machine_do_resume(void *context, const shell_args_t *args)
{
    machine_t *machine = context;
    (void)args;
    (void)performer_resume(MACHINE_PERFORMER(machine));
    return MACHINE_OK;
}

