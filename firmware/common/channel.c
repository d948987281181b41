/* SPDX-License-Identifier: MIT */
#include "channel.h"

#include "crc16.h"
#include "shell.h"
#include "text.h"
#include "tick.h"

enum { CR = '\r', DEL = 0x7F, CRC_DIGITS = 4, CUT_OFF_TICKS = 32 };

static struct {
    bool printing;
    uint8_t length;       /* of `line`; 0: no request has begun */
    uint8_t last_tick;    /* of the last byte, modulo 256 */
    char line[1 + CHANNEL_LINE_CHARS + 1];   /* CHANNEL_BEGIN, the request, NUL */
} channel;

void channel_init(void)
{
    channel.printing = false;
    channel.length = 0;
}

bool channel_is_open(void)
{
    return channel.length != 0;
}

channel_event_t channel_byte(uint8_t byte)
{
    if (channel.length == 0 && byte != CHANNEL_BEGIN) {
        return CHANNEL_NONE;
    }
    channel.last_tick = (uint8_t)tick_now16();
    if (byte == CR) {
        return CHANNEL_LINE;
    }
    /* Only text is kept, because a refusal prints it and an XOFF would stop the terminal. A line that is cut at the end of
     * the buffer fails its CRC. */
    const bool is_text = byte >= ' ' && byte < DEL;
    if ((is_text || channel.length == 0) && channel.length < sizeof channel.line - 1u) {
        channel.line[channel.length++] = (char)byte;
    }
    return CHANNEL_PART;
}

bool channel_is_cut_off(void)
{
    return channel.length != 0 && (uint8_t)(tick_now16() - channel.last_tick) >= CUT_OFF_TICKS;
}

/* Removes the CRC from the end of a line of `length` characters. false: the CRC is wrong. */
static bool take_crc(char *line, uint8_t length)
{
    uint16_t crc;
    if (length < CRC_DIGITS) {
        return false;
    }
    length = (uint8_t)(length - CRC_DIGITS);
    const bool fits = shell_hex(line + length, CRC_DIGITS, &crc) && crc == crc16_bytes(CRC16_START, line, length);
    if (fits) {
        line[length] = '\0';
    }
    return fits;
}

const char *channel_line(void)
{
    channel.line[channel.length] = '\0';
    return &channel.line[1];
}

char *channel_take(uint8_t *fault)
{
    char *line = &channel.line[1];
    channel.line[channel.length] = '\0';
    *fault = take_crc(line, (uint8_t)(channel.length - 1u)) ? SHELL_OK : SHELL_ERR_LOSSY;
    channel.length = 0;
    return line;
}

/* ---- output ---- */

bool channel_is_printing(void)
{
    return channel.printing;
}

void channel_print_begin(void)
{
    channel.printing = true;
    text_put(CHANNEL_BEGIN);
}

void channel_print_end(void)
{
    channel.printing = false;
}
