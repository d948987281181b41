/* SPDX-License-Identifier: MIT */
#include "servo_protocol.h"

#include <string.h>

/* Offsets in a packet: FF FF ID LEN INST params... SUM. */
enum { AT_ID = 2, AT_LENGTH = 3, AT_INSTRUCTION = 4, AT_PARAMS = 5, FRAME_BYTES = 4, STATUS_BYTES = 6 };

/* Result of one packet. */
typedef struct {
    uint8_t errors;
    bool answers; /* this instruction has a reply */
    uint8_t first, count; /* READ: part of the table to send */
} outcome_t;

uint8_t servo_checksum(const uint8_t *packet, uint8_t count)
{
    uint8_t sum = 0;
    for (uint8_t i = AT_ID; i + 1 < count; i++) {
        sum = (uint8_t)(sum + packet[i]);
    }
    return (uint8_t)~sum;
}

void servo_parser_clear(servo_parser_t *parser)
{
    parser->count = 0;
}

static void drop(servo_parser_t *parser, uint32_t *counter)
{
    parser->count = 0;
    if (counter) {
        (*counter)++;
    }
}

bool servo_parser_byte(servo_parser_t *parser, servo_stats_t *stats, uint64_t start_cycles, uint64_t end_cycles,
                       uint8_t byte)
{
    if (parser->count > 0 && start_cycles > parser->last_end_cycles + SERVO_GAP_CYCLES) {
        drop(parser, stats && parser->count >= AT_LENGTH ? &stats->gaps : NULL);
    }
    parser->last_end_cycles = end_cycles;
    if (parser->count < AT_ID && byte != 0xFF) {
        parser->count = 0;
        return false;
    }
    if (parser->count == AT_ID && byte == 0xFF) {
        return false; /* an extra FF before the ID */
    }
    parser->bytes[parser->count++] = byte;
    if (parser->count == AT_LENGTH + 1 && (byte < 2 || byte + FRAME_BYTES > SERVO_PACKET_MAX)) {
        drop(parser, stats ? &stats->oversize : NULL);
        return false;
    }
    return parser->count > AT_LENGTH && parser->count == parser->bytes[AT_LENGTH] + FRAME_BYTES;
}

static void obey_read(const uint8_t *params, uint8_t count, outcome_t *outcome)
{
    if (count != 2 || params[1] == 0 || params[0] + params[1] > SERVO_TABLE_BYTES) {
        outcome->errors |= SERVO_ERR_RANGE;
        return;
    }
    outcome->first = params[0];
    outcome->count = params[1];
}

static void obey_write(servo_t *servo, const uint8_t *params, uint8_t count, outcome_t *outcome)
{
    outcome->errors |= count < 2 ? SERVO_ERR_RANGE : servo_write(servo, params[0], params + 1, (uint8_t)(count - 1));
}

static void obey_reg_write(servo_t *servo, const uint8_t *params, uint8_t count, outcome_t *outcome)
{
    outcome->errors |=
        count < 2 ? SERVO_ERR_RANGE : servo_check_write(servo, params[0], params + 1, (uint8_t)(count - 1));
    if (outcome->errors & SERVO_ERR_RANGE) {
        return;
    }
    servo->registered_address = params[0];
    servo->registered_count = (uint8_t)(count - 1);
    memcpy(servo->registered, params + 1, servo->registered_count);
    servo->table[SERVO_REGISTERED] = 1;
}

static void obey_action(servo_t *servo, outcome_t *outcome)
{
    if (!servo->table[SERVO_REGISTERED] || servo->registered_count == 0) {
        outcome->errors |= SERVO_ERR_INSTRUCTION;
        return;
    }
    servo->table[SERVO_REGISTERED] = 0;
    outcome->errors |=
        servo_write(servo, servo->registered_address, servo->registered, servo->registered_count);
    servo->registered_count = 0;
}

/* ADDR L (ID data[L])...: the servo takes the data after its own ID. */
static void obey_sync_write(servo_t *servo, const uint8_t *params, uint8_t count)
{
    if (servo->model == SERVO_DX117 || count < 4) {
        return;
    }
    const uint8_t address = params[0], length = params[1];
    if (length == 0 || (count - 2) % (length + 1) != 0) {
        return;
    }
    for (int i = 2; i < count; i += length + 1) {
        if (params[i] == servo->table[SERVO_ID]) {
            (void)servo_write(servo, address, params + i + 1, length);
        }
    }
}

static outcome_t obey_instruction(servo_t *servo, const uint8_t *packet, uint8_t count)
{
    const uint8_t *params = packet + AT_PARAMS;
    const uint8_t params_count = (uint8_t)(count - AT_PARAMS - 1);
    const uint8_t level = servo->table[SERVO_RETURN_LEVEL];
    outcome_t outcome = {.answers = level == 2 && packet[AT_ID] != SERVO_BROADCAST};
    switch (packet[AT_INSTRUCTION]) {
    case SERVO_PING: outcome.answers = true; break;
    case SERVO_READ:
        outcome.answers = level >= 1 && packet[AT_ID] != SERVO_BROADCAST;
        obey_read(params, params_count, &outcome);
        break;
    case SERVO_WRITE_DATA: obey_write(servo, params, params_count, &outcome); break;
    case SERVO_REG_WRITE: obey_reg_write(servo, params, params_count, &outcome); break;
    case SERVO_ACTION: obey_action(servo, &outcome); break;
    case SERVO_RESET: servo_factory_reset(servo); break;
    case SERVO_SYNC_WRITE: obey_sync_write(servo, params, params_count); break;
    default: outcome.errors |= SERVO_ERR_INSTRUCTION; break;
    }
    return outcome;
}

uint8_t servo_obey(servo_t *servo, const uint8_t *packet, uint8_t count, uint8_t answer[SERVO_PACKET_MAX])
{
    const uint8_t id = servo->table[SERVO_ID];
    if (packet[AT_ID] != id && packet[AT_ID] != SERVO_BROADCAST) {
        return 0;
    }
    servo->stats.packets++;
    outcome_t outcome;
    if (servo_checksum(packet, count) != packet[count - 1]) {
        servo->stats.checksum_errors++;
        outcome = (outcome_t){.errors = SERVO_ERR_CHECKSUM,
                              .answers = servo->table[SERVO_RETURN_LEVEL] == 2 && packet[AT_ID] != SERVO_BROADCAST};
    } else {
        outcome = obey_instruction(servo, packet, count);
    }
    if (!outcome.answers) {
        return 0;
    }
    answer[0] = answer[1] = 0xFF;
    answer[AT_ID] = id;
    answer[AT_LENGTH] = (uint8_t)(outcome.count + 2);
    answer[AT_INSTRUCTION] = outcome.errors | servo->alarms;
    memcpy(answer + AT_PARAMS, servo->table + outcome.first, outcome.count);
    const uint8_t length = (uint8_t)(outcome.count + STATUS_BYTES);
    answer[length - 1] = servo_checksum(answer, length);
    return length;
}
