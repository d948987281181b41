/* SPDX-License-Identifier: MIT
 * world.c - the program's environment: servos on their bus, the line to it, memory, and the actions of a session. */
#include "session.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define CYCLES 8u                  /* of the servos' clock per half microsecond */
#define UNASKED_WRITE 16u          /* one in so many bytes of EEPROM: the computer writes to its disk what was kept before */
#define SUM_AT 31u                 /* a page's checksum */
#define BYTE_TIME 347u             /* of the console's line at 57,600 8N1, half microseconds */

static struct {
    uint32_t latency, lump;        /* of the adapter, half microseconds: delay of a byte, and the period of lumps */
    uint32_t lose, damage;         /* answer bytes still to lose, to change */
} line;

static uint64_t cycles(uint64_t half_us)
{
    return half_us * CYCLES;
}

/* ---- the bus ---- */

static void on_byte(void *context, uint64_t now_cycles, uint8_t byte, uint32_t rate_bps, bool bad)
{
    (void)context;
    (void)rate_bps;
    const uint64_t now = (now_cycles + CYCLES - 1) / CYCLES;
    if (line.lose > 0) {
        line.lose--;
        session.trouble_tick = session.tick;
        return;
    }
    if (line.damage > 0) {
        line.damage--;
        session.trouble_tick = session.tick;
        byte ^= (uint8_t)(1u << session_random() % 8);
    }
    if (bad) {
        return;
    }
    uint64_t at = now + line.latency;
    at += line.lump > 0 ? line.lump - at % line.lump : 0;
    simtime_hear(byte, (uint32_t)(at - simtime_now()));
}

/* Removes the words for deaf servos from a SYNC WRITE. Returns the length of the packet for the others. */
static uint8_t heard_of(const uint8_t *packet, uint16_t count, uint8_t *heard)
{
    uint8_t length = 7, sum = 0;
    memcpy(heard, packet, length);
    for (unsigned at = length; at + packet[6] < count - 1u; at += packet[6] + 1u) {
        if (packet[at] >= IDS || !session.joint[packet[at]].is_deaf) {
            memcpy(heard + length, packet + at, packet[6] + 1u);
            length = (uint8_t)(length + packet[6] + 1u);
        }
    }
    heard[3] = (uint8_t)(length - 3u);
    for (unsigned i = 2; i < length; i++) {
        sum = (uint8_t)(sum + heard[i]);
    }
    heard[length] = (uint8_t)~sum;
    return (uint8_t)(length + 1u);
}

static void bus_packet(uint64_t end, const uint8_t *packet, uint16_t count, uint32_t bits_per_s)
{
    if (session.shows) {
        printf("\nbus %llu", (unsigned long long)end);
        for (unsigned i = 2; i < count; i++) {
            printf(" %02x", packet[i]);
        }
        printf("\n");
    }
    handed_left();
    if (packet[4] == INST_SYNC_WRITE && count > 8) {
        uint8_t heard[UINT8_MAX];
        servo_bus_host_packet(session.bus, cycles(end), heard, heard_of(packet, count, heard), bits_per_s);
    } else {
        servo_bus_host_packet(session.bus, cycles(end), packet, (uint8_t)count, bits_per_s);
    }
    rules_packet(packet, count);
}

static uint64_t bus_next(void)
{
    const uint64_t next = servo_bus_next_cycles(session.bus);
    return next == SERVO_BUS_NEVER ? SIMTIME_NEVER : (next + CYCLES - 1) / CYCLES;
}

static void bus_advance(uint64_t now)
{
    servo_bus_advance(session.bus, cycles(now));
}

void world_add_servo(unsigned id)
{
    servo_t *servo = servo_bus_add(session.bus, (uint8_t)id, SERVO_AX12, 1000000);
    if (servo == NULL || id >= IDS) {
        abort();
    }
    session.joint[id].servo = servo;
}

void world_init(void)
{
    memset(&line, 0, sizeof line);
    line.lump = 250 * 2;
    session.bus = servo_bus_new();
    if (session.bus == NULL) {
        abort();
    }
    session.bus->on_byte = on_byte;
}

void world_free(void)
{
    servo_bus_free(session.bus);
}

void world_power(bool on)
{
    servo_bus_power(session.bus, cycles(simtime_now()), on);
    handed_lost();
}

/* ---- the console ---- */

/* Keeps the newest line as a terminal shows it. */
static void show(uint8_t byte)
{
    if (byte == '\n') {
        rules_printed(session.line);
        marks_printed(session.line);
        memset(session.line, 0, sizeof session.line);
        session.column = 0;
    } else if (byte == '\r') {
        session.column = 0;
    } else if (byte == '\b') {
        session.column = (uint16_t)(session.column > 0 ? session.column - 1 : 0);
    } else if (byte >= ' ' && session.column < LINE_BYTES - 1) {
        session.line[session.column++] = (char)byte;
    }
}

static void printed(const uint8_t *bytes, uint16_t count)
{
    session.printed_tick = session.tick;
    rules_started();
    for (uint16_t i = 0; i < count; i++) {
        show(bytes[i]);
        if (session.is_edit) {
            screen_byte(bytes[i]);
        }
    }
    if (session.shows) {
        fwrite(bytes, 1, count, stdout);
    }
}

static void said(const char *sentence)
{
    rules_said(sentence);
    marks_said(sentence);
}

/* ---- memory ---- */

static bool toss(void)
{
    return (session_random() & 1u) != 0;
}

/* Cuts the power while these bytes are written. The chip changes them in order; a computer's disk may use any order.
 * Of the EEPROM only what was settled before stays. */
static void cut_write(machine_memory_t memory, uint32_t at, const uint8_t *bytes, uint32_t count)
{
    static const char *const names[MACHINE_MEMORIES] = {
        "power cut while a page was written", "power cut while the journal was written",
        "power cut while settings were written"};
    marks_cut(names[memory]);
    const uint32_t way = session_random() % 4;
    if (way == 0) {
        simtime_tear(memory, at, bytes, count, toss);
    } else {
        memcpy(simtime_memory(memory) + at, bytes, session_random() % (count + 1));
    }
    simtime_lose_unsettled();
    simtime_cut();
}

static bool keep(machine_memory_t memory, uint32_t at, const uint8_t *bytes, uint32_t count)
{
    if (memory == MACHINE_EEPROM && session_random() % UNASKED_WRITE == 0) {
        machine_settle(MACHINE_EEPROM);
    }
    session.writes++;
    rules_kept(memory, at, bytes, count);
    if (session.cut_at_write != 0 && --session.cut_at_write == 0) {
        cut_write(memory, at, bytes, count);
    }
    return true;
}

/* ---- actions ---- */

/* Bytes in transit on the console's line: a byte from the user, or a remote packet with its buttons at the last
   byte. */
#define UNDER_WAY 65536u
#define REMOTE 0x10000u
#define NOTHING 0x20000u           /* a byte of a packet, not its last */
static struct {
    uint32_t what[UNDER_WAY];
    uint32_t head, tail;
} under_way;

static void put_on_line(uint8_t byte, uint32_t what)
{
    simtime_type(&byte, 1, BYTE_TIME);
    under_way.what[under_way.head++ % UNDER_WAY] = what;
}

/* The program has read one more byte. */
static void was_read(void)
{
    const uint32_t what = under_way.what[under_way.tail++ % UNDER_WAY];
    if (what < REMOTE) {
        rules_typed((uint8_t)what);
    } else if (what != NOTHING) {
        rules_remote(what - REMOTE);
        marks_remote(what - REMOTE);
    }
}

void world_forget_line(void)
{
    under_way.tail = under_way.head;
}

static void send_remote(unsigned buttons)
{
    const uint8_t low = (uint8_t)buttons, high = (uint8_t)(buttons >> 8);
    const uint8_t packet[6] = {0xFF, 0x55, low, (uint8_t)~low, high, (uint8_t)~high};
    for (unsigned i = 0; i < sizeof packet; i++) {
        put_on_line(packet[i], i + 1 < sizeof packet ? NOTHING : REMOTE + (buttons & 0xFFFFu));
    }
}

/* Presses buttons of the panel. */
static void press(unsigned buttons)
{
    simtime_press((uint8_t)buttons);
    presses_panel(buttons);
    stops_pressed();
    joins_pressed();
    if (buttons != 0) {
        rules_asked();
        law_remote(0);
        law_remote(buttons >= 16 ? 512 : buttons);   /* Start stops */
        rest_remote(buttons >= 16 ? 512 : buttons);
    }
    law_remote(0);
}

/* Types bytes given as hexadecimal digits. */
static bool type_hex(const char *hex)
{
    unsigned byte;
    for (; sscanf(hex, "%2x", &byte) == 1; hex += 2) {
        put_on_line((uint8_t)byte, byte);
    }
    return *hex == '\0';
}

static bool set_fault(unsigned id, const char *name, uint32_t answers)
{
    joint_t *joint = id < IDS ? &session.joint[id] : NULL;
    const servo_fault_t fault = servo_fault_by_name(name);
    if (joint == NULL || joint->servo == NULL || fault == SERVO_FAULTS) {
        return false;
    }
    servo_bus_fault(session.bus, cycles(simtime_now()), joint->servo, fault, answers == 0 ? SERVO_FAULT_ALWAYS : answers);
    joint->fault_tick = session.tick;
    joint->late_tick = fault == SERVO_FAULT_LATE ? session.tick : joint->late_tick;
    if (fault == SERVO_FAULT_SILENT || fault == SERVO_FAULT_DEAD) {
        const bool was_silent = joint->silent_since != NEVER_TICK;
        joint->silent_since = answers != 0 ? NEVER_TICK : was_silent ? joint->silent_since : session.tick;
    }
    return true;
}

static bool clear_faults(unsigned id)
{
    if (id >= IDS || session.joint[id].servo == NULL) {
        return false;
    }
    servo_t *servo = session.joint[id].servo;
    session.joint[id].late_tick = servo_fault_is_on(servo, SERVO_FAULT_LATE) ? session.tick : session.joint[id].late_tick;
    for (unsigned fault = 0; fault < SERVO_FAULTS; fault++) {
        if (servo_fault_is_on(servo, (servo_fault_t)fault)) {
            servo_bus_fault(session.bus, cycles(simtime_now()), servo, (servo_fault_t)fault, 0);
        }
    }
    servo->temperature_c = servo->ambient_c;
    session.joint[id].fault_tick = session.tick;
    session.joint[id].silent_since = NEVER_TICK;
    return true;
}

/* Writes the non-volatile memories to a file: pages, journal, settings. */
static bool write_memories(const char *path)
{
    FILE *file = fopen(path, "wb");
    if (file == NULL) {
        return false;
    }
    for (unsigned memory = 0; memory < MACHINE_MEMORIES; memory++) {
        fwrite(simtime_memory((machine_memory_t)memory), 1, simtime_bytes((machine_memory_t)memory), file);
    }
    return fclose(file) == 0;
}

/* Loads motion pages from a file, before the first start. */
static bool load_motions(const char *path)
{
    FILE *file = fopen(path, "rb");
    if (file == NULL) {
        return false;
    }
    const size_t got = fread(simtime_memory(MACHINE_PAGES), 1, simtime_bytes(MACHINE_PAGES), file);
    fclose(file);
    return got > 0;
}

/* Puts a joint's offset into page 0. */
static void set_trim(unsigned id, int offset)
{
    uint8_t *page = simtime_memory(MACHINE_PAGES), *word = page + 3 * STEP_BYTES + 2 * id;
    word[0] = (uint8_t)offset;
    word[1] = (uint8_t)((unsigned)offset >> 8);
    page[SUM_AT] = 0;
    page[SUM_AT] = (uint8_t)(0xFF - sum_of(page));
}

bool world_do(char *words)
{
    char verb[16] = "", word[64] = "";
    int at = 0;
    unsigned a = 0, b = 0;
    int offset = 0;
    if (sscanf(words, "%15s %n", verb, &at) != 1) {
        return false;
    }
    const char *rest = words + at;
    const int numbers = sscanf(rest, "%u %u", &a, &b);
    if (strcmp(verb, "type") == 0) {
        return type_hex(rest);
    } else if (strcmp(verb, "fault") == 0 && sscanf(rest, "%u %63s %u", &a, word, &b) >= 2) {
        return set_fault(a, word, b);
    } else if (strcmp(verb, "clear") == 0 && numbers == 1) {
        return clear_faults(a);
    } else if (strcmp(verb, "push") == 0 && numbers == 2 && a < IDS && session.joint[a].servo != NULL) {
        servo_push_to(session.joint[a].servo, cycles(simtime_now()), b);
        session.joint[a].pushed_tick = session.pushed_tick = session.tick;
    } else if (strcmp(verb, "supply") == 0 && numbers == 1) {
        servo_bus_supply(session.bus, cycles(simtime_now()), a / 10.0);
        session.trouble_tick = session.tick;
    } else if (strcmp(verb, "remote") == 0 && numbers == 1) {
        send_remote(a);
    } else if (strcmp(verb, "press") == 0 && numbers == 1) {
        press(a);
    } else if (strcmp(verb, "latency") == 0 && numbers == 2) {
        line.latency = session.latency = a;
        line.lump = b;
    } else if (strcmp(verb, "lose") == 0 && numbers == 1) {
        line.lose = a;
    } else if (strcmp(verb, "damage") == 0 && numbers == 1) {
        line.damage = a;
    } else if (strcmp(verb, "late") == 0 && numbers == 1) {
        simtime_hold_up((uint64_t)a * SIMTIME_PER_MS);
        session.trouble_tick = session.late_tick = session.tick + (a + 7) / 8;
    } else if (strcmp(verb, "plug") == 0 && numbers == 1) {
        simtime_plug(a != 0);
        handed_lost();
        session.trouble_tick = session.late_tick = session.plug_tick = session.tick;
    } else if (strcmp(verb, "cutwrite") == 0 && numbers == 1) {
        session.cut_at_write = a;
    } else if (strcmp(verb, "cut") == 0) {
        session.cut_now = true;
    } else if (strcmp(verb, "servo") == 0 && numbers == 1) {
        world_add_servo(a);
    } else if (strcmp(verb, "deaf") == 0 && numbers == 1 && a < IDS && session.joint[a].servo != NULL) {
        session.joint[a].is_deaf = session.has_deaf = true;
    } else if (strcmp(verb, "trim") == 0 && sscanf(rest, "%u %d", &a, &offset) == 2 && a < JOINTS) {
        set_trim(a, offset);
    } else if (strcmp(verb, "pause") == 0 && numbers == 1) {
        simtime_type_pause(a);
    } else if (strcmp(verb, "memories") == 0) {
        return write_memories(rest);
    } else if (strcmp(verb, "motions") == 0) {
        return load_motions(rest);
    } else {
        return false;
    }
    return true;
}

/* ---- callbacks of the machine ---- */

static void tick(void)
{
    session.tick++;
    rules_tick();
    if (session.cut_now) {
        session.cut_now = false;
        marks_cut("power cut");
        simtime_lose_unsettled();
        simtime_cut();
    }
}

const simtime_callbacks_t world_callbacks = {
    .bus_packet = bus_packet, .bus_next = bus_next, .bus_advance = bus_advance, .tick = tick, .was_read = was_read,
    .printed = printed, .said = said, .keep = keep,
};
