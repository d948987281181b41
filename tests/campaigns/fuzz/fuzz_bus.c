/* SPDX-License-Identifier: MIT
 * Status packets: dxl_find_status on any bytes, and the bus engine with any order of bytes, times and calls.
 * Input: pairs of an action and its argument. */
#include "fuzz.h"
#include "bus_core.h"
#include "bus_port.h"
#include "trap.h"

#include <stdlib.h>
#include <string.h>

static bus_core_t core;
static uint16_t now;
static bool on_wire;   /* a packet is being sent */

void bus_port_send(uint8_t count)
{
    ASSERT(!on_wire && count == core.size && count >= DXL_PACKET_OVERHEAD);
    on_wire = true;
}

TARGET_BUS_TIME bus_port_margin_half_us(void)
{
    return 600u;
}

void bus_port_listen(void)
{
    ASSERT(!on_wire);
}

/* The answer must match the request and lie within the received bytes. */
static void must_be_the_answer(const bus_answer_t *answer)
{
    uint8_t sum = 0;
    ASSERT(answer->params >= core.heard + DXL_PARAMS_AT && answer->params + answer->count < core.heard + core.heard_count);
    const uint8_t *packet = answer->params - DXL_PARAMS_AT;
    ASSERT(packet[0] == 0xFF && packet[1] == 0xFF && packet[2] == answer->id && packet[3] == answer->count + 2);
    for (unsigned i = 2; i < answer->count + 6u; i++) {
        sum = (uint8_t)(sum + packet[i]);
    }
    ASSERT(sum == 0xFF);
    ASSERT(answer->id == core.asked_id && answer->count == core.answer_params);
}

static void poll(void)
{
    bus_answer_t answer = {0};
    const uint8_t waiting = core.answer_params;
    const bus_status_t before = (bus_status_t)core.result;
    const bus_status_t status = bus_core_poll(&core, now, &answer);
    ASSERT(status <= BUS_ERR_BUSY);
    if (before == BUS_PENDING && status == BUS_OK && waiting != BUS_NO_ANSWER) {
        must_be_the_answer(&answer);
    }
}

static void sent(void)
{
    bus_core_on_last(&core);
    on_wire = false;
    bus_core_on_sent(&core, now);
}

static void submit(uint8_t argument, fuzz_t *fuzz)
{
    const uint8_t params[2] = {fuzz_byte(fuzz), fuzz_byte(fuzz)};
    const uint8_t wanted = argument >= 0xF0 ? BUS_NO_ANSWER : argument % (DXL_ANSWER_PARAMS + 1);
    if (core.result == BUS_PENDING) {
        ASSERT(bus_core_submit(&core, 8, wanted, 1) == BUS_ERR_BUSY);
        return;
    }
    const uint8_t size = dxl_build(core.packet, params[0] & 0xFD, DXL_READ, params, 2);
    ASSERT(bus_core_submit(&core, size, wanted, (uint8_t)(1 + argument % BUS_TRIES_MAX)) == BUS_PENDING);
}

static void step(uint8_t action, uint8_t argument, fuzz_t *fuzz)
{
    switch (action & 7) {
    case 0: submit(argument, fuzz); break;
    case 1: if (on_wire) { sent(); } break;
    case 2: now = (uint16_t)(now + argument * 8u); poll(); break;
    case 4: bus_core_on_byte(&core, argument, (uint8_t)(action >> 3 & 3)); break;
    case 5: bus_core_set_rate(&core, argument & 1 ? BUS_RATE_1M : BUS_RATE_57142); break;
    default: bus_core_on_byte(&core, argument, 0); poll(); break;
    }
}

/* After any history: once sending ends and time passes, the engine is free again. */
static void must_come_to_rest(void)
{
    for (unsigned i = 0; i < 4000 && core.result == BUS_PENDING; i++) {
        if (on_wire) {
            sent();
        }
        now = (uint16_t)(now + 200);
        poll();
    }
    ASSERT(core.result != BUS_PENDING && core.state == BUS_IDLE);
}

/* Uses a copy of exactly this size, so that a read beyond it is found. */
static void find(const uint8_t *data, size_t size)
{
    const uint8_t count = (uint8_t)(size > BUS_HEARD_BYTES ? BUS_HEARD_BYTES : size);
    uint8_t *heard = malloc(count > 0 ? count : 1);
    const uint8_t *packet = NULL;
    ASSERT(heard != NULL);
    memcpy(heard, data, count);
    const dxl_result_t result = dxl_find_status(heard, count, &packet);
    ASSERT((packet != NULL) == (result == DXL_GOOD));
    if (result == DXL_GOOD) {
        ASSERT(packet >= heard && packet[3] >= 2 && packet + packet[3] + 4 <= heard + count);
        ASSERT(packet[3] - 2u <= DXL_ANSWER_PARAMS);
    }
    free(heard);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    fuzz_t fuzz = {data, data + size};
    find(data, size);
    bus_core_init(&core);
    now = 0;
    on_wire = false;
    while (fuzz_left(&fuzz) > 0) {
        const uint8_t action = fuzz_byte(&fuzz);
        step(action, fuzz_byte(&fuzz), &fuzz);
    }
    must_come_to_rest();
    return 0;
}
