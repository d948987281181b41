/* SPDX-License-Identifier: MIT
 * board_ports.h - what is plugged into the board: the PC's serial line and the remote on UART1, the servo bus on
 * UART0, panel, battery. Part of board.h. */
#ifndef SIM_BOARD_PORTS_H
#define SIM_BOARD_PORTS_H

#include <stddef.h>

#include "board.h"

/* Console: the PC end of UART1 at 57,600 bps, or at the rate set here. Bytes wait in a queue without limit and go
 * on the line back to back; the remote's bytes share the queue, because they share the wire. A byte is heard when the
 * gate of its sender (CM-5: PD5 for the PC, PD6 for the remote) is open from its start bit to its end. */
typedef enum { CONSOLE_PC, CONSOLE_REMOTE } console_sender_t;
void board_console_rate(board_t *board, uint32_t bps);
void board_console_send(board_t *board, console_sender_t sender, const uint8_t *bytes, size_t count);

/* Nothing on the line for so long (counted in microseconds, up to an hour), behind what is queued already. */
void board_console_pause(board_t *board, uint64_t cycles);

/* Bytes still queued or on the line; drops them. */
size_t board_console_waiting(const board_t *board);
void board_console_flush(board_t *board);

/* Everything the board has sent since board_new(), as the PC heard it. The pointer is good until the next run.
 * Forgetting begins anew with nothing (a run of hours would fill the memory); the room stays for what comes. */
const uint8_t *board_console_output(const board_t *board, size_t *count);
void board_console_forget(board_t *board);

/* Called for each byte the PC hears, when its stop bit has passed. bad: framing error (wrong rate). */
typedef void (*board_byte_fn)(void *context, uint64_t now_cycles, uint8_t byte, bool bad);
void board_on_console(board_t *board, board_byte_fn heard, void *context);

/* The servo bus (servo_bus.h), made with the board, empty. Add servos before power-on or while it runs. */
struct servo_bus *board_servo_bus(board_t *board);

/* Hangs the servos' shafts on a body, in lock step with the board; NULL: each turns its own rotor again. Which calls a body
 * answers and when: servo_body.h. What `body` points to must live as long as it is attached. */
struct servo_body;
void board_body(board_t *board, const struct servo_body *body);

/* The longest time, in cycles, between the last stop bit of a packet of the board's and its listening again: a servo that
 * answers sooner is not heard. forget: measure anew. */
uint64_t board_bus_turn(board_t *board, bool forget);

/* The longest pause, in cycles, between two characters of a packet of the board's. forget: measure anew. */
uint64_t board_bus_pause(board_t *board, bool forget);

/* Keeps every instruction packet with a good checksum that the board sends to the servos, from now on (what was kept
 * before is dropped). It uses the bus's on_packet. The pointer is good until the next run. */
typedef struct {
    uint64_t cycle;
    uint8_t count, bytes[143];
} trace_packet_t;
bool board_trace_start(board_t *board);
const trace_packet_t *board_trace(const board_t *board, size_t *count);

/* Counters of a UART (0 bus, 1 console) since board_new(); they never fall. */
typedef struct {
    uint64_t sent, received; /* characters */
    uint64_t overruns;       /* received characters lost in the UART */
    uint64_t framing;        /* received with a framing error */
    uint64_t deaf;           /* passed while the receiver was off or its gate closed */
} uart_counts_t;
void board_uart_counts(const board_t *board, int uart, uart_counts_t *counts);

/* Panel of the CM-5 (a CM-2 build has none that is known: LEDs dark, buttons without effect). */
typedef enum { BUTTON_UP, BUTTON_DOWN, BUTTON_LEFT, BUTTON_RIGHT, BUTTON_START, BUTTON_MODE, BUTTON_COUNT } button_t;
typedef enum { LED_POWER, LED_TXD, LED_RXD, LED_AUX, LED_MANAGE, LED_PROGRAM, LED_PLAY, LED_COUNT } led_t;
void board_press(board_t *board, button_t button, bool down);

/* Contacts bounce: for so long behind each press and release a button reads as one or the other, by chance, in slices of
 * 0.1 ms (the first one as what it becomes). 5 ms at first; 0: none. MODE does not: whatever its contact does, the chip
 * starts once, after it (its start-up time is longer). */
void board_set_bounce(board_t *board, uint64_t cycles);
uint8_t board_leds(const board_t *board); /* bit n: led_t n is lit */

/* One port pin as the outside sees it: 0, 1, or -1 when nothing drives it. port 'A'..'G'. */
int board_pin(const board_t *board, char port, int bit);

/* Battery voltage (9.6 V at first). On the CM-5 ADC0 sees BOARD_BATTERY_DIVIDER of it; the servos are fed with it.
 * ADC2 sees the thermistor as a voltage. */
#define BOARD_BATTERY_DIVIDER 0.25
void board_battery(board_t *board, double volts);
void board_thermistor(board_t *board, double volts);

#endif
