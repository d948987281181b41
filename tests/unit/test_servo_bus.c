/* SPDX-License-Identifier: MIT
 * Protocol 1.0 on the wire. Packets worked out by hand: checksum = inverted low byte of ID + LEN + INST + parameters.
 * Those marked "manual" are examples of the public AX-12 manual. */
#include "servo_wire.h"

static wire_t wire;
static servo_t *one;

void setUp(void)
{
    wire_open(&wire);
    one = servo_bus_add(wire.bus, 1, SERVO_AX12, 1000000);
    wire.now = MS;
    servo_bus_advance(wire.bus, wire.now);
}

void tearDown(void)
{
    wire_close(&wire);
}

#define PING_1 0xFF, 0xFF, 0x01, 0x02, 0x01, 0xFB
#define FINE_1 0xFF, 0xFF, 0x01, 0x02, 0x00, 0xFC

static void test_servo_bus_ping_is_answered(void)
{
    ASK(&wire, PING_1); /* manual */
    EXPECT_ANSWER(&wire, FINE_1);
}

static void test_servo_bus_answer_starts_after_the_return_delay(void)
{
    SEND(&wire, PING_1);
    const uint64_t asked = wire.now;
    wire_wait(&wire, 5 * MS);
    TEST_ASSERT_EQUAL_UINT64(asked + 500 * US + 10 * US, wire.heard_at[0]); /* 250 * 2 us, then ten bits */
    TEST_ASSERT_EQUAL_UINT64(asked + 500 * US + 60 * US, wire.heard_at[5]);
}

static void test_servo_bus_return_delay_0_answers_within_20_us(void)
{
    ASK(&wire, 0xFF, 0xFF, 0x01, 0x04, 0x03, 0x05, 0x00, 0xF2);
    wire.count = 0;
    SEND(&wire, PING_1);
    const uint64_t asked = wire.now;
    wire_wait(&wire, MS);
    TEST_ASSERT_EQUAL_INT(6, wire.count);
    TEST_ASSERT_UINT64_WITHIN(10 * US, asked + 20 * US, wire.heard_at[0]); /* stop bit; the byte began 10 us before */
}

static void test_servo_bus_next_event_is_the_end_of_the_next_byte(void)
{
    TEST_ASSERT_EQUAL_UINT64(SERVO_BUS_NEVER, servo_bus_next_cycles(wire.bus));
    SEND(&wire, PING_1);
    TEST_ASSERT_EQUAL_UINT64(wire.now + 510 * US, servo_bus_next_cycles(wire.bus));
    wire_wait(&wire, 510 * US);
    TEST_ASSERT_EQUAL_INT(1, wire.count);
    TEST_ASSERT_EQUAL_UINT64(wire.now + 10 * US, servo_bus_next_cycles(wire.bus));
    wire_wait(&wire, 50 * US);
    TEST_ASSERT_EQUAL_UINT64(SERVO_BUS_NEVER, servo_bus_next_cycles(wire.bus));
}

static void test_servo_bus_read_temperature(void)
{
    one->ambient_c = one->temperature_c = 32;
    ASK(&wire, 0xFF, 0xFF, 0x01, 0x04, 0x02, 0x2B, 0x01, 0xCC);     /* manual */
    EXPECT_ANSWER(&wire, 0xFF, 0xFF, 0x01, 0x03, 0x00, 0x20, 0xDB); /* manual: 32 degrees */
}

static void test_servo_bus_read_of_model_and_whole_table(void)
{
    ASK(&wire, 0xFF, 0xFF, 0x01, 0x04, 0x02, 0x00, 0x02, 0xF6);
    EXPECT_ANSWER(&wire, 0xFF, 0xFF, 0x01, 0x04, 0x00, 0x0C, 0x00, 0xEE);
    ASK(&wire, 0xFF, 0xFF, 0x01, 0x04, 0x02, 0x00, 0x32, 0xC6);
    TEST_ASSERT_EQUAL_INT(56, wire.count);
    TEST_ASSERT_EQUAL_HEX8(0, wire.heard[4]);
}

static void test_servo_bus_read_past_the_table_is_a_range_error(void)
{
    ASK(&wire, 0xFF, 0xFF, 0x01, 0x04, 0x02, 0x31, 0x02, 0xC5);
    EXPECT_ANSWER(&wire, 0xFF, 0xFF, 0x01, 0x02, 0x08, 0xF4);
}

static void test_servo_bus_write_goal_and_speed(void)
{
    ASK(&wire, 0xFF, 0xFF, 0x01, 0x07, 0x03, 0x1E, 0x00, 0x02, 0x00, 0x02, 0xD2); /* manual, for ID 0: D3 */
    EXPECT_ANSWER(&wire, FINE_1);
    TEST_ASSERT_EQUAL_UINT16(512, servo_get(one, SERVO_GOAL, 2));
    TEST_ASSERT_EQUAL_UINT16(512, servo_get(one, SERVO_SPEED, 2));
    TEST_ASSERT_EQUAL_UINT8(1, one->table[SERVO_TORQUE_ENABLE]);
}

static void test_servo_bus_write_of_a_wrong_value_changes_nothing(void)
{
    ASK(&wire, 0xFF, 0xFF, 0x01, 0x05, 0x03, 0x1E, 0x00, 0x04, 0xD4); /* goal 1024 */
    EXPECT_ANSWER(&wire, 0xFF, 0xFF, 0x01, 0x02, 0x08, 0xF4);
    TEST_ASSERT_EQUAL_UINT16(512, servo_get(one, SERVO_GOAL, 2));
    ASK(&wire, 0xFF, 0xFF, 0x01, 0x04, 0x03, 0x24, 0x01, 0xD2); /* present position is read-only */
    EXPECT_ANSWER(&wire, 0xFF, 0xFF, 0x01, 0x02, 0x08, 0xF4);
}

static void test_servo_bus_wrong_checksum_is_reported(void)
{
    ASK(&wire, 0xFF, 0xFF, 0x01, 0x02, 0x01, 0xFA);
    EXPECT_ANSWER(&wire, 0xFF, 0xFF, 0x01, 0x02, 0x10, 0xEC);
    TEST_ASSERT_EQUAL_UINT32(1, one->stats.checksum_errors);
}

static void test_servo_bus_unknown_instruction_and_action_alone_are_instruction_errors(void)
{
    ASK(&wire, 0xFF, 0xFF, 0x01, 0x02, 0x07, 0xF5);
    EXPECT_ANSWER(&wire, 0xFF, 0xFF, 0x01, 0x02, 0x40, 0xBC);
    ASK(&wire, 0xFF, 0xFF, 0x01, 0x02, 0x05, 0xF7);
    EXPECT_ANSWER(&wire, 0xFF, 0xFF, 0x01, 0x02, 0x40, 0xBC);
}

static void test_servo_bus_registered_write_waits_for_action(void)
{
    ASK(&wire, 0xFF, 0xFF, 0x01, 0x05, 0x04, 0x1E, 0x00, 0x03, 0xD4); /* goal 768 */
    EXPECT_ANSWER(&wire, FINE_1);
    TEST_ASSERT_EQUAL_UINT16(512, servo_get(one, SERVO_GOAL, 2));
    TEST_ASSERT_EQUAL_UINT8(1, one->table[SERVO_REGISTERED]);
    ASK(&wire, 0xFF, 0xFF, 0xFE, 0x02, 0x05, 0xFA); /* manual */
    EXPECT_SILENCE(&wire);
    TEST_ASSERT_EQUAL_UINT16(768, servo_get(one, SERVO_GOAL, 2));
    TEST_ASSERT_EQUAL_UINT8(0, one->table[SERVO_REGISTERED]);
}

static void test_servo_bus_broadcast_is_never_answered_but_ping(void)
{
    ASK(&wire, 0xFF, 0xFF, 0xFE, 0x04, 0x02, 0x2B, 0x01, 0xCF);
    EXPECT_SILENCE(&wire);
    ASK(&wire, 0xFF, 0xFF, 0xFE, 0x04, 0x03, 0x19, 0x01, 0xE0); /* LED on */
    EXPECT_SILENCE(&wire);
    TEST_ASSERT_EQUAL_UINT8(1, one->table[SERVO_LED]);
    ASK(&wire, 0xFF, 0xFF, 0xFE, 0x02, 0x01, 0xFE);
    EXPECT_ANSWER(&wire, FINE_1);
}

static void test_servo_bus_new_id_holds_after_the_answer(void)
{
    ASK(&wire, 0xFF, 0xFF, 0x01, 0x04, 0x03, 0x03, 0x05, 0xEF);
    EXPECT_ANSWER(&wire, FINE_1);
    ASK(&wire, PING_1);
    EXPECT_SILENCE(&wire);
    ASK(&wire, 0xFF, 0xFF, 0x05, 0x02, 0x01, 0xF7);
    EXPECT_ANSWER(&wire, 0xFF, 0xFF, 0x05, 0x02, 0x00, 0xF8);
}

static void test_servo_bus_reset_restores_what_was_shipped(void)
{
    servo_t *zero = servo_bus_add(wire.bus, 0, SERVO_AX12, 1000000);
    one->table[SERVO_ID] = 9;
    zero->table[SERVO_RETURN_DELAY] = 7;
    ASK(&wire, 0xFF, 0xFF, 0x00, 0x02, 0x06, 0xF7);           /* manual */
    EXPECT_ANSWER(&wire, 0xFF, 0xFF, 0x00, 0x02, 0x00, 0xFD); /* manual: the answer has the old ID */
    TEST_ASSERT_EQUAL_UINT8(1, zero->table[SERVO_ID]);
    TEST_ASSERT_EQUAL_UINT8(250, zero->table[SERVO_RETURN_DELAY]);
}

static void test_servo_bus_return_level_1_answers_reads_and_0_only_ping(void)
{
    ASK(&wire, 0xFF, 0xFF, 0x01, 0x04, 0x03, 0x10, 0x01, 0xE6); /* level 1: no answer to WRITEs, not even this one */
    ASK(&wire, 0xFF, 0xFF, 0x01, 0x04, 0x03, 0x19, 0x01, 0xDD);
    EXPECT_SILENCE(&wire);
    ASK(&wire, 0xFF, 0xFF, 0x01, 0x04, 0x02, 0x19, 0x01, 0xDE);
    EXPECT_ANSWER(&wire, 0xFF, 0xFF, 0x01, 0x03, 0x00, 0x01, 0xFA);
    ASK(&wire, 0xFF, 0xFF, 0x01, 0x04, 0x03, 0x10, 0x00, 0xE7);
    ASK(&wire, 0xFF, 0xFF, 0x01, 0x04, 0x02, 0x19, 0x01, 0xDE);
    EXPECT_SILENCE(&wire);
    ASK(&wire, PING_1);
    EXPECT_ANSWER(&wire, FINE_1);
}

static void test_servo_bus_sync_write_reaches_each_servo(void)
{
    servo_t *zero = servo_bus_add(wire.bus, 0, SERVO_AX12, 1000000);
    servo_t *two = servo_bus_add(wire.bus, 2, SERVO_AX12, 1000000);
    servo_t *three = servo_bus_add(wire.bus, 3, SERVO_AX12, 1000000);
    ASK(&wire, 0xFF, 0xFF, 0xFE, 0x18, 0x83, 0x1E, 0x04, 0x00, 0x10, 0x00, 0x50, 0x01, 0x01, 0x20, 0x02, 0x60, 0x03,
        0x02, 0x30, 0x00, 0x70, 0x01, 0x03, 0x20, 0x02, 0x80, 0x03, 0x12); /* manual */
    EXPECT_SILENCE(&wire);
    TEST_ASSERT_EQUAL_HEX16(0x010, servo_get(zero, SERVO_GOAL, 2));
    TEST_ASSERT_EQUAL_HEX16(0x150, servo_get(zero, SERVO_SPEED, 2));
    TEST_ASSERT_EQUAL_HEX16(0x220, servo_get(one, SERVO_GOAL, 2));
    TEST_ASSERT_EQUAL_HEX16(0x030, servo_get(two, SERVO_GOAL, 2));
    TEST_ASSERT_EQUAL_HEX16(0x220, servo_get(three, SERVO_GOAL, 2));
    TEST_ASSERT_EQUAL_HEX16(0x380, servo_get(three, SERVO_SPEED, 2));
}

/* A sync write of goals (L = 2) for n servos, IDs 1..n, all to 0x0200: LEN = 3 n + 4. */
static void sync_write_goals(int n)
{
    uint8_t packet[256] = {0xFF, 0xFF, 0xFE, (uint8_t)(3 * n + 4), 0x83, 0x1E, 0x02};
    unsigned sum = 0xFEu + (unsigned)(3 * n + 4) + 0x83 + 0x1E + 0x02;
    for (int i = 0; i < n; i++) {
        packet[7 + 3 * i] = (uint8_t)(i + 1);
        packet[9 + 3 * i] = 0x02;
        sum += (unsigned)(i + 1) + 2;
    }
    packet[7 + 3 * n] = (uint8_t)(0xFF - (sum & 0xFF));
    wire_ask(&wire, packet, 8 + 3 * n);
}

static void test_servo_bus_packet_of_143_bytes_is_taken_and_a_longer_one_lost(void)
{
    one->position = 100;
    servo_get(one, SERVO_GOAL, 2);
    sync_write_goals(45); /* 8 + 135 = 143 bytes */
    TEST_ASSERT_EQUAL_UINT8(1, one->table[SERVO_TORQUE_ENABLE]);
    one->table[SERVO_TORQUE_ENABLE] = 0;
    sync_write_goals(46);
    TEST_ASSERT_EQUAL_UINT8(0, one->table[SERVO_TORQUE_ENABLE]);
    TEST_ASSERT_EQUAL_UINT32(1, one->stats.oversize);
}

static void test_servo_bus_dx117_ignores_sync_write_and_takes_registered_writes(void)
{
    servo_t *old = servo_bus_add(wire.bus, 2, SERVO_DX117, 57142);
    TEST_ASSERT_EQUAL_UINT8(34, old->table[SERVO_BAUD]);
    wire.rate_bps = 57142;
    ASK(&wire, 0xFF, 0xFF, 0xFE, 0x07, 0x83, 0x1E, 0x02, 0x02, 0x00, 0x03, 0x52);
    TEST_ASSERT_EQUAL_UINT16(512, servo_get(old, SERVO_GOAL, 2));
    ASK(&wire, 0xFF, 0xFF, 0x02, 0x05, 0x04, 0x1E, 0x00, 0x03, 0xD3);
    EXPECT_ANSWER(&wire, 0xFF, 0xFF, 0x02, 0x02, 0x00, 0xFB);
    ASK(&wire, 0xFF, 0xFF, 0xFE, 0x02, 0x05, 0xFA);
    TEST_ASSERT_EQUAL_UINT16(768, servo_get(old, SERVO_GOAL, 2));
}

static void test_servo_bus_wrong_rate_is_garbage(void)
{
    wire.rate_bps = 57142;
    ASK(&wire, PING_1);
    EXPECT_SILENCE(&wire);
    TEST_ASSERT_EQUAL_UINT32(6, one->stats.framing_errors);
}

static void test_servo_bus_baud_change_holds_after_the_answer(void)
{
    ASK(&wire, 0xFF, 0xFF, 0x01, 0x04, 0x03, 0x04, 0x22, 0xD1); /* address 4 = 34 */
    EXPECT_ANSWER(&wire, FINE_1);
    ASK(&wire, PING_1);
    EXPECT_SILENCE(&wire);
    wire.rate_bps = 57142;
    ASK(&wire, PING_1);
    EXPECT_ANSWER(&wire, FINE_1);
}

static void test_servo_bus_a_gap_of_100_us_is_borne_and_a_longer_one_drops_the_packet(void)
{
    SEND(&wire, 0xFF, 0xFF, 0x01);
    wire_wait(&wire, 100 * US);
    ASK(&wire, 0x02, 0x01, 0xFB);
    EXPECT_ANSWER(&wire, FINE_1);
    SEND(&wire, 0xFF, 0xFF, 0x01);
    wire_wait(&wire, 101 * US);
    ASK(&wire, 0x02, 0x01, 0xFB);
    EXPECT_SILENCE(&wire);
    TEST_ASSERT_EQUAL_UINT32(1, one->stats.gaps);
}

static void test_servo_bus_noise_before_the_header_is_skipped(void)
{
    ASK(&wire, 0x00, 0xFF, 0x55, 0xFF, PING_1); /* FF FF FF: the first is noise */
    EXPECT_ANSWER(&wire, FINE_1);
}

static void test_servo_bus_controller_talking_into_an_answer_spoils_both(void)
{
    SEND(&wire, PING_1);
    wire_wait(&wire, 515 * US); /* the answer is in its second byte */
    SEND(&wire, 0x00, 0x00, 0x00);
    wire_wait(&wire, MS);
    TEST_ASSERT_EQUAL_INT(6, wire.count);
    const uint8_t clean[] = {FINE_1};
    TEST_ASSERT_FALSE(memcmp(clean, wire.heard, 6) == 0);
    TEST_ASSERT_GREATER_THAN_UINT64(0, wire.bus->collisions);
    TEST_ASSERT_GREATER_THAN_UINT32(0, one->stats.deaf);
}

static int packets_seen;
static void count_packet(void *context, uint64_t now, const uint8_t *packet, uint8_t count)
{
    (void)context;
    (void)now;
    packets_seen += packet[4] == 0x01 && count == 6;
}

static void test_servo_bus_reports_each_good_packet_of_the_controller(void)
{
    packets_seen = 0;
    wire.bus->on_packet = count_packet;
    ASK(&wire, PING_1);
    ASK(&wire, 0xFF, 0xFF, 0x01, 0x02, 0x01, 0xFA); /* wrong checksum */
    ASK(&wire, 0xFF, 0xFF, 0x63, 0x02, 0x01, 0x99); /* no such servo */
    TEST_ASSERT_EQUAL_INT(2, packets_seen);
}

/* Makes a bus with two servos and sends it the same packets whole or byte by byte. */
static void tell(wire_t *to, bool whole)
{
    static const uint8_t packets[][12] = {
        {6, PING_1},
        {11, 0xFF, 0xFF, 0xFE, 0x07, 0x83, 0x1E, 0x02, 0x01, 0x10, 0x02, 0x44}, /* goal 528 */
        {6, 0xFF, 0xFF, 0x02, 0x02, 0x01, 0xFA},
        {8, 0xFF, 0xFF, 0x01, 0x04, 0x02, 0x24, 0x02, 0xD2},                    /* READ of the position */
        {6, 0xFF, 0xFF, 0x01, 0x02, 0x01, 0x00},                                /* a wrong checksum */
        {6, PING_1},
    };
    /* After only 100 us the fifth packet comes before the answer to the fourth. */
    static const uint64_t pauses[] = {5 * MS, 20 * MS, MS, 100 * US, 5 * MS, 5 * MS};
    wire_open(to);
    (void)servo_bus_add(to->bus, 1, SERVO_AX12, 1000000);
    (void)servo_bus_add(to->bus, 2, SERVO_AX12, 1000000);
    to->now = MS;
    for (unsigned i = 0; i < sizeof packets / sizeof packets[0]; i++) {
        const uint8_t count = packets[i][0];
        if (whole) {
            to->now += count * 10u * US;
            servo_bus_host_packet(to->bus, to->now, packets[i] + 1, count, 1000000);
        } else {
            wire_send(to, packets[i] + 1, count);
        }
        wire_wait(to, pauses[i]);
    }
    servo_advance(to->bus->servos[0], to->now);
}

static void test_servo_bus_packet_at_once_is_the_same_as_byte_by_byte(void)
{
    static wire_t whole, bytes;
    tell(&whole, true);
    tell(&bytes, false);
    TEST_ASSERT_EQUAL_UINT64(bytes.now, whole.now);
    TEST_ASSERT_TRUE(bytes.count > 20);
    TEST_ASSERT_EQUAL_INT(bytes.count, whole.count);
    TEST_ASSERT_EQUAL_MEMORY(bytes.heard, whole.heard, (size_t)bytes.count);
    TEST_ASSERT_EQUAL_MEMORY(bytes.heard_at, whole.heard_at, (size_t)bytes.count * sizeof bytes.heard_at[0]);
    for (int i = 0; i < 2; i++) {
        TEST_ASSERT_EQUAL_MEMORY(bytes.bus->servos[i]->table, whole.bus->servos[i]->table, SERVO_TABLE_BYTES);
        TEST_ASSERT_EQUAL_MEMORY(&bytes.bus->servos[i]->stats, &whole.bus->servos[i]->stats, sizeof(servo_stats_t));
    }
    wire_close(&whole);
    wire_close(&bytes);
}
