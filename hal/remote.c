/* SPDX-License-Identifier: MIT */
#include "remote.h"

#include <string.h>

#define HEAD1 0xFFu
#define HEAD2 0x55u
#define CODE_BUTTONS 0xFFu /* directions and buttons 1..4 */
#define CODE_STOP 255u

void remote_init(remote_t *remote)
{
    memset(remote, 0, sizeof *remote);
}

/* Whether these `count` bytes may be a packet or the beginning of one. */
static bool looks_good(const uint8_t *bytes, uint8_t count)
{
    if (bytes[0] != HEAD1) {
        return false;
    }
    if (count >= 2 && bytes[1] != HEAD2) {
        return false;
    }
    if (count >= 4 && (bytes[2] ^ bytes[3]) != 0xFF) {
        return false;
    }
    return count < REMOTE_PACKET_BYTES || (bytes[4] ^ bytes[5]) == 0xFF;
}

/* Handles a byte outside any packet: text if it may have been typed (only ASCII is stored), otherwise noise. */
static void give_up(remote_t *remote, uint8_t byte, bool may_be_typed)
{
    if (may_be_typed) {
        remote->text[remote->text_count++] = byte < 0x80 ? byte : (uint8_t)'?';
    } else {
        remote->dropped++;
    }
}

/* Gives up bytes at the front of `window` until the rest may begin a packet; keeps the rest. */
static void resynchronize(remote_t *remote, const uint8_t *window, uint8_t count)
{
    /* After a shared FF, "U" and two more characters may have been typed. Four bytes with a good complement were not. */
    const bool may_be_typed = remote->shared && count <= 1 + REMOTE_TEXT_BYTES;
    if (remote->shared) {
        window++; /* the FF belongs to the previous packet */
        count--;
        remote->shared = false;
    } else {
        give_up(remote, *window++, false);
        count--;
    }
    while (count > 0 && !looks_good(window, count)) {
        give_up(remote, *window++, may_be_typed);
        count--;
    }
    memcpy(remote->held, window, count);
    remote->count = count;
}

static remote_event_t finish(remote_t *remote, const uint8_t *packet)
{
    remote->buttons = packet[2] | (packet[4] << 8);
    remote->packets++;
    remote->shared = packet[5] == HEAD1;
    remote->held[0] = HEAD1;
    remote->count = remote->shared ? 1 : 0;
    return REMOTE_PACKET;
}

remote_event_t remote_byte(remote_t *remote, uint8_t byte)
{
    uint8_t window[REMOTE_PACKET_BYTES];
    uint8_t count = remote->count;
    memcpy(window, remote->held, count);
    window[count++] = byte;
    remote->text_count = 0;
    if (byte != HEAD1 && (count == 1 || (count == 2 && byte != HEAD2))) {
        /* No open packet, or only a lone FF, which the original sends when its UART starts. */
        remote->dropped = (uint16_t)(remote->dropped + (count == 2 && !remote->shared ? 1 : 0));
        remote->shared = false;
        remote->count = 0;
        give_up(remote, byte, true);
        return REMOTE_TEXT;
    }
    if (looks_good(window, count)) {
        if (count == REMOTE_PACKET_BYTES) {
            return finish(remote, window);
        }
        remote->held[count - 1] = byte;
        remote->count = count;
        return REMOTE_NOTHING;
    }
    resynchronize(remote, window, count);
    return remote->text_count > 0 ? REMOTE_TEXT : REMOTE_NOTHING;
}

remote_event_t remote_quiet(remote_t *remote)
{
    const bool may_be_typed = remote->shared && remote->count <= 1 + REMOTE_TEXT_BYTES;
    remote->text_count = 0;
    for (uint8_t i = remote->shared ? 1 : 0; i < remote->count; i++) {
        give_up(remote, remote->held[i], may_be_typed);
    }
    remote->count = 0;
    remote->shared = false;
    return remote->text_count > 0 ? REMOTE_TEXT : REMOTE_NOTHING;
}

remote_act_t remote_act(uint16_t buttons, uint8_t *code)
{
    *code = buttons & CODE_BUTTONS;
    if ((buttons & REMOTE_BUTTON6) != 0 || *code == CODE_STOP) {
        return REMOTE_ACT_STOP;
    }
    if ((buttons & REMOTE_BUTTON5) != 0 && *code == 0) {
        return REMOTE_ACT_PAUSE;
    }
    return REMOTE_ACT_CODE;
}
