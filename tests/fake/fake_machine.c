/* SPDX-License-Identifier: MIT */
#include "fake_machine.h"
#include "machine.h"
#include "trap.h"

#include <string.h>

#define MEMORY_BYTES (256u * 512u)
#define UNDER_WAY 64u
#define PACKET_BYTES 256u

static uint64_t now;

static struct {
    fake_machine_servo_t *servo;
    uint32_t latency, least_patience, rate;
    bool echoes, is_there;
    uint16_t packets;
    uint64_t line_free;
    struct {
        uint64_t at;
        uint16_t count;
        uint8_t bytes[PACKET_BYTES];
    } under_way[UNDER_WAY];   /* answers and echoes to the program, oldest first */
    uint8_t count;
} bus;

static struct {
    uint8_t sure[MACHINE_MEMORIES][MEMORY_BYTES], now[MACHINE_MEMORIES][MEMORY_BYTES];
    bool is_there[MACHINE_MEMORIES];
    uint32_t writes, cut_at, random;
    jmp_buf *cut_to;
} memory;

void fake_machine_reset(void)
{
    memset(&bus, 0, sizeof bus);
    memset(&memory, 0, sizeof memory);
    now = 1000000;
    bus.is_there = true;
    bus.least_patience = 40000u;   /* 20 ms */
}

/* ---- time ---- */

uint64_t machine_now(void)
{
    return now;
}

void fake_machine_pass(uint32_t half_us)
{
    now += half_us;
}

void machine_wait(uint64_t until)
{
    const uint64_t next = bus.count > 0 && bus.under_way[0].at < until ? bus.under_way[0].at : until;
    now = next > now ? next : now + 2u;   /* a read of the clock takes 1 us, so that a loop that waits in vain ends */
}

/* ---- the bus ---- */

void fake_machine_set_servo(fake_machine_servo_t *servo)
{
    bus.servo = servo;
}

void fake_machine_set_latency(uint32_t half_us)
{
    bus.latency = half_us;
}

void fake_machine_set_least_patience(uint32_t half_us)
{
    bus.least_patience = half_us;
}

void fake_machine_set_echo(bool echoes)
{
    bus.echoes = echoes;
}

void fake_machine_plug(bool there)
{
    bus.is_there = there;
    bus.count = 0;
}

uint16_t fake_machine_packets(void)
{
    return bus.packets;
}

uint32_t fake_machine_rate(void)
{
    return bus.rate;
}

bool machine_bus_is_there(void)
{
    return bus.is_there;
}

uint32_t machine_bus_first_patience(void)
{
    return 160000u;   /* 80 ms */
}

uint32_t machine_bus_least_patience(void)
{
    return bus.least_patience;
}

uint32_t machine_bus_rate(uint8_t divisor)
{
    bus.rate = 2000000u / (divisor + 1u);
    return bus.rate;
}

static void bring(const uint8_t *bytes, uint16_t count)
{
    ASSERT(bus.count < UNDER_WAY);
    bus.under_way[bus.count].at = bus.line_free + bus.latency;
    bus.under_way[bus.count].count = count;
    memcpy(bus.under_way[bus.count].bytes, bytes, count);
    bus.count++;
}

void machine_bus_write(const uint8_t *bytes, uint16_t count)
{
    uint8_t answer[PACKET_BYTES];
    ASSERT(bus.is_there && bus.rate != 0);
    bus.packets++;
    bus.line_free = (now > bus.line_free ? now : bus.line_free) + (uint64_t)count * 20000000u / bus.rate;
    if (bus.echoes) {
        bring(bytes, count);
    }
    const uint16_t size = bus.servo != NULL ? bus.servo(bytes, count, answer) : 0;
    if (size > 0) {
        bring(answer, size);
    }
}

uint16_t machine_bus_read(uint8_t *to, uint16_t room)
{
    if (bus.count == 0 || bus.under_way[0].at > now) {
        return 0;
    }
    const uint16_t count = bus.under_way[0].count;
    ASSERT(count <= room);
    memcpy(to, bus.under_way[0].bytes, count);
    memmove(bus.under_way, bus.under_way + 1, sizeof bus.under_way - sizeof bus.under_way[0]);
    bus.count--;
    return count;
}

/* ---- console ---- */

static const char *typed = "";
static bool output_is_blocked;

void fake_machine_type(const char *text)
{
    typed = text;
}

void fake_machine_block(bool blocked)
{
    output_is_blocked = blocked;
}

uint16_t machine_console_read(uint8_t *to, uint16_t room)
{
    const size_t left = strlen(typed);
    const uint16_t count = left < room ? (uint16_t)left : room;
    memcpy(to, typed, count);
    typed += count;
    return count;
}

uint16_t machine_console_write(const uint8_t *bytes, uint16_t count)
{
    (void)bytes;
    return output_is_blocked ? 0 : count;
}

uint8_t machine_buttons(void)
{
    return 0;
}

void machine_tell(const char *sentence)
{
    (void)sentence;
}

void machine_watch(void)
{
}

bool machine_is_asked_to_end(void)
{
    return false;
}

void machine_end(void)
{
    abort();
}

/* ---- memory ---- */

void fake_machine_cut(uint32_t write, uint32_t seed, jmp_buf *where)
{
    memory.writes = 0;
    memory.cut_at = write;
    memory.random = seed * 2654435761u + 1u;
    memory.cut_to = where;
}

uint32_t fake_machine_writes(void)
{
    return memory.writes;
}

static bool by_chance(void)
{
    memory.random = memory.random * 1664525u + 1013904223u;
    return (memory.random >> 31) != 0;
}

/* Each byte of the write that is cut becomes the old or the new one. */
static void cut(machine_memory_t which, uint32_t at, uint32_t count)
{
    for (uint32_t i = at; i < at + count; i++) {
        if (by_chance()) {
            memory.sure[which][i] = memory.now[which][i];
        }
    }
    memcpy(memory.now, memory.sure, sizeof memory.now);
    memory.cut_at = 0;
    longjmp(*memory.cut_to, 1);
}

bool machine_recall(machine_memory_t which, uint8_t *bytes, uint32_t count)
{
    ASSERT(count <= MEMORY_BYTES);
    if (!memory.is_there[which]) {
        memory.is_there[which] = true;
        memcpy(memory.now[which], bytes, count);
        memcpy(memory.sure[which], bytes, count);
        return false;
    }
    memcpy(bytes, memory.now[which], count);
    return true;
}

bool machine_keep(machine_memory_t which, uint32_t at, const uint8_t *bytes, uint32_t count, bool sure)
{
    ASSERT(memory.is_there[which] && at + count <= MEMORY_BYTES);
    const bool is_written = sure || by_chance();   /* the computer writes when it likes, too */
    if (!sure && is_written) {
        machine_settle(which);
    }
    memcpy(memory.now[which] + at, bytes, count);
    if (++memory.writes == memory.cut_at) {
        cut(which, at, is_written ? count : 0);
    }
    if (sure) {
        machine_settle(which);
    }
    return true;
}

void machine_settle(machine_memory_t which)
{
    memcpy(memory.sure[which], memory.now[which], MEMORY_BYTES);
}
