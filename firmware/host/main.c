/* SPDX-License-Identifier: MIT
 * main.c - how Play and Edit begin on a PC: what the boot loader does on the chip. Options, the computer's ports and files,
 * the save that a power cut has interrupted; then the image's own main, which the build calls image_main. */
#include "hal/host/host.h"
#include "hal/host/machine.h"
#include "hal/host/pc/pc.h"

#include "journal.h"
#include "page_service.h"

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

int main(int argc, char **argv)
{
    pc_read_options(argc, argv);
    pc_open();
    host_recall();
    complete_save();
    return image_main();
}
