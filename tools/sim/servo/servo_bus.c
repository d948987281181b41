/* SPDX-License-Identifier: MIT */
#include "servo_bus.h"

#include <stdlib.h>
#include <string.h>

#include "servo_motion.h"
#include "servo_protocol.h"

#define PROCESS_US 16u   /* the least time between a packet and its answer, also with return delay 0 */
#define TWIN_SKEW_US 3u  /* servos with the same ID do not answer in step */
#define BITS_PER_BYTE 10u /* start, 8 data, stop */

static uint64_t byte_cycles(uint32_t rate_bps)
{
    return (BITS_PER_BYTE * 1000000u * SERVO_CYCLES_PER_US + rate_bps / 2) / rate_bps;
}

static bool is_talking(const servo_talk_t *talk)
{
    return talk->sent < talk->count;
}

static uint64_t byte_end(const servo_talk_t *talk)
{
    return talk->start_cycles + (talk->sent + 1u) * talk->byte_cycles;
}

static uint64_t talk_end(const servo_talk_t *talk)
{
    return talk->start_cycles + talk->count * talk->byte_cycles;
}

/* ---- the wire ---- */

/* Level that one talker puts on the wire. */
static unsigned level_of(const servo_talk_t *talk, uint64_t at_cycles)
{
    if (talk->count == 0 || at_cycles < talk->start_cycles || at_cycles >= talk_end(talk)) {
        return 1;
    }
    const uint64_t since = at_cycles - talk->start_cycles;
    const uint8_t byte = talk->bytes[since / talk->byte_cycles];
    const uint64_t bit = since % talk->byte_cycles * BITS_PER_BYTE / talk->byte_cycles;
    return bit == 0 ? 0 : bit == BITS_PER_BYTE - 1 ? 1 : (unsigned)(byte >> (bit - 1)) & 1;
}

static unsigned level(const servo_bus_t *bus, uint64_t at_cycles)
{
    unsigned level = level_of(&bus->host, at_cycles) & level_of(&bus->noise, at_cycles);
    for (int i = 0; i < bus->count; i++) {
        level &= level_of(&bus->servos[i]->talk, at_cycles);
    }
    return level;
}

static bool overlaps(const servo_talk_t *talk, uint64_t start_cycles, uint64_t end_cycles)
{
    return talk->count > 0 && talk->start_cycles < end_cycles && talk_end(talk) > start_cycles;
}

/* Does anyone but self use the wire in [start, end)? *first: is self the one who began before all others? */
static bool is_shared(const servo_bus_t *bus, const servo_talk_t *self, uint64_t start, uint64_t end, bool *first)
{
    bool shared = self != &bus->host && overlaps(&bus->host, start, end);
    bool self_seen = false; /* of those who began at the same time the first in this order counts */
    *first = true;
    for (int i = -1; i < bus->count; i++) {
        const servo_talk_t *talk = i < 0 ? &bus->noise : &bus->servos[i]->talk;
        if (talk == self || !overlaps(talk, start, end)) {
            self_seen = self_seen || talk == self;
            continue;
        }
        shared = true;
        if (talk->start_cycles < self->start_cycles || (talk->start_cycles == self->start_cycles && !self_seen)) {
            *first = false;
        }
    }
    return shared;
}

/* What a receiver of the right rate gets from the byte time [start, end). Returns false: no stop bit. */
static bool sample(const servo_bus_t *bus, uint64_t start, uint64_t end, uint8_t *byte)
{
    uint8_t value = 0;
    for (unsigned bit = 1; bit <= 8; bit++) {
        value |= (uint8_t)(level(bus, start + (end - start) * (2 * bit + 1) / 20) << (bit - 1));
    }
    *byte = value;
    return level(bus, start + (end - start) * 19 / 20) == 1;
}

/* ---- answering ---- */

static void update_next(servo_bus_t *bus)
{
    bus->next_cycles = is_talking(&bus->noise) ? byte_end(&bus->noise) : SERVO_BUS_NEVER;
    if (bus->body.step && bus->body_cycles + SERVO_STEP_CYCLES < bus->next_cycles) {
        bus->next_cycles = bus->body_cycles + SERVO_STEP_CYCLES;
    }
    for (int i = 0; i < bus->count; i++) {
        const servo_talk_t *talk = &bus->servos[i]->talk;
        if (is_talking(talk) && byte_end(talk) < bus->next_cycles) {
            bus->next_cycles = byte_end(talk);
        }
    }
}

static void say(servo_talk_t *talk, uint64_t start_cycles, uint32_t rate_bps)
{
    talk->start_cycles = start_cycles;
    talk->rate_bps = rate_bps;
    talk->byte_cycles = byte_cycles(rate_bps);
    talk->sent = 0;
}

/* Puts a status packet on its way, spoiled by whatever faults are on. */
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

/* The "two talkers" fault: a question to somebody else is answered with our own ID and no error. */
static void talk_over(servo_t *servo, uint64_t now_cycles, const uint8_t *packet)
{
    const bool question = packet[2] != SERVO_BROADCAST && (packet[4] == SERVO_PING || packet[4] == SERVO_READ);
    if (!question || !servo_fault_take(servo, SERVO_FAULT_TWO_TALKERS)) {
        return;
    }
    uint8_t status[6] = {0xFF, 0xFF, servo->table[SERVO_ID], 2, 0, 0};
    status[5] = servo_checksum(status, sizeof status);
    answer(servo, now_cycles, status, sizeof status, servo_rate_bps(servo),
           servo->table[SERVO_RETURN_DELAY] * 2u + TWIN_SKEW_US);
}

static void take_packet(servo_t *servo, uint64_t now_cycles)
{
    uint8_t status[SERVO_PACKET_MAX];
    const servo_parser_t *parser = &servo->parser;
    const uint32_t rate_bps = servo_rate_bps(servo);
    const uint32_t delay_us = servo->table[SERVO_RETURN_DELAY] * 2u;
    servo_advance(servo, now_cycles);
    if (parser->bytes[2] != servo->table[SERVO_ID] && parser->bytes[2] != SERVO_BROADCAST) {
        talk_over(servo, now_cycles, parser->bytes);
    } else {
        const uint8_t count = servo_obey(servo, parser->bytes, parser->count, status);
        if (count > 0) {
            answer(servo, now_cycles, status, count, rate_bps, delay_us);
        }
    }
    servo_parser_clear(&servo->parser);
}

/* ---- hearing ---- */

/* A UART still reads a byte right when the rates differ by less than half a bit in ten: 4 % is safe. */
static bool rates_match(uint32_t a, uint32_t b)
{
    const uint32_t difference = a > b ? a - b : b - a;
    return (uint64_t)difference * 100 <= (uint64_t)b * 4;
}

static void hear(servo_t *servo, uint64_t start, uint64_t end, uint8_t byte, uint32_t rate_bps, bool bad)
{
    if (!servo->powered) {
        return;
    }
    if (is_talking(&servo->talk)) {
        servo->stats.deaf++;
        return;
    }
    if (bad || !rates_match(rate_bps, servo_rate_bps(servo))) {
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

/* One byte of a servo or of the noise has passed. Of talkers at once the one who began first is heard, spoiled. */
static void pass_byte(servo_bus_t *bus, servo_talk_t *talk)
{
    const uint64_t end = byte_end(talk), start = end - talk->byte_cycles;
    uint8_t byte = talk->bytes[talk->sent];
    bool first, bad = false;
    if (is_shared(bus, talk, start, end, &first)) {
        bus->collisions++;
        bad = !sample(bus, start, end, &byte);
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
        servo_motion_turned(bus->servos[i], bus->shafts[i].angle_rad, bus->shafts[i].speed_rad_s);
        servo_advance(bus->servos[i], bus->body_cycles);
    }
}

static void step_body(servo_bus_t *bus)
{
    for (int i = 0; i < bus->count; i++) {
        bus->shafts[i].torque_nm = servo_motion_torque(bus->servos[i]);
    }
    bus->body.step(bus->body.context, bus->shafts, bus->count);
    bus->body_cycles += SERVO_STEP_CYCLES;
    take_shafts(bus);
}

/* Each servo's shaft as it stands now, in the body or by itself. */
static void look_at_body(servo_bus_t *bus)
{
    for (int i = 0; i < bus->count; i++) {
        servo_t *servo = bus->servos[i];
        servo->in_body = bus->body.step != NULL;
        bus->shafts[i].angle_rad = (servo->position - 512) / SERVO_UNITS_PER_RADIAN;
        bus->shafts[i].speed_rad_s = servo->velocity / SERVO_UNITS_PER_RADIAN;
        servo->step_cycles = bus->body_cycles;
    }
    if (bus->body.look) {
        bus->body.look(bus->body.context, bus->shafts, bus->count);
        take_shafts(bus);
    }
}

void servo_bus_body(servo_bus_t *bus, uint64_t now_cycles, const servo_body_t *body)
{
    servo_bus_advance(bus, now_cycles);
    bus->body = body ? *body : (servo_body_t){0};
    bus->body_cycles = now_cycles - now_cycles % SERVO_STEP_CYCLES;
    look_at_body(bus);
    update_next(bus);
}

/* ---- time ---- */

static void pass_next_byte(servo_bus_t *bus)
{
    servo_talk_t *next = &bus->noise;
    for (int i = 0; i < bus->count; i++) {
        servo_talk_t *talk = &bus->servos[i]->talk;
        if (is_talking(talk) && (!is_talking(next) || byte_end(talk) < byte_end(next))) {
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
        update_next(bus);
    }
    if (now_cycles > bus->now_cycles) {
        bus->now_cycles = now_cycles;
    }
}

void servo_bus_host_byte(servo_bus_t *bus, uint64_t now_cycles, uint8_t byte, uint32_t rate_bps)
{
    servo_bus_advance(bus, now_cycles);
    const uint64_t start = now_cycles - byte_cycles(rate_bps);
    servo_talk_t *host = &bus->host;
    say(host, start, rate_bps);
    host->bytes[0] = byte;
    host->count = host->sent = 1;
    bool first, bad = false;
    if (is_shared(bus, host, start, now_cycles, &first)) {
        bus->collisions++;
        bad = !sample(bus, start, now_cycles, &byte);
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
    update_next(bus);
}

void servo_bus_noise(servo_bus_t *bus, uint64_t now_cycles, const uint8_t *bytes, uint8_t count, uint32_t rate_bps)
{
    servo_bus_advance(bus, now_cycles);
    bus->noise.count = count > SERVO_PACKET_MAX ? SERVO_PACKET_MAX : count;
    memcpy(bus->noise.bytes, bytes, bus->noise.count);
    say(&bus->noise, now_cycles, rate_bps);
    update_next(bus);
}

/* ---- the set of servos ---- */

servo_bus_t *servo_bus_new(void)
{
    servo_bus_t *bus = calloc(1, sizeof *bus);
    if (bus) {
        bus->powered = true;
        bus->supply_v = 9.6;
        bus->next_cycles = SERVO_BUS_NEVER;
    }
    return bus;
}

void servo_bus_free(servo_bus_t *bus)
{
    if (bus) {
        for (int i = 0; i < bus->count; i++) {
            free(bus->servos[i]);
        }
        free(bus->servos);
        free(bus->shafts);
        free(bus);
    }
}

servo_t *servo_bus_find(const servo_bus_t *bus, uint8_t id)
{
    for (int i = 0; i < bus->count; i++) {
        if (bus->servos[i]->table[SERVO_ID] == id) {
            return bus->servos[i];
        }
    }
    return NULL;
}

servo_t *servo_bus_add(servo_bus_t *bus, uint8_t id, servo_model_t model, uint32_t rate_bps)
{
    servo_t *servo = malloc(sizeof *servo);
    servo_t **servos = realloc(bus->servos, (size_t)(bus->count + 1) * sizeof *servos);
    if (servos) {
        bus->servos = servos;
    }
    servo_shaft_t *shafts = realloc(bus->shafts, (size_t)(bus->count + 1) * sizeof *shafts);
    if (shafts) {
        bus->shafts = shafts;
    }
    if (servo == NULL || servos == NULL || shafts == NULL) {
        free(servo);
        return NULL;
    }
    servo_init(servo, id, model, rate_bps);
    for (int i = 0; i < bus->count; i++) {
        if (bus->servos[i]->table[SERVO_ID] == id) {
            servo->skew_us = (uint16_t)(servo->skew_us + TWIN_SKEW_US);
        }
    }
    servo->supply_v = bus->supply_v;
    servo->step_cycles = bus->now_cycles - bus->now_cycles % SERVO_STEP_CYCLES;
    shafts[bus->count] = (servo_shaft_t){.id = id};
    bus->servos[bus->count++] = servo;
    if (bus->body.step) {
        look_at_body(bus);
    }
    servo_power(servo, bus->now_cycles, bus->powered);
    return servo;
}

void servo_bus_power(servo_bus_t *bus, uint64_t now_cycles, bool on)
{
    servo_bus_advance(bus, now_cycles);
    bus->powered = on;
    for (int i = 0; i < bus->count; i++) {
        servo_power(bus->servos[i], now_cycles, on && !servo_fault_is_on(bus->servos[i], SERVO_FAULT_DEAD));
    }
    update_next(bus);
}

void servo_bus_supply(servo_bus_t *bus, uint64_t now_cycles, double volts)
{
    servo_bus_advance(bus, now_cycles);
    bus->supply_v = volts;
    for (int i = 0; i < bus->count; i++) {
        servo_advance(bus->servos[i], now_cycles);
        bus->servos[i]->supply_v = volts;
    }
}

static void set_fault(servo_bus_t *bus, servo_t *servo, servo_fault_t fault, uint32_t answers)
{
    servo_fault_set(servo, fault, answers);
    servo_power(servo, bus->now_cycles, bus->powered && !servo_fault_is_on(servo, SERVO_FAULT_DEAD));
    servo_advance(servo, bus->now_cycles);
}

/* The twin of a duplicate ID stays plugged in; without the fault it is dead. */
static void set_twin(servo_bus_t *bus, const servo_t *servo, bool on)
{
    const uint8_t id = servo->table[SERVO_ID];
    servo_t *twin = NULL;
    for (int i = 0; i < bus->count; i++) {
        if (bus->servos[i] != servo && bus->servos[i]->table[SERVO_ID] == id) {
            twin = bus->servos[i];
        }
    }
    if (twin == NULL && on) {
        twin = servo_bus_add(bus, id, servo->model, servo_rate_bps(servo));
    }
    if (twin) {
        set_fault(bus, twin, SERVO_FAULT_DEAD, on ? 0 : SERVO_FAULT_ALWAYS);
    }
}

void servo_bus_fault(servo_bus_t *bus, uint64_t now_cycles, servo_t *servo, servo_fault_t fault, uint32_t answers)
{
    servo_bus_advance(bus, now_cycles);
    servo_advance(servo, now_cycles);
    if (fault == SERVO_FAULT_DUPLICATE) {
        set_twin(bus, servo, answers > 0);
    }
    set_fault(bus, servo, fault, answers);
    update_next(bus);
}
