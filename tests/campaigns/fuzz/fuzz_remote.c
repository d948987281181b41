/* SPDX-License-Identifier: MIT
 * The remote's packets in any stream. Input: bytes of the line; FE is 20 ms of silence (FE FE: the byte itself). */
#include "fuzz.h"
#include "remote.h"
#include "trap.h"

#include <stdbool.h>

static remote_t remote;
static unsigned taken, given;   /* bytes in; bytes accounted for as text or packets */

static void account(remote_event_t event)
{
    ASSERT(remote.count <= REMOTE_PACKET_BYTES - 1);
    if (event == REMOTE_TEXT) {
        ASSERT(remote.text_count >= 1 && remote.text_count <= REMOTE_TEXT_BYTES);
        given += remote.text_count;
        for (unsigned i = 0; i < remote.text_count; i++) {
            ASSERT(remote.text[i] != 0xFF);
        }
    } else if (event == REMOTE_PACKET) {
        uint8_t code = 0;
        const remote_act_t act = remote_act(remote.buttons, &code);
        ASSERT(act != REMOTE_ACT_CODE || code < 255);
        ASSERT((remote.buttons & REMOTE_BUTTON6) == 0 || act == REMOTE_ACT_STOP);
        given += REMOTE_PACKET_BYTES;
    }
}

/* After a silence a good packet must be received, whatever came before. */
static void must_hear(uint16_t buttons)
{
    const uint8_t low = (uint8_t)buttons, high = (uint8_t)(buttons >> 8);
    const uint8_t packet[] = {0xFF, 0x55, low, (uint8_t)~low, high, (uint8_t)~high};
    remote_event_t event = REMOTE_NOTHING;
    account(remote_quiet(&remote));
    for (unsigned i = 0; i < sizeof packet; i++) {
        ASSERT(event == REMOTE_NOTHING);
        event = remote_byte(&remote, packet[i]);
        taken++;
    }
    account(event);
    ASSERT(event == REMOTE_PACKET && remote.buttons == buttons);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    fuzz_t fuzz = {data, data + size};
    taken = 0;
    given = 0;
    remote_init(&remote);
    while (fuzz_left(&fuzz) > 0) {
        uint8_t byte = fuzz_byte(&fuzz);
        if (byte == 0xFE && fuzz_left(&fuzz) > 0 && (byte = fuzz_byte(&fuzz)) != 0xFE) {
            account(remote_quiet(&remote));
        }
        taken++;
        account(remote_byte(&remote, byte));
    }
    must_hear((uint16_t)(size * 257u));
    account(remote_quiet(&remote));
    /* No byte is lost or doubled; the FF between two packets may belong to both. */
    ASSERT(given + remote.dropped >= taken && given + remote.dropped <= taken + remote.packets);
    return 0;
}
