/* SPDX-License-Identifier: MIT
 * board_private.h - the one struct behind board.h, for the files of the board model only.
 * Each file owns one part of it (the part's struct says which) and changes no other. */
#ifndef SIM_BOARD_PRIVATE_H
#define SIM_BOARD_PRIVATE_H

#include <simavr/sim_avr.h>
#include <simavr/sim_core.h>
#include <simavr/sim_gdb.h>
#include <stdio.h>

#include "board.h"
#include "board_debug.h"
#include "board_memory.h"
#include "board_ports.h"
#include "m128.h"
#include "symbols.h"

#define NEVER UINT64_MAX

/* Own events, one slot each: simavr's cycle timers do not survive avr_reset(). */
typedef enum {
    EVENT_LIMIT, EVENT_UART0, EVENT_UART1, EVENT_CONSOLE, EVENT_BUS, EVENT_SPM, EVENT_EEPROM, EVENT_WATCHDOG,
    EVENT_POWER, EVENT_CHARGER, EVENT_TIMER1, EVENT_TIMER3, EVENT_COUNT
} event_t;
typedef void (*event_fn)(board_t *board, uint64_t now);

typedef struct { /* events.c */
    uint64_t next; /* the smallest of when[] */
    uint64_t when[EVENT_COUNT];
} events_t;

/* What cpu.c must look at before an instruction, by flash word. Zero for most. */
enum {
    NOTE_STACK = 0x01,   /* PUSH, calls: writes below the stack pointer */
    NOTE_FLASH = 0x02,   /* LPM, ELPM, SPM */
    NOTE_SLEEP = 0x04,
    NOTE_RETI = 0x08,
    NOTE_WRONG = 0x10,   /* erased, illegal or BREAK */
    NOTE_PROBE = 0x20,   /* first instruction of a probed function */
    NOTE_RETURN = 0x40,  /* where a probed function may return to */
    NOTE_STOP = 0x80     /* board_stop_at() */
};

typedef struct { /* cpu.c, interrupt.c */
    uint8_t note[M128_FLASH_BYTES / 2];
    uint64_t lines;        /* interrupt requests of our own modules, bit n = vector n */
    bool sleeping;
    bool enabled_before;   /* I was set before the last instruction too: an interrupt may come */
    uint32_t fetch_floor;  /* addresses below are busy (RWW) */
    uint64_t halted_until; /* CPU stopped by an NRWW page operation */
    uint64_t idle_cycles;
    uint32_t vector_base;  /* 0 or 0x1E000 (IVSEL) */
    uint8_t depth;         /* interrupts nested */
    uint64_t entered[16];
    uint8_t vector[16];
    uint64_t interrupt_cycles, count[VECTOR_COUNT], longest[VECTOR_COUNT];
} cpu_t;

typedef struct { /* stack.c */
    bool set;
    uint16_t low, limit;
} stack_guard_t;

typedef struct { /* flash.c */
    uint16_t page[M128_PAGE_BYTES / 2];
    bool filled[M128_PAGE_BYTES / 2];
    uint8_t control;       /* SPMCSR as written */
    uint64_t armed_until;
    bool busy, rww_locked;
    operation_kind_t operation;
    uint32_t address;
    uint8_t lock, lock_new, fuses[3];
    bool locking;
    uint32_t wear[M128_PAGES];
} flash_t;

typedef struct { /* eeprom.c */
    uint8_t bytes[M128_EEPROM_BYTES];
    uint32_t wear[M128_EEPROM_BYTES];
    bool busy, ready_enabled;
    uint64_t master_until;
    uint16_t address;
    uint8_t value;
} eeprom_t;

#define OPERATION_LOG 65536u
typedef struct { /* power.c */
    bool on;
    uint64_t count;
    struct { uint8_t kind; uint32_t address; } *log; /* ring of OPERATION_LOG */
    uint64_t cut_operation;
    cut_phase_t cut_phase;
    uint32_t cut_tear;
    board_operation_fn done;
    void *done_context;
} power_t;

typedef struct { /* timer.c */
    board_t *board;
    uint8_t index, mode, temp; /* index 0: timer 1, 1: timer 3 */
    uint16_t count, ocr[3], icr, prescale;
    uint64_t at; /* count is as of this cycle */
} timer16_t;

struct uart;
typedef struct uart { /* uart.c */
    board_t *board;
    uint8_t index, a, b, c;
    uint16_t ubrr;
    bool shifting, waiting;      /* transmitter: shift register, UDR */
    uint8_t shift, udr;
    uint32_t rate_bps;           /* of the character in the shift register */
    uint64_t bit_cycles, shift_start;
    uint8_t fifo[3], flags[3];   /* two-character buffer and the receive shift register behind it */
    uint8_t fill;
    uint64_t freed_at;           /* when the receive shift register became free */
    uint64_t enabled_at;         /* RXEN set */
    uart_counts_t counts;
    /* The outside: a character begins to leave; one has left, stop bit included. */
    void (*begin)(struct uart *uart, uint64_t now);
    void (*sent)(struct uart *uart, uint64_t now, uint8_t byte, uint32_t rate_bps);
} uart_t;

typedef struct { uint8_t byte, kind; uint32_t rate; uint64_t cycles; } console_item_t;
typedef struct { /* console.c */
    uint32_t rate_bps;
    console_item_t *queue;
    size_t head, count, room;
    bool on_line;
    bool heard_from_start;
    uint64_t line_start;
    uint8_t *output;
    size_t output_count, output_room;
    board_byte_fn heard;
    void *heard_context;
    char stop_text[128];
    size_t stop_from;
} console_t;

typedef struct { /* bus_wire.c */
    struct servo_bus *bus;
    uint64_t listening_since; /* NEVER: not listening */
    board_bus_fn heard;
    void *heard_context;
} bus_wire_t;

typedef struct { /* panel.c */
    uint8_t pressed; /* bit n: button_t n */
    uint8_t leds;
    /* simavr's own handlers of the port registers, called first so that its pin signals stay right */
    struct { avr_io_write_t write; void *param; } inner[M128_PORTB + 1];
    double battery_v, thermistor_v;
    board_leds_fn changed;
    void *changed_context;
} panel_t;

typedef struct { /* reset.c */
    uint8_t mcucsr, wdtcr;
    uint64_t watchdog_open, ivsel_open; /* ends of the timed sequences */
    uint32_t count;
    reset_cause_t cause;
    bool held, pending;
    reset_cause_t pending_cause;
} reset_t;

struct probes;
struct trace;
struct vcd;

struct board {
    avr_t *avr;
    board_kind_t kind;
    bool bootrst;
    uint32_t random; /* xorshift state */
    bool stopped;
    board_stop_t stop;
    violation_t violation;
    bool allowed[VIOLATION_COUNT];
    uint32_t violations[VIOLATION_COUNT];
    char error[256];
    uint32_t stop_at;
    events_t events;
    cpu_t cpu;
    stack_guard_t stack;
    flash_t flash;
    eeprom_t eeprom;
    power_t power;
    uart_t uart[2];
    timer16_t timer[2];
    console_t console;
    bus_wire_t wire;
    panel_t panel;
    reset_t reset;
    symbols_t symbols;
    struct probes *probes;
    struct trace *trace;
    struct vcd *vcd;
    avr_io_t io; /* how simavr's core asks us about SPM and WDR */
};

/* board.c */
uint32_t board_random(board_t *board);
void board_end_run(board_t *board, board_stop_t why);
/* Takes over one register: simavr's own handlers are not asked any more. NULL: plain memory. */
void board_io(board_t *board, uint16_t address, avr_io_read_t read, avr_io_write_t write, void *param);

/* violation.c: true if the run must end (the caller then leaves the chip's state alone). */
__attribute__((format(printf, 3, 4)))
bool violation_note(board_t *board, violation_kind_t kind, const char *format, ...);

/* events.c */
void event_at(board_t *board, event_t event, uint64_t when);
void events_run(board_t *board);
void event_limit(board_t *board, uint64_t now);

/* cpu.c, opcode.c, interrupt.c, stack.c */
void cpu_init(board_t *board);
void cpu_reset(board_t *board, uint32_t pc);
void cpu_run(board_t *board);
void cpu_step(board_t *board);
uint64_t cpu_instruction_end(const board_t *board); /* of the instruction being executed */
uint8_t opcode_note(uint16_t opcode);
bool opcode_is_legal(uint16_t opcode);
bool opcode_is_push(uint8_t high_byte);
void cpu_flash_changed(board_t *board, uint32_t address, uint32_t count);
bool interrupt_take(board_t *board); /* true: one was taken */
bool interrupt_wanted(const board_t *board);
void interrupt_return(board_t *board);
static inline void interrupt_line(board_t *board, int vector, bool level)
{
    board->cpu.lines = (board->cpu.lines & ~(1ull << vector)) | ((uint64_t)level << vector);
}
void stack_reset(board_t *board);
void stack_moved(board_t *board, uint32_t pc, bool pushed);

/* flash.c, eeprom.c, power.c */
void flash_init(board_t *board);
void flash_reset(board_t *board);
void flash_spm(board_t *board);
bool flash_before_lpm(board_t *board, uint32_t pc, uint16_t opcode); /* true: done, do not execute */
void flash_event(board_t *board, uint64_t now);
void flash_tear(board_t *board, uint32_t tear);
void eeprom_init(board_t *board);
void eeprom_reset(board_t *board);
void eeprom_event(board_t *board, uint64_t now);
void eeprom_tear(board_t *board, uint32_t tear);
void power_begin(board_t *board, operation_kind_t kind, uint32_t address);
void power_done(board_t *board, operation_kind_t kind, uint32_t address);
void power_event(board_t *board, uint64_t now);

/* timer.c */
void timer_init(board_t *board, int index);
void timer_reset(timer16_t *timer);
void timer_event(timer16_t *timer, uint64_t now);
void timer_flags_changed(board_t *board);

/* uart.c, console.c, bus_wire.c */
void uart_init(board_t *board, int index);
void uart_reset(uart_t *uart);
void uart_event(uart_t *uart, uint64_t now);
bool uart_is_sending(const uart_t *uart);
/* A character has passed at rate_bps, started at start; bad: the wire was not clean. */
void uart_receive(uart_t *uart, uint64_t start, uint64_t now, uint8_t byte, uint32_t rate_bps, bool bad);
/* What a receiver set to rate_to sees of a character sent at rate_from; false: framing error. */
bool uart_sample(uint8_t byte, uint32_t rate_from, uint32_t rate_to, uint8_t *seen);
void console_init(board_t *board);
void console_free(board_t *board);
void console_event(board_t *board, uint64_t now);
bool bus_wire_init(board_t *board);
void bus_wire_free(board_t *board);
void bus_wire_follow(board_t *board); /* takes over the bus's next event */
void bus_wire_event(board_t *board, uint64_t now);
void bus_wire_supply(board_t *board, double volts);
void bus_wire_pins(board_t *board, uint8_t before, uint8_t after); /* port E outputs that are driven high */

/* panel.c, reset.c, probe.c, trace.c, vcd.c */
void panel_init(board_t *board);
void panel_reset(board_t *board);
void panel_event(board_t *board, uint64_t now);
void reset_init(board_t *board);
void reset_now(board_t *board, reset_cause_t cause);
void reset_event(board_t *board, uint64_t now); /* watchdog */
bool reset_watchdog_runs(const board_t *board);
void probe_free(board_t *board);
void probe_reset(board_t *board);
void probe_enter(board_t *board, uint32_t pc);
void probe_leave(board_t *board, uint32_t pc);
void probe_mark(board_t *board); /* sets the notes again after the flash changed */
void trace_free(board_t *board);
void vcd_free(board_t *board);
void vcd_pins(board_t *board);
void vcd_byte(board_t *board, int uart, bool sent, int byte); /* -1: line idle */

#endif
