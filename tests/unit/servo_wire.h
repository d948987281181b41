/* SPDX-License-Identifier: MIT
 * servo_wire.h - for the servo tests: a bus, and a controller that sends bytes at line rate and records what it
 * receives. */
#ifndef SERVO_WIRE_H
#define SERVO_WIRE_H

#include <string.h>

#include "servo_bus.h"
#include "unity.h"

#define US ((uint64_t)16)
#define MS ((uint64_t)16000)

typedef struct {
    servo_bus_t *bus;
    uint64_t now;
    uint32_t rate_bps;
    uint8_t heard[512];
    uint64_t heard_at[512]; /* end of the stop bit */
    int count, bad;
} wire_t;

static inline void wire_heard(void *context, uint64_t now, uint8_t byte, uint32_t rate_bps, bool bad)
{
    wire_t *wire = context;
    wire->heard[wire->count] = byte;
    wire->heard_at[wire->count++] = now;
    wire->bad += bad || rate_bps * 25 > wire->rate_bps * 26 || rate_bps * 25 < wire->rate_bps * 24; /* over 4 % off */
}

static inline void wire_open(wire_t *wire)
{
    memset(wire, 0, sizeof *wire);
    wire->bus = servo_bus_new();
    wire->bus->on_byte = wire_heard;
    wire->bus->on_byte_context = wire;
    wire->rate_bps = 1000000;
}

static inline void wire_close(wire_t *wire)
{
    servo_bus_free(wire->bus);
}

static inline void wire_wait(wire_t *wire, uint64_t cycles)
{
    wire->now += cycles;
    servo_bus_advance(wire->bus, wire->now);
}

/* Sends bytes back to back, starting now. wire->now is the end of the last stop bit afterwards. */
static inline void wire_send(wire_t *wire, const uint8_t *bytes, int count)
{
    for (int i = 0; i < count; i++) {
        wire->now += 10 * 16000000ull / wire->rate_bps;
        servo_bus_host_byte(wire->bus, wire->now, bytes[i], wire->rate_bps);
    }
}

/* Forgets earlier input, sends, and listens for 5 ms. */
static inline void wire_ask(wire_t *wire, const uint8_t *bytes, int count)
{
    wire->count = wire->bad = 0;
    wire_send(wire, bytes, count);
    wire_wait(wire, 5 * MS);
}

#define SEND(wire, ...)                                                                                               \
    do {                                                                                                              \
        const uint8_t sent_[] = {__VA_ARGS__};                                                                        \
        wire_send(wire, sent_, sizeof sent_);                                                                         \
    } while (0)
#define ASK(wire, ...)                                                                                                \
    do {                                                                                                              \
        const uint8_t sent_[] = {__VA_ARGS__};                                                                        \
        wire_ask(wire, sent_, sizeof sent_);                                                                          \
    } while (0)
#define EXPECT_ANSWER(wire, ...)                                                                                      \
    do {                                                                                                              \
        const uint8_t expected_[] = {__VA_ARGS__};                                                                    \
        TEST_ASSERT_EQUAL_INT_MESSAGE(sizeof expected_, (wire)->count, "length of the answer");                       \
        TEST_ASSERT_EQUAL_HEX8_ARRAY(expected_, (wire)->heard, sizeof expected_);                                     \
        TEST_ASSERT_EQUAL_INT_MESSAGE(0, (wire)->bad, "framing errors");                                              \
    } while (0)
#define EXPECT_SILENCE(wire) TEST_ASSERT_EQUAL_INT_MESSAGE(0, (wire)->count, "bytes heard")

static inline uint16_t register_of(wire_t *wire, servo_t *servo, uint8_t address, uint8_t bytes)
{
    servo_advance(servo, wire->now);
    return servo_get(servo, address, bytes);
}

#endif
