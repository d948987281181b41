/* SPDX-License-Identifier: MIT
 * remote.h - extracts RC-100 packets from a byte stream that also carries typed text.
 * Knows no UART and no page: bytes in; buttons, or the bytes that were not a packet, out. Caller-owned state, main
 * loop only. Source: REMOTE.md ("Sources of a code").
 *
 * A packet is FF 55 L ~L H ~H. Typed text never has 0xFF, so bytes outside a packet pass at once. Bytes that began like a
 * packet but are not one are searched for the next FF 55, so that a good packet inside or right after a bad one is not
 * lost. The bytes before it are noise: counted and dropped, never typed.
 * Elsewhere a byte above 0x7F is half of a letter. It becomes a question mark, so that a name does not turn into another.
 *
 * One case needs care: a packet that lost its last byte is completed by the FF of the next one. So the FF that ends a
 * good packet may begin another. A 0x55 ('U') right after it is held back until it is clear whether it was typed. */
#ifndef REMOTE_H
#define REMOTE_H

#include <stdbool.h>
#include <stdint.h>

/* Buttons, bits of a packet's word H:L. */
enum {
    REMOTE_UP = 1,
    REMOTE_DOWN = 2,
    REMOTE_LEFT = 4,
    REMOTE_RIGHT = 8,
    REMOTE_BUTTON1 = 16,
    REMOTE_BUTTON2 = 32,
    REMOTE_BUTTON3 = 64,
    REMOTE_BUTTON4 = 128,
    REMOTE_BUTTON5 = 256,
    REMOTE_BUTTON6 = 512
};

#define REMOTE_PACKET_BYTES 6u

/* The result of a byte. */
typedef enum {
    REMOTE_NOTHING = 0, /* part of an unfinished packet, or noise */
    REMOTE_PACKET,      /* completed a packet: remote.buttons */
    REMOTE_TEXT         /* remote.text has remote.text_count typed bytes */
} remote_event_t;

#define REMOTE_TEXT_BYTES 3u

typedef struct {
    uint16_t buttons;   /* of the last good packet */
    uint16_t packets;   /* good ones; wraps */
    uint16_t dropped;   /* bytes of broken packets; wraps */
    uint8_t text[REMOTE_TEXT_BYTES];
    uint8_t text_count;
    uint8_t held[REMOTE_PACKET_BYTES - 1];
    uint8_t count;      /* bytes in held */
    bool shared;        /* held[0] is the last byte of a good packet */
} remote_t;

void remote_init(remote_t *remote);

/* Takes one byte. */
remote_event_t remote_byte(remote_t *remote, uint8_t byte);

/* Call after 20 ms or more without a byte. Drops an unfinished packet, so that it cannot swallow text typed later.
 * Returns REMOTE_TEXT (a 'U' that was held back) or REMOTE_NOTHING. */
remote_event_t remote_quiet(remote_t *remote);

/* The meaning of the buttons. */
typedef enum {
    REMOTE_ACT_CODE = 0, /* *code is a code 0..254 */
    REMOTE_ACT_STOP,     /* button 6, alone or in any chord */
    REMOTE_ACT_PAUSE     /* button 5 alone: pause or resume */
} remote_act_t;

/* The code table of REMOTE.md. Button 5 in a chord is ignored. The first eight buttons together are 255, the code of stop:
 * a fist on the remote stops the robot. */
remote_act_t remote_act(uint16_t buttons, uint8_t *code);

#endif
