/* SPDX-License-Identifier: MIT
 * servo_bus.h - the half-duplex wire with any number of servos. Pure C, no simavr.
 * Time is counted in controller cycles (16 MHz) and never runs backwards. Single-threaded.
 *
 * The level of the wire is the AND of all senders (low wins). A byte of 10 bits occupies the wire from its start bit to
 * the end of its stop bit. A receiver samples the middle of each bit, so two senders at once give the bytes and framing
 * errors that a UART would see. A servo that is sending, or about to reply, does not receive. */
#ifndef SIM_SERVO_BUS_H
#define SIM_SERVO_BUS_H

#include "servo.h"
#include "servo_body.h"
#include "servo_fault.h"

#define SERVO_BUS_NEVER UINT64_MAX

/* A byte of a servo has passed completely. byte: as sampled at rate_bps; bad: no stop bit (collision). The receiver
 * checks the rate itself. */
typedef void (*servo_bus_byte_fn)(void *context, uint64_t now_cycles, uint8_t byte, uint32_t rate_bps, bool bad);

/* A complete instruction packet of the controller with a good checksum has passed. */
typedef void (*servo_bus_packet_fn)(void *context, uint64_t now_cycles, const uint8_t *packet, uint8_t count);

typedef struct servo_bus {
    servo_t **servos; /* in order of servo_bus_add() */
    int count;
    servo_body_t body;     /* step NULL: each servo turns its own rotor */
    servo_shaft_t *shafts; /* one for each servo */
    uint64_t body_cycles;  /* time of the last step of the body: a multiple of SERVO_STEP_CYCLES */
    bool powered;
    double supply_v;
    uint64_t now_cycles;
    uint64_t next_cycles; /* see servo_bus_next_cycles() */

    servo_bus_byte_fn on_byte;
    void *on_byte_context;
    servo_bus_packet_fn on_packet;
    void *on_packet_context;

    servo_talk_t host;          /* the newest byte of the controller */
    servo_talk_t noise;         /* servo_bus_noise() */
    servo_parser_t host_parser; /* for on_packet */
    uint64_t collisions;        /* spoiled bytes of the controller or a servo */
} servo_bus_t;

/* Makes an empty bus with power, 9.6 V. NULL: out of memory. */
servo_bus_t *servo_bus_new(void);
void servo_bus_free(servo_bus_t *bus);

/* Adds a servo (see servo_init()); it has power if the bus has. Several servos may have the same ID. The pointer is
 * valid until servo_bus_free(). NULL: out of memory. */
servo_t *servo_bus_add(servo_bus_t *bus, uint8_t id, servo_model_t model, uint32_t rate_bps);

/* Connects all shafts to a body (the struct is copied), or disconnects them (NULL). They jump to their angles in the
 * body. Servos added later join it. With a body, the bus has an event every 1/1024 s. */
void servo_bus_body(servo_bus_t *bus, uint64_t now_cycles, const servo_body_t *body);

/* First servo that has this ID now, or NULL. */
servo_t *servo_bus_find(const servo_bus_t *bus, uint8_t id);

/* The controller has sent a byte: its stop bit ends now. */
void servo_bus_host_byte(servo_bus_t *bus, uint64_t now_cycles, uint8_t byte, uint32_t rate_bps);

/* The controller has sent a whole packet, its bytes back to back: the last stop bit ends now. Same effect as one
 * servo_bus_host_byte() for each byte, but a good packet on a quiet wire costs a tenth of the time. */
void servo_bus_host_packet(servo_bus_t *bus, uint64_t now_cycles, const uint8_t *packet, uint8_t count, uint32_t rate_bps);

/* Time of the bus's next own event; SERVO_BUS_NEVER: none. Changes only inside calls of this module. */
static inline uint64_t servo_bus_next_cycles(const servo_bus_t *bus)
{
    return bus->next_cycles;
}

/* Handles everything up to and including now. Calls on_byte and on_packet. */
void servo_bus_advance(servo_bus_t *bus, uint64_t now_cycles);

/* Supply of the servos, switched with the board: on or off, and its voltage. */
void servo_bus_power(servo_bus_t *bus, uint64_t now_cycles, bool on);
void servo_bus_supply(servo_bus_t *bus, uint64_t now_cycles, double volts);

/* Sets a fault of one servo (see servo_fault_set()). DUPLICATE adds a twin or disables it. DEAD unplugs this servo. */
void servo_bus_fault(servo_bus_t *bus, uint64_t now_cycles, servo_t *servo, servo_fault_t fault, uint32_t answers);

/* Puts count (up to SERVO_PACKET_MAX) stray bytes on the wire from now on, in addition to other senders. */
void servo_bus_noise(servo_bus_t *bus, uint64_t now_cycles, const uint8_t *bytes, uint8_t count, uint32_t rate_bps);

/* For servo_set.c, which adds servos and sets their supply. servo_bus_update_next() sets next_cycles after any change
 * of the senders or the body. servo_bus_look_at_body() reads the present angle of each shaft, from the body or from the
 * servo. */
#define SERVO_TWIN_SKEW_US 3u /* servos with the same ID do not reply in step */
void servo_bus_update_next(servo_bus_t *bus);
void servo_bus_look_at_body(servo_bus_t *bus);

#endif
