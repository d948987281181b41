/* SPDX-License-Identifier: MIT */
#include "bus_call.h"
#include "dxl_packet.h"

#include <stddef.h>
#include <string.h>

bus_status_t bus_call(uint8_t id, uint8_t instruction, const uint8_t *params, uint8_t count, uint8_t answer_params,
                      uint8_t tries, bus_answer_t *answer)
{
    (void)bus_wait(NULL);
    uint8_t size = dxl_build(bus_packet(), id, instruction, params, count);
    (void)bus_submit(size, answer_params, tries);
    return bus_wait(answer);
}

bus_status_t bus_call_ping(uint8_t id, uint8_t tries, uint8_t *error)
{
    bus_answer_t answer;
    bus_status_t status = bus_call(id, DXL_PING, NULL, 0, 0, tries, &answer);
    if (status == BUS_OK && error != NULL) {
        *error = answer.error;
    }
    return status;
}

bus_status_t bus_call_read(uint8_t id, uint8_t at, void *to, uint8_t count, uint8_t *error)
{
    const uint8_t params[2] = { at, count };
    bus_answer_t answer;
    bus_status_t status = bus_call(id, DXL_READ, params, 2, count, BUS_CALL_TRIES, &answer);
    if (status != BUS_OK) {
        return status;
    }
    memcpy(to, answer.params, count);
    if (error != NULL) {
        *error = answer.error;
    }
    return BUS_OK;
}

bus_status_t bus_start_read(uint8_t id, uint8_t at, uint8_t count, uint8_t tries)
{
    const uint8_t params[2] = { at, count };
    if (bus_is_busy()) {
        return BUS_ERR_BUSY;
    }
    return bus_submit(dxl_build(bus_packet(), id, DXL_READ, params, 2), count, tries);
}
