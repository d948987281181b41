/* SPDX-License-Identifier: MIT
 * robot.c - a robot that executes one-byte commands from the serial line. Only for the tests of the simulator: it polls
 * (except for serial input), it waits, and it uses no code of the real firmware.
 *
 *   p  pings servo 3: "servo 3: 00" (error byte), or "servo 3: silent" / "garbled"
 *   m  one sync write: servos 1..3 to 600
 *   l  Play LED on / off            e  adds 1 to EEPROM byte 0 and prints it
 *   s  sends on the bus without driving it: a violation
 *   w  prints flash byte 0xE000     other bytes are echoed
 * The START button prints "START"; a remote packet FF 55 L ~L H ~H prints "rc HHLL". Starts with "ready". */
#include <avr/eeprom.h>
#include <avr/interrupt.h>
#include <avr/io.h>
#include <avr/pgmspace.h>
#include <stdbool.h>
#include <stdint.h>
#include <util/delay.h>

#define DRIVE (1 << PE2)
#define LISTEN (1 << PE3)
#define START (1 << PD0)
#define GATES (1 << PD5 | 1 << PD6)

static volatile uint8_t heard[256]; /* written by the interrupt at heard_head, read at heard_tail */
static volatile uint8_t heard_head;
static uint8_t heard_tail;

ISR(USART1_RX_vect)
{
    heard[heard_head] = UDR1;
    heard_head++;
}

static void put(char c)
{
    while (!(UCSR1A & 1 << UDRE1)) {
    }
    UDR1 = (uint8_t)c;
}

static void say(const char *text)
{
    for (char c; (c = (char)pgm_read_byte(text)) != 0; text++) {
        put(c);
    }
}

static void say_hex(uint8_t byte)
{
    static const char digits[] PROGMEM = "0123456789ABCDEF";
    put((char)pgm_read_byte(&digits[byte >> 4]));
    put((char)pgm_read_byte(&digits[byte & 15]));
}

static void say_line(const char *text, uint8_t byte)
{
    say(text);
    say_hex(byte);
    say(PSTR("\r\n"));
}

static void bus_send(const uint8_t *bytes, uint8_t count)
{
    PORTE = (uint8_t)((PORTE & ~LISTEN) | DRIVE);
    for (uint8_t i = 0; i < count; i++) {
        while (!(UCSR0A & 1 << UDRE0)) {
        }
        UCSR0A |= 1 << TXC0;
        UDR0 = bytes[i];
    }
    while (!(UCSR0A & 1 << TXC0)) {
    }
    PORTE = (uint8_t)((PORTE & ~DRIVE) | LISTEN);
}

/* Next byte of an answer, or -1 after about 2 ms. */
static int16_t bus_take(void)
{
    for (uint16_t turn = 0; turn < 3200; turn++) {
        if (UCSR0A & 1 << RXC0) {
            return UDR0;
        }
        _delay_us(0.1);
    }
    return -1;
}

static void ping(void)
{
    static const uint8_t packet[] = {0xFF, 0xFF, 0x03, 0x02, 0x01, 0xF9};
    uint8_t answer[6], sum = 0, count = 0;
    while (UCSR0A & 1 << RXC0) {
        (void)UDR0; /* bytes that came too late for the last packet */
    }
    bus_send(packet, sizeof packet);
    for (int16_t byte; count < 6 && (byte = bus_take()) >= 0; count++) {
        answer[count] = (uint8_t)byte;
        sum = (uint8_t)(sum + (count > 1 ? answer[count] : 0));
    }
    if (count == 0) {
        say(PSTR("servo 3: silent\r\n"));
    } else if (count < 6 || answer[0] != 0xFF || answer[1] != 0xFF || sum != 0xFF) {
        say(PSTR("servo 3: garbled\r\n"));
    } else {
        say_line(PSTR("servo 3: "), answer[4]);
    }
}

static void move(void)
{
    /* FE + 0D + 83 + 1E + 02 + (01 + 58 + 02) + (02 + 58 + 02) + (03 + 58 + 02) = 0x2C2 -> 0x3D */
    static const uint8_t packet[] = {0xFF, 0xFF, 0xFE, 0x0D, 0x83, 0x1E, 0x02, 0x01, 0x58, 0x02,
                                     0x02, 0x58, 0x02, 0x03, 0x58, 0x02, 0x3D};
    bus_send(packet, sizeof packet);
    say(PSTR("moving\r\n"));
}

static void count_in_eeprom(void)
{
    const uint8_t count = (uint8_t)(eeprom_read_byte((const uint8_t *)0) + 1);
    eeprom_write_byte((uint8_t *)0, count);
    eeprom_busy_wait();
    say_line(PSTR("eeprom "), count);
}

static void break_a_rule(void)
{
    PORTE = (uint8_t)(PORTE & ~(DRIVE | LISTEN));
    UDR0 = 0x55;
}

/* Collects a remote packet. Returns true if the byte belongs to one. */
static bool remote(uint8_t byte)
{
    static uint8_t packet[6], count;
    const bool fits = count == 0 ? byte == 0xFF : count == 1 ? byte == 0x55 : true;
    if (!fits) {
        count = 0;
        return false;
    }
    packet[count++] = byte;
    if (count == 6) {
        count = 0;
        say(PSTR("rc "));
        say_hex(packet[4]);
        say_hex(packet[2]);
        say(PSTR("\r\n"));
    }
    return true;
}

static void obey(uint8_t byte)
{
    switch (byte) {
    case 'p': ping(); break;
    case 'm': move(); break;
    case 'l': PORTC ^= 1 << PC6; break;
    case 'e': count_in_eeprom(); break;
    case 's': break_a_rule(); break;
    case 'w': say_line(PSTR("flash "), pgm_read_byte(0xE000)); break;
    default: put((char)byte); break;
    }
}

int main(void)
{
    bool was_down = false;
    UCSR1A = 1 << U2X1;
    UBRR1L = 34;
    UCSR1B = 1 << RXEN1 | 1 << TXEN1 | 1 << RXCIE1;
    UCSR0A = 1 << U2X0;
    UBRR0L = 1;
    UCSR0B = 1 << RXEN0 | 1 << TXEN0;
    PORTB |= 1 << PB5; /* charger off */
    DDRB |= 1 << PB5;
    DDRC = 0x7F;
    PORTC = 0x7E; /* Power LED on */
    DDRE |= DRIVE | LISTEN;
    PORTE |= LISTEN;
    PORTD |= START | GATES;
    DDRD |= GATES;
    sei();
    say(PSTR("ready\r\n"));
    for (;;) {
        const bool down = !(PIND & START);
        if (down && !was_down) {
            say(PSTR("START\r\n"));
        }
        was_down = down;
        if (heard_tail != heard_head) {
            const uint8_t byte = heard[heard_tail++];
            if (!remote(byte)) {
                obey(byte);
            }
        }
    }
}
