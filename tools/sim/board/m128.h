/* SPDX-License-Identifier: MIT
 * m128.h - the parts of the ATmega128 that the board model overrides: register addresses (data space), bits, vectors,
 * times. All numbers come from the ATmega128 data sheet (2467). */
#ifndef SIM_M128_H
#define SIM_M128_H

#define M128_HZ 16000000u
#define M128_FLASH_BYTES 0x20000u
#define M128_PAGE_BYTES 256u
#define M128_PAGES (M128_FLASH_BYTES / M128_PAGE_BYTES)
#define M128_NRWW_START 0x1E000u /* BOOTSZ = 00; the NRWW part is these 8 KiB for every BOOTSZ */
#define M128_EEPROM_BYTES 4096u
#define M128_RAM_START 0x0100u
#define M128_RAM_END 0x1100u /* first address after the SRAM */
#define M128_VECTOR_BYTES 4u

/* Ports */
enum {
    M128_PINE = 0x21, M128_DDRE = 0x22, M128_PORTE = 0x23,
    M128_PIND = 0x30, M128_DDRD = 0x31, M128_PORTD = 0x32,
    M128_DDRC = 0x34, M128_PORTC = 0x35,
    M128_DDRB = 0x37, M128_PORTB = 0x38,
    M128_DDRA = 0x3A, M128_PORTA = 0x3B
};

/* Core, clock, reset */
enum {
    M128_WDTCR = 0x41, M128_MCUCSR = 0x54, M128_MCUCR = 0x55, M128_RAMPZ = 0x5B, M128_XDIV = 0x5C,
    M128_SPL = 0x5D, M128_SPH = 0x5E
};
enum { MCUCR_IVCE = 0x01, MCUCR_IVSEL = 0x02, MCUCR_SM = 0x1C, MCUCR_SE = 0x20, MCUCR_SRE = 0x80 };
enum { WDTCR_WDP = 0x07, WDTCR_WDE = 0x08, WDTCR_WDCE = 0x10 };

/* Interrupt flags and masks that simavr keeps up to date in the data space */
enum {
    M128_ADCSRA = 0x26, M128_TIFR = 0x56, M128_TIMSK = 0x57, M128_EIFR = 0x58, M128_EIMSK = 0x59, M128_ETIFR = 0x7C,
    M128_ETIMSK = 0x7D
};
enum { ADCSRA_ADIE = 0x08, ADCSRA_ADIF = 0x10 };

/* EEPROM */
enum { M128_EECR = 0x3C, M128_EEDR = 0x3D, M128_EEARL = 0x3E, M128_EEARH = 0x3F };
enum { EECR_EERE = 0x01, EECR_EEWE = 0x02, EECR_EEMWE = 0x04, EECR_EERIE = 0x08 };

/* Self-programming */
enum { M128_SPMCSR = 0x68 };
enum {
    SPMCSR_SPMEN = 0x01, SPMCSR_PGERS = 0x02, SPMCSR_PGWRT = 0x04, SPMCSR_BLBSET = 0x08, SPMCSR_RWWSRE = 0x10,
    SPMCSR_RWWSB = 0x40, SPMCSR_SPMIE = 0x80
};

/* USART bits (the same in both) */
enum { UCSRA_MPCM = 0x01, UCSRA_U2X = 0x02, UCSRA_UPE = 0x04, UCSRA_DOR = 0x08, UCSRA_FE = 0x10, UCSRA_UDRE = 0x20,
    UCSRA_TXC = 0x40, UCSRA_RXC = 0x80 };
enum { UCSRB_TXB8 = 0x01, UCSRB_RXB8 = 0x02, UCSRB_UCSZ2 = 0x04, UCSRB_TXEN = 0x08, UCSRB_RXEN = 0x10,
    UCSRB_UDRIE = 0x20, UCSRB_TXCIE = 0x40, UCSRB_RXCIE = 0x80 };
enum { UCSRC_8N1 = 0x06 };

/* Interrupt vector numbers; 1 is the first after reset */
enum {
    VECTOR_INT0 = 1, VECTOR_T2_COMP = 9, VECTOR_T2_OVF = 10, VECTOR_T1_CAPT = 11, VECTOR_T1_COMPA = 12,
    VECTOR_T1_COMPB = 13, VECTOR_T1_OVF = 14, VECTOR_T0_COMP = 15, VECTOR_T0_OVF = 16, VECTOR_USART0_RX = 18,
    VECTOR_USART0_UDRE = 19, VECTOR_USART0_TX = 20, VECTOR_ADC = 21, VECTOR_EE_READY = 22, VECTOR_T1_COMPC = 24,
    VECTOR_T3_CAPT = 25, VECTOR_T3_COMPA = 26, VECTOR_T3_COMPB = 27, VECTOR_T3_COMPC = 28, VECTOR_T3_OVF = 29,
    VECTOR_USART1_RX = 30, VECTOR_USART1_UDRE = 31, VECTOR_USART1_TX = 32, VECTOR_SPM_READY = 34, VECTOR_COUNT = 35
};

/* Times in cycles of 16 MHz. Where the data sheet gives a range, the slow end, so that nothing relies on less. */
#define M128_SPM_CYCLES 72000u         /* page erase, page write, lock bits: 3.7-4.5 ms */
#define M128_EEPROM_CYCLES 136000u     /* one byte: 8.5 ms */
#define M128_WATCHDOG_CYCLES 224000u   /* WDP = 0 at 5 V: 14.0 ms, doubled by each prescaler step */
#define M128_TIMED_SEQUENCE_CYCLES 4u  /* SPMCSR -> SPM, EEMWE -> EEWE, WDCE, IVCE */

#endif
