/* SPDX-License-Identifier: MIT
 * servo_bus.h - the half-duplex wire with any number of servos on it. Pure C, no simavr.
 * Time is counted in controller cycles (16 MHz) and never runs backwards. Single-threaded.
 *
 * The wire is the AND of all talkers (a low level wins). A byte of 10 bits lies on it from its start bit to the end
 * of its stop bit; a receiver samples the middle of each bit, so two talkers at once give the bytes and framing
 * errors that a UART would see. A servo that talks, or is about to answer, does not hear. */
#ifndef SIM_SERVO_BUS_H
#define SIM_SERVO_BUS_H

#include "servo.h"
#include "servo_body.h"
#include "servo_fault.h"

#define SERVO_BUS_NEVER UINT64_MAX

/* A byte of a servo has passed completely: value as sampled at rate_bps; bad = no stop bit (collision). The
 * controller's own rate is the receiver's business. */
typedef void (*servo_bus_byte_fn)(void *context, uint64_t now_cycles, uint8_t byte, uint32_t rate_bps, bool bad);

/* A complete instruction packet from the controller has passed, checksum good. */
typedef void (*servo_bus_packet_fn)(void *context, uint64_t now_cycles, const uint8_t *packet, uint8_t count);

typedef struct servo_bus {
    servo_t **servos; /* in order of servo_bus_add() */
    int count;
    servo_body_t body;     /* step NULL: each servo turns its own rotor */
    servo_shaft_t *shafts; /* one a servo */
    uint64_t body_cycles;  /* when the body was stepped last: a multiple of SERVO_STEP_CYCLES */
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
    uint64_t collisions;        /* bytes, of the controller or a servo, that came out spoiled */
} servo_bus_t;

/* An empty bus, powered, 9.6 V. Free with servo_bus_free(). NULL: no memory. */
servo_bus_t *servo_bus_new(void);
void servo_bus_free(servo_bus_t *bus);

/* Plugs in a servo (see servo_init()); it gets power if the bus has it. Several may have the same ID. The pointer
 * stays good until servo_bus_free(). NULL: no memory. */
servo_t *servo_bus_add(servo_bus_t *bus, uint8_t id, servo_model_t model, uint32_t rate_bps);

/* Hangs all shafts on a body (its struct is copied), or takes them off it again: NULL. They jump to where the body has them
 * now. Servos that are plugged in later join it. From here on the bus has an event every 1/1024 s. */
void servo_bus_body(servo_bus_t *bus, uint64_t now_cycles, const servo_body_t *body);

/* First servo with this ID now, or NULL. */
servo_t *servo_bus_find(const servo_bus_t *bus, uint8_t id);

/* The controller's byte has left: its stop bit ends now. */
void servo_bus_host_byte(servo_bus_t *bus, uint64_t now_cycles, uint8_t byte, uint32_t rate_bps);

/* A whole packet of the controller has left, its bytes back to back: the last stop bit ends now. The same as one call of
 * servo_bus_host_byte() for each, and a good packet on a quiet wire costs a tenth of that. */
void servo_bus_host_packet(servo_bus_t *bus, uint64_t now_cycles, const uint8_t *packet, uint8_t count, uint32_t rate_bps);

/* Time of the bus's next own event, SERVO_BUS_NEVER = none. Changes only inside calls of this module. */
static inline uint64_t servo_bus_next_cycles(const servo_bus_t *bus)
{
    return bus->next_cycles;
}

/* Lets everything up to and including now happen. on_byte and on_packet are called in here. */
void servo_bus_advance(servo_bus_t *bus, uint64_t now_cycles);

/* Supply of the servos (switched with the board): on or off, and how much. */
void servo_bus_power(servo_bus_t *bus, uint64_t now_cycles, bool on);
void servo_bus_supply(servo_bus_t *bus, uint64_t now_cycles, double volts);

/* A fault of one servo (see servo_fault_set()); DUPLICATE plugs in a twin or takes it out, DEAD takes this one's
 * plug out. */
void servo_bus_fault(servo_bus_t *bus, uint64_t now_cycles, servo_t *servo, servo_fault_t fault, uint32_t answers);

/* Puts count (up to SERVO_PACKET_MAX) stray bytes on the wire from now on, whoever else talks. */
void servo_bus_noise(servo_bus_t *bus, uint64_t now_cycles, const uint8_t *bytes, uint8_t count, uint32_t rate_bps);

/* For servo_set.c, in which servos are plugged in and get their supply: sets next_cycles, at the end of whatever changes who
 * talks, or the body; and takes each servo's shaft as it stands now, in the body or by itself. */
#define SERVO_TWIN_SKEW_US 3u /* servos with the same ID do not answer in step */
void servo_bus_update_next(servo_bus_t *bus);
void servo_bus_look_at_body(servo_bus_t *bus);

#endif
