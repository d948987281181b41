/* SPDX-License-Identifier: MIT
 * bus_core.h - the half-duplex engine of bus.h, without registers: bytes and times in, states out. It uses bus_port.h.
 * Three callers: the main loop (submit, poll), the transmit ISR (on_last, on_sent) and the receive ISR (on_byte).
 * The ISR side only moves bytes; bus_core_poll parses packets. RAM: one bus_core_t (bus.h).
 *
 *        submit                    the last bytes go to the UART      transmit complete
 *  IDLE ---------> SENDING --------------------------------> TURNING -----------------> LISTENING
 *   ^                ^                                          |                        |  |
 *   |                |  a try is left and the line is quiet     |  no answer expected    |  |
 *   |                +------------------------------------------|------------------------+  |
 *   +-----------------------------------------------------------+---------------------------+
 *                            poll finds the answer complete, or the last try failed
 *
 * TURNING ends only on transmit complete, never on data register empty: until then the last bits are on the wire and the
 * line must not be released. */
#ifndef BUS_CORE_H
#define BUS_CORE_H

#include "bus.h"
#include "dxl_packet.h"
#include "target.h"

typedef enum { BUS_IDLE = 0, BUS_SENDING, BUS_TURNING, BUS_LISTENING } bus_state_t;

/* Flags of a received byte. */
enum { BUS_BYTE_FRAMING = 1 << 0, BUS_BYTE_OVERRUN = 1 << 1 };

/* Room for the bytes of one try: the longest answer and four bytes of noise before it. */
#define BUS_HEARD_BYTES (DXL_ANSWER_PARAMS + DXL_PACKET_OVERHEAD + 4u)

/* Half microseconds, free-running. 16 bits on the board, more where answers take longer. */
typedef TARGET_BUS_TIME bus_time_t;
typedef TARGET_BUS_SPAN bus_span_t;

/* Silence required after a failed try before the next one. */
#define BUS_QUIET_HALF_US 200u

typedef struct {
    volatile uint8_t state;       /* bus_state_t; written by main loop and ISRs, see the figure */
    volatile uint8_t result;      /* bus_status_t of the packet */
    uint8_t failure;              /* LISTENING: why this try has failed; BUS_OK: not failed */
    uint8_t size, asked_id, answer_params, tries_left;
    uint8_t parsed;               /* bytes of heard[] parsed so far */
    volatile bool sent;           /* ISR: transmit complete; cleared by poll */
    volatile uint8_t heard_count; /* ISR: bytes in heard[] */
    volatile uint8_t heard_flags; /* ISR: BUS_BYTE_ flags of this try */
    uint16_t byte_half_us;        /* time of one character */
    uint16_t return_delay_half_us;
    volatile bus_time_t since;     /* when the line was last active: transmit complete (ISR), then bytes seen by poll */
    ring_t *volatile tap;
    bus_counts_t counts;          /* all but strays: main loop */
    volatile uint16_t strays;     /* ISR */
    const uint8_t *status;        /* the good answer, within heard[] */
    uint8_t heard[BUS_HEARD_BYTES];
    uint8_t packet[BUS_PACKET_BYTES];
} bus_core_t;

/* Idle, 1 Mbps, the longest return delay, counts 0. */
void bus_core_init(bus_core_t *core);
void bus_core_set_rate(bus_core_t *core, uint8_t divisor);
bus_status_t bus_core_submit(bus_core_t *core, uint8_t size, uint8_t answer_params, uint8_t tries);
bus_status_t bus_core_poll(bus_core_t *core, bus_time_t now_half_us, bus_answer_t *answer);
bool bus_core_has_news(const bus_core_t *core);
void bus_core_counts(const bus_core_t *core, bus_counts_t *counts);

/* ---- ISR side; inline to save cycles: at 1 Mbps a byte arrives every 160 ---- */

static inline void bus_core_on_last(bus_core_t *core)
{
    core->state = BUS_TURNING;
}

void bus_core_on_sent(bus_core_t *core, bus_time_t now_half_us);

/* Skips a byte without a stop bit: if it was a glitch before the answer, the answer is still good. */
static inline void bus_core_on_byte(bus_core_t *core, uint8_t byte, uint8_t flags)
{
    uint8_t count = core->heard_count;
    if (core->tap != 0) {
        (void)ring_put(core->tap, byte);
        return;   /* 160 cycles are not enough for both */
    }
    if (core->state != BUS_LISTENING) {
        core->strays = (uint16_t)(core->strays + 1u);
        return;
    }
    core->heard_flags |= flags;
    if (count < BUS_HEARD_BYTES && !(flags & BUS_BYTE_FRAMING)) {
        core->heard[count] = byte;
        irq_barrier();
        core->heard_count = (uint8_t)(count + 1u);
    }
}

#endif
