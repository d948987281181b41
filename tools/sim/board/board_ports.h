/* SPDX-License-Identifier: MIT
 * board_ports.h - what is connected to the board: the PC's serial line and the remote on UART1, the servo bus on UART0,
 * the panel, the battery. Part of board.h. */
#ifndef SIM_BOARD_PORTS_H
#define SIM_BOARD_PORTS_H

#include <stddef.h>

#include "board.h"

/* Console: the PC end of UART1 at 57,600 bps or the rate set here. Bytes wait in an unlimited queue and go out back to
 * back. The bytes of the remote share the queue, because they share the wire. The board receives a byte if the gate of
 * its sender (CM-5: PD5 for the PC, PD6 for the remote) is open from the start bit to the end. */
typedef enum { CONSOLE_PC, CONSOLE_REMOTE } console_sender_t;
void board_console_rate(board_t *board, uint32_t bps);
void board_console_send(board_t *board, console_sender_t sender, const uint8_t *bytes, size_t count);

/* Adds a pause to the queue, after what waits there. It is counted in microseconds, up to an hour. */
void board_console_pause(board_t *board, uint64_t cycles);

/* Number of bytes still queued or on the line; flush drops them. */
size_t board_console_waiting(const board_t *board);
void board_console_flush(board_t *board);

/* Everything the board has sent since board_new(), as the PC received it. The pointer is valid until the next run.
 * Forgetting empties the buffer but keeps its memory; hours of output would otherwise fill the memory. */
const uint8_t *board_console_output(const board_t *board, size_t *count);
void board_console_forget(board_t *board);

/* Called for each byte that the PC receives, after its stop bit. bad: framing error (wrong rate). */
typedef void (*board_byte_fn)(void *context, uint64_t now_cycles, uint8_t byte, bool bad);
void board_on_console(board_t *board, board_byte_fn heard, void *context);

/* The servo bus (servo_bus.h), made empty together with the board. Add servos before power-on or during the run. */
struct servo_bus *board_servo_bus(board_t *board);

/* Connects the servo shafts to a body, in lock step with the board. NULL: each servo turns its own rotor again.
 * servo_body.h says which calls a body answers, and when. *body must live as long as it is attached. */
struct servo_body;
void board_body(board_t *board, const struct servo_body *body);

/* The longest time, in cycles, from the last stop bit of a packet of the board until the board listens again. An
 * earlier servo reply is lost. forget: starts a new measurement. */
uint64_t board_bus_turn(board_t *board, bool forget);

/* The longest pause, in cycles, between two characters of a packet of the board. forget: starts a new measurement. */
uint64_t board_bus_pause(board_t *board, bool forget);

/* Records every instruction packet with a good checksum that the board sends to the servos from now on, and drops
 * earlier records. Uses the bus's on_packet. The pointer is valid until the next run. */
typedef struct {
    uint64_t cycle;
    uint8_t count, bytes[143];
} trace_packet_t;
void board_trace_start(board_t *board);
const trace_packet_t *board_trace(const board_t *board, size_t *count);

/* Counters of a UART (0 bus, 1 console) since board_new(). They never decrease. */
typedef struct {
    uint64_t sent, received; /* characters */
    uint64_t overruns;       /* received characters lost in the UART */
    uint64_t framing;        /* received with a framing error */
    uint64_t deaf;           /* passed while the receiver was off or its gate closed */
} uart_counts_t;
void board_uart_counts(const board_t *board, int uart, uart_counts_t *counts);

/* Panel of the CM-5. The panel of the CM-2 is unknown: its LEDs stay dark and its buttons have no effect. */
typedef enum { BUTTON_UP, BUTTON_DOWN, BUTTON_LEFT, BUTTON_RIGHT, BUTTON_START, BUTTON_MODE, BUTTON_COUNT } button_t;
typedef enum { LED_POWER, LED_TXD, LED_RXD, LED_AUX, LED_MANAGE, LED_PROGRAM, LED_PLAY, LED_COUNT } led_t;
void board_press(board_t *board, button_t button, bool down);

/* Contact bounce: for this long after each press and release, a button reads as pressed or released at random, in
 * slices of 0.1 ms. The first slice reads as the new state. 5 ms at first; 0: none. MODE does not bounce: the start-up
 * time of the chip is longer than the bounce, so the chip starts once, after it. */
void board_set_bounce(board_t *board, uint64_t cycles);
uint8_t board_leds(const board_t *board); /* bit n: led_t n is lit */

/* One port pin as seen from outside: 0, 1, or -1 if nothing drives it. port 'A'..'G'. */
int board_pin(const board_t *board, char port, int bit);

/* Battery voltage (9.6 V at first). It also feeds the servos. On the CM-5, ADC0 measures BOARD_BATTERY_DIVIDER of it.
 * ADC2 measures the thermistor voltage. */
#define BOARD_BATTERY_DIVIDER 0.25
void board_battery(board_t *board, double volts);

#endif
