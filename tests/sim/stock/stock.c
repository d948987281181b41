/* SPDX-License-Identifier: MIT */
#include "stock.h"

#include <stdlib.h>
#include <string.h>

#include <avr_eeprom.h>
#include <avr_uart.h>
#include <sim_avr.h>
#include <sim_hex.h>
#include <sim_interrupts.h>
#include <sim_time.h>

#include "memory_map.h"

#define CLOCK_HZ 16000000u
#define UBRR0L 0x29u
#define UBRR_1_MBPS 1u            /* rate of the servos */
#define BUS_BYTE_CYCLES 160u      /* at 1 Mbps */
#define CONSOLE_BYTE_CYCLES 2800u /* at 57,143 */
#define TICK_VECTOR 12u           /* timer 1, compare match A */
#define SERVOS 32u
#define REGISTERS 50u
#define BOOT_MODE_APPLICATION 0x11u

/* Bytes in order of arrival. */
typedef struct {
    uint8_t *bytes;
    size_t count, taken;
} queue_t;

struct stock {
    avr_t *avr;
    queue_t typed, said;    /* from and to the PC */
    queue_t heard, answers; /* from and to the board, on the bus */
    avr_irq_t *console_in, *bus_in;
    uint32_t ticks, answered, servos;
    uint8_t registers[SERVOS][REGISTERS];
    stock_frame_t *frames;
    size_t frame_count;
};

static void append(queue_t *queue, uint8_t byte)
{
    if ((queue->count & (queue->count - 1)) == 0) {
        queue->bytes = realloc(queue->bytes, queue->count ? queue->count * 2 : 1);
        if (!queue->bytes) {
            abort();
        }
    }
    queue->bytes[queue->count++] = byte;
}

/* ---- servos ---- */

/* Register addresses of an AX-12. The model reaches a position at once. */
enum { DELAY = 5, LEVEL = 16, TORQUE = 24, GOAL = 30, PRESENT = 36, MOVING = 46 };
enum { PING = 1, READ = 2, WRITE = 3, SYNC_WRITE = 0x83 };

static const uint8_t factory_settings[REGISTERS] = {
    12, 0, 24, 0, 1, 250, 0, 0, 0xFF, 3, 0, 80, 60, 190, 0xFF, 3, 2, 36, 36, 0,
    0, 0, 0, 0, 0, 0, 0, 0, 32, 32, 0, 2, 0, 0, 0xFF, 3, 0, 2, 0, 0,
    0, 0, 110, 30, 0, 0, 0, 0, 32, 0,
};

static void write_registers(stock_t *robot, uint8_t id, uint8_t address, const uint8_t *bytes, uint8_t count)
{
    uint8_t *registers = robot->registers[id];
    if (address + count > REGISTERS) {
        return;
    }
    memcpy(registers + address, bytes, count);
    if (address <= GOAL + 1 && address + count > GOAL) {
        registers[TORQUE] = 1;
    }
    if (registers[TORQUE]) {
        memcpy(registers + PRESENT, registers + GOAL, 2);
    }
}

static avr_cycle_count_t send_answer(avr_t *avr, avr_cycle_count_t when, void *param)
{
    stock_t *robot = param;
    (void)avr;
    avr_raise_irq(robot->bus_in, robot->answers.bytes[robot->answers.taken++]);
    return robot->answers.taken < robot->answers.count ? when + BUS_BYTE_CYCLES : 0;
}

/* Answers after the return delay, counted from the last byte, which simavr passes on as soon as it is written. */
static void answer(stock_t *robot, uint8_t id, const uint8_t *params, uint8_t count)
{
    uint8_t sum = (uint8_t)(id + count + 2);
    const uint8_t head[] = {0xFF, 0xFF, id, (uint8_t)(count + 2), 0};
    for (size_t i = 0; i < sizeof head; i++) {
        append(&robot->answers, head[i]);
    }
    for (uint8_t i = 0; i < count; i++) {
        append(&robot->answers, params[i]);
        sum = (uint8_t)(sum + params[i]);
    }
    append(&robot->answers, (uint8_t)~sum);
    robot->answered++;
    avr_cycle_timer_register(robot->avr, 2 * BUS_BYTE_CYCLES + 32u * robot->registers[id][DELAY], send_answer, robot);
}

static void take_frame(stock_t *robot, const uint8_t *params, uint8_t count)
{
    uint8_t address = params[0], length = params[1];
    stock_frame_t frame = {.tick = robot->ticks};
    memset(frame.goals, 0xFF, sizeof frame.goals);
    for (uint8_t at = 2; at + length < count; at = (uint8_t)(at + length + 1)) {
        uint8_t id = params[at] % SERVOS;
        write_registers(robot, id, address, params + at + 1, length);
        frame.goals[id] = (uint16_t)(params[at + 1] | params[at + 2] << 8);
    }
    if (address == GOAL) {
        robot->frames = realloc(robot->frames, (robot->frame_count + 1) * sizeof frame);
        if (!robot->frames) {
            abort();
        }
        robot->frames[robot->frame_count++] = frame;
    }
}

static void obey(stock_t *robot, const uint8_t *packet)
{
    uint8_t id = packet[2], count = (uint8_t)(packet[3] - 2), instruction = packet[4];
    const uint8_t *params = packet + 5;
    if (instruction == SYNC_WRITE) {
        take_frame(robot, params, count);
    }
    if (id >= SERVOS || !(robot->servos >> id & 1)) {
        return;
    }
    if (instruction == PING) {
        answer(robot, id, params, 0);
    } else if (instruction == READ && params[0] + params[1] <= REGISTERS) {
        answer(robot, id, robot->registers[id] + params[0], params[1]);
    } else if (instruction == WRITE) {
        write_registers(robot, id, params[0], params + 1, (uint8_t)(count - 1));
        answer(robot, id, params, 0);
    }
}

/* A byte of the board on the bus: FF FF, ID, length, instruction, parameters, checksum. */
static void on_bus(avr_irq_t *irq, uint32_t value, void *param)
{
    static const uint8_t start[] = {0xFF, 0xFF};
    stock_t *robot = param;
    queue_t *heard = &robot->heard;
    (void)irq;
    if (robot->avr->data[UBRR0L] != UBRR_1_MBPS) {
        return;
    }
    append(heard, (uint8_t)value);
    if (heard->count <= 2 && value != start[heard->count - 1]) {
        heard->count = 0;
    } else if (heard->count >= 4 && heard->count == heard->bytes[3] + 4u) {
        heard->count = 0;
        obey(robot, heard->bytes);
    }
}

/* ---- the PC's line, the clock ---- */

static void on_console(avr_irq_t *irq, uint32_t value, void *param)
{
    stock_t *robot = param;
    (void)irq;
    append(&robot->said, (uint8_t)value);
}

static avr_cycle_count_t type_next(avr_t *avr, avr_cycle_count_t when, void *param)
{
    stock_t *robot = param;
    (void)avr;
    avr_raise_irq(robot->console_in, robot->typed.bytes[robot->typed.taken++]);
    return robot->typed.taken < robot->typed.count ? when + CONSOLE_BYTE_CYCLES : 0;
}

static void on_tick(avr_irq_t *irq, uint32_t value, void *param)
{
    stock_t *robot = param;
    (void)irq;
    robot->ticks += value;
}

/* ---- the chip ---- */

/* Lets simulated time pass without real time. */
static void sleep_no_time(avr_t *avr, avr_cycle_count_t cycles)
{
    (void)avr;
    (void)cycles;
}

static bool load(avr_t *avr, const char *file)
{
    ihex_chunk_p chunks = NULL;
    int count = read_ihex_chunks(file, &chunks);
    for (int i = 0; i < count; i++) {
        if (chunks[i].baseaddr + chunks[i].size > MEM_BOOT_END) {
            return false;
        }
        memcpy(avr->flash + chunks[i].baseaddr, chunks[i].data, chunks[i].size);
    }
    free_ihex_chunks(chunks);
    return count > 0;
}

static avr_irq_t *uart(avr_t *avr, uint32_t name, int irq)
{
    uint32_t flags = 0;
    avr_ioctl(avr, AVR_IOCTL_UART_SET_FLAGS(name), &flags);
    return avr_io_getirq(avr, AVR_IOCTL_UART_GETIRQ(name), irq);
}

/* Makes the loader start the application by itself. At its prompt it would receive nothing, because simavr takes the
 * interrupt vector from the application. */
static void set_boot_mode(avr_t *avr)
{
    uint8_t start = BOOT_MODE_APPLICATION;
    avr_eeprom_desc_t byte = {.ee = &start, .offset = MEM_EE_BOOT_MODE, .size = 1};
    avr_ioctl(avr, AVR_IOCTL_EEPROM_SET, &byte);
}

stock_t *stock_new(const char *const *files, size_t count, const uint8_t *motions, uint32_t servos)
{
    stock_t *robot = calloc(1, sizeof *robot);
    avr_t *avr = robot ? avr_make_mcu_by_name("atmega128") : NULL;
    if (!avr) {
        abort();
    }
    avr_init(avr);
    robot->avr = avr;
    robot->servos = servos;
    avr->frequency = CLOCK_HZ;
    avr->log = LOG_ERROR;
    avr->sleep = sleep_no_time;
    avr->reset_pc = avr->pc = MEM_BOOT_START; /* the fuse BOOTRST */
    avr->codeend = avr->flashend;
    memset(avr->flash, 0xFF, MEM_BOOT_END);
    for (size_t i = 0; i < count; i++) {
        if (!load(avr, files[i])) {
            stock_free(robot);
            return NULL;
        }
    }
    if (motions) {
        memcpy(avr->flash + MEM_MOTION_START, motions, MEM_MOTION_END - MEM_MOTION_START);
    }
    for (uint8_t id = 0; id < SERVOS; id++) {
        memcpy(robot->registers[id], factory_settings, REGISTERS);
        robot->registers[id][3] = id;
    }
    robot->bus_in = uart(avr, '0', UART_IRQ_INPUT);
    robot->console_in = uart(avr, '1', UART_IRQ_INPUT);
    avr_irq_register_notify(uart(avr, '0', UART_IRQ_OUTPUT), on_bus, robot);
    avr_irq_register_notify(uart(avr, '1', UART_IRQ_OUTPUT), on_console, robot);
    avr_irq_register_notify(avr_get_interrupt_irq(avr, TICK_VECTOR) + AVR_INT_IRQ_RUNNING, on_tick, robot);
    set_boot_mode(avr);
    return robot;
}

void stock_free(stock_t *robot)
{
    avr_terminate(robot->avr);
    free(robot->avr);
    free(robot->typed.bytes);
    free(robot->said.bytes);
    free(robot->heard.bytes);
    free(robot->answers.bytes);
    free(robot->frames);
    free(robot);
}

bool stock_run(stock_t *robot, uint64_t cycles)
{
    avr_cycle_count_t end = robot->avr->cycle + cycles;
    while (robot->avr->cycle < end) {
        int state = avr_run(robot->avr);
        if (state == cpu_Done || state == cpu_Crashed) {
            return false;
        }
    }
    return true;
}

void stock_type(stock_t *robot, const uint8_t *bytes, size_t count)
{
    bool idle = robot->typed.taken == robot->typed.count;
    for (size_t i = 0; i < count; i++) {
        append(&robot->typed, bytes[i]);
    }
    if (idle && count) {
        avr_cycle_timer_register(robot->avr, CONSOLE_BYTE_CYCLES, type_next, robot);
    }
}

size_t stock_console(const stock_t *robot, const uint8_t **bytes)
{
    *bytes = robot->said.bytes;
    return robot->said.count;
}

size_t stock_frames(const stock_t *robot, const stock_frame_t **frames)
{
    *frames = robot->frames;
    return robot->frame_count;
}

const uint8_t *stock_flash(const stock_t *robot)
{
    return robot->avr->flash;
}

uint32_t stock_answers(const stock_t *robot)
{
    return robot->answered;
}
