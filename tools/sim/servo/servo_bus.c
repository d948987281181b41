/* SPDX-License-Identifier: MIT
 * servo_bus.c - time on the bus: bytes pass, servos receive and reply, the body is stepped. */
#include "servo_bus.h"

#include <math.h>
#include <string.h>

#include "servo_motion.h"
#include "servo_protocol.h"
#include "servo_wire.h"

#define PROCESS_US 16u /* least time between a packet and its reply, even with return delay 0 */

/* ---- replying ---- */

static void say(servo_talk_t *talk, uint64_t start_cycles, uint32_t rate_bps)
{
    talk->start_cycles = start_cycles;
    talk->rate_bps = rate_bps;
    talk->byte_cycles = servo_wire_byte_cycles(rate_bps);
    talk->sent = 0;
}

/* Schedules a status packet, spoiled by the active faults. */
static void answer(servo_t *servo, uint64_t now_cycles, const uint8_t *packet, uint8_t count, uint32_t rate_bps,
                   uint32_t delay_us)
{
    if (servo_fault_take(servo, SERVO_FAULT_SILENT)) {
        return;
    }
    servo_talk_t *talk = &servo->talk;
    talk->count = 0;
    if (servo_fault_take(servo, SERVO_FAULT_NOISE)) {
        talk->bytes[talk->count++] = servo_noise_byte(servo);
        talk->bytes[talk->count++] = servo_noise_byte(servo);
    }
    memcpy(talk->bytes + talk->count, packet, count);
    talk->count = (uint16_t)(talk->count + count);
    if (servo_fault_take(servo, SERVO_FAULT_CHECKSUM)) {
        talk->bytes[talk->count - 1] ^= 0x10;
    }
    if (servo_fault_take(servo, SERVO_FAULT_SHORT)) {
        talk->count = (uint16_t)(talk->count - count / 2);
    }
    if (servo_fault_take(servo, SERVO_FAULT_LATE)) {
        delay_us += servo->late_us;
    }
    delay_us = (delay_us < PROCESS_US ? PROCESS_US : delay_us) + servo->skew_us;
    say(talk, now_cycles + (uint64_t)delay_us * SERVO_CYCLES_PER_US, rate_bps);
    servo->stats.answers++;
}

/* The "two talkers" fault: replies to a request for another servo, with its own ID and no error. */
static void talk_over(servo_t *servo, uint64_t now_cycles, const uint8_t *packet)
{
    const bool question = packet[2] != SERVO_BROADCAST && (packet[4] == SERVO_PING || packet[4] == SERVO_READ);
    if (!question || !servo_fault_take(servo, SERVO_FAULT_TWO_TALKERS)) {
        return;
    }
    uint8_t status[6] = {0xFF, 0xFF, servo->table[SERVO_ID], 2, 0, 0};
    status[5] = servo_checksum(status, sizeof status);
    answer(servo, now_cycles, status, sizeof status, servo_rate_bps(servo),
           servo->table[SERVO_RETURN_DELAY] * 2u + SERVO_TWIN_SKEW_US);
}

/* The "mishears" fault: the last bit of a WRITE arrives wrong. */
static void spoil_write(servo_t *servo, servo_parser_t *parser)
{
    if ((parser->bytes[4] == SERVO_WRITE_DATA || parser->bytes[4] == SERVO_REG_WRITE) &&
        servo_fault_take(servo, SERVO_FAULT_MISHEARS)) {
        parser->bytes[parser->count - 1] ^= 0x80;
    }
}

static void take_packet(servo_t *servo, uint64_t now_cycles)
{
    uint8_t status[SERVO_PACKET_MAX];
    servo_parser_t *parser = &servo->parser;
    const uint32_t rate_bps = servo_rate_bps(servo);
    const uint32_t delay_us = servo->table[SERVO_RETURN_DELAY] * 2u;
    servo_advance(servo, now_cycles);
    if (parser->bytes[2] != servo->table[SERVO_ID] && parser->bytes[2] != SERVO_BROADCAST) {
        talk_over(servo, now_cycles, parser->bytes);
    } else {
        spoil_write(servo, parser);
        const uint8_t count = servo_obey(servo, parser->bytes, parser->count, status);
        if (count > 0) {
            answer(servo, now_cycles, status, count, rate_bps, delay_us);
        }
    }
    servo_parser_clear(&servo->parser);
}

/* ---- receiving ---- */

/* A UART still reads a byte correctly if the rates differ by less than half a bit in ten. 4 % is safe. */
static bool rates_match(uint32_t a, uint32_t b)
{
    const uint32_t difference = a > b ? a - b : b - a;
    return (uint64_t)difference * 100 <= (uint64_t)b * 4;
}

/* The common case comes first: the division would cost a tenth of all simulated time. */
static bool hears_rate(const servo_t *servo, uint32_t rate_bps)
{
    return (rate_bps == 1000000u && servo->table[SERVO_BAUD] == 1) || rates_match(rate_bps, servo_rate_bps(servo));
}

static void hear(servo_t *servo, uint64_t start, uint64_t end, uint8_t byte, uint32_t rate_bps, bool bad)
{
    if (!servo->powered) {
        return;
    }
    if (servo_wire_is_talking(&servo->talk)) {
        servo->stats.deaf++;
        return;
    }
    if (bad || !hears_rate(servo, rate_bps)) {
        servo->stats.framing_errors++;
        servo_parser_clear(&servo->parser);
        return;
    }
    if (servo_parser_byte(&servo->parser, &servo->stats, start, end, byte)) {
        take_packet(servo, end);
    }
}

static void hear_all(servo_bus_t *bus, const servo_talk_t *talker, uint64_t start, uint64_t end, uint8_t byte,
                     bool bad)
{
    for (int i = 0; i < bus->count; i++) {
        if (&bus->servos[i]->talk != talker) {
            hear(bus->servos[i], start, end, byte, talker->rate_bps, bad);
        }
    }
}

/* A byte of a servo or of the noise has passed. Of simultaneous senders, only the first to begin is received,
 * spoiled. */
static void pass_byte(servo_bus_t *bus, servo_talk_t *talk)
{
    const uint64_t end = servo_wire_byte_end(talk), start = end - talk->byte_cycles;
    uint8_t byte = talk->bytes[talk->sent];
    bool first, bad = false;
    if (servo_wire_is_shared(bus, talk, start, end, &first)) {
        bus->collisions++;
        bad = !servo_wire_sample(bus, start, end, &byte);
    }
    talk->sent++;
    if (!first) {
        return;
    }
    hear_all(bus, talk, start, end, byte, bad);
    if (bus->on_byte) {
        bus->on_byte(bus->on_byte_context, end, byte, talk->rate_bps, bad);
    }
}

/* ---- the body ---- */

static void take_shafts(servo_bus_t *bus)
{
    for (int i = 0; i < bus->count; i++) {
        if (bus->servos[i]->in_body) {
            servo_motion_turned(bus->servos[i], bus->shafts[i].angle_rad, bus->shafts[i].speed_rad_s);
            servo_advance(bus->servos[i], bus->body_cycles);
        }
    }
}

static void step_body(servo_bus_t *bus)
{
    for (int i = 0; i < bus->count; i++) {
        bus->shafts[i].torque_nm = bus->servos[i]->in_body ? servo_motion_torque(bus->servos[i]) : 0;
    }
    bus->body.step(bus->body.context, bus->shafts, bus->count);
    bus->body_cycles += SERVO_STEP_CYCLES;
    take_shafts(bus);
}

void servo_bus_look_at_body(servo_bus_t *bus)
{
    for (int i = 0; i < bus->count; i++) {
        servo_t *servo = bus->servos[i];
        bus->shafts[i].angle_rad = (servo->position - 512) / SERVO_UNITS_PER_RADIAN;
        bus->shafts[i].speed_rad_s = servo->velocity / SERVO_UNITS_PER_RADIAN;
        servo->step_cycles = bus->body_cycles;
    }
    if (bus->body.look) {
        bus->body.look(bus->body.context, bus->shafts, bus->count);
    }
    for (int i = 0; i < bus->count; i++) {
        bus->servos[i]->in_body = bus->body.step != NULL && !isnan(bus->shafts[i].angle_rad);
    }
    take_shafts(bus);
}

void servo_bus_body(servo_bus_t *bus, uint64_t now_cycles, const servo_body_t *body)
{
    servo_bus_advance(bus, now_cycles);
    bus->body = body ? *body : (servo_body_t){0};
    bus->body_cycles = now_cycles - now_cycles % SERVO_STEP_CYCLES;
    servo_bus_look_at_body(bus);
    servo_bus_update_next(bus);
}

/* ---- time ---- */

void servo_bus_update_next(servo_bus_t *bus)
{
    bus->next_cycles = servo_wire_is_talking(&bus->noise) ? servo_wire_byte_end(&bus->noise) : SERVO_BUS_NEVER;
    if (bus->body.step && bus->body_cycles + SERVO_STEP_CYCLES < bus->next_cycles) {
        bus->next_cycles = bus->body_cycles + SERVO_STEP_CYCLES;
    }
    for (int i = 0; i < bus->count; i++) {
        const servo_talk_t *talk = &bus->servos[i]->talk;
        if (servo_wire_is_talking(talk) && servo_wire_byte_end(talk) < bus->next_cycles) {
            bus->next_cycles = servo_wire_byte_end(talk);
        }
    }
}

static void pass_next_byte(servo_bus_t *bus)
{
    servo_talk_t *next = &bus->noise;
    for (int i = 0; i < bus->count; i++) {
        servo_talk_t *talk = &bus->servos[i]->talk;
        if (servo_wire_is_talking(talk)
            && (!servo_wire_is_talking(next) || servo_wire_byte_end(talk) < servo_wire_byte_end(next))) {
            next = talk;
        }
    }
    pass_byte(bus, next);
}

void servo_bus_advance(servo_bus_t *bus, uint64_t now_cycles)
{
    while (bus->next_cycles <= now_cycles) {
        bus->now_cycles = bus->next_cycles;
        if (bus->body.step && bus->next_cycles == bus->body_cycles + SERVO_STEP_CYCLES) {
            step_body(bus);
        } else {
            pass_next_byte(bus);
        }
        servo_bus_update_next(bus);
    }
    if (now_cycles > bus->now_cycles) {
        bus->now_cycles = now_cycles;
    }
}

void servo_bus_host_byte(servo_bus_t *bus, uint64_t now_cycles, uint8_t byte, uint32_t rate_bps)
{
    servo_bus_advance(bus, now_cycles);
    const uint64_t start = now_cycles - servo_wire_byte_cycles(rate_bps);
    servo_talk_t *host = &bus->host;
    say(host, start, rate_bps);
    host->bytes[0] = byte;
    host->count = host->sent = 1;
    bool first, bad = false;
    if (servo_wire_is_shared(bus, host, start, now_cycles, &first)) {
        bus->collisions++;
        bad = !servo_wire_sample(bus, start, now_cycles, &byte);
    }
    hear_all(bus, host, start, now_cycles, byte, bad);
    if (bad) {
        servo_parser_clear(&bus->host_parser);
    } else if (servo_parser_byte(&bus->host_parser, NULL, start, now_cycles, byte)) {
        const servo_parser_t *packet = &bus->host_parser;
        if (bus->on_packet && servo_checksum(packet->bytes, packet->count) == packet->bytes[packet->count - 1]) {
            bus->on_packet(bus->on_packet_context, now_cycles, packet->bytes, packet->count);
        }
        servo_parser_clear(&bus->host_parser);
    }
    servo_bus_update_next(bus);
}

/* ---- whole packets ---- */

static bool is_quiet(const servo_talk_t *talk, uint64_t since_cycles)
{
    return talk->count == 0 || servo_wire_talk_end(talk) <= since_cycles;
}

/* Whether every servo receives the packet whole, with no other byte since the last one. */
static bool is_plain(const servo_bus_t *bus, uint64_t start, const uint8_t *packet, uint8_t count, uint32_t rate_bps)
{
    bool plain = count >= 6 && count <= SERVO_PACKET_MAX && packet[0] == 0xFF && packet[1] == 0xFF && packet[2] != 0xFF &&
                 packet[3] >= 2 && packet[3] + 4 == count && packet[count - 1] == servo_checksum(packet, count) &&
                 bus->host_parser.count == 0 && is_quiet(&bus->noise, start) && is_quiet(&bus->host, start);
    for (int i = 0; i < bus->count && plain; i++) {
        const servo_t *servo = bus->servos[i];
        plain = is_quiet(&servo->talk, start) &&
                (!servo->powered || (servo->parser.count == 0 && hears_rate(servo, rate_bps)));
    }
    return plain;
}

static void hear_packet(servo_t *servo, uint64_t end, const uint8_t *packet, uint8_t count)
{
    if (!servo->powered) {
        return;
    }
    servo->parser.last_end_cycles = end;
    if (packet[2] != servo->table[SERVO_ID] && packet[2] != SERVO_BROADCAST) {
        talk_over(servo, end, packet);
        return;
    }
    memcpy(servo->parser.bytes, packet, count);
    servo->parser.count = count;
    take_packet(servo, end);
}

void servo_bus_host_packet(servo_bus_t *bus, uint64_t now_cycles, const uint8_t *packet, uint8_t count, uint32_t rate_bps)
{
    const uint64_t byte_cycles = servo_wire_byte_cycles(rate_bps), start = now_cycles - count * byte_cycles;
    if (bus->next_cycles <= now_cycles || !is_plain(bus, start, packet, count, rate_bps)) {
        for (uint8_t i = 0; i < count; i++) {
            servo_bus_host_byte(bus, start + (i + 1u) * byte_cycles, packet[i], rate_bps);
        }
        return;
    }
    servo_bus_advance(bus, now_cycles);
    say(&bus->host, now_cycles - byte_cycles, rate_bps);
    bus->host.bytes[0] = packet[count - 1];
    bus->host.count = bus->host.sent = 1;
    bus->host_parser.last_end_cycles = now_cycles;
    for (int i = 0; i < bus->count; i++) {
        hear_packet(bus->servos[i], now_cycles, packet, count);
    }
    if (bus->on_packet) {
        bus->on_packet(bus->on_packet_context, now_cycles, packet, count);
    }
    servo_bus_update_next(bus);
}

void servo_bus_noise(servo_bus_t *bus, uint64_t now_cycles, const uint8_t *bytes, uint8_t count, uint32_t rate_bps)
{
    servo_bus_advance(bus, now_cycles);
    bus->noise.count = count > SERVO_PACKET_MAX ? SERVO_PACKET_MAX : count;
    memcpy(bus->noise.bytes, bytes, bus->noise.count);
    say(&bus->noise, now_cycles, rate_bps);
    servo_bus_update_next(bus);
}
