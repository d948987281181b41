/* SPDX-License-Identifier: MIT */
#include "dxl_packet.h"

uint8_t dxl_build(uint8_t *packet, uint8_t id, uint8_t instruction, const uint8_t *params, uint8_t count)
{
    dxl_writer_t writer;
    dxl_begin(&writer, packet, id, instruction);
    while (count--) {
        dxl_put(&writer, *params++);
    }
    return dxl_end(&writer);
}

dxl_result_t dxl_find_status(const uint8_t *heard, uint8_t count, const uint8_t **packet)
{
    while (count >= 4u && !(heard[0] == 0xFF && heard[1] == 0xFF && heard[2] != 0xFF)) {
        heard++;
        count--;
    }
    if (count < 4u) {
        return DXL_MORE;
    }
    uint8_t length = heard[3];
    if (length < 2u || length > DXL_ANSWER_PARAMS + 2u) {
        return DXL_BAD_LENGTH;
    }
    uint8_t size = length + 4u;
    if (count < size) {
        return DXL_MORE;
    }
    uint8_t sum = 0;
    const uint8_t *end = heard + size;
    for (const uint8_t *at = heard + 2; at != end; at++) {
        sum += *at;
    }
    if (sum != 0xFFu) {
        return DXL_BAD_CHECKSUM;
    }
    *packet = heard;
    return DXL_GOOD;
}
