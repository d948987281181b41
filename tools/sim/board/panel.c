/* SPDX-License-Identifier: MIT */
#include <simavr/avr_adc.h>

#include "board_private.h"

#define LED_MASK 0x7Fu            /* PC0-PC6, low = lit */
#define CHARGER_PIN 0x20u         /* PB5, 0 = charging */
#define CHARGER_GRACE_CYCLES (5 * BOARD_CYCLES_PER_MS)
#define BUTTONS_E 0xF0u           /* PE4-PE7: up, down, left, right */
#define BUTTONS_D 0x01u           /* PD0: start */
#define BOUNCE_CYCLES (5 * BOARD_CYCLES_PER_MS)
#define BOUNCE_SLICE_CYCLES (BOARD_CYCLES_PER_MS / 10)
#define M128_SFIOR 0x40u
#define SFIOR_PUD 0x04u
#define DEFAULT_BATTERY_V 9.6
#define DEFAULT_THERMISTOR_V 2.5

static const uint16_t watched[] = { M128_DDRB, M128_PORTB, M128_DDRC, M128_PORTC,
                                    M128_DDRD, M128_PORTD, M128_DDRE, M128_PORTE };

static void follow_leds(board_t *board)
{
    const uint8_t *data = board->avr->data;
    uint8_t lit = data[M128_DDRC] & (uint8_t)~data[M128_PORTC] & LED_MASK;
    if (board->kind == BOARD_CM2) {
        lit = 0;
    }
    board->panel.leds = lit;
}

static bool charger_is_on(const board_t *board)
{
    const uint8_t *data = board->avr->data;
    return board->kind == BOARD_CM5 && (data[M128_DDRB] & CHARGER_PIN) && !(data[M128_PORTB] & CHARGER_PIN);
}

static void follow_charger(board_t *board)
{
    bool timing = board->events.when[EVENT_CHARGER] != NEVER;
    if (charger_is_on(board) != timing) {
        event_at(board, EVENT_CHARGER, timing ? NEVER : board->avr->cycle + CHARGER_GRACE_CYCLES);
    }
}

void panel_event(board_t *board, uint64_t now)
{
    (void)now;
    if (charger_is_on(board)) {
        violation_note(board, VIOLATION_CHARGER, "battery charger on (PB5 low) for 5 ms");
    }
}

static void check_fight(board_t *board)
{
    const uint8_t *data = board->avr->data;
    if (board->kind == BOARD_CM5 && ((data[M128_DDRE] & BUTTONS_E) || (data[M128_DDRD] & BUTTONS_D))) {
        violation_note(board, VIOLATION_PIN_FIGHT, "a button pin is an output (DDRE 0x%02X, DDRD 0x%02X)",
                       data[M128_DDRE], data[M128_DDRD]);
    }
}

static void write_port(avr_t *avr, avr_io_addr_t address, uint8_t value, void *param)
{
    board_t *board = param;
    uint8_t before = avr->data[M128_DDRE] & avr->data[M128_PORTE];
    board->panel.inner[address].write(avr, address, value, board->panel.inner[address].param);
    avr->data[address] = value;
    if (address == M128_DDRE || address == M128_PORTE) {
        bus_wire_pins(board, before, avr->data[M128_DDRE] & avr->data[M128_PORTE]);
    }
    follow_leds(board);
    follow_charger(board);
    check_fight(board);
    vcd_pins(board);
}

/* Bits that the instruction being executed looks at: one for SBIC and SBIS, all for IN. */
static uint8_t bits_looked_at(const board_t *board)
{
    const uint8_t *at = &board->avr->flash[board->avr->pc];
    bool skip = (at[1] & 0xFD) == 0x99;
    return skip ? (uint8_t)(1u << (at[0] & 7)) : 0xFF;
}

/* The buttons whose contact is open instead of closed just now, or the other way round. */
static uint8_t bouncing(const board_t *board)
{
    const panel_t *panel = &board->panel;
    uint8_t inverted = 0;
    for (unsigned button = 0; button < BUTTON_COUNT; button++) {
        uint64_t now = board->avr->cycle, until = panel->bounces_until[button];
        if (now < until && now + panel->bounce >= until + BOUNCE_SLICE_CYCLES) {
            uint64_t noise = (until ^ (uint64_t)button << 60) + (until - now) / BOUNCE_SLICE_CYCLES * 0x9E3779B97F4A7C15u;
            noise = (noise ^ noise >> 30) * 0xBF58476D1CE4E5B9u; /* any good mixture does */
            inverted |= (uint8_t)((noise >> 40 & 1u) << button);
        }
    }
    return inverted;
}

static uint8_t buttons_down(const board_t *board, avr_io_addr_t pin)
{
    uint8_t pressed = board->panel.pressed ^ bouncing(board);
    return pin == M128_PINE ? (uint8_t)((pressed & 0x0F) << 4) : (uint8_t)(pressed >> BUTTON_START & 1);
}

static uint8_t read_pin(avr_t *avr, avr_io_addr_t address, void *param)
{
    board_t *board = param;
    uint8_t ddr = avr->data[address + 1], port = avr->data[address + 2];
    uint8_t buttons = address == M128_PINE ? BUTTONS_E : BUTTONS_D;
    if (board->kind == BOARD_CM2) {
        buttons = 0;
    }
    uint8_t pulled = avr->data[M128_SFIOR] & SFIOR_PUD ? 0 : port;
    uint8_t floating = buttons & (uint8_t)~ddr & (uint8_t)~pulled & bits_looked_at(board);
    if (floating) {
        violation_note(board, VIOLATION_PULLUP, "%s read with button pins floating (0x%02X have no pull-up)",
                       address == M128_PINE ? "PINE" : "PIND", floating);
    }
    uint8_t outside = (uint8_t)~(buttons & buttons_down(board, address));
    uint8_t value = (uint8_t)((port & ddr) | (outside & ~ddr));
    avr->data[address] = value;
    return value;
}

void board_press(board_t *board, button_t button, bool down)
{
    if (button == BUTTON_MODE) {
        board_hold_reset(board, down);
    } else if ((unsigned)button < BUTTON_MODE) {
        uint8_t bit = (uint8_t)(1u << button);
        if (!(board->panel.pressed & bit) == down) {
            board->panel.bounces_until[button] = board->avr->cycle + board->panel.bounce;
        }
        board->panel.pressed = (uint8_t)(down ? board->panel.pressed | bit : board->panel.pressed & ~bit);
        vcd_pins(board);
    }
}

void board_set_bounce(board_t *board, uint64_t cycles) { board->panel.bounce = cycles; }

uint8_t board_leds(const board_t *board) { return board->panel.leds; }

int board_pin(const board_t *board, char port, int bit)
{
    static const uint16_t ports[7] = { M128_PORTA, M128_PORTB, M128_PORTC, M128_PORTD, M128_PORTE, 0x62, 0x65 };
    if (port < 'A' || port > 'G' || bit < 0 || bit > 7) {
        return -1;
    }
    uint16_t address = ports[port - 'A'];
    unsigned ddr = board->avr->data[address - 1], out = board->avr->data[address];
    return ddr >> bit & 1 ? (int)(out >> bit & 1) : -1;
}

static void set_adc(board_t *board, int channel, double volts)
{
    avr_irq_t *irq = avr_io_getirq(board->avr, AVR_IOCTL_ADC_GETIRQ, ADC_IRQ_ADC0 + channel);
    if (irq) {
        avr_raise_irq(irq, (uint32_t)(volts * 1000 + 0.5));
    }
}

static void follow_voltages(board_t *board)
{
    set_adc(board, 0, board->panel.battery_v * BOARD_BATTERY_DIVIDER);
    set_adc(board, 1, 0);
    set_adc(board, 2, board->panel.thermistor_v);
}

void board_thermistor(board_t *board, double volts)
{
    board->panel.thermistor_v = volts;
    follow_voltages(board);
}

void board_battery(board_t *board, double volts)
{
    board->panel.battery_v = volts;
    follow_voltages(board);
    bus_wire_supply(board, volts);
}

void panel_reset(board_t *board)
{
    bus_wire_pins(board, 0, 0);
    follow_leds(board);
    follow_charger(board);
    follow_voltages(board);
    vcd_pins(board);
}

void panel_init(board_t *board)
{
    avr_t *avr = board->avr;
    board->panel.bounce = BOUNCE_CYCLES;
    board->panel.battery_v = DEFAULT_BATTERY_V;
    board->panel.thermistor_v = DEFAULT_THERMISTOR_V;
    for (unsigned i = 0; i < sizeof watched / sizeof watched[0]; i++) {
        uint16_t address = watched[i];
        board->panel.inner[address].write = avr->io[AVR_DATA_TO_IO(address)].w.c;
        board->panel.inner[address].param = avr->io[AVR_DATA_TO_IO(address)].w.param;
        board_io(board, address, NULL, write_port, board);
    }
    board_io(board, M128_PINE, read_pin, NULL, board);
    board_io(board, M128_PIND, read_pin, NULL, board);
}
