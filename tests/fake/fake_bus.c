/* SPDX-License-Identifier: MIT */
#include "fake_bus.h"
#include "bus.h"
#include "dxl_packet.h"
#include "trap.h"

#include <string.h>

#define SERVOS 254u
#define LOG_PACKETS 1024u

typedef struct {
    uint8_t size;
    uint8_t bytes[BUS_PACKET_BYTES];
} logged_t;

static fake_servo_t servos[SERVOS];
static logged_t packets[LOG_PACKETS];
static uint16_t sent;
static uint8_t outgoing[BUS_PACKET_BYTES];
static uint8_t rate, latency, polls_left;
static bus_status_t result;
static bus_answer_t last;
static uint8_t answer_params[FAKE_BUS_TABLE_BYTES];
static uint8_t asked_params, tries;
static uint8_t pending_size;
static uint8_t pending[BUS_PACKET_BYTES];   /* the packet that awaits its answer */
static bool through_adapter, lost;
static uint32_t waited;
static bus_counts_t counters;
static ring_t *tap;

void fake_bus_reset(void)
{
    memset(servos, 0, sizeof servos);
    memset(&counters, 0, sizeof counters);
    fake_bus_clear_log();
    rate = BUS_RATE_1M;
    latency = 1;
    polls_left = 0;
    result = BUS_OK;
    tap = NULL;
    through_adapter = false;
    lost = false;
    pending_size = 0;
}

fake_servo_t *fake_bus_servo(uint8_t id)
{
    ASSERT(id < SERVOS);
    return &servos[id];
}

/* Factory values of an AX-12 (DYNAMIXEL.md's control table; voltage 9.6 V, 30 degrees C). */
fake_servo_t *fake_bus_add(uint8_t id, uint8_t servo_rate)
{
    fake_servo_t *servo = fake_bus_servo(id);
    memset(servo, 0, sizeof *servo);
    servo->there = true;
    servo->rate = servo_rate;
    servo->table[DXL_AT_MODEL] = 12;
    servo->table[DXL_AT_ID] = id;
    servo->table[DXL_AT_BAUD] = servo_rate;
    servo->table[DXL_AT_CCW_LIMIT] = 0xFF;
    servo->table[DXL_AT_CCW_LIMIT + 1] = 3;
    servo->table[DXL_AT_RETURN_DELAY] = 250;
    servo->table[DXL_AT_RETURN_LEVEL] = 2;
    servo->table[DXL_AT_CW_SLOPE] = 32;
    servo->table[DXL_AT_CCW_SLOPE] = 32;
    servo->table[DXL_AT_VOLTAGE] = 96;
    servo->table[DXL_AT_TEMPERATURE] = 30;
    fake_bus_set_word(id, DXL_AT_CCW_LIMIT, 1023);
    fake_bus_set_word(id, DXL_AT_MAX_TORQUE, 1023);
    fake_bus_set_word(id, DXL_AT_TORQUE_LIMIT, 1023);
    fake_bus_set_word(id, DXL_AT_GOAL, 512);
    fake_bus_set_word(id, DXL_AT_PRESENT, 512);
    return servo;
}

void fake_bus_set_latency(uint8_t polls)
{
    latency = polls;
}

void fake_bus_set_adapter(bool there)
{
    through_adapter = there;
}

uint32_t fake_bus_waited(void)
{
    return waited;
}

void fake_bus_lose(void)
{
    lost = true;
}

uint16_t fake_bus_word(uint8_t id, uint8_t at)
{
    return (uint16_t)(servos[id].table[at] | servos[id].table[at + 1u] << 8);
}

void fake_bus_set_word(uint8_t id, uint8_t at, uint16_t value)
{
    servos[id].table[at] = (uint8_t)value;
    servos[id].table[at + 1u] = (uint8_t)(value >> 8);
}

uint16_t fake_bus_sent(void)
{
    return sent;
}

const uint8_t *fake_bus_packet(uint16_t index)
{
    ASSERT(index < sent && (uint16_t)(sent - index) <= LOG_PACKETS);
    return packets[index % LOG_PACKETS].bytes;
}

uint8_t fake_bus_packet_size(uint16_t index)
{
    ASSERT(index < sent && (uint16_t)(sent - index) <= LOG_PACKETS);
    return packets[index % LOG_PACKETS].size;
}

void fake_bus_clear_log(void)
{
    sent = 0;
    waited = 0;
}

/* ---- behaviour of the servos ---- */

static void write_table(fake_servo_t *servo, uint8_t at, const uint8_t *data, uint8_t count)
{
    for (uint8_t i = 0; i < count && at + i < FAKE_BUS_TABLE_BYTES; i++) {
        servo->table[at + i] = data[i];
    }
    if (at <= DXL_AT_GOAL && at + count > DXL_AT_GOAL) {
        servo->table[DXL_AT_TORQUE_ENABLE] = 1;   /* as the AX-12 does */
    }
    if (servo->table[DXL_AT_TORQUE_ENABLE] != 0) {
        memcpy(&servo->table[DXL_AT_PRESENT], &servo->table[DXL_AT_GOAL], 2);
    }
    servo->rate = servo->table[DXL_AT_BAUD];
}

static void sync_write(const uint8_t *packet, uint8_t params)
{
    uint8_t at = packet[5], length = packet[6];
    ASSERT(params >= 2 && length > 0 && (params - 2) % (length + 1) == 0);
    for (uint8_t i = 2; i < params; i = (uint8_t)(i + length + 1u)) {
        fake_servo_t *servo = fake_bus_servo(packet[5 + i]);
        if (servo->there && servo->rate == rate && !(servo->faults & (FAKE_BUS_SILENT | FAKE_BUS_DEAF_TO_SYNC))) {
            write_table(servo, at, &packet[6 + i], length);
        }
    }
}

static void action(fake_servo_t *servo)
{
    if (servo->table[DXL_AT_REGISTERED] != 0) {
        servo->table[DXL_AT_REGISTERED] = 0;
        write_table(servo, servo->registered[0], &servo->registered[2], servo->registered[1]);
    }
}

/* Lets one servo execute one instruction. Puts the answer's parameters into answer_params. Returns whether it
 * answers. */
static bool execute(fake_servo_t *servo, const uint8_t *packet, uint8_t params)
{
    uint8_t level = servo->table[DXL_AT_RETURN_LEVEL];
    last.count = 0;
    last.error = servo->error;
    if (servo->mishear_next > 0 && (packet[4] == DXL_WRITE || packet[4] == DXL_REG_WRITE)) {
        servo->mishear_next--;
        last.error |= DXL_ERR_CHECKSUM;
        return level >= 2;
    }
    switch (packet[4]) {
    case DXL_PING:
        return true;
    case DXL_READ:
        ASSERT(params == 2 && packet[5] + packet[6] <= FAKE_BUS_TABLE_BYTES);
        memcpy(answer_params, &servo->table[packet[5]], packet[6]);
        last.count = packet[6];
        return level >= 1;
    case DXL_WRITE:
        ASSERT(params >= 2);
        write_table(servo, packet[5], &packet[6], (uint8_t)(params - 1u));
        return level >= 2;
    case DXL_REG_WRITE:
        ASSERT(params >= 2 && params <= 7);
        servo->registered[0] = packet[5];
        servo->registered[1] = (uint8_t)(params - 1u);
        memcpy(&servo->registered[2], &packet[6], params - 1u);
        servo->table[DXL_AT_REGISTERED] = 1;
        return level >= 2;
    case DXL_ACTION:
        action(servo);
        return level >= 2;
    default:
        return level >= 2;
    }
}

static void broadcast(const uint8_t *packet, uint8_t params)
{
    if (packet[4] == DXL_SYNC_WRITE) {
        sync_write(packet, params);
        return;
    }
    for (uint8_t id = 0; id < SERVOS; id++) {
        if (servos[id].there && servos[id].rate == rate && !(servos[id].faults & FAKE_BUS_SILENT)) {
            (void)execute(&servos[id], packet, params);
        }
    }
}

static bus_status_t answer_of(fake_servo_t *servo, bool answers)
{
    if (!answers) {
        return BUS_ERR_TIMEOUT;
    }
    if (servo->fail_next > 0) {
        servo->fail_next--;
        return BUS_ERR_TIMEOUT;
    }
    if (servo->faults & FAKE_BUS_BAD_CHECKSUM) {
        return BUS_ERR_CHECKSUM;
    }
    if (servo->faults & FAKE_BUS_WRONG_ID) {
        return BUS_ERR_WRONG_ID;
    }
    if (servo->faults & FAKE_BUS_SHORT) {
        return BUS_ERR_LENGTH;
    }
    last.params = answer_params;
    if (last.count == 0 && (last.error & DXL_REJECTED)) {
        return BUS_ERR_REJECTED;
    }
    return last.count == asked_params ? BUS_OK : BUS_ERR_LENGTH;
}

/* Sends the packet once and logs it. */
static bus_status_t send_once(uint8_t size)
{
    logged_t *entry = &packets[sent++ % LOG_PACKETS];
    uint8_t params = (uint8_t)(size - DXL_PACKET_OVERHEAD);
    fake_servo_t *servo = &servos[outgoing[2] < SERVOS ? outgoing[2] : 0];
    entry->size = size;
    memcpy(entry->bytes, outgoing, size);
    counters.packets++;
    if (outgoing[2] == DXL_BROADCAST) {
        broadcast(outgoing, params);
        return asked_params == BUS_NO_ANSWER ? BUS_OK : BUS_ERR_TIMEOUT;
    }
    last.id = outgoing[2];
    if (!servo->there || servo->rate != rate || (servo->faults & FAKE_BUS_SILENT)) {
        return asked_params == BUS_NO_ANSWER ? BUS_OK : BUS_ERR_TIMEOUT;
    }
    bool answers = execute(servo, outgoing, params);
    return asked_params == BUS_NO_ANSWER ? BUS_OK : answer_of(servo, answers);
}

static void count_result(void)
{
    counters.answers += result == BUS_OK && asked_params != BUS_NO_ANSWER;
    counters.timeouts = (uint16_t)(counters.timeouts + (result == BUS_ERR_TIMEOUT));
    counters.checksums = (uint16_t)(counters.checksums + (result == BUS_ERR_CHECKSUM));
    counters.rejected = (uint16_t)(counters.rejected + (result == BUS_ERR_REJECTED));
}

static void check_packet(uint8_t size)
{
    uint8_t sum = 0;
    ASSERT(size >= DXL_PACKET_OVERHEAD && size <= DXL_PACKET_MAX);
    ASSERT(outgoing[0] == 0xFF && outgoing[1] == 0xFF && outgoing[2] != 0xFF && outgoing[3] == size - 4);
    for (uint8_t i = 2; i < size; i++) {
        sum = (uint8_t)(sum + outgoing[i]);
    }
    ASSERT(sum == 0xFF);
}

/* ---- bus.h ---- */

void bus_init(void)
{
    fake_bus_reset();
}

void bus_set_rate(uint8_t divisor)
{
    (void)bus_wait(NULL);
    rate = divisor;
}

uint8_t bus_rate(void)
{
    return rate;
}

static bool may_send_between(void)
{
    return through_adapter && asked_params != BUS_NO_ANSWER && tries == 1;
}

uint8_t *bus_packet(void)
{
    ASSERT(polls_left == 0 || may_send_between());
    return outgoing;
}

bool bus_is_busy(void)
{
    return bus_poll(NULL) == BUS_PENDING;
}

bool bus_is_free(void)
{
    return !bus_is_busy() || may_send_between();
}

void bus_wait_free(void)
{
    while (!bus_is_free()) {
        waited++;
    }
}

bool bus_was_lost(void)
{
    bool was_lost = lost;
    lost = false;
    return was_lost;
}

/* Sends a packet without answer while an answer is pending. */
static bus_status_t send_between(uint8_t size)
{
    const uint8_t asked = asked_params;
    check_packet(size);
    asked_params = BUS_NO_ANSWER;
    (void)send_once(size);
    asked_params = asked;
    return BUS_OK;
}

bus_status_t bus_submit(uint8_t size, uint8_t params, uint8_t allowed_tries)
{
    ASSERT(allowed_tries >= 1 && allowed_tries <= BUS_TRIES_MAX);
    if (pending_size != 0) {
        return params == BUS_NO_ANSWER && may_send_between() ? send_between(size) : BUS_ERR_BUSY;
    }
    check_packet(size);
    memcpy(pending, outgoing, size);
    asked_params = params;
    tries = allowed_tries;
    pending_size = size;
    polls_left = params == BUS_NO_ANSWER && through_adapter ? 0 : latency;
    result = BUS_PENDING;
    return BUS_PENDING;
}

static void finish(void)
{
    memcpy(outgoing, pending, pending_size);
    do {
        result = send_once(pending_size);
        counters.retries = (uint16_t)(counters.retries + (result != BUS_OK && tries > 1));
    } while (result != BUS_OK && --tries > 0);
    count_result();
    pending_size = 0;
}

bus_status_t bus_poll(bus_answer_t *answer)
{
    if (pending_size != 0) {
        if (polls_left > 0) {
            polls_left--;
            return BUS_PENDING;
        }
        finish();
    }
    if (answer != NULL && (result == BUS_OK || result == BUS_ERR_REJECTED)) {
        *answer = last;
    }
    return result;
}

bool bus_has_news(void)
{
    return pending_size != 0;
}

bus_status_t bus_wait(bus_answer_t *answer)
{
    bus_status_t status;
    while ((status = bus_poll(answer)) == BUS_PENDING) {
        waited++;
    }
    return status;
}

void bus_set_tap(ring_t *ring)
{
    tap = ring;
}

void bus_counts(bus_counts_t *counts)
{
    *counts = counters;
}
