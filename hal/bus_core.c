/* SPDX-License-Identifier: MIT */
#include "bus_core.h"
#include "bus_port.h"
#include "trap.h"

#include <stddef.h>
#include <string.h>

/* Address 5 has at most 254 units of 2 us. */
#define RETURN_DELAY_MAX_HALF_US (254u * 4u)

static void bump(uint16_t *count)
{
    if (*count != 0xFFFFu) {
        (*count)++;
    }
}

void bus_core_init(bus_core_t *core)
{
    memset(core, 0, sizeof *core);
    core->return_delay_half_us = RETURN_DELAY_MAX_HALF_US;
    bus_core_set_rate(core, BUS_RATE_1M);
}

/* Ten bits at 2,000,000 / (divisor + 1): 10 * (divisor + 1) half microseconds. */
void bus_core_set_rate(bus_core_t *core, uint8_t divisor)
{
    core->byte_half_us = (uint16_t)(10u * (divisor + 1u));
}

/* IDLE or LISTENING -> SENDING. */
static NOINLINE void send(bus_core_t *core)
{
    core->failure = BUS_OK;
    core->parsed = 0;
    core->heard_count = 0;
    core->heard_flags = 0;
    core->status = NULL;
    core->counts.packets++;
    core->state = BUS_SENDING;
    bus_port_send(core->size);
}

bus_status_t bus_core_submit(bus_core_t *core, uint8_t size, uint8_t answer_params, uint8_t tries)
{
    ASSERT(size >= DXL_PACKET_OVERHEAD && size <= BUS_PACKET_BYTES && tries >= 1u && tries <= BUS_TRIES_MAX);
    if (core->state != BUS_IDLE) {
        return BUS_ERR_BUSY;
    }
    core->size = size;
    core->asked_id = core->packet[2];
    core->answer_params = answer_params;
    core->tries_left = (uint8_t)(tries - 1u);
    core->result = BUS_PENDING;
    send(core);
    return BUS_PENDING;
}

void bus_core_on_sent(bus_core_t *core, bus_time_t now_half_us)
{
    if (core->state != BUS_TURNING) {
        return;
    }
    bus_port_listen();
    core->sent = true;
    core->since = now_half_us;
    if (core->answer_params == BUS_NO_ANSWER) {
        core->result = BUS_OK;
        core->state = BUS_IDLE;
    } else {
        core->state = BUS_LISTENING;
    }
}

/* Records why this try failed. A UART error counts as the cause, whatever it led to. */
static void fail(bus_core_t *core, bus_status_t why, uint16_t *count)
{
    uint8_t flags = core->heard_flags;
    if (flags & BUS_BYTE_OVERRUN) {
        why = BUS_ERR_FRAMING;
        count = &core->counts.overruns;
    } else if (flags & BUS_BYTE_FRAMING) {
        why = BUS_ERR_FRAMING;
        count = &core->counts.framing;
    }
    core->failure = why;
    bump(count);
}

/* Handles a status packet with a good checksum. */
static void take_packet(bus_core_t *core)
{
    const uint8_t *status = core->status;
    if (status[2] != core->asked_id) {
        fail(core, BUS_ERR_WRONG_ID, &core->counts.wrong_ids);
    } else if (status[3] == 2u && (status[4] & DXL_REJECTED) != 0) { /* an answer with data is valid despite such a bit */
        fail(core, BUS_ERR_REJECTED, &core->counts.rejected);
    } else if ((uint8_t)(status[3] - 2u) != core->answer_params) {
        fail(core, BUS_ERR_LENGTH, &core->counts.lengths);
    } else {
        core->counts.answers++;
        core->result = BUS_OK;
        core->state = BUS_IDLE;
    }
}

/* Parses the bytes received since the last call. Returns whether there were any. */
static bool take_heard(bus_core_t *core)
{
    uint8_t count = core->heard_count;
    if (count == core->parsed) {
        return false;
    }
    core->parsed = count;
    if (core->failure != BUS_OK) {
        return true;
    }
    switch (dxl_find_status(core->heard, count, &core->status)) {
    case DXL_GOOD:
        take_packet(core);
        break;
    case DXL_BAD_CHECKSUM:
        fail(core, BUS_ERR_CHECKSUM, &core->counts.checksums);
        break;
    case DXL_BAD_LENGTH:
        fail(core, BUS_ERR_LENGTH, &core->counts.lengths);
        break;
    default:
        break;
    }
    return true;
}

/* In LISTENING, after a failed try: tries again once the line is quiet, or ends the packet. */
static void after_failure(bus_core_t *core, bus_time_t silence)
{
    if (silence <= BUS_QUIET_HALF_US + core->byte_half_us) {
        return;
    }
    if (core->tries_left > 0) {
        core->tries_left--;
        bump(&core->counts.retries);
        send(core);
    } else {
        core->result = core->failure;
        core->state = BUS_IDLE;
    }
}

static void listen(bus_core_t *core, bus_time_t now)
{
    if (take_heard(core)) {
        core->since = now;
    }
    if (core->state != BUS_LISTENING) {
        return;
    }
    /* Negative if transmit complete came after `now` was read. */
    bus_span_t silence = (bus_span_t)(now - core->since);
    if (silence <= 0) {
        return;
    }
    bus_time_t patience = (bus_time_t)(core->return_delay_half_us + 3u * core->byte_half_us + bus_port_margin_half_us());
    if (core->failure == BUS_OK && (bus_time_t)silence > patience) {
        fail(core, BUS_ERR_TIMEOUT, &core->counts.timeouts);
    }
    if (core->failure != BUS_OK) {
        after_failure(core, (bus_time_t)silence);
    }
}

bus_status_t bus_core_poll(bus_core_t *core, bus_time_t now_half_us, bus_answer_t *answer)
{
    core->sent = false;
    if (core->state == BUS_LISTENING) {
        listen(core, now_half_us);
    }
    if (answer != NULL && (core->result == BUS_OK || core->result == BUS_ERR_REJECTED) && core->status != NULL) {
        const uint8_t *status = core->status;
        answer->id = status[2];
        answer->count = (uint8_t)(status[3] - 2u);
        answer->error = status[4];
        answer->params = status + DXL_PARAMS_AT;
    }
    return (bus_status_t)core->result;
}

bool bus_core_has_news(const bus_core_t *core)
{
    return core->sent || (core->state == BUS_LISTENING && core->heard_count != core->parsed);
}

void bus_core_counts(const bus_core_t *core, bus_counts_t *counts)
{
    irq_state_t state = irq_save();
    *counts = core->counts;
    counts->strays = core->strays;
    irq_restore(state);
}
