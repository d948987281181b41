/* SPDX-License-Identifier: MIT */
#include "told.h"

#include <dlfcn.h>
#include <setjmp.h>
#include <stdlib.h>
#include <string.h>

#define QUEUE_BYTES 16384u         /* a power of two */
#define PACKETS 64u
#define PACKET_BYTES 260u
#define WATCH (1000u * TOLD_PER_MS)
#define LOOKS_A_US 32u             /* a program that only looks at the clock sees it go on */
#define AT_ONCE 100u               /* 50 us */
#define FIRST_PATIENCE (30u * TOLD_PER_MS)
#define LEAST_PATIENCE (20u * TOLD_PER_MS)
#define BUS_BITS_PER_S_1M 1000000u

/* Bytes and when each comes. */
typedef struct {
    uint64_t at[QUEUE_BYTES];
    uint8_t byte[QUEUE_BYTES];
    uint32_t head, tail;
} queue_t;

static struct {
    told_teller_t teller;
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
} told;

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
    return queue->head == queue->tail ? TOLD_NEVER : queue->at[queue->tail % QUEUE_BYTES];
}

static uint16_t queue_take(queue_t *queue, uint8_t *to, uint16_t room)
{
    uint16_t count = 0;
    while (count < room && queue_next(queue) <= told.now) {
        to[count++] = queue->byte[queue->tail++ % QUEUE_BYTES];
    }
    return count;
}

/* ---- time ---- */

static uint64_t packet_end(void)
{
    return told.packet_head == told.packet_tail ? TOLD_NEVER : told.packet[told.packet_tail % PACKETS].end;
}

/* Lets everything happen up to `until`; stops where the program would be woken by a byte, if asked to. */
static void pass(uint64_t until, bool wakes)
{
    for (;;) {
        const uint64_t bus = told.teller.bus_next(), packet = packet_end();
        uint64_t next = bus < packet ? bus : packet;
        next = next < told.next_tick ? next : told.next_tick;
        if (wakes) {
            uint64_t byte = queue_next(&told.bus), typed = queue_next(&told.console);
            byte = byte < typed ? byte : typed;
            if (byte <= until && byte <= next) {
                told.now = byte > told.now ? byte : told.now;
                return;
            }
        }
        if (next > until) {
            told.now = until > told.now ? until : told.now;
            return;
        }
        told.now = next > told.now ? next : told.now;
        if (next == packet) {
            const uint32_t at = told.packet_tail++ % PACKETS;
            told.teller.bus_packet(next, told.packet[at].bytes, told.packet[at].count, told.packet[at].bits_per_s);
        } else if (next == bus) {
            told.teller.bus_advance(next);
        } else {
            told.next_tick += TOLD_TICK;
            told.teller.tick();
        }
    }
}

uint64_t machine_now(void)
{
    if (++told.looks == LOOKS_A_US) {
        told.looks = 0;
        pass(told.now + 2u, false);
        if (told.now - told.watched > WATCH) {
            longjmp(told.leave, 1 + TOLD_HUNG);
        }
    }
    return told.now;
}

void machine_wait(uint64_t until)
{
    told.looks = 0;
    if (told.hold_up > 0) {
        const uint64_t late = told.now + told.hold_up;
        told.hold_up = 0;
        pass(late, false);
        return;
    }
    if (queue_next(&told.bus) <= told.now || queue_next(&told.console) <= told.now) {
        /* The program has left bytes where they are: a computer would return at once, again and again. */
        pass(until < told.now + AT_ONCE ? until : told.now + AT_ONCE, false);
        return;
    }
    pass(until, true);
}

/* ---- the bus ---- */

bool machine_bus_is_there(void)
{
    return told.is_there;
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
    told.bits_per_s = 2000000u / (divisor + 1u);
    return told.bits_per_s;
}

void machine_bus_write(const uint8_t *bytes, uint16_t count)
{
    const uint64_t begin = told.now > told.line_free ? told.now : told.line_free;
    told.line_free = begin + (uint64_t)count * (20000000u / told.bits_per_s);
    if (!told.is_there || count > PACKET_BYTES || told.packet_head - told.packet_tail == PACKETS) {
        return;
    }
    const uint32_t at = told.packet_head++ % PACKETS;
    told.packet[at].end = told.line_free;
    told.packet[at].bits_per_s = told.bits_per_s;
    told.packet[at].count = count;
    memcpy(told.packet[at].bytes, bytes, count);
}

uint16_t machine_bus_read(uint8_t *to, uint16_t room)
{
    return queue_take(&told.bus, to, room);
}

/* ---- the console and the panel ---- */

uint16_t machine_console_read(uint8_t *to, uint16_t room)
{
    const uint16_t count = queue_take(&told.console, to, room);
    for (uint16_t i = 0; i < count; i++) {
        told.teller.was_read();
    }
    return count;
}

uint16_t machine_console_write(const uint8_t *bytes, uint16_t count)
{
    if (count > 0) {
        told.teller.printed(bytes, count);
    }
    return count;
}

uint8_t machine_buttons(void)
{
    return told.buttons;
}

void machine_tell(const char *sentence)
{
    told.teller.said(sentence);
}

/* ---- memory ---- */

bool machine_recall(machine_memory_t memory, uint8_t *bytes, uint32_t count)
{
    if (count != memories[memory].count) {
        abort();   /* the target's numbers have changed, and those above have not */
    }
    memcpy(bytes, memories[memory].bytes, count);
    return true;
}

bool machine_keep(machine_memory_t memory, uint32_t at, const uint8_t *bytes, uint32_t count, bool now)
{
    (void)now;
    if (!told.teller.keep(memory, at, bytes, count)) {
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

void told_tear(machine_memory_t memory, uint32_t at, const uint8_t *bytes, uint32_t count, bool (*choose)(void))
{
    for (uint32_t i = 0; i < count; i++) {
        if (choose()) {
            memories[memory].bytes[at + i] = bytes[i];
        }
    }
}

void told_tear_unsettled(bool (*choose)(void))
{
    for (uint32_t i = 0; i < sizeof eeprom; i++) {
        if (eeprom[i] != settled_eeprom[i] && choose()) {
            eeprom[i] = settled_eeprom[i];
        }
    }
}

uint8_t *told_memory(machine_memory_t memory)
{
    return memories[memory].bytes;
}

uint32_t told_bytes(machine_memory_t memory)
{
    return memories[memory].count;
}

/* ---- life ---- */

void machine_watch(void)
{
    told.watched = told.now;
}

bool machine_is_asked_to_end(void)
{
    return told.end_asked;
}

_Noreturn void machine_end(void)
{
    longjmp(told.leave, 1 + TOLD_ENDED);
}

_Noreturn void told_cut(void)
{
    longjmp(told.leave, 1 + TOLD_CUT);
}

_Noreturn void told_stop(void)
{
    longjmp(told.leave, 1 + TOLD_STOPPED);
}

void told_init(const told_teller_t *teller)
{
    memset(&told, 0, sizeof told);
    told.teller = *teller;
    told.next_tick = TOLD_TICK;
    told.bits_per_s = BUS_BITS_PER_S_1M;
    told.is_there = true;
    for (unsigned memory = 0; memory < MACHINE_MEMORIES; memory++) {
        memset(memories[memory].bytes, 0xFF, memories[memory].count);
    }
    memset(settled_eeprom, 0xFF, sizeof settled_eeprom);
}

/* What was under way when the power went is lost. */
static void switch_on(void)
{
    told.bus.tail = told.bus.head;
    told.console.tail = told.console.head;
    told.packet_tail = told.packet_head;
    told.line_free = told.typed_until = told.now;
    told.watched = told.now;
    told.hold_up = 0;
    told.end_asked = false;
    memcpy(settled_eeprom, eeprom, sizeof eeprom);
}

told_end_t told_run(const char *file, const char **error)
{
    static void *program;   /* static: kept across longjmp */
    static int why;
    *error = NULL;
    program = dlopen(file, RTLD_NOW | RTLD_LOCAL);
    if (program == NULL) {
        *error = dlerror();
        return TOLD_ENDED;
    }
    int (*begin)(void);
    *(void **)&begin = dlsym(program, "program_start");
    if (begin == NULL) {
        *error = dlerror();
        return TOLD_ENDED;
    }
    switch_on();
    why = setjmp(told.leave);
    if (why == 0) {
        (void)begin();
        why = 1 + TOLD_ENDED;
    }
    (void)dlclose(program);
    if (dlopen(file, RTLD_NOW | RTLD_NOLOAD) != NULL) {
        *error = "the program stays in memory, so it would not begin anew";
    }
    return (told_end_t)(why - 1);
}

/* ---- what the teller tells ---- */

uint64_t told_now(void)
{
    return told.now;
}

void told_hear(uint8_t byte, uint32_t delay)
{
    if (told.is_there) {
        queue_put(&told.bus, told.now + delay, byte);
    }
}

void told_type(const uint8_t *bytes, uint16_t count, uint32_t byte_time)
{
    told.typed_until = told.typed_until > told.now ? told.typed_until : told.now;
    for (uint16_t i = 0; i < count; i++) {
        told.typed_until += byte_time;
        queue_put(&told.console, told.typed_until, bytes[i]);
    }
}

void told_type_pause(uint32_t half_us)
{
    told.typed_until = (told.typed_until > told.now ? told.typed_until : told.now) + half_us;
}

bool told_has_typed(void)
{
    return told.console.head == told.console.tail;
}

void told_press(uint8_t buttons)
{
    told.buttons = buttons;
}

void told_plug(bool is_there)
{
    told.is_there = is_there;
    if (!is_there) {
        told.bus.tail = told.bus.head;
        told.packet_tail = told.packet_head;
    }
}

void told_hold_up(uint64_t half_us)
{
    told.hold_up = half_us;
}

void told_ask_to_end(void)
{
    told.end_asked = true;
}
