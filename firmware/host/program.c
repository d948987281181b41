/* SPDX-License-Identifier: MIT
 * program.c - the part of the boot loader on the chip: loads the kept memories, completes a save that a power cut
 * interrupted, then runs the image's own main, which the build renames to image_main. */
#include "program.h"

#include "hal/host/host.h"
#include "hal/host/machine.h"

#include "app_record.h"
#include "journal.h"
#include "page_service.h"
#include <stddef.h>

int image_main(void);

static void complete_save(void)
{
    uint8_t page[JOURNAL_TARGET_BYTES];
    (void)page_service_init(NULL);
    switch (journal_recover(page)) {
    case JOURNAL_RESTORED:
        machine_tell("a save was cut off last time: it is complete now");
        break;
    case JOURNAL_LOST:
    case JOURNAL_FAILED:
        machine_tell("a save was cut off last time and cannot be completed: check the page that was being saved");
        break;
    default:
        break;
    }
}

int program_start(void)
{
    static const app_record_t record = {.magic = APP_RECORD_MAGIC, .board = APP_RECORD_PC, .version = {PROGRAM_VERSION},
                                        .layout = APP_RECORD_LAYOUT};
    host_recall(&record, sizeof record);
    complete_save();
    return image_main();
}
