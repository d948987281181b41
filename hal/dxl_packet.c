/* SPDX-License-Identifier: MIT */
#include "dxl_packet.h"

/* What the parser waits for next. */
enum { WAIT_FF1 = 0, WAIT_FF2, WAIT_ID, WAIT_LENGTH, WAIT_ERROR, WAIT_PARAM, WAIT_SUM };

uint8_t dxl_build(uint8_t *packet, uint8_t id, uint8_t instruction, const uint8_t *params, uint8_t count)
{
    dxl_writer_t writer;
    dxl_begin(&writer, packet, id, instruction);
    while (count--) {
        dxl_put(&writer, *params++);
    }
    return dxl_end(&writer);
}

void dxl_parser_init(dxl_parser_t *parser, uint8_t *params)
{
    parser->params = params;
    parser->state = WAIT_FF1;
    parser->id = 0;
    parser->length = 0;
    parser->error = 0;
    parser->count = 0;
    parser->sum = 0;
}

bool dxl_parser_is_empty(const dxl_parser_t *parser)
{
    return parser->state == WAIT_FF1;
}

/* The byte after FF FF, and after any further FF: no servo has ID 255. */
static void take_id(dxl_parser_t *parser, uint8_t byte)
{
    if (byte == 0xFF) {
        return;
    }
    parser->id = byte;
    parser->sum = byte;
    parser->count = 0;
    parser->state = WAIT_LENGTH;
}

static dxl_result_t take_length(dxl_parser_t *parser, uint8_t byte)
{
    parser->sum = (uint8_t)(parser->sum + byte);
    parser->length = byte;
    if (byte < 2u || byte > DXL_ANSWER_PARAMS + 2u) {
        parser->state = WAIT_FF1;
        return DXL_BAD_LENGTH;
    }
    parser->state = WAIT_ERROR;
    return DXL_MORE;
}

static void take_content(dxl_parser_t *parser, uint8_t byte)
{
    parser->sum = (uint8_t)(parser->sum + byte);
    if (parser->state == WAIT_ERROR) {
        parser->error = byte;
    } else {
        parser->params[parser->count++] = byte;
    }
    parser->state = parser->count == (uint8_t)(parser->length - 2u) ? WAIT_SUM : WAIT_PARAM;
}

dxl_result_t dxl_parser_byte(dxl_parser_t *parser, uint8_t byte)
{
    switch (parser->state) {
    case WAIT_FF1:
        parser->state = byte == 0xFF ? WAIT_FF2 : WAIT_FF1;
        return DXL_MORE;
    case WAIT_FF2:
        parser->state = byte == 0xFF ? WAIT_ID : WAIT_FF1;
        return DXL_MORE;
    case WAIT_ID:
        take_id(parser, byte);
        return DXL_MORE;
    case WAIT_LENGTH:
        return take_length(parser, byte);
    case WAIT_SUM:
        parser->state = WAIT_FF1;
        return (uint8_t)(parser->sum + byte) == 0xFFu ? DXL_GOOD : DXL_BAD_CHECKSUM;
    default:
        take_content(parser, byte);
        return DXL_MORE;
    }
}
