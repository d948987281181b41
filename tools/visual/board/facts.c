/* SPDX-License-Identifier: MIT
 * facts.c - writes the C constants that the page's TypeScript needs to a TypeScript module: facts FILE. It runs on the
 * build machine. These constants are not repeated anywhere in TypeScript. */
#include <stdio.h>

#include "board.h"
#include "board_api.h"
#include "link.h"
#include "m128.h"
#include "memory_map.h"
#include "motion_api.h"
#include "page.h"
#include "player.h"
#include "remote.h"
#include "servo.h"
#include "servo_body.h"
#include "shape.h"
#include "start.h"
#include "trial_api.h"

#define FACT(name) { #name, (long)(name) }

static const struct { const char *name; long number; } facts[] = {
    /* page.h */
    FACT(PAGE_BYTES), FACT(PAGE_COUNT), FACT(PAGE_JOINTS), FACT(PAGE_STEPS), FACT(PAGE_STEP_BYTES),
    FACT(PAGE_NAME_BYTES), FACT(PAGE_AT_NAME), FACT(PAGE_AT_PLAY_COUNT), FACT(PAGE_AT_SCHEDULE),
    FACT(PAGE_AT_BLEND_RIGHT), FACT(PAGE_AT_BLEND_LEFT), FACT(PAGE_AT_STEPS), FACT(PAGE_AT_PLAY_CODE),
    FACT(PAGE_AT_SPEED), FACT(PAGE_AT_ACCEL_TIME), FACT(PAGE_AT_NEXT_PAGE), FACT(PAGE_AT_EXIT_PAGE),
    FACT(PAGE_AT_LINKED1_PAGE), FACT(PAGE_AT_LINKED1_CODE), FACT(PAGE_AT_LINKED2_PAGE), FACT(PAGE_AT_LINKED2_CODE),
    FACT(PAGE_AT_COMPLIANCE), FACT(PAGE_AT_STEP0), FACT(PAGE_STEP_AT_PAUSE), FACT(PAGE_STEP_AT_SPEED),
    FACT(PAGE_SCHEDULE_SPEED), FACT(PAGE_SCHEDULE_TIME), FACT(PAGE_POS_MAX), FACT(PAGE_POS_MIDDLE),
    FACT(PAGE_POS_UNUSED), FACT(PAGE_POS_TORQUE_OFF), FACT(PAGE_ERR_CHECKSUM), FACT(PAGE_ERR_STEPS),
    FACT(PAGE_ERR_SCHEDULE), FACT(PAGE_ERR_SPEED), FACT(PAGE_ERR_LINK), FACT(PAGE_ERR_POSITION),
    /* player.h, link.h, shape.h */
    FACT(PLAYER_TICKS_PER_SECOND), FACT(PLAYER_LAW_EXACT), FACT(PLAYER_LAW_CLASSIC), FACT(PLAYER_EV_PAGE),
    FACT(PLAYER_EV_LINK), FACT(LINK_CODE_STOP), FACT(SHAPE_RATE_MIN), FACT(SHAPE_RATE_MAX), FACT(SHAPE_AMPLITUDE_MAX),
    FACT(SHAPE_BLEND_MAX), FACT(SHAPE_NORMAL),
    /* firmware */
    FACT(MEM_APP_END), FACT(MEM_MOTION_START), FACT(MEM_BOOT_END), FACT(MEM_EEPROM_BYTES), FACT(MEM_EE_BOOT_MODE),
    FACT(START_MODE_APPLICATION),
    /* hal/remote.h */
    FACT(REMOTE_UP), FACT(REMOTE_DOWN), FACT(REMOTE_LEFT), FACT(REMOTE_RIGHT), FACT(REMOTE_BUTTON1),
    FACT(REMOTE_BUTTON2), FACT(REMOTE_BUTTON3), FACT(REMOTE_BUTTON4), FACT(REMOTE_BUTTON5), FACT(REMOTE_BUTTON6),
    /* the modules' own interfaces */
    FACT(MOTION_API_LEAD_NEXT), FACT(MOTION_API_LEAD_EXIT), FACT(MOTION_API_LEAD_LINKED1),
    FACT(MOTION_API_LEAD_LINKED2), FACT(MOTION_API_LEAD_BLEND_RIGHT), FACT(MOTION_API_LEAD_BLEND_LEFT),
    FACT(MOTION_API_LEADS), FACT(MOTION_API_LEAD_BYTES), FACT(MOTION_API_CURVE_TICKS), FACT(MOTION_API_MARK_BYTES),
    FACT(BOARD_API_BUFFER_BYTES), FACT(BOARD_API_SERVO_ID), FACT(BOARD_API_SERVO_GOAL), FACT(BOARD_API_SERVO_POSITION),
    FACT(BOARD_API_SERVO_VELOCITY), FACT(BOARD_API_SERVO_OUTPUT), FACT(BOARD_API_SERVO_TORQUE),
    FACT(BOARD_API_SERVO_ALARMS), FACT(BOARD_API_SERVO_CELSIUS), FACT(BOARD_API_SERVO_FAULTS),
    FACT(BOARD_API_SERVO_LED), FACT(BOARD_API_SERVO_FIELDS), FACT(SERVO_EEPROM_BYTES), FACT(M128_HZ), FACT(BOARD_CM5),
    FACT(SERVO_AX12), FACT(TRIAL_API_IMAGE_BYTES), { "SERVO_SHAFT_FIELDS", sizeof(servo_shaft_t) / sizeof(double) },
};

int main(int count, char **words)
{
    FILE *file = count == 2 ? fopen(words[1], "w") : NULL;
    if (file == NULL) {
        fprintf(stderr, "usage: facts FILE\n");
        return 2;
    }
    fprintf(file, "// Made by tools/visual/board/facts.c from the headers of C. Not to be edited.\n");
    for (size_t i = 0; i < sizeof facts / sizeof facts[0]; i++) {
        fprintf(file, "export const %s = %ld;\n", facts[i].name, facts[i].number);
    }
    return fclose(file) == 0 ? 0 : 1;
}
