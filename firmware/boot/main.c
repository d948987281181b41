/* SPDX-License-Identifier: MIT
 * main.c - the boot loader from reset on: completes a save that a power cut interrupted, serves the mailbox, then stays or
 * starts the application.
 *
 *   reset -> journal -> mailbox -> window of 60 ms ---- stay requested, or no application ----> prompt
 *                                        \---- else ----> application */
#include "button.h"
#include "journal.h"
#include "memory.h"
#include "prompt.h"
#include "start.h"
#include "print.h"
#include "uart.h"
#include BOOT_PORTS_H

#include <avr/interrupt.h>
#include <avr/io.h>

#define WINDOW_TICKS UART_TICKS(60)
#define START_TICKS UART_TICKS(12) /* a little longer than START's debounce time (button.c) */
#define LEDS_TICKS UART_TICKS(100)
#define MAIL_POSTED 0xAAu
#define MAIL_WRITTEN 0x55u
#define MAIL_REFUSED 0xFFu

/* Writes the motion page that the factory's application left in EEPROM (section 7a). The state stays AA until both flash
 * pages are handled, so after a power cut the next start repeats it. A page above 127 is in the boot section or beyond;
 * memory_commit refuses it. */
static void answer_mailbox(void)
{
    uint16_t page = MEM_MOTION_START / 256 + memory_ee(MEM_EE_MAILBOX_PAGE) * 2u;
    uint8_t state = MAIL_WRITTEN;
    if (memory_ee(MEM_EE_MAILBOX_STATE) != MAIL_POSTED) {
        return;
    }
    PUT(" Writing ");
    memory_seek(MEMORY_EEPROM + MEM_EE_MAILBOX);
    for (uint8_t half = 0; half < 2; half++) {
        memory_fetch(memory_work, 256);
        if (!memory_write_work(page++)) {
            state = MAIL_REFUSED;
        }
    }
    memory_ee_set(MEM_EE_MAILBOX_STATE, state);
}

typedef enum { STAY_NO, STAY_PROMPT, STAY_STK500 } stay_t;

/* First debounces START, which must be down from the beginning. Then listens until 60 ms have passed, or longer if the
 * application's CRC takes longer; the receiver's interrupt keeps the bytes that arrive meanwhile. Only the last byte counts,
 * as in the original; the sync of avrdude is two bytes. */
static stay_t ask_to_stay(void)
{
    uint8_t last = 0, byte = 0;
    uint16_t since = uart_clock();
    button_t start;
    do {
        start = button_look();
    } while (uart_since(since) < START_TICKS);
    bool is_startable = memory_is_startable();
    do {
        if (uart_has()) {
            last = byte;
            byte = uart_next();
        }
    } while (uart_has() || uart_since(since) < WINDOW_TICKS);
    if (last == PROMPT_SYNC_1 && byte == PROMPT_SYNC_2) {
        return STAY_STK500;
    }
    return byte == '#' || start == BUTTON_DOWN || !is_startable || memory_ee(MEM_EE_BOOT_MODE) == START_MODE_SYSTEM
               ? STAY_PROMPT
               : STAY_NO;
}

/* Our own vectors: only two of the 35 are used; tables fill the gap between them (boot.ld.in). */
static void __attribute__((naked, used, section(".vectors"))) reset_vector(void)
{
    asm volatile("jmp __init");
}

void __attribute__((naked, used, section(".init0"))) __init(void);
void __init(void)
{
    asm volatile("clr r1\n\t"
                 "out __SREG__, r1\n\t"
                 "ldi r28, lo8(%[top])\n\t"
                 "ldi r29, hi8(%[top])\n\t"
                 "out __SP_H__, r29\n\t"
                 "out __SP_L__, r28"
                 :
                 : [top] "i"(MEM_RAM_END - 1));
}

static void __attribute__((naked, used, section(".init9"))) enter_main(void)
{
    asm volatile("jmp main");
}

int __attribute__((OS_main, used, externally_visible)) main(void)
{
    PORTS_OPEN();
    uart_open(UART_UBRR_57143);
    MCUCR = 1 << IVCE;
    MCUCR = 1 << IVSEL;
    sei();
    uart_put(0xFF);
    journal_recover(memory_work);
    answer_mailbox();
    stay_t stay = ask_to_stay();
    if (stay == STAY_NO) {
        start_jump(0);
    }
    PORTS_LEDS_ON();
    if (stay == STAY_PROMPT) {
        uart_pause(LEDS_TICKS);
    }
    PORTS_LEDS_OFF();
    prompt_run(stay == STAY_STK500);
}
