/* SPDX-License-Identifier: MIT */
#include "panel.h"

#include <simavr/avr_adc.h>

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
#define THERMISTOR_V 2.5

static const uint16_t watched[] = { M128_DDRB, M128_PORTB, M128_DDRC, M128_PORTC,
                                    M128_DDRD, M128_PORTD, M128_DDRE, M128_PORTE };

static void follow_leds(panel_t *panel)
{
    const uint8_t *data = panel->machine->avr->data;
    uint8_t lit = data[M128_DDRC] & (uint8_t)~data[M128_PORTC] & LED_MASK;
    if (panel->kind == BOARD_CM2) {
        lit = 0;
    }
    panel->leds = lit;
}

static bool charger_is_on(const panel_t *panel)
{
    const uint8_t *data = panel->machine->avr->data;
    return panel->kind == BOARD_CM5 && (data[M128_DDRB] & CHARGER_PIN) && !(data[M128_PORTB] & CHARGER_PIN);
}

static void follow_charger(panel_t *panel)
{
    bool timing = panel->machine->events.when[EVENT_CHARGER] != NEVER;
    if (charger_is_on(panel) != timing) {
        event_at(&panel->machine->events, EVENT_CHARGER, timing ? NEVER : panel->machine->avr->cycle + CHARGER_GRACE_CYCLES);
    }
}

static void grace_is_over(void *context, uint64_t now)
{
    panel_t *panel = context;
    (void)now;
    if (charger_is_on(panel)) {
        violation_note(panel->machine, VIOLATION_CHARGER, "battery charger on (PB5 low) for 5 ms");
    }
}

static void check_fight(panel_t *panel)
{
    const uint8_t *data = panel->machine->avr->data;
    if (panel->kind == BOARD_CM5 && ((data[M128_DDRE] & BUTTONS_E) || (data[M128_DDRD] & BUTTONS_D))) {
        violation_note(panel->machine, VIOLATION_PIN_FIGHT, "a button pin is an output (DDRE 0x%02X, DDRD 0x%02X)",
                       data[M128_DDRE], data[M128_DDRD]);
    }
}

static void write_port(avr_t *avr, avr_io_addr_t address, uint8_t value, void *param)
{
    panel_t *panel = param;
    uint8_t before = avr->data[M128_DDRE] & avr->data[M128_PORTE];
    panel->inner[address].write(avr, address, value, panel->inner[address].param);
    avr->data[address] = value;
    if (address == M128_DDRE || address == M128_PORTE) {
        bus_wire_pins(panel->wire, before, avr->data[M128_DDRE] & avr->data[M128_PORTE]);
    }
    follow_leds(panel);
    follow_charger(panel);
    check_fight(panel);
}

/* Bits that the current instruction reads: one for SBIC and SBIS, all for IN. */
static uint8_t bits_looked_at(const panel_t *panel)
{
    const uint8_t *at = &panel->machine->avr->flash[panel->machine->avr->pc];
    bool skip = (at[1] & 0xFD) == 0x99;
    return skip ? (uint8_t)(1u << (at[0] & 7)) : 0xFF;
}

/* The buttons that read inverted at this moment because of contact bounce. */
static uint8_t bouncing(const panel_t *panel)
{
    uint8_t inverted = 0;
    for (unsigned button = 0; button < BUTTON_COUNT; button++) {
        uint64_t now = panel->machine->avr->cycle, until = panel->bounces_until[button];
        if (now < until && now + panel->bounce >= until + BOUNCE_SLICE_CYCLES) {
            uint64_t noise = (until ^ (uint64_t)button << 60) + (until - now) / BOUNCE_SLICE_CYCLES * 0x9E3779B97F4A7C15u;
            noise = (noise ^ noise >> 30) * 0xBF58476D1CE4E5B9u; /* any good mixing function will do */
            inverted |= (uint8_t)((noise >> 40 & 1u) << button);
        }
    }
    return inverted;
}

static uint8_t buttons_down(const panel_t *panel, avr_io_addr_t pin)
{
    uint8_t pressed = panel->pressed ^ bouncing(panel);
    return pin == M128_PINE ? (uint8_t)((pressed & 0x0F) << 4) : (uint8_t)(pressed >> BUTTON_START & 1);
}

static uint8_t read_pin(avr_t *avr, avr_io_addr_t address, void *param)
{
    panel_t *panel = param;
    uint8_t ddr = avr->data[address + 1], port = avr->data[address + 2];
    uint8_t buttons = address == M128_PINE ? BUTTONS_E : BUTTONS_D;
    if (panel->kind == BOARD_CM2) {
        buttons = 0;
    }
    uint8_t pulled = avr->data[M128_SFIOR] & SFIOR_PUD ? 0 : port;
    uint8_t floating = buttons & (uint8_t)~ddr & (uint8_t)~pulled & bits_looked_at(panel);
    if (floating) {
        violation_note(panel->machine, VIOLATION_PULLUP, "%s read with button pins floating (0x%02X have no pull-up)",
                       address == M128_PINE ? "PINE" : "PIND", floating);
    }
    uint8_t outside = (uint8_t)~(buttons & buttons_down(panel, address));
    uint8_t value = (uint8_t)((port & ddr) | (outside & ~ddr));
    avr->data[address] = value;
    return value;
}

void panel_press(panel_t *panel, button_t button, bool down)
{
    uint8_t bit = (uint8_t)(1u << button);
    if ((unsigned)button >= BUTTON_MODE) {
        return;
    }
    if (!(panel->pressed & bit) == down) {
        panel->bounces_until[button] = panel->machine->avr->cycle + panel->bounce;
        machine_unsettled(panel->machine, panel->bounces_until[button]);
    }
    panel->pressed = (uint8_t)(down ? panel->pressed | bit : panel->pressed & ~bit);
}

static void set_adc(panel_t *panel, int channel, double volts)
{
    avr_irq_t *irq = avr_io_getirq(panel->machine->avr, AVR_IOCTL_ADC_GETIRQ, ADC_IRQ_ADC0 + channel);
    if (irq) {
        avr_raise_irq(irq, (uint32_t)(volts * 1000 + 0.5));
    }
}

static void follow_voltages(panel_t *panel)
{
    set_adc(panel, 0, panel->battery_v * BOARD_BATTERY_DIVIDER);
    set_adc(panel, 1, 0);
    set_adc(panel, 2, THERMISTOR_V);
}

void panel_battery(panel_t *panel, double volts)
{
    panel->battery_v = volts;
    follow_voltages(panel);
    bus_wire_supply(panel->wire, volts);
}

void panel_reset(panel_t *panel)
{
    bus_wire_pins(panel->wire, 0, 0);
    follow_leds(panel);
    follow_charger(panel);
    follow_voltages(panel);
}

void panel_init(panel_t *panel, machine_t *machine, bus_wire_t *wire, board_kind_t kind)
{
    avr_t *avr = machine->avr;
    panel->machine = machine;
    panel->wire = wire;
    panel->kind = kind;
    events_handle(&machine->events, EVENT_CHARGER, grace_is_over, panel);
    panel->bounce = BOUNCE_CYCLES;
    panel->battery_v = DEFAULT_BATTERY_V;
    for (unsigned i = 0; i < sizeof watched / sizeof watched[0]; i++) {
        uint16_t address = watched[i];
        panel->inner[address].write = avr->io[AVR_DATA_TO_IO(address)].w.c;
        panel->inner[address].param = avr->io[AVR_DATA_TO_IO(address)].w.param;
        machine_io(panel->machine, address, NULL, write_port, panel);
    }
    machine_io(panel->machine, M128_PINE, read_pin, NULL, panel);
    machine_io(panel->machine, M128_PIND, read_pin, NULL, panel);
}
