/* SPDX-License-Identifier: MIT
 * lab.c - lets a test perform single operations on the chip, from the boot section, over UART1 at 57,600. A command is
 * a letter, a 3-byte address and a 2-byte value (both low byte first). The answer is always 4 bytes: two 16-bit
 * numbers.
 *   e A    erase a page      time in 8 cycles, turns of the waiting loop meanwhile
 *   f A V  fill a word       0, 0
 *   w A    write a page      as e
 *   r      enable RWW        0, 0
 *   g A    read flash        byte, 0
 *   l   V  program lock bits as e
 *   k A    lock or fuse byte byte, 0      (A: Z)
 *   p A V  write a register  0, 0
 *   q A    read a register   byte, 0
 *   m A V  write EEPROM      as e
 *   n A    read EEPROM       byte, 0
 *   u   V  send V bytes on UART0: cycles from the first write to TXC, TXC interrupts
 *   i      receive twice: UCSR1A and UDR1 of each byte as it arrives
 *   x   V  watchdog on with prescaler V, then hang
 *   c      reset cause (MCUCSR at the start), number of starts since power-on */
#include <avr/boot.h>
#include <avr/eeprom.h>
#include <avr/interrupt.h>
#include <avr/io.h>
#include <avr/pgmspace.h>
#include <avr/sleep.h>
#include <avr/wdt.h>
#include <stdbool.h>

typedef struct {
    uint16_t first, second;
} answer_t;

static volatile uint8_t transmitted;
static uint8_t cause;
static uint16_t starts __attribute__((section(".noinit")));

ISR(USART0_TX_vect)
{
    transmitted++;
}

static uint8_t get(void)
{
    while (!(UCSR1A & _BV(RXC1))) {
    }
    return UDR1;
}

static void put(uint8_t byte)
{
    while (!(UCSR1A & _BV(UDRE1))) {
    }
    UDR1 = byte;
}

static answer_t wait_for_spm(void)
{
    uint16_t turns = 0;
    while (boot_spm_busy()) {
        turns++;
    }
    return (answer_t){ TCNT3, turns };
}

static answer_t wait_for_eeprom(void)
{
    uint16_t turns = 0;
    while (!eeprom_is_ready()) {
        turns++;
    }
    return (answer_t){ TCNT3, turns };
}

static void start_clock(uint8_t select)
{
    TCCR3B = 0;
    TCNT3 = 0;
    TCCR3B = select;
}

static answer_t send(uint16_t count)
{
    DDRE |= _BV(PE2) | _BV(PE3);
    PORTE = _BV(PE2);
    UBRR0L = 1;
    UCSR0A = _BV(U2X0); /* set after the rate: plain simavr would ignore it */
    UCSR0B = _BV(TXEN0) | _BV(TXCIE0);
    transmitted = 0;
    MCUCR = _BV(IVCE);
    MCUCR = _BV(IVSEL);
    start_clock(_BV(CS30));
    sei();
    while (count--) {
        while (!(UCSR0A & _BV(UDRE0))) {
        }
        UDR0 = 0xFF;
    }
    while (!transmitted) {
    }
    uint16_t time = TCNT3;
    cli();
    UCSR0B = 0;
    UCSR0B = _BV(TXEN0); /* toggled: the transmitter must work again next time */
    PORTE = 0;
    return (answer_t){ time, transmitted };
}

static answer_t receive(void)
{
    answer_t answer;
    while (!(UCSR1A & _BV(RXC1))) {
    }
    answer.first = UCSR1A;
    answer.first |= (uint16_t)(UDR1 << 8);
    while (!(UCSR1A & _BV(RXC1))) {
    }
    answer.second = UCSR1A;
    answer.second |= (uint16_t)(UDR1 << 8);
    return answer;
}

static void hang(uint8_t prescaler)
{
    wdt_enable(prescaler);
    for (;;) {
    }
}

static answer_t flash(uint8_t letter, uint32_t address, uint16_t word)
{
    start_clock(_BV(CS31));
    switch (letter) {
    case 'e':
        boot_page_erase(address);
        return wait_for_spm();
    case 'w':
        boot_page_write(address);
        return wait_for_spm();
    case 'f':
        boot_page_fill(address, word);
        break;
    case 'r':
        boot_rww_enable();
        break;
    case 'l':
        boot_lock_bits_set((uint8_t)~word);
        return wait_for_spm();
    case 'k':
        return (answer_t){ boot_lock_fuse_bits_get((uint16_t)address), 0 };
    default:
        return (answer_t){ pgm_read_byte_far(address), 0 };
    }
    return (answer_t){ 0, 0 };
}

static answer_t rest(uint8_t letter, uint16_t address, uint16_t value)
{
    start_clock(_BV(CS31));
    switch (letter) {
    case 'p':
        _SFR_MEM8(address) = (uint8_t)value;
        break;
    case 'q':
        return (answer_t){ _SFR_MEM8(address), 0 };
    case 'm':
        eeprom_write_byte((uint8_t *)address, (uint8_t)value);
        return wait_for_eeprom();
    case 'n':
        return (answer_t){ eeprom_read_byte((const uint8_t *)address), 0 };
    case 'u':
        return send(value);
    case 'i':
        return receive();
    case 'x':
        hang((uint8_t)value);
        break;
    default:
        return (answer_t){ cause, starts };
    }
    return (answer_t){ 0, 0 };
}

static answer_t do_command(void)
{
    uint8_t letter = get();
    uint32_t address = get();
    address |= (uint32_t)get() << 8;
    address |= (uint32_t)get() << 16;
    uint16_t value = get();
    value |= (uint16_t)(get() << 8);
    switch (letter) {
    case 'e':
    case 'w':
    case 'f':
    case 'r':
    case 'l':
    case 'k':
    case 'g':
        return flash(letter, address, value);
    default:
        return rest(letter, (uint16_t)address, value);
    }
}

int main(void)
{
    cause = MCUCSR;
    MCUCSR = 0;
    starts = cause & _BV(PORF) ? 1 : starts + 1;
    DDRD |= _BV(PD5) | _BV(PD6);
    PORTD |= _BV(PD5) | _BV(PD6);
    UBRR1L = 34;
    UCSR1A = _BV(U2X1);
    UCSR1B = _BV(RXEN1) | _BV(TXEN1);
    for (;;) {
        answer_t answer = do_command();
        put((uint8_t)answer.first);
        put((uint8_t)(answer.first >> 8));
        put((uint8_t)answer.second);
        put((uint8_t)(answer.second >> 8));
    }
}
