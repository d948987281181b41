/* SPDX-License-Identifier: MIT */
#include "block.h"

#include "check.h"
#include "compiler.h"
#include "crc16.h"
#include "memory.h"
#include "start.h"
#include "uart.h"

#define GAP_TICKS UART_TICKS(100)  /* inside a frame */
#define IDLE_TICKS UART_TICKS(4000) /* between frames */
#define NOISE_MAX 1000u             /* bytes without a frame: a person is typing */
#define SUMS_MAX 64u               /* pages in one answer */
#define EEPROM_WRITE_MAX 32u       /* takes 0.27 s, in which the ring does not overflow */
#define RAM_PAGES_END ((MEMORY_RAM + MEM_RAM_END) / 256u)
#define EEPROM_PAGES (MEMORY_EEPROM / 256u)
STATIC_ASSERT(MEM_RAM_END % 256u == 0, "RAM ends with a page");

enum { HELLO = 1, RATE, READ, WRITE, SUMS, EE_WRITE, LEAVE };
enum { OK = 0, REFUSED = MEMORY_REFUSED, BAD_FRAME = 4 };
enum { TO_PROMPT, TO_APPLICATION, TO_RESET, TO_ANY_APPLICATION };

/* The bodies of all requests (BLOCK_PROTOCOL.md). */
typedef struct {
    uint16_t page; /* READ, WRITE, SUMS: address / 256. EE_WRITE: address. RATE: UBRR. LEAVE: where to */
    union {
        uint8_t data[FLASH_PAGE_BYTES]; /* WRITE */
        struct {
            uint16_t count;             /* SUMS: pages. EE_WRITE: bytes */
            uint8_t bytes[EEPROM_WRITE_MAX];
        };
    };
} block_body_t;

static uint16_t crc;

static void put(uint8_t byte)
{
    crc = crc16_byte(crc, byte);
    uart_put(byte);
}

/* Sends the beginning of an answer: head, status, detail. `bytes` (even) of data and answer_end must follow. */
static void answer_begin(const uint8_t *request, uint8_t status, uint8_t detail, uint16_t bytes)
{
    uart_put(FRAME_ANSWER);
    crc = CRC16_START;
    put(request[FRAME_AT_COMMAND]);
    put(request[FRAME_AT_NUMBER]);
    put((uint8_t)(bytes / 2 + 1));
    put(status);
    put(detail);
}

static void answer_end(void)
{
    uint16_t end = crc;
    uart_put((uint8_t)(end >> 8));
    uart_put((uint8_t)end);
}

/* Sends CRC and plain sum of each page: two different checks, so that a changed page does not appear equal. */
static void put_sums(uint16_t page, uint16_t count)
{
    for (; count > 0; count--) {
        memory_sums.crc = CRC16_START;
        memory_scan_start();
        memory_scan(page++);
        const uint8_t *byte = (const uint8_t *)&memory_sums; /* its CRC and its sum */
        for (uint8_t i = 0; i < 4; i++) {
            put(*byte++);
        }
    }
}

/* Does the part of a good request that precedes its answer. Returns the answer's status. *bytes of data must follow, read
 * from the cursor on (SUMS: computed while they are sent). */
static uint8_t perform(uint8_t command, const uint8_t *request, uint16_t *bytes)
{
    const block_body_t *body = (const block_body_t *)(request + FRAME_AT_BODY);
    uint16_t count = body->count;
    switch (command) {
    case HELLO:
        return OK;
    case LEAVE:
        return body->page != TO_APPLICATION || memory_is_startable() ? OK : REFUSED;
    case RATE:
        return body->page == UART_UBRR_57143 || body->page == UART_UBRR_117647 ? OK : REFUSED;
    case READ:
        if (body->page >= RAM_PAGES_END && body->page < EEPROM_PAGES) {
            return REFUSED; /* no memory here: reads would return leftovers of the chip's bus */
        }
        memory_seek(flash_addr(body->page));
        *bytes = FLASH_PAGE_BYTES;
        return OK;
    case WRITE:
        return request[FRAME_AT_COUNT] == FRAME_BODY_MAX / 2 ? (uint8_t)memory_commit(body->page, body->data) : REFUSED;
    case SUMS:
        if (count <= SUMS_MAX) {
            *bytes = count * 4;
            return OK;
        }
        return REFUSED;
    case EE_WRITE:
        return count <= EEPROM_WRITE_MAX && memory_ee_write(body->page, body->bytes, count) ? OK : REFUSED;
    default:
        return REFUSED;
    }
}

/* Does the part of a request that follows its answer. false: the session is over. */
static bool follow_up(uint8_t command, uint16_t where)
{
    if (command == RATE) {
        uart_open((uint8_t)where);
    }
    if (command != LEAVE) {
        return true;
    }
    if (where == TO_APPLICATION || where == TO_ANY_APPLICATION) {
        start_jump(0);
    }
    if (where == TO_RESET) {
        start_reset();
    }
    return false;
}

/* Carries out a good request and answers it. false: the session is over. */
static bool carry_out(const uint8_t *request)
{
    const block_body_t *body = (const block_body_t *)(request + FRAME_AT_BODY);
    uint8_t command = request[FRAME_AT_COMMAND];
    uint16_t bytes = 0;
    uint8_t status = perform(command, request, &bytes);

    answer_begin(request, status, command == HELLO ? (uint8_t)memory_app() : 0, bytes);
    if (command == SUMS) {
        put_sums(body->page, bytes / 4);
    } else {
        while (bytes-- > 0) {
            put(memory_next());
        }
    }
    answer_end();
    uart_flush();
    return status != OK || follow_up(command, body->page);
}

void block_session(void)
{
    frame_t frame;
    uint16_t noise = 0;
    bool is_proven = false;

    frame_init(&frame, memory_work);
    (void)frame_feed(&frame, FRAME_REQUEST);
    while (noise++ < NOISE_MAX) {
        frame_status_t status = FRAME_BAD;
        bool was_open = frame_is_open(&frame);
        if (uart_wait(was_open ? GAP_TICKS : IDLE_TICKS)) {
            status = frame_feed(&frame, uart_next());
        } else if (!was_open) {
            break;
        }
        if (status == FRAME_GOOD) {
            noise = 0;
            is_proven = true;
            if (!carry_out(memory_work)) {
                break;
            }
        } else if (status == FRAME_BAD) {
            frame_init(&frame, memory_work);
            if (!is_proven) {
                break;
            }
            noise = 0; /* still a program: after an end of the session, the prompt would take the rest for typed text */
            answer_begin(memory_work, BAD_FRAME, 0, 0); /* command and number may be damaged too (BLOCK_PROTOCOL.md) */
            answer_end();
        }
    }
    uart_flush();
    uart_open(UART_UBRR_57143);
}
