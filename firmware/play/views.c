/* SPDX-License-Identifier: MIT */
#include "views.h"

#include "board.h"
#include "performer_shape.h"
#include "report.h"
#include "system.h"
#include "text.h"

/* ---- pages ---- */

static void print_page_link(const char *what_P, uint8_t page)
{
    if (page != 0) {
        text_P_number(what_P, page);
    }
}

static void print_code_link(uint8_t page, uint8_t code)
{
    if (code != 0) {
        text_P_number(TEXT_P(" on code "), code);
        print_page_link(TEXT_P(" to "), page);
    }
}

static void print_page_line(uint8_t page, const uint8_t *header)
{
    char name[PAGE_NAME_BYTES];
    page_store_name(page, name);
    text_padded(page, 3, ' ');
    text_put(' ');
    text_string_padded(name, PAGE_NAME_BYTES);
    text_P_number(TEXT_P("steps "), header[PAGE_AT_STEPS]);
    text_P_number(TEXT_P(" x "), header[PAGE_AT_PLAY_COUNT]);
    print_page_link(TEXT_P(" code "), header[PAGE_AT_PLAY_CODE]);
    print_page_link(TEXT_P(" next "), header[PAGE_AT_NEXT_PAGE]);
    print_page_link(TEXT_P(" exit "), header[PAGE_AT_EXIT_PAGE]);
    print_code_link(header[PAGE_AT_LINKED1_PAGE], header[PAGE_AT_LINKED1_CODE]);
    print_code_link(header[PAGE_AT_LINKED2_PAGE], header[PAGE_AT_LINKED2_CODE]);
    text_line_end();
}

uint8_t views_list(const shell_args_t *args)
{
    uint8_t used = 0, damaged = 0;
    for (uint16_t number = 0; number < PAGE_COUNT; number++) {
        const uint8_t page = (uint8_t)number;
        play_service(); /* a page without a line takes up to 2 ms */
        if (page_store_is_good(&the_play.pages, page)) {
            uint8_t header[PAGE_AT_COMPLIANCE];
            page_store_read(page, 0, header, sizeof header);
            if (page == 0 || (header[PAGE_AT_NAME] == '\0' && header[PAGE_AT_STEPS] == 0)) {
                continue;   /* page 0, the trim, is told only when it is damaged */
            }
            used++;
            print_page_line(page, header);
        } else if (page_store_is_damaged(&the_play.pages, page)) {
            damaged++;
            text_padded(page, 3, ' ');
            TEXT(" damaged: ");
            text_P(report_page_fault_P(page_store_check(&the_play.pages, page)));
            text_line_end();
        }
    }
    text_number(used);
    text_P_number(TEXT_P(" pages, "), damaged);
    TEXT(" damaged");
    text_line_end();
    return SHELL_OK;
}

/* ---- state ---- */

static void print_state(void)
{
    const performer_t *performer = &the_play.performer;
    if (performer_is_paused(performer)) {
        TEXT("Paused in ");
        report_page(performer_page(performer));
    } else {
        switch (performer->state) {
        case PERFORMER_IDLE:
            TEXT("Nothing is playing");
            break;
        case PERFORMER_PLAY:
            TEXT("Playing ");
            report_page(performer_page(performer));
            break;
        default:
            TEXT("On the way to ");
            if (performer_page(performer) == 0) {
                TEXT("the pose");
            } else {
                report_page(performer_page(performer));
            }
            break;
        }
    }
    if (performer->state == PERFORMER_PLAY) {
        text_P_number(TEXT_P(" step "), performer->player.now.step);
        text_P_number(TEXT_P(" repetition "), performer->player.repetition);
        text_P_number(TEXT_P(" code "), performer->link.code);
    }
    text_line_end();
}

uint8_t views_status(const shell_args_t *args)
{
    print_state();
    if (!shape_is_neutral(&the_play.performer.shape) || performer_layers_joints(&the_play.performer) != 0) {
        views_print_shape();
        text_line_end();
    }
    TEXT("Law ");
    text_P(settings_word_P(settings_laws_P, the_play.store.settings.law));
    TEXT(", remote ");
    text_P(settings_word_P(settings_remotes_P, the_play.store.settings.remote_mode));
    TEXT(", approach ");
    if (the_play.store.settings.approach_deg_s == 0) {
        TEXT("off");
    } else {
        text_number(the_play.store.settings.approach_deg_s);
        TEXT(" degrees/s");
    }
    text_line_end();
    TEXT("Torque on: ");
    report_joints(the_play.servos.torque & the_play.servos.present);
    if (the_play.servos.voltage_dv != 0) {
        TEXT(", ");
        report_voltage(the_play.servos.voltage_dv);
        text_P_number(TEXT_P(", hottest servo "), the_play.servos.hottest_id);
        text_P_number(TEXT_P(" at "), the_play.servos.hottest_degrees);
        TEXT(" C");
    }
    text_line_end();
    return SHELL_OK;
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

void views_print_shape(void)
{
    const performer_t *performer = &the_play.performer;
    const shape_t *shape = &performer->shape;
    text_P_number(TEXT_P(" rate="), shape->rate_percent);
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
    text_P_number(TEXT_P(" layer="), performer_layer_page(performer));
    TEXT(" aim=");
    text_mask(performer->layers->code.joints);
}

/* ---- settings, version, refusals ---- */

void views_print_settings(void)
{
    for (uint8_t i = 0; i < SETTINGS_ITEMS; i++) {
        settings_item_t item;
        settings_item(i, &item);
        text_P(item.name);
        text_put(' ');
        text_number(settings_value(&the_play.store.settings, &item));
        text_P_number(TEXT_P("  ("), item.low);
        text_P_number(TEXT_P(".."), item.high);
        TEXT(")  ");
        text_P(item.meaning);
        text_line_end();
    }
}

/* The causes of all resets since an application last ran: the loader does not clear them. */
static void print_resets(uint8_t causes)
{
    TEXT_NAMED(power_on, "power-on");
    TEXT_NAMED(external, "reset button");
    TEXT_NAMED(brown_out, "brown-out");
    TEXT_NAMED(watchdog, "on request or watchdog");   /* an intentional restart uses the watchdog */
    TEXT_NAMED(jtag, "JTAG");
    static const char *const names[] PROGMEM = { power_on, external, brown_out, watchdog, jtag };   /* by bit */
    STATIC_ASSERT(SYSTEM_RESET_JTAG == 1 << 4 && SYSTEM_RESET_WATCHDOG == 1 << 3 && SYSTEM_RESET_BROWN_OUT == 1 << 2 &&
                  SYSTEM_RESET_EXTERNAL == 1 << 1, "the order of the names");
    TEXT(", last reset: ");
    if (causes == 0) {
        TEXT("unknown");
    }
    for (uint8_t bit = 0; causes != 0; bit++, causes >>= 1) {
        if ((causes & 1u) != 0) {
            text_P(pgm_read_ptr(&names[bit]));
            if (causes > 1) {
                TEXT(", ");
            }
        }
    }
}

uint8_t views_version(const shell_args_t *args)
{
    app_record_t record;
    TEXT("Motion512 Play ");
    if (board_record(&record)) {
        report_version(&record);
        text_P(record.board == APP_RECORD_CM2 ? TEXT_P(" for CM-2") :
               record.board == APP_RECORD_PC  ? TEXT_P(" for a PC") :
                                                TEXT_P(" for CM-5"));
    }
    print_resets(system_reset_cause());
    text_line_end();
    return SHELL_OK;
}

void views_print_refusal(const inputs_refusal_t *refusal)
{
    if (refusal->no_page) {
        text_P_number(TEXT_P("No page has code "), refusal->code);
    } else {
        report_refusal((performer_status_t)refusal->status, refusal->page, refusal->fault);
    }
}
