/* SPDX-License-Identifier: MIT
 * main.c - the Edit image: its parts, start-up order, main loop. */
#include "board.h"
#include "compiler.h"
#include "console.h"
#include "editor.h"
#include "journal.h"
#include "page_service.h"
#include "parts.h"
#include "pgm.h"
#include "system.h"
#include "text.h"

page_store_t the_pages;
servo_link_t the_servos;
performer_t the_performer;
settings_store_t the_settings_store;
static boot_rx_t receiver;   /* the loader puts bytes that arrive during a page write into the console's ring */

static void put(char character)
{
    editor_put(character);
}

/* The message for the first screen: the result of a page in the mailbox, or how SAVE will work. */
static const char *mail_text_P(void)
{
    page_service_mail_t mail = page_service_mail();
    return mail == PAGE_SERVICE_MAIL_NONE      ? TEXT_P("SAVE will restart")
           : mail == PAGE_SERVICE_MAIL_WRITTEN ? TEXT_P("Saved")
                                               : TEXT_P("Not saved");
}

/* NOINLINE: main never returns, so the stack used here would stay in use. */
static NOINLINE void start(void)
{
    board_start();
    ring_t *ring = console_rx_ring();
    receiver = (boot_rx_t){ ring->bytes, &ring->head, &ring->tail, console_rx_lost(), ring->mask };
    page_service_kind_t service = page_service_init(&receiver);
    journal_result_t recovered = journal_recover(the_session.cells);
    const char *notice_P = recovered == JOURNAL_RESTORED ? TEXT_P("Saved what was cut off")
                      : recovered == JOURNAL_FAILED ? TEXT_P("Not saved: flash error")
                      : service == PAGE_SERVICE_MAILBOX ? mail_text_P()
                      : service == PAGE_SERVICE_NONE  ? TEXT_P("No boot loader can write: no SAVE")
                                                      : TEXT_P("Arrows move, HELP explains, EXIT leaves");
    page_store_init(&the_pages);
    if (page_store_is_damaged(&the_pages, 0)) {
        notice_P = TEXT_P("Page 0 is damaged: no trim");
    }
    (void)settings_load(&the_settings_store);
    console_set_flow(the_settings_store.settings.flow != 0);
    text_init(put);
    servo_link_init(&the_servos);
    servo_link_scan(&the_servos);
    performer_init(&the_performer, &the_pages.source, &the_servos, &the_settings_store.settings);
    editor_init(notice_P);
}

int main(void)
{
    start();
    for (;;) {
        system_kick();   /* also in turns that do not idle, while a list or the screen is printed */
        if (!editor_turn()) {
            board_idle();
        }
    }
}
