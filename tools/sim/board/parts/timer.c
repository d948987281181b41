/* SPDX-License-Identifier: MIT
 * Timers 1 and 3, on which the firmware's time base depends. (Timers 0 and 2 are simavr's.) They count lazily:
 * registers are updated when read or written, and an event is scheduled only for a flag whose interrupt is enabled. */
#include "timer.h"

#define SOURCES 4 /* compare A, B, C, overflow */
#define NO_TICK UINT64_MAX
enum { WGM_NORMAL = 0, WGM_CTC_OCR = 4, WGM_CTC_ICR = 12 };

typedef struct {
    uint16_t control_a, control_b, tcnt, ocr[3], icr; /* addresses; for a pair, the low byte */
    struct { uint16_t flags; uint8_t mask; } source[SOURCES]; /* the mask register follows the flags */
} place_t;

static const place_t places[2] = {
    { 0x4F, 0x4E, 0x4C, { 0x4A, 0x48, 0x78 }, 0x46,
      { { M128_TIFR, 0x10 }, { M128_TIFR, 0x08 }, { M128_ETIFR, 0x01 }, { M128_TIFR, 0x04 } } },
    { 0x8B, 0x8A, 0x88, { 0x86, 0x84, 0x82 }, 0x80,
      { { M128_ETIFR, 0x10 }, { M128_ETIFR, 0x08 }, { M128_ETIFR, 0x02 }, { M128_ETIFR, 0x04 } } },
};

static const place_t *place_of(const timer16_t *timer) { return &places[timer->index]; }

static uint32_t top_of(const timer16_t *timer)
{
    return timer->mode == WGM_CTC_OCR ? timer->ocr[0] : timer->mode == WGM_CTC_ICR ? timer->icr : 0xFFFF;
}

/* Ticks until a source sets its flag: one after the match, when the count continues or returns to 0. A count above the
 * top (OCR was set too low) runs on to 0xFFFF, as in the chip. */
static uint64_t ticks_to(const timer16_t *timer, int source)
{
    uint32_t count = timer->count, top = top_of(timer);
    uint32_t end = count > top ? 0xFFFF : top; /* last count of this turn */
    if (source == SOURCES - 1) {
        return end == 0xFFFF ? 0x10000u - count : NO_TICK;
    }
    uint32_t target = timer->ocr[source];
    if (target >= count && target <= end) {
        return target - count + 1;
    }
    return target <= top ? (uint64_t)end - count + 1 + target + 1 : NO_TICK;
}

static uint16_t count_after(const timer16_t *timer, uint64_t ticks)
{
    uint32_t top = top_of(timer);
    uint32_t end = timer->count > top ? 0xFFFF : top;
    uint64_t left = end - timer->count;
    return (uint16_t)(ticks <= left ? timer->count + ticks : (ticks - left - 1) % (top + 1u));
}

/* Updates count and flags to now. The prescaler always runs. */
static void sync(timer16_t *timer, uint64_t now)
{
    uint8_t *data = timer->machine->avr->data;
    uint64_t ticks = timer->prescale ? now / timer->prescale - timer->at / timer->prescale : 0;
    for (int i = 0; ticks && i < SOURCES; i++) {
        if (ticks >= ticks_to(timer, i)) {
            data[place_of(timer)->source[i].flags] |= place_of(timer)->source[i].mask;
        }
    }
    timer->count = count_after(timer, ticks);
    timer->at = now;
}

static void schedule(timer16_t *timer)
{
    const place_t *place = place_of(timer);
    const uint8_t *data = timer->machine->avr->data;
    uint64_t ticks = NO_TICK;
    for (int i = 0; timer->prescale && i < SOURCES; i++) {
        uint16_t flags = place->source[i].flags;
        bool wanted = data[flags + 1] & (uint8_t)~data[flags] & place->source[i].mask;
        uint64_t next = wanted ? ticks_to(timer, i) : NO_TICK;
        ticks = next < ticks ? next : ticks;
    }
    event_at(&timer->machine->events, timer->index ? EVENT_TIMER3 : EVENT_TIMER1,
             ticks == NO_TICK ? NEVER : (timer->at / timer->prescale + ticks) * timer->prescale);
}

static void follow(void *context, uint64_t now)
{
    timer16_t *timer = context;
    sync(timer, now);
    schedule(timer);
}

static void flags_changed(timers_t *timers)
{
    for (int i = 0; i < 2; i++) {
        follow(&timers->timer[i], timers->machine->avr->cycle);
    }
}

static void interrupt_taken(void *context, int vector)
{
    (void)vector;
    flags_changed(context);
}

static uint8_t read_flags(avr_t *avr, avr_io_addr_t address, void *param)
{
    flags_changed(param);
    return avr->data[address];
}

static void write_flags(avr_t *avr, avr_io_addr_t address, uint8_t value, void *param)
{
    flags_changed(param); /* sets the flags that are due before clearing */
    avr->data[address] &= (uint8_t)~value;
    flags_changed(param);
}

static void write_mask(avr_t *avr, avr_io_addr_t address, uint8_t value, void *param)
{
    avr->data[address] = value;
    flags_changed(param);
}

static uint8_t read_tcnt(avr_t *avr, avr_io_addr_t address, void *param)
{
    timer16_t *timer = param;
    if (address == place_of(timer)->tcnt) {
        follow(timer, avr->cycle);
        timer->temp = (uint8_t)(timer->count >> 8);
        return avr->data[address] = (uint8_t)timer->count;
    }
    return avr->data[address] = timer->temp;
}

static uint16_t *pair_at(timer16_t *timer, avr_io_addr_t low)
{
    const place_t *place = place_of(timer);
    return low == place->tcnt     ? &timer->count
           : low == place->ocr[0] ? &timer->ocr[0]
           : low == place->ocr[1] ? &timer->ocr[1]
           : low == place->ocr[2] ? &timer->ocr[2]
                                  : &timer->icr;
}

/* 16-bit registers: the high byte waits in TEMP until the low byte is written. */
static void write_pair(avr_t *avr, avr_io_addr_t address, uint8_t value, void *param)
{
    timer16_t *timer = param;
    if (address & 1) {
        timer->temp = value;
        return;
    }
    sync(timer, avr->cycle);
    *pair_at(timer, address) = (uint16_t)(timer->temp << 8 | value);
    avr->data[address] = value;
    avr->data[address + 1] = timer->temp;
    schedule(timer);
}

static void set_prescale(timer16_t *timer, uint16_t prescale)
{
    timer->prescale = prescale;
    timer->machine->count_cycles[timer->index] = prescale;
}

static void write_control(avr_t *avr, avr_io_addr_t address, uint8_t value, void *param)
{
    static const uint16_t prescales[8] = { 0, 1, 8, 64, 256, 1024, 0, 0 };
    timer16_t *timer = param;
    const place_t *place = place_of(timer);
    sync(timer, avr->cycle);
    avr->data[address] = value;
    unsigned a = avr->data[place->control_a], b = avr->data[place->control_b];
    timer->mode = (uint8_t)((a & 3) | (b >> 1 & 0x0C));
    set_prescale(timer, prescales[b & 7]);
    bool counts = timer->mode == WGM_NORMAL || timer->mode == WGM_CTC_OCR || timer->mode == WGM_CTC_ICR;
    if ((b & 7) > 5 || (timer->prescale && !counts)) {
        violation_note(timer->machine, VIOLATION_UNMODELLED, "timer %d in PWM or on an outside clock",
                       timer->index ? 3 : 1);
    }
    schedule(timer);
}

static void reset(timer16_t *timer)
{
    timer->at = timer->machine->avr->cycle;
    timer->count = timer->icr = timer->ocr[0] = timer->ocr[1] = timer->ocr[2] = 0;
    set_prescale(timer, 0);
    timer->mode = WGM_NORMAL;
    schedule(timer);
}

void timers_reset(timers_t *timers)
{
    reset(&timers->timer[0]);
    reset(&timers->timer[1]);
}

static void take_pair(timer16_t *timer, uint16_t low, avr_io_read_t read)
{
    machine_io(timer->machine, low, read, write_pair, timer);
    machine_io(timer->machine, low + 1, read, write_pair, timer);
}

static void init(timer16_t *timer, machine_t *machine, int index)
{
    const place_t *place = &places[index];
    timer->machine = machine;
    timer->index = (uint8_t)index;
    events_handle(&machine->events, index ? EVENT_TIMER3 : EVENT_TIMER1, follow, timer);
    machine_io(machine, place->control_a, NULL, write_control, timer);
    machine_io(machine, place->control_b, NULL, write_control, timer);
    take_pair(timer, place->tcnt, read_tcnt);
    take_pair(timer, place->icr, NULL);
    for (int i = 0; i < 3; i++) {
        take_pair(timer, place->ocr[i], NULL);
    }
}

void timers_init(timers_t *timers, machine_t *machine)
{
    static const uint8_t vectors[] = { VECTOR_T1_CAPT, VECTOR_T1_COMPA, VECTOR_T1_COMPB, VECTOR_T1_COMPC, VECTOR_T1_OVF,
                                       VECTOR_T3_CAPT, VECTOR_T3_COMPA, VECTOR_T3_COMPB, VECTOR_T3_COMPC, VECTOR_T3_OVF };
    timers->machine = machine;
    init(&timers->timer[0], machine, 0);
    init(&timers->timer[1], machine, 1);
    machine_io(machine, M128_TIFR, read_flags, write_flags, timers);
    machine_io(machine, M128_ETIFR, read_flags, write_flags, timers);
    machine_io(machine, M128_TIMSK, NULL, write_mask, timers);
    machine_io(machine, M128_ETIMSK, NULL, write_mask, timers);
    for (unsigned i = 0; i < sizeof vectors; i++) {
        machine->source[vectors[i]] = (interrupt_source_t){ interrupt_taken, NULL, timers };
    }
}
