/* SPDX-License-Identifier: MIT */
#include "views.h"

#include "board.h"
#include "bus.h"
#include "console.h"
#include "performer_shape.h"
#include "report.h"
#include "system.h"
#include "text.h"
#include "tick.h"

/* ---- pages ---- */

static void print_page_link(const char *what_P, uint8_t page)
{
    if (page != 0) {
        text_P(what_P);
        text_number(page);
    }
}

static void print_page_line(uint8_t page, const uint8_t *header)
{
    char name[PAGE_NAME_BYTES];
    page_store_name(page, name);
    text_padded(page, 3, ' ');
    text_put(' ');
    text_string_padded(name, PAGE_NAME_BYTES);
    TEXT("steps ");
    text_number(header[PAGE_AT_STEPS]);
    TEXT(" x ");
    text_number(header[PAGE_AT_PLAY_COUNT]);
    print_page_link(TEXT_P(" code "), header[PAGE_AT_PLAY_CODE]);
    print_page_link(TEXT_P(" next "), header[PAGE_AT_NEXT_PAGE]);
    print_page_link(TEXT_P(" exit "), header[PAGE_AT_EXIT_PAGE]);
    for (uint8_t at = PAGE_AT_LINKED1_PAGE; at <= PAGE_AT_LINKED2_PAGE; at = (uint8_t)(at + 2)) {
        if (header[at + 1] != 0) {
            TEXT(" on code ");
            text_number(header[at + 1]);
            print_page_link(TEXT_P(" to "), header[at]);
        }
    }
    text_line_end();
}

void views_print_list(play_t *play)
{
    uint8_t used = 0, damaged = 0;
    for (uint8_t page = 1; page < PAGE_COUNT; page++) {
        play_service(play); /* pages without a line take up to 2 ms each */
        if (page_store_is_good(&play->pages, page)) {
            uint8_t header[PAGE_AT_COMPLIANCE];
            page_store_read(page, 0, header, sizeof header);
            if (header[PAGE_AT_NAME] == '\0' && header[PAGE_AT_STEPS] == 0) {
                continue;
            }
            used++;
            print_page_line(page, header);
        } else if (!page_store_is_erased(page)) {
            damaged++;
            text_padded(page, 3, ' ');
            TEXT(" damaged: ");
            text_P(report_page_fault_P((uint8_t)page_store_check(&play->pages, page)));
            text_line_end();
        }
    }
    text_number(used);
    TEXT(" pages, ");
    text_number(damaged);
    TEXT(" damaged");
    text_line_end();
}

/* ---- state ---- */

static void print_state(const performer_t *performer)
{
    if (performer_is_paused(performer)) {
        TEXT("Paused in ");
        report_page(performer->page);
    } else {
        switch (performer->state) {
        case PERFORMER_IDLE:
            TEXT("Nothing is playing");
            break;
        case PERFORMER_PLAY:
            TEXT("Playing ");
            report_page(performer->page);
            break;
        default:
            TEXT("On the way to ");
            report_page(performer->page);
            break;
        }
    }
    if (performer->state == PERFORMER_PLAY) {
        TEXT(" step ");
        text_number(performer->engine.player.step);
        TEXT(" repetition ");
        text_number(performer->engine.player.repetition);
        TEXT(" code ");
        text_number(performer->link.code);
    }
    text_line_end();
}

void views_print_status(const play_t *play)
{
    print_state(&play->performer);
    if (!shape_is_neutral(&play->performer.shape) || performer_layers_joints(&play->performer) != 0) {
        views_print_shape(&play->performer);
        text_line_end();
    }
    TEXT("Law ");
    text_P(play->settings.law == PLAYER_LAW_CLASSIC ? TEXT_P("classic") : TEXT_P("exact"));
    TEXT(", remote ");
    text_P(play->settings.remote_mode == SETTINGS_REMOTE_HOLD    ? TEXT_P("hold")
           : play->settings.remote_mode == SETTINGS_REMOTE_DRIVE ? TEXT_P("drive")
                                                                 : TEXT_P("latch"));
    TEXT(", approach ");
    if (play->settings.approach_deg_s == 0) {
        TEXT("off");
    } else {
        text_number(play->settings.approach_deg_s);
        TEXT(" degrees/s");
    }
    text_line_end();
    TEXT("Torque on: ");
    report_joints(play->servos.torque & play->servos.present);
    if (play->servos.voltage_dv != 0) {
        TEXT(", ");
        report_voltage(play->servos.voltage_dv);
        TEXT(", hottest servo ");
        text_number(play->servos.hottest_id);
        TEXT(" at ");
        text_number(play->servos.hottest_degrees);
        TEXT(" C");
    }
    text_line_end();
}

/* ---- shape ---- */

static bool has_one_amplitude(const shape_t *shape)
{
    for (uint8_t id = 1; id < PAGE_JOINTS; id++) {
        if (shape->amplitude_percent[id] != shape->amplitude_percent[0]) {
            return false;
        }
    }
    return true;
}

static void print_field(const char *name_P, uint16_t value)
{
    text_P(name_P);
    text_number(value);
}

void views_print_shape(const performer_t *performer)
{
    const shape_t *shape = &performer->shape;
    print_field(TEXT_P(" rate="), shape->rate_percent);
    TEXT(" blend=");
    text_signed(shape->blend_percent);
    TEXT(" amplitude=");
    if (has_one_amplitude(shape)) {
        text_number(shape->amplitude_percent[0]);
    } else {
        for (uint8_t id = 0; id < PAGE_JOINTS; id++) {
            text_hex(shape->amplitude_percent[id], 2);
        }
    }
    print_field(TEXT_P(" layer="), performer_layer_page(performer));
    TEXT(" aim=");
    text_mask(performer->layers->code_joints);
}

/* ---- servos ---- */

void views_print_servos_found(const play_t *play)
{
    uint8_t count = 0;
    for (uint32_t joints = play->servos.present; joints != 0; joints &= joints - 1) {
        count++;
    }
    text_number(count);
    TEXT(" servos: ");
    report_joints(play->servos.present);
    text_line_end();
    if (play->servos.slow != 0) {
        TEXT("Not used, at 57142 bps (fast of the monitor image): ");
        report_joints(play->servos.slow);
        text_line_end();
    }
}

static bool is_in_trouble(const servo_link_t *servos, uint8_t id)
{
    return servo_link_has(&servos->silent, id) || servos->errors[id] != 0;
}

static void print_trouble(const servo_link_t *servos, uint8_t id)
{
    if (servo_link_has(&servos->silent, id)) {
        TEXT(" does not answer");
    } else {
        TEXT(" reports ");
        report_servo_errors(servos->errors[id]);
    }
}

void views_print_servos(const play_t *play)
{
    const servo_link_t *servos = &play->servos;
    for (uint8_t id = 0; id < SERVO_LINK_JOINTS; id++) {
        const uint32_t joint = servo_link_bit(id);
        if ((servos->present & joint) == 0) {
            continue;
        }
        text_padded(id, 3, ' ');
        TEXT("  position ");
        if (servos->present_pos[id] == SERVO_LINK_NO_POSE) {
            TEXT("   ?");
        } else {
            text_padded(servos->present_pos[id], 4, ' ');
        }
        text_P((servos->torque & joint) != 0 ? TEXT_P("  torque on ") : TEXT_P("  torque off"));
        if ((play->performer.released & joint) != 0) {
            TEXT("  switched off");
        }
        if (is_in_trouble(servos, id)) {
            print_trouble(servos, id);
        }
        text_line_end();
    }
    views_print_servos_found(play);
}

/* ---- faults ---- */

static void print_count(const char *what_P, uint16_t count)
{
    text_put(' ');
    text_P(what_P);
    text_put(' ');
    text_number(count);
}

static void print_servo_faults(const servo_link_t *servos)
{
    bool any = false;
    for (uint8_t id = 0; id < SERVO_LINK_JOINTS; id++) {
        if (servo_link_has(&servos->present, id) && is_in_trouble(servos, id)) {
            any = true;
            TEXT("Servo ");
            text_number(id);
            print_trouble(servos, id);
            text_line_end();
        }
    }
    if (!any) {
        TEXT("No servo has a fault");
        text_line_end();
    }
}

void views_print_faults(const play_t *play)
{
    print_servo_faults(&play->servos);
    bus_counts_t bus;
    bus_counts(&bus);
    TEXT("Bus: packets ");
    text_number32(bus.packets);
    TEXT(" answers ");
    text_number32(bus.answers);
    print_count(TEXT_P("retries"), bus.retries);
    print_count(TEXT_P("time-outs"), bus.timeouts);
    print_count(TEXT_P("checksum"), bus.checksums);
    print_count(TEXT_P("framing"), bus.framing);
    print_count(TEXT_P("wrong ID"), bus.wrong_ids);
    text_line_end();
    console_counts_t console;
    console_counts(&console);
    TEXT("Serial:");
    print_count(TEXT_P("overruns"), console.overruns);
    print_count(TEXT_P("framing"), console.framing);
    print_count(TEXT_P("lost"), (uint16_t)(console.ring_full + play->inputs.lost));
    print_count(TEXT_P("remote packets"), play->inputs.remote.packets);
    print_count(TEXT_P("remote noise"), play->inputs.remote.dropped);
    text_line_end();
    TEXT("Ticks:");
    print_count(TEXT_P("missed"), tick_missed());
    print_count(TEXT_P("goals late"), play->servos.late);
    text_line_end();
}

/* ---- settings, version, refusals ---- */

void views_print_settings(const play_t *play)
{
    for (uint8_t i = 0; i < SETTINGS_ITEMS; i++) {
        settings_item_t item;
        settings_item(i, &item);
        text_P(item.name);
        text_put(' ');
        text_number(settings_value(&play->settings, &item));
        TEXT("  (");
        text_number(item.low);
        TEXT("..");
        text_number(item.high);
        TEXT(")  ");
        text_P(item.meaning);
        text_line_end();
    }
}

/* The first cause that applies, in this order: power-on, brown-out, watchdog, external, JTAG. */
static const char *reset_text_P(uint8_t cause)
{
    if (cause & SYSTEM_RESET_POWER_ON) {
        return TEXT_P("power-on");
    }
    if (cause & SYSTEM_RESET_BROWN_OUT) {
        return TEXT_P("brown-out");
    }
    if (cause & SYSTEM_RESET_WATCHDOG) {
        return TEXT_P("watchdog");
    }
    if (cause & SYSTEM_RESET_EXTERNAL) {
        return TEXT_P("reset button");
    }
    return cause & SYSTEM_RESET_JTAG ? TEXT_P("JTAG") : TEXT_P("unknown");
}

void views_print_version(void)
{
    app_record_t record;
    TEXT("Motion512 Play ");
    if (board_record(&record)) {
        report_version(&record);
        text_P(record.board == APP_RECORD_CM2 ? TEXT_P(" for CM-2") : TEXT_P(" for CM-5"));
    }
    TEXT(", last reset: ");
    text_P(reset_text_P(system_reset_cause()));
    text_line_end();
    uint16_t line;
    uint32_t address;
    if (system_take_failed_assert(&line, &address)) {
        TEXT("The run before ended at line ");
        text_number(line);
        text_line_end();
    }
}

void views_print_refusal(const inputs_refusal_t *refusal)
{
    if (refusal->no_page) {
        TEXT("No page has code ");
        text_number(refusal->code);
    } else {
        report_refusal((performer_status_t)refusal->status, refusal->page, refusal->fault);
    }
}
