/* SPDX-License-Identifier: MIT
 * mailbox.c - a boot section that only does what the factory loader does at a start (boot/ORIGINAL.md, sections 1, 5
 * and 7a): UART 1 on, FF out, the EEPROM mailbox into flash, 60 ms, application. */
#include <avr/boot.h>
#include <avr/eeprom.h>
#include <avr/io.h>
#include <util/delay.h>

#define MAIL_DATA 0x800u
#define MAIL_STATE 0xFF4u
#define MAIL_PAGE 0xFF5u
#define MAIL_POSTED 0xAAu
#define MAIL_WRITTEN 0x55u
#define MOTION_START 0xE000ul

static void put(char byte)
{
    while (!(UCSR1A & 1 << UDRE1)) {
    }
    UDR1 = (uint8_t)byte;
}

static uint8_t ee(uint16_t address)
{
    return eeprom_read_byte((const uint8_t *)address);
}

static void write_page(uint32_t address, uint16_t from)
{
    for (uint16_t i = 0; i < SPM_PAGESIZE; i += 2) {
        boot_page_fill(address + i, (uint16_t)(ee(from + i) | ee(from + i + 1) << 8));
    }
    boot_page_erase(address);
    boot_spm_busy_wait();
    boot_page_write(address);
    boot_spm_busy_wait();
    boot_rww_enable();
}

static void deliver(void)
{
    uint32_t address = MOTION_START + 512ul * ee(MAIL_PAGE);
    for (const char *text = " Writing "; *text != '\0'; text++) {
        put(*text);
    }
    write_page(address, MAIL_DATA);
    write_page(address + SPM_PAGESIZE, MAIL_DATA + SPM_PAGESIZE);
    eeprom_write_byte((uint8_t *)MAIL_STATE, MAIL_WRITTEN);
    eeprom_busy_wait();
}

int main(void)
{
    UCSR1A = 1 << U2X1;
    UBRR1H = 0;
    UBRR1L = 34;
    UCSR1B = 1 << RXCIE1 | 1 << RXEN1 | 1 << TXEN1;
    put((char)0xFF);
    if (ee(MAIL_STATE) == MAIL_POSTED) {
        deliver();
    }
    _delay_ms(60);
    asm volatile("clr r1\n\tjmp 0");
    return 0;
}
