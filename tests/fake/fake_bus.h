/* SPDX-License-Identifier: MIT
 * fake_bus.h - fake servos for bus.h at packet level: control tables, answers, faults, a log of sent packets. Models no
 * times: an answer is ready after a number of bus_poll calls. Malformed packets and submits while busy abort. */
#ifndef FAKE_BUS_H
#define FAKE_BUS_H

#include <stdbool.h>
#include <stdint.h>

#define FAKE_BUS_TABLE_BYTES 50u

/* Faults, bits. */
enum {
    FAKE_BUS_SILENT = 1 << 0,         /* receives but does nothing and never answers */
    FAKE_BUS_BAD_CHECKSUM = 1 << 1,   /* answers with a wrong checksum */
    FAKE_BUS_WRONG_ID = 1 << 2,       /* answers with another ID */
    FAKE_BUS_DEAF_TO_SYNC = 1 << 3,   /* ignores SYNC WRITE */
    FAKE_BUS_SHORT = 1 << 4           /* answers with one parameter too few */
};

typedef struct {
    bool there;
    uint8_t rate;                     /* baud rate divisor */
    uint8_t faults;
    uint8_t error;                    /* error byte of its answers */
    uint8_t fail_next;                /* the next answers that get lost */
    uint8_t mishear_next;             /* the next WRITEs and REG WRITEs that arrive damaged: error answer, no effect */
    uint8_t registered[8];            /* REG WRITE: address, count, data */
    uint8_t table[FAKE_BUS_TABLE_BYTES];
} fake_servo_t;

void fake_bus_reset(void);                        /* no servos, 1 Mbps, counts 0 */
fake_servo_t *fake_bus_add(uint8_t id, uint8_t rate); /* AX-12 with factory values, at 512, torque off */
fake_servo_t *fake_bus_servo(uint8_t id);
void fake_bus_set_latency(uint8_t polls);         /* bus_poll returns BUS_PENDING this often first; default 1 */
/* As with a USB adapter: packets without answer may be sent while an answer is pending. */
void fake_bus_set_adapter(bool there);
/* Polls within bus_wait and bus_wait_free since reset or clear, which block the main loop. */
uint32_t fake_bus_waited(void);
void fake_bus_lose(void);                         /* the next bus_was_lost returns true */
uint16_t fake_bus_word(uint8_t id, uint8_t at);   /* a word of a servo's table */
void fake_bus_set_word(uint8_t id, uint8_t at, uint16_t value);

/* The log: the last 1024 packets since reset or clear. */
uint16_t fake_bus_sent(void);                     /* how many */
const uint8_t *fake_bus_packet(uint16_t index);   /* FF FF ID LEN INST ... */
uint8_t fake_bus_packet_size(uint16_t index);
void fake_bus_clear_log(void);

#endif
