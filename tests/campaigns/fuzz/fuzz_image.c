/* SPDX-License-Identifier: MIT */
#include "fuzz_image.h"

#include "console.h"
#include "dxl.h"
#include "fake_bus.h"
#include "fake_console.h"
#include "fake_eeprom.h"
#include "fake_flash.h"
#include "fake_panel.h"
#include "fake_time.h"
#include "hal/bus.h"
#include "linker/memory_map.h"
#include "page.h"
#include "page_service.h"
#include "page_store.h"
#include "system.h"
#include "trap.h"

#include <setjmp.h>
#include <stdbool.h>
#include <string.h>

#define KICK_HALF_US 100u      /* one turn of the main loop */
#define TICK_HALF_US 15625u
#define ROOM_A_TURN 64u        /* bytes sent per turn: a fast line, otherwise the runs get long */
#define TURNS_MAX 400000u      /* between two sleeps: it hangs */
#define REST_TICKS 64u
#define BREAK_TICKS 260u        /* the longest ramp, plus the rest of a break */
#define LAST_TICKS 40u

static fuzz_t input;
static unsigned ticks_to_wait, turns;
static enum { FEEDING, LAST_WORDS } phase;
static unsigned last;          /* number of last words typed */
static uint16_t packets_seen;
static jmp_buf over;

/* ---- what reaches the servos ---- */

/* Goals must go to present servos and be within 0..1023. */
static void check_sync_write(const uint8_t *packet, uint8_t size)
{
    const uint8_t address = packet[5], length = packet[6];
    for (unsigned at = 7; at + length < size; at += length + 1u) {
        const uint8_t id = packet[at];
        ASSERT(id >= 1 && id <= FUZZ_IMAGE_SERVOS);
        if (address <= DXL_AT_GOAL && address + length >= DXL_AT_GOAL + 2) {
            const uint8_t *goal = &packet[at + 1 + DXL_AT_GOAL - address];
            ASSERT((goal[0] | goal[1] << 8) <= 1023);
        }
    }
}

static void check_packets(void)
{
    const uint16_t sent = fake_bus_sent();
    for (; packets_seen != sent; packets_seen++) {
        if ((uint16_t)(sent - packets_seen) > 1000) {
            continue;   /* a search: more than the log holds */
        }
        const uint8_t *packet = fake_bus_packet(packets_seen);
        if (packet[4] == DXL_SYNC_WRITE) {
            check_sync_write(packet, fake_bus_packet_size(packets_seen));
        }
    }
}

/* ---- the input ---- */

static void type_packet(uint8_t buttons)
{
    const uint8_t packet[] = {0xFF, 0x55, buttons, (uint8_t)~buttons, 0x00, 0xFF};
    fake_console_type_bytes(packet, sizeof packet);
}

static void happen(uint8_t what, uint8_t argument)
{
    fake_servo_t *servo = fake_bus_servo((uint8_t)(1 + (argument & 3)));
    switch (what) {
    case 0xFE: ticks_to_wait = argument; break;
    case 0xFD:
        servo->faults = argument >> 2 & 31;
        servo->error = argument & 128 ? 32 : 0;
        break;
    case 0xFC: fake_panel_press(argument); break;
    default: type_packet(argument); break;
    }
}

/* Types as much of the input as the line takes at once. */
static void feed(void)
{
    while (fuzz_left(&input) > 0 && ticks_to_wait == 0 && console_waiting() < 100) {
        uint8_t byte = fuzz_byte(&input);
        if (byte >= 0xFB && byte <= 0xFE && !(byte == 0xFE && fuzz_left(&input) > 0 && *input.at == 0xFE)) {
            happen(byte, fuzz_byte(&input));
            continue;
        }
        if (byte == 0xFE) {
            byte = fuzz_byte(&input);
        }
        fake_console_type_bytes(&byte, 1);
    }
}

/* At the end of the input, releases all buttons, clears faults and waits for half a second. */
static void rest(void)
{
    phase = LAST_WORDS;
    last = 0;
    ticks_to_wait = REST_TICKS;
    fake_panel_press(0);
    for (uint8_t id = 1; id <= FUZZ_IMAGE_SERVOS; id++) {
        fake_bus_servo(id)->faults = 0;
    }
}

/* Called when the main loop sleeps: makes the next thing happen. */
static void go_on(void)
{
    if (ticks_to_wait > 0) {
        ticks_to_wait--;
    } else if (phase == FEEDING && fuzz_left(&input) > 0) {
        feed();
    } else if (phase == FEEDING) {
        rest();
    } else {
        const char *words = fuzz_image_last_words(last++);
        if (words == NULL) {
            longjmp(over, 1);
        }
        fake_console_clear();
        fake_console_type(words);
        ticks_to_wait = last == 1 ? BREAK_TICKS : LAST_TICKS;
    }
}

/* ---- system.h ---- */

void system_init(void)
{
}

uint8_t system_reset_cause(void)
{
    return SYSTEM_RESET_POWER_ON;
}

/* The end of board_start: everything is initialized, and the servos are powered. */
void system_watchdog_on(void)
{
    for (uint8_t id = 1; id <= FUZZ_IMAGE_SERVOS; id++) {
        (void)fake_bus_add(id, BUS_RATE_1M);
    }
    fake_bus_servo(4)->faults = FAKE_BUS_DEAF_TO_SYNC;
    packets_seen = 0;
}

void system_kick(void)
{
    const uint8_t room = console_room();
    ASSERT(++turns < TURNS_MAX);
    fake_time_half_us(KICK_HALF_US);
    fake_console_set_room(room + ROOM_A_TURN < CONSOLE_TX_BYTES ? (uint8_t)(room + ROOM_A_TURN) : (uint8_t)CONSOLE_TX_BYTES);
    if (fake_console_output_count() > 32768 && phase != LAST_WORDS) {
        fake_console_clear();
    }
}

void system_sleep(void)
{
    turns = 0;
    check_packets();
    fake_time_half_us(TICK_HALF_US);
    go_on();
}

void system_restart(void)
{
    longjmp(over, 2);
}

bool system_is_asked_to_end(void)
{
    return false;
}

void system_end(void)
{
    system_restart();
}

bool system_take_failed_assert(uint16_t *line, uint32_t *address)
{
    (void)line;
    (void)address;
    return false;
}

uint16_t system_adc(uint8_t channel)
{
    (void)channel;
    return 512;
}

/* ---- page_service.h: reports our loader; fake_flash does the writing ---- */

page_service_kind_t page_service_init(const boot_rx_t *rx)
{
    (void)rx;
    return PAGE_SERVICE_OURS;
}

page_service_kind_t page_service_kind(void)
{
    return PAGE_SERVICE_OURS;
}

bool page_service_post(uint8_t motion_page, const uint8_t data[512])
{
    (void)data;
    return motion_page < 128;
}

page_service_mail_t page_service_mail(void)
{
    return PAGE_SERVICE_MAIL_NONE;
}

/* ---- */

static void put_page(uint8_t number, uint8_t next, uint8_t exit_page, uint8_t code)
{
    uint8_t *page = fake_flash_bytes() + MEM_MOTION_START + 512u * number;
    page_clear(page);
    memcpy(page, "page", 4);
    page[4] = (uint8_t)('0' + number);
    page[PAGE_AT_STEPS] = 2;
    page[PAGE_AT_NEXT_PAGE] = next;
    page[PAGE_AT_EXIT_PAGE] = exit_page;
    page[PAGE_AT_PLAY_CODE] = code;
    for (uint8_t joint = 0; joint < 6; joint++) {
        page_set_pos(page, 0, joint, (uint16_t)(512 + 20 * joint));
        page_set_pos(page, 1, joint, (uint16_t)(512 - 20 * joint));
    }
    page[64 + PAGE_STEP_AT_SPEED] = 20;
    page[128 + PAGE_STEP_AT_SPEED] = 30;
    page_seal(page);
}

void fuzz_image_pages(void)
{
    put_page(1, 0, 0, 1);
    put_page(2, 3, 4, 2);
    put_page(3, 2, 4, 0);
    put_page(4, 0, 0, 16);
    put_page(5, 5, 4, 4);
    fake_flash_bytes()[MEM_MOTION_START + 512 * 6] = 0;   /* neither erased nor good */
}

bool fuzz_image_run(const uint8_t *data, size_t size)
{
    input = (fuzz_t){data, data + size};
    ticks_to_wait = 0;
    turns = 0;
    phase = FEEDING;
    fake_flash_reset();
    fake_eeprom_reset();
    fake_panel_reset();
    fake_time_reset();
    fake_console_reset();
    fuzz_image_pages();
    const int why = setjmp(over);
    if (why == 0) {
        (void)image_main();
    }
    return why == 1;
}

const char *fuzz_image_said(void)
{
    return fake_console_output();
}
