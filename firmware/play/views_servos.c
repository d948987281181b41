/* SPDX-License-Identifier: MIT
 * views_servos.c - the servos, their faults, and the error counts of bus, serial line and ticks. */
#include "views.h"

#include "bus.h"
#include "console.h"
#include "report.h"
#include "text.h"
#include "tick.h"

static uint8_t count(uint32_t joints)
{
    uint8_t found = 0;
    for (; joints != 0; joints &= joints - 1u) {
        found++;
    }
    return found;
}

void views_print_servos_found(void)
{
    const uint8_t found = count(the_play.servos.present);
    text_number(found);
    text_P(found == 1 ? TEXT_P(" servo: ") : TEXT_P(" servos: "));
    report_joints(the_play.servos.present);
    text_line_end();
    if (the_play.servos.endless != 0) {
        TEXT("Not used, turns without end (both angle limits are 0): ");
        report_joints(the_play.servos.endless);
        text_line_end();
    }
    if (the_play.servos.slow != 0) {
        TEXT("Not used, at 57142 bps (fast of the monitor image): ");
        report_joints(the_play.servos.slow);
        text_line_end();
    }
}

static bool is_in_trouble(const servo_link_t *servos, uint8_t id)
{
    return servo_link_has(&servos->silent, id) || servos->errors[id] != 0 || servo_link_has(&the_play.performer.faulty, id);
}

static void print_trouble(const servo_link_t *servos, uint8_t id)
{
    if (servo_link_has(&servos->silent, id)) {
        TEXT(" does not answer");
    } else if (servos->errors[id] == 0) {
        text_P(servo_link_has(&servos->torque, id) ? TEXT_P(" does not obey") : TEXT_P(" has no torque"));
    } else {
        TEXT(" reports ");
        report_servo_errors(servos->errors[id]);
    }
}

void views_print_servos(void)
{
    const servo_link_t *servos = &the_play.servos;
    for (uint8_t id = 0; id < SERVO_LINK_JOINTS; id++) {
        if (!servo_link_has(&servos->present, id)) {
            continue;
        }
        text_padded(id, 3, ' ');
        TEXT("  position ");
        if (servos->present_pos[id] == SERVO_LINK_NO_POSE) {
            TEXT("   ?");
        } else {
            text_padded(servos->present_pos[id], 4, ' ');
        }
        text_P(servo_link_has(&servos->torque, id) ? TEXT_P("  torque on ") : TEXT_P("  torque off"));
        if (servo_link_has(&the_play.performer.released, id)) {
            TEXT("  switched off");
        }
        if (is_in_trouble(servos, id)) {
            print_trouble(servos, id);
        }
        text_line_end();
    }
    views_print_servos_found();
}

/* ---- faults ---- */

static void print_servo_faults(const servo_link_t *servos)
{
    bool any = false;
    for (uint8_t id = 0; id < SERVO_LINK_JOINTS; id++) {
        if (servo_link_has(&servos->present, id) && is_in_trouble(servos, id)) {
            any = true;
            text_P_number(TEXT_P("Servo "), id);
            print_trouble(servos, id);
            text_line_end();
        }
    }
    if (!any) {
        TEXT("No servo has a fault");
        text_line_end();
    }
}

uint8_t views_faults(const shell_args_t *args)
{
    print_servo_faults(&the_play.servos);
    bus_counts_t bus;
    bus_counts(&bus);
    TEXT("Bus: packets ");
    text_number32(bus.packets);
    TEXT(" answers ");
    text_number32(bus.answers);
    text_P_number(TEXT_P(" retries "), bus.retries);
    text_P_number(TEXT_P(" time-outs "), bus.timeouts);
    text_P_number(TEXT_P(" checksum "), bus.checksums);
    text_P_number(TEXT_P(" framing "), bus.framing);
    text_P_number(TEXT_P(" wrong ID "), bus.wrong_ids);
    text_P_number(TEXT_P(" rejected "), bus.rejected);
    text_line_end();
    console_counts_t console;
    console_counts(&console);
    TEXT("Serial:");
    text_P_number(TEXT_P(" overruns "), console.overruns);
    text_P_number(TEXT_P(" framing "), console.framing);
    text_P_number(TEXT_P(" lost "), console.ring_full + the_play.inputs.lost);
    text_P_number(TEXT_P(" remote packets "), the_play.inputs.remote.packets);
    text_P_number(TEXT_P(" remote noise "), the_play.inputs.remote.dropped);
    text_line_end();
    TEXT("Ticks:");
    text_P_number(TEXT_P(" missed "), tick_missed());
    text_P_number(TEXT_P(" goals late "), the_play.servos.late);
    text_line_end();
    return SHELL_OK;
}
