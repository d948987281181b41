/* SPDX-License-Identifier: MIT */
#include "simtime.h"

#include <dlfcn.h>
#include <setjmp.h>
#include <stdlib.h>
#include <string.h>

#define QUEUE_BYTES 16384u         /* a power of two */
#define PACKETS 64u
#define PACKET_BYTES 260u
#define WATCH (1000u * SIMTIME_PER_MS)
#define LOOKS_A_US 32u             /* clock readings per microsecond: the clock also runs for a program that only reads it */
#define AT_ONCE 100u               /* 50 us */
#define FIRST_PATIENCE (30u * SIMTIME_PER_MS)
#define LEAST_PATIENCE (20u * SIMTIME_PER_MS)
#define BUS_BITS_PER_S_1M 1000000u

/* Bytes and their arrival times. */
typedef struct {
    uint64_t at[QUEUE_BYTES];
    uint8_t byte[QUEUE_BYTES];
    uint32_t head, tail;
} queue_t;

static struct {
    simtime_callbacks_t callbacks;
    uint64_t now, next_tick, watched;
    uint32_t looks;
    uint64_t hold_up;
    queue_t bus, console;
    struct {
        uint64_t end;
        uint32_t bits_per_s;
        uint16_t count;
        uint8_t bytes[PACKET_BYTES];
    } packet[PACKETS];
    uint32_t packet_head, packet_tail;
    uint64_t line_free;
    uint32_t bits_per_s;
    uint64_t typed_until;
    uint8_t buttons;
    bool is_there, end_asked;
    jmp_buf leave;
} simtime;

static uint8_t pages[0x20000], journal[0x2000], eeprom[0x1000], settled_eeprom[0x1000];
static const struct {
    uint8_t *bytes;
    uint32_t count;
} memories[MACHINE_MEMORIES] = {
    [MACHINE_PAGES] = {pages, sizeof pages}, [MACHINE_JOURNAL] = {journal, sizeof journal},
    [MACHINE_EEPROM] = {eeprom, sizeof eeprom},
};

/* ---- queues ---- */

static void queue_put(queue_t *queue, uint64_t at, uint8_t byte)
{
    if (queue->head - queue->tail < QUEUE_BYTES) {
        queue->at[queue->head % QUEUE_BYTES] = at;
        queue->byte[queue->head % QUEUE_BYTES] = byte;
        queue->head++;
    }
}

static uint64_t queue_next(const queue_t *queue)
{
    return queue->head == queue->tail ? SIMTIME_NEVER : queue->at[queue->tail % QUEUE_BYTES];
}

static uint16_t queue_take(queue_t *queue, uint8_t *to, uint16_t room)
{
    uint16_t count = 0;
    while (count < room && queue_next(queue) <= simtime.now) {
        to[count++] = queue->byte[queue->tail++ % QUEUE_BYTES];
    }
    return count;
}

/* ---- time ---- */

static uint64_t packet_end(void)
{
    return simtime.packet_head == simtime.packet_tail ? SIMTIME_NEVER : simtime.packet[simtime.packet_tail % PACKETS].end;
}

/* Runs all events up to `until`. wakes: stops at a byte that would wake the program. */
static void pass(uint64_t until, bool wakes)
{
    for (;;) {
        const uint64_t bus = simtime.callbacks.bus_next(), packet = packet_end();
        uint64_t next = bus < packet ? bus : packet;
        next = next < simtime.next_tick ? next : simtime.next_tick;
        if (wakes) {
            uint64_t byte = queue_next(&simtime.bus), typed = queue_next(&simtime.console);
            byte = byte < typed ? byte : typed;
            if (byte <= until && byte <= next) {
                simtime.now = byte > simtime.now ? byte : simtime.now;
                return;
            }
        }
        if (next > until) {
            simtime.now = until > simtime.now ? until : simtime.now;
            return;
        }
        simtime.now = next > simtime.now ? next : simtime.now;
        if (next == packet) {
            const uint32_t at = simtime.packet_tail++ % PACKETS;
            simtime.callbacks.bus_packet(next, simtime.packet[at].bytes, simtime.packet[at].count,
                                         simtime.packet[at].bits_per_s);
        } else if (next == bus) {
            simtime.callbacks.bus_advance(next);
        } else {
            simtime.next_tick += SIMTIME_TICK;
            simtime.callbacks.tick();
        }
    }
}

uint64_t machine_now(void)
{
    if (++simtime.looks == LOOKS_A_US) {
        simtime.looks = 0;
        pass(simtime.now + 2u, false);
        if (simtime.now - simtime.watched > WATCH) {
            longjmp(simtime.leave, 1 + SIMTIME_HUNG);
        }
    }
    return simtime.now;
}

void machine_wait(uint64_t until)
{
    simtime.looks = 0;
    if (simtime.hold_up > 0) {
        const uint64_t late = simtime.now + simtime.hold_up;
        simtime.hold_up = 0;
        pass(late, false);
        return;
    }
    if (queue_next(&simtime.bus) <= simtime.now || queue_next(&simtime.console) <= simtime.now) {
        /* The program has left bytes unread: a computer would return at once, again and again. */
        pass(until < simtime.now + AT_ONCE ? until : simtime.now + AT_ONCE, false);
        return;
    }
    pass(until, true);
}

/* ---- the bus ---- */

bool machine_bus_is_there(void)
{
    return simtime.is_there;
}

uint32_t machine_bus_first_patience(void)
{
    return FIRST_PATIENCE;
}

uint32_t machine_bus_least_patience(void)
{
    return LEAST_PATIENCE;
}

uint32_t machine_bus_rate(uint8_t divisor)
{
    simtime.bits_per_s = 2000000u / (divisor + 1u);
    return simtime.bits_per_s;
}

void machine_bus_write(const uint8_t *bytes, uint16_t count)
{
    const uint64_t begin = simtime.now > simtime.line_free ? simtime.now : simtime.line_free;
    simtime.line_free = begin + (uint64_t)count * (20000000u / simtime.bits_per_s);
    if (!simtime.is_there || count > PACKET_BYTES || simtime.packet_head - simtime.packet_tail == PACKETS) {
        return;
    }
    const uint32_t at = simtime.packet_head++ % PACKETS;
    simtime.packet[at].end = simtime.line_free;
    simtime.packet[at].bits_per_s = simtime.bits_per_s;
    simtime.packet[at].count = count;
    memcpy(simtime.packet[at].bytes, bytes, count);
}

uint16_t machine_bus_read(uint8_t *to, uint16_t room)
{
    return queue_take(&simtime.bus, to, room);
}

/* ---- the console and the panel ---- */

uint16_t machine_console_read(uint8_t *to, uint16_t room)
{
    const uint16_t count = queue_take(&simtime.console, to, room);
    for (uint16_t i = 0; i < count; i++) {
        simtime.callbacks.was_read();
    }
    return count;
}

uint16_t machine_console_write(const uint8_t *bytes, uint16_t count)
{
    if (count > 0) {
        simtime.callbacks.printed(bytes, count);
    }
    return count;
}

uint8_t machine_buttons(void)
{
    return simtime.buttons;
}

void machine_tell(const char *sentence)
{
    simtime.callbacks.said(sentence);
}

/* ---- memory ---- */

bool machine_recall(machine_memory_t memory, uint8_t *bytes, uint32_t count)
{
    if (count != memories[memory].count) {
        abort();   /* the target's sizes no longer match those above */
    }
    memcpy(bytes, memories[memory].bytes, count);
    return true;
}

bool machine_keep(machine_memory_t memory, uint32_t at, const uint8_t *bytes, uint32_t count, bool now)
{
    (void)now;
    if (!simtime.callbacks.keep(memory, at, bytes, count)) {
        return false;
    }
    memcpy(memories[memory].bytes + at, bytes, count);
    return true;
}

void machine_settle(machine_memory_t memory)
{
    if (memory == MACHINE_EEPROM) {
        memcpy(settled_eeprom, eeprom, sizeof eeprom);
    }
}

void simtime_tear(machine_memory_t memory, uint32_t at, const uint8_t *bytes, uint32_t count, bool (*choose)(void))
{
    for (uint32_t i = 0; i < count; i++) {
        if (choose()) {
            memories[memory].bytes[at + i] = bytes[i];
        }
    }
}

void simtime_lose_unsettled(void)
{
    memcpy(eeprom, settled_eeprom, sizeof eeprom);
}

uint8_t *simtime_memory(machine_memory_t memory)
{
    return memories[memory].bytes;
}

uint32_t simtime_bytes(machine_memory_t memory)
{
    return memories[memory].count;
}

/* ---- life ---- */

void machine_watch(void)
{
    simtime.watched = simtime.now;
}

bool machine_is_asked_to_end(void)
{
    return simtime.end_asked;
}

_Noreturn void machine_end(void)
{
    longjmp(simtime.leave, 1 + SIMTIME_ENDED);
}

_Noreturn void simtime_cut(void)
{
    longjmp(simtime.leave, 1 + SIMTIME_CUT);
}

_Noreturn void simtime_stop(void)
{
    longjmp(simtime.leave, 1 + SIMTIME_STOPPED);
}

void simtime_init(const simtime_callbacks_t *callbacks)
{
    memset(&simtime, 0, sizeof simtime);
    simtime.callbacks = *callbacks;
    simtime.next_tick = SIMTIME_TICK;
    simtime.bits_per_s = BUS_BITS_PER_S_1M;
    simtime.is_there = true;
    for (unsigned memory = 0; memory < MACHINE_MEMORIES; memory++) {
        memset(memories[memory].bytes, 0xFF, memories[memory].count);
    }
    memset(settled_eeprom, 0xFF, sizeof settled_eeprom);
}

/* Bytes in transit at the power cut are lost. */
static void switch_on(void)
{
    simtime.bus.tail = simtime.bus.head;
    simtime.console.tail = simtime.console.head;
    simtime.packet_tail = simtime.packet_head;
    simtime.line_free = simtime.typed_until = simtime.now;
    simtime.watched = simtime.now;
    simtime.hold_up = 0;
    simtime.end_asked = false;
    memcpy(settled_eeprom, eeprom, sizeof eeprom);
}

simtime_end_t simtime_run(const char *file, const char **error)
{
    static void *program;   /* static: kept across longjmp */
    static int why;
    *error = NULL;
    program = dlopen(file, RTLD_NOW | RTLD_LOCAL);
    if (program == NULL) {
        *error = dlerror();
        return SIMTIME_ENDED;
    }
    int (*begin)(void);
    *(void **)&begin = dlsym(program, "program_start");
    if (begin == NULL) {
        *error = dlerror();
        return SIMTIME_ENDED;
    }
    switch_on();
    why = setjmp(simtime.leave);
    if (why == 0) {
        (void)begin();
        why = 1 + SIMTIME_ENDED;
    }
    (void)dlclose(program);
    if (dlopen(file, RTLD_NOW | RTLD_NOLOAD) != NULL) {
        *error = "the program stays in memory, so it would not begin anew";
    }
    return (simtime_end_t)(why - 1);
}

/* ---- functions for the caller ---- */

uint64_t simtime_now(void)
{
    return simtime.now;
}

void simtime_hear(uint8_t byte, uint32_t delay)
{
    if (simtime.is_there) {
        queue_put(&simtime.bus, simtime.now + delay, byte);
    }
}

void simtime_type(const uint8_t *bytes, uint16_t count, uint32_t byte_time)
{
    simtime.typed_until = simtime.typed_until > simtime.now ? simtime.typed_until : simtime.now;
    for (uint16_t i = 0; i < count; i++) {
        simtime.typed_until += byte_time;
        queue_put(&simtime.console, simtime.typed_until, bytes[i]);
    }
}

void simtime_type_pause(uint32_t half_us)
{
    simtime.typed_until = (simtime.typed_until > simtime.now ? simtime.typed_until : simtime.now) + half_us;
}

bool simtime_has_typed(void)
{
    return simtime.console.head == simtime.console.tail;
}

void simtime_press(uint8_t buttons)
{
    simtime.buttons = buttons;
}

void simtime_plug(bool is_there)
{
    simtime.is_there = is_there;
    if (!is_there) {
        simtime.bus.tail = simtime.bus.head;
        simtime.packet_tail = simtime.packet_head;
    }
}

void simtime_hold_up(uint64_t half_us)
{
    simtime.hold_up = half_us;
}

void simtime_ask_to_end(void)
{
    simtime.end_asked = true;
}
