/* SPDX-License-Identifier: MIT
 * settings_names.c - the settings by name, for a line shell. */
#include "settings_parts.h"
#include "text.h"

#define NAME(id) static const char name_##id[] PROGMEM = #id
NAME(law);
TEXT_NAMED(meaning_law, "0 exact, 1 classic");
NAME(remote);
TEXT_NAMED(meaning_remote, "0 latch, 1 hold, 2 drive");
NAME(approach);
TEXT_NAMED(meaning_approach, "degrees/s, 0 = off");
NAME(fault);
TEXT_NAMED(meaning_fault, "0 hold, 1 exit page, 2 go on without it");
NAME(low);
TEXT_NAMED(meaning_low, "battery warning, 0.1 V, 0 = off");
NAME(hot);
TEXT_NAMED(meaning_hot, "servo warning, degrees C, 0 = off");
NAME(neutral);
TEXT_NAMED(meaning_neutral, "MIRROR about 0: 512, 1: page 1");
NAME(flow);
TEXT_NAMED(meaning_flow, "1 = XON/XOFF");
NAME(fast);
TEXT_NAMED(meaning_fast, "1 = 117,647 baud after start");
NAME(talk);
TEXT_NAMED(meaning_talk, "1 = status lines while playing");
NAME(centre);
TEXT_NAMED(meaning_centre, "amplitude is about step 1 of this page, 0 = off");
NAME(drive);
TEXT_NAMED(meaning_drive, "0.1 s without @drive until the stop, 0 = never");

#define ITEM_TEXT(id) { name_##id, meaning_##id }
static const struct {
    const char *name, *meaning;
} texts_P[SETTINGS_ITEMS] PROGMEM = {
    ITEM_TEXT(law), ITEM_TEXT(remote), ITEM_TEXT(approach), ITEM_TEXT(fault), ITEM_TEXT(low),
    ITEM_TEXT(hot), ITEM_TEXT(neutral), ITEM_TEXT(flow), ITEM_TEXT(fast), ITEM_TEXT(talk),
    ITEM_TEXT(centre), ITEM_TEXT(drive),
};

void settings_item(uint8_t index, settings_item_t *item)
{
    item->name = pgm_read_ptr(&texts_P[index].name);
    item->meaning = pgm_read_ptr(&texts_P[index].meaning);
    memcpy_P(&item->range, &settings_ranges_P[index], sizeof item->range);
}

const char settings_laws_P[] PROGMEM = "exact\0classic\0";
const char settings_remotes_P[] PROGMEM = "latch\0hold\0drive\0";

const char *settings_word_P(const char *words_P, uint8_t value)
{
    for (; value > 0; value--) {
        words_P += strlen_P(words_P) + 1;
    }
    return words_P;
}
