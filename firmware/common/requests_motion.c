/* SPDX-License-Identifier: MIT
 * requests_motion.c - requests that move something. */
#include "requests_parts.h"

#include "ranges.h"
#include "text.h"

/* Reads three digits a joint, from joint `id` on, into to_pos; --- skips a joint. Returns the joints read; 0: bad digits. */
static uint32_t parse_pose(uint8_t id, const char *digits, uint16_t to_pos[PAGE_JOINTS])
{
    uint32_t joints = 0;
    for (; *digits != '\0'; digits += 3, id++) {
        uint16_t pos;
        if (digits[0] == '-' && digits[1] == '-' && digits[2] == '-') {
            continue;
        }
        if (id >= PAGE_JOINTS || !shell_hex(digits, 3, &pos) || pos > PAGE_POS_MAX) {
            return 0;
        }
        to_pos[id] = pos;
        servo_link_put(&joints, id, true);
    }
    return joints;
}

uint8_t request_move(void *context, const shell_args_t *args)
{
    uint16_t to_pos[PAGE_JOINTS] = {0};
    (void)context;
    const uint32_t joints = parse_pose((uint8_t)args->number[1], shell_word(args, 3), to_pos);
    if (joints == 0) {
        return requests_refuse(REQUEST_ERR_RANGE, TEXT_P("Positions must be 000..3FF or ---, up to ID 30"));
    }
    return requests_refusal(performer_move(requests_image.performer, to_pos, joints, args->number[0]));
}

uint32_t requests_switch_torque(uint32_t joints, bool on)
{
    uint32_t done = 0;
    for (uint8_t id = 0; id < SERVO_LINK_JOINTS; id++) {
        if (servo_link_has(&joints, id)) {
            const uint32_t joint = servo_link_bit(id);
            if (on) {
                done |= performer_on(requests_image.performer, joint);
            } else {
                performer_off(requests_image.performer, joint);
                done |= joint;
            }
            requests_image.serve();
        }
    }
    return done;
}

static uint8_t switch_named(const shell_args_t *args, uint8_t first, bool on)
{
    uint32_t joints;
    const uint8_t status = requests_take_joints(args, first, &joints);
    if (status != REQUEST_OK) {
        return status;
    }
    if (on && !performer_is_idle(requests_image.performer)) {   /* off may always be sent, so the table cannot refuse both */
        return SHELL_ERR_MOVING;
    }
    return requests_no_answer(joints & ~requests_switch_torque(joints, on));
}

uint8_t request_torque(void *context, const shell_args_t *args)
{
    const bool on = shell_word_is(args, 1, PSTR("on"));
    (void)context;
    if (!on && !shell_word_is(args, 1, PSTR("off"))) {
        return requests_refuse(REQUEST_ERR_RANGE, TEXT_P("Say on or off"));
    }
    return switch_named(args, 2, on);
}

uint8_t request_on(void *context, const shell_args_t *args)
{
    (void)context;
    return switch_named(args, 1, true);
}

uint8_t request_off(void *context, const shell_args_t *args)
{
    (void)context;
    return switch_named(args, 1, false);
}

uint8_t request_play(void *context, const shell_args_t *args)
{
    (void)context;
    return requests_refusal(performer_start(requests_image.performer, (uint8_t)args->number[0], (uint8_t)args->number[1]));
}

/* These four answer OK even if there is nothing to do: a program asks @where. */
uint8_t request_stop(void *context, const shell_args_t *args)
{
    (void)context;
    (void)args;
    performer_stop(requests_image.performer);
    return REQUEST_OK;
}

uint8_t request_break(void *context, const shell_args_t *args)
{
    (void)context;
    (void)args;
    performer_break(requests_image.performer);
    return REQUEST_OK;
}

uint8_t request_pause(void *context, const shell_args_t *args)
{
    (void)context;
    (void)args;
    (void)performer_pause(requests_image.performer);
    return REQUEST_OK;
}

uint8_t request_resume(void *context, const shell_args_t *args)
{
    (void)context;
    (void)args;
    (void)performer_resume(requests_image.performer);
    return REQUEST_OK;
}
