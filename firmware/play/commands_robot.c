/* SPDX-License-Identifier: MIT
 * commands_robot.c - words about servos. */
#include "commands_parts.h"

#include "report.h"
#include "text.h"
#include "views.h"

uint8_t commands_do_on(void *context, const shell_args_t *args)
{
    play_t *play = context;
    uint32_t joints;
    if (!commands_joints(play, args, 1, &joints)) {
        return SHELL_ERR_SAID;
    }
    if (!performer_is_idle(&play->performer)) {
        return commands_refuse(PERFORMER_ERR_BUSY, 0, 0);
    }
    const uint32_t failed = joints & ~requests_switch_torque(joints, true);
    if (failed != 0) {
        TEXT("No answer from servos ");
        report_joints(failed);
        return SHELL_ERR_SAID;
    }
    return SHELL_OK;
}

uint8_t commands_do_off(void *context, const shell_args_t *args)
{
    play_t *play = context;
    uint32_t joints;
    if (!commands_joints(play, args, 1, &joints)) {
        return SHELL_ERR_SAID;
    }
    (void)requests_switch_torque(joints, false);
    return SHELL_OK;
}

uint8_t commands_do_servos(void *context, const shell_args_t *args)
{
    play_t *play = context;
    if (args->count > 1 && !shell_word_is(args, 1, PSTR("find"))) {
        TEXT("Say servos, or servos find to search again");
        return SHELL_ERR_SAID;
    }
    if (args->count > 1) {
        if (!performer_is_still(&play->performer)) {
            return commands_refuse(PERFORMER_ERR_BUSY, 0, 0);
        }
        play_find_servos(play);
        views_print_servos_found(play);
        return SHELL_OK;
    }
    views_print_servos(play);
    return SHELL_OK;
}

uint8_t commands_do_baud(void *context, const shell_args_t *args)
{
    play_t *play = context;
    uint32_t joints;
    if (!commands_ids(play, args, 1, &joints)) {
        return SHELL_ERR_SAID;
    }
    if (args->count == 1) {
        joints = play->servos.slow;
    }
    if ((joints & play->servos.slow) != joints || joints == 0) {
        TEXT("Servos at 57142 bps: ");
        report_joints(play->servos.slow);
        return SHELL_ERR_SAID;
    }
    const uint32_t moved = servo_link_fast_baud(&play->servos, joints);
    TEXT("Moved to 1 Mbps: ");
    report_joints(moved);
    text_line_end();
    views_print_servos_found(play);
    return SHELL_OK;
}
