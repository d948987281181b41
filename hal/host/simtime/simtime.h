/* SPDX-License-Identifier: MIT
 * simtime.h - simulated time: the machine of machine.h without a computer. Time passes only while the program waits, so
 * hours take seconds, and one seed decides everything. Knows no servos: what is on the bus, who types and what fails is the
 * caller's, through this header.
 *
 * The program is a shared object that is loaded for each run (simtime_run), so it begins with fresh memory like a chip that
 * is switched on. One thread, one machine. Times are half microseconds since the first run began, and never fall. */
#ifndef SIMTIME_H
#define SIMTIME_H

#include <stdbool.h>
#include <stdint.h>

#include "machine.h"

#define SIMTIME_PER_MS 2000u
#define SIMTIME_TICK 15625u          /* 1/128 s */
#define SIMTIME_NEVER UINT64_MAX

/* How a run ended. */
typedef enum {
    SIMTIME_ENDED,      /* the program ended by itself: a restart, or somebody asked for it */
    SIMTIME_CUT,        /* the power was cut */
    SIMTIME_HUNG,       /* it did not kick the watchdog for a second */
    SIMTIME_STOPPED     /* simtime_stop() */
} simtime_end_t;

/* What the caller of this module does. Called while the program waits or calls the machine. */
typedef struct {
    /* The servo bus: the last bit of a packet leaves at `end`; when something happens there next; time passes there. */
    void (*bus_packet)(uint64_t end, const uint8_t *packet, uint16_t count, uint32_t bits_per_s);
    uint64_t (*bus_next)(void);
    void (*bus_advance)(uint64_t now);
    /* 1/128 s has passed. May call simtime_stop(). */
    void (*tick)(void);
    /* The program has read one more byte of the console. */
    void (*was_read)(void);
    /* The program prints; tells the person a sentence beside the console. */
    void (*printed)(const uint8_t *bytes, uint16_t count);
    void (*said)(const char *sentence);
    /* Bytes of a memory are about to be replaced. false: nothing is kept, as on a full disk. May call simtime_cut(). */
    bool (*keep)(machine_memory_t memory, uint32_t at, const uint8_t *bytes, uint32_t count);
} simtime_callbacks_t;

/* Forgets everything, time too. What is kept without power is erased. */
void simtime_init(const simtime_callbacks_t *callbacks);

/* Loads the program from a file, runs it from its beginning (firmware/host/program.c) until it ends. NULL error: it ran. */
simtime_end_t simtime_run(const char *file, const char **error);

/* Ends the run from within a callback. Do not return. */
_Noreturn void simtime_cut(void);
_Noreturn void simtime_stop(void);

uint64_t simtime_now(void);

/* What is kept without power: simtime_bytes() of it, which the caller may change between runs. */
uint8_t *simtime_memory(machine_memory_t memory);
uint32_t simtime_bytes(machine_memory_t memory);

/* Cuts short what is being kept: each of these bytes becomes new or stays old, as `choose` says. Before simtime_cut(), from
 * within keep(). Settings that are not yet sure (machine_settle) become a mixture in the same way. */
void simtime_tear(machine_memory_t memory, uint32_t at, const uint8_t *bytes, uint32_t count, bool (*choose)(void));
void simtime_tear_unsettled(bool (*choose)(void));

/* A byte of a servo has passed; the adapter passes it on `delay` later. */
void simtime_hear(uint8_t byte, uint32_t delay);
/* Bytes on the console's line from now on, or behind those that are still under way, at `byte_time` each. Whether the
 * program has read all. */
void simtime_type(const uint8_t *bytes, uint16_t count, uint32_t byte_time);
bool simtime_has_typed(void);
void simtime_type_pause(uint32_t half_us);    /* the line is silent for so long, before what is typed next */

void simtime_press(uint8_t buttons);          /* panel.h; those that are down from now on */
void simtime_plug(bool is_there);             /* the adapter */
void simtime_hold_up(uint64_t half_us);       /* the computer does something else for so long */
void simtime_ask_to_end(void);                /* as Ctrl-C does */

#endif
