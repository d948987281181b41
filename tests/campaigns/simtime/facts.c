/* SPDX-License-Identifier: MIT */
#include "session.h"

#include <stdlib.h>
#include <string.h>

#define TRIM_MAX 300               /* a larger one counts as damaged */
#define POS_MAX 1023

const uint8_t *page_at(unsigned page)
{
    return simtime_memory(MACHINE_PAGES) + page % PAGES * PAGE_BYTES;
}

uint8_t sum_of(const uint8_t *page)
{
    uint8_t sum = 0;
    for (unsigned i = 0; i < PAGE_BYTES; i++) {
        sum = (uint8_t)(sum + page[i]);
    }
    return sum;
}

uint16_t crc_of(const uint8_t *bytes, unsigned count)
{
    uint16_t crc = 0xFFFF;
    for (unsigned i = 0; i < count; i++) {
        crc ^= (uint16_t)(bytes[i] << 8);
        for (unsigned bit = 0; bit < 8; bit++) {
            crc = (uint16_t)(crc & 0x8000u ? crc << 1 ^ 0x1021 : crc << 1);
        }
    }
    return crc;
}

bool begins_with_one_of(const char *line, const char *const *texts)
{
    for (; *texts != NULL; texts++) {
        if (strncmp(line, *texts, strlen(*texts)) == 0) {
            return true;
        }
    }
    return false;
}

uint32_t joints_named(const char *words)
{
    uint32_t joints = 0;
    for (char *end; ; words = end) {
        const unsigned long id = strtoul(words, &end, 10);
        if (end == words) {
            return joints;
        }
        joints |= id < JOINTS ? 1u << id : 0;
    }
}

int trim_of(unsigned id)
{
    const uint8_t *word = page_at(0) + 3 * STEP_BYTES + 2 * id;   /* step 2 */
    const int trim = (int16_t)(word[0] | word[1] << 8);
    return sum_of(page_at(0)) == 0xFF && abs(trim) <= TRIM_MAX ? trim : 0;
}

int limited(int pos)
{
    return pos < 0 ? 0 : pos > POS_MAX ? POS_MAX : pos;
}

int to_page(unsigned id, double servo_pos)
{
    return limited((int)servo_pos - trim_of(id));
}

bool is_stop_of(unsigned buttons)
{
    return buttons >= 512 || (buttons & 255) == 255;
}
