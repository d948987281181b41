/* SPDX-License-Identifier: MIT
 * simtime.h - simulated time: an implementation of machine.h without a computer. Time passes only while the program waits or
 * reads the clock, so hours take seconds, and one seed determines everything. Knows no servos: through this header the
 * caller supplies the bus, the typing and the failures.
 *
 * The program is a shared object that is loaded for each run (simtime_run), so it begins with fresh memory, like a chip that
 * is switched on. One thread, one machine. Times are half microseconds since simtime_init and never decrease. */
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
    SIMTIME_ENDED,      /* the program ended by itself: a restart, or on request */
    SIMTIME_CUT,        /* the power was cut */
    SIMTIME_HUNG,       /* it did not kick the watchdog for a second */
    SIMTIME_STOPPED     /* simtime_stop() */
} simtime_end_t;

/* Functions of the caller of this module. Called while the program waits or calls the machine. */
typedef struct {
    /* The servo bus: the last bit of a packet leaves at `end`; returns the time of its next event; time has advanced. */
    void (*bus_packet)(uint64_t end, const uint8_t *packet, uint16_t count, uint32_t bits_per_s);
    uint64_t (*bus_next)(void);
    void (*bus_advance)(uint64_t now);
    /* 1/128 s has passed. May call simtime_stop(). */
    void (*tick)(void);
    /* The program has read one more byte of the console. */
    void (*was_read)(void);
    /* The program prints; the program shows the user a message (machine_tell). */
    void (*printed)(const uint8_t *bytes, uint16_t count);
    void (*said)(const char *sentence);
    /* Bytes of a memory are about to be replaced. false: nothing is kept, as on a full disk. May call simtime_cut(). */
    bool (*keep)(machine_memory_t memory, uint32_t at, const uint8_t *bytes, uint32_t count);
} simtime_callbacks_t;

/* Resets everything, including the time. Erases the persistent memories. */
void simtime_init(const simtime_callbacks_t *callbacks);

/* Loads the program from a file, runs it from its start (firmware/host/program.c) until it ends. *error: NULL if it ran. */
simtime_end_t simtime_run(const char *file, const char **error);

/* Ends the run from within a callback. Do not return. */
_Noreturn void simtime_cut(void);
_Noreturn void simtime_stop(void);

uint64_t simtime_now(void);

/* A persistent memory of simtime_bytes() bytes. The caller may change it between runs. */
uint8_t *simtime_memory(machine_memory_t memory);
uint32_t simtime_bytes(machine_memory_t memory);

/* Tears a write: each of these bytes becomes new or stays old, as `choose` decides. Call before simtime_cut(), from within
 * keep(). simtime_lose_unsettled takes the EEPROM back to what machine_settle has made certain. */
void simtime_tear(machine_memory_t memory, uint32_t at, const uint8_t *bytes, uint32_t count, bool (*choose)(void));
void simtime_lose_unsettled(void);

/* A servo has sent a byte; the adapter delivers it `delay` later. */
void simtime_hear(uint8_t byte, uint32_t delay);
/* simtime_type sends bytes on the console's line, from now on or after pending ones, at `byte_time` each. simtime_has_typed:
 * whether the program has read all. */
void simtime_type(const uint8_t *bytes, uint16_t count, uint32_t byte_time);
bool simtime_has_typed(void);
void simtime_type_pause(uint32_t half_us);    /* silence on the line before the next typed bytes */

void simtime_press(uint8_t buttons);          /* panel.h; the buttons that are down from now on */
void simtime_plug(bool is_there);             /* plugs or unplugs the adapter */
void simtime_hold_up(uint64_t half_us);       /* the computer's delay at the next wait of the program */
void simtime_ask_to_end(void);                /* like Ctrl-C */

#endif
