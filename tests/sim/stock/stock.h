/* SPDX-License-Identifier: MIT
 * stock.h - a robot on the packaged simavr, with its own UARTs, timers and flash and nothing of tools/sim. Around it is
 * the minimum that the images need: AX-12 on the bus of UART 0, a PC on UART 1. It checks no violations, only that the
 * images run. For stock_robot.py. */
#ifndef STOCK_H
#define STOCK_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct stock stock_t;

/* Goals of one SYNC WRITE. tick: interrupts of timer 1 since power-on. Goal 0xFFFF: joint not included. */
typedef struct {
    uint32_t tick;
    uint16_t goals[32];
} stock_frame_t;

/* Power-on with these Intel HEX files in flash. motions: the 64 KiB of the motion area, or NULL. servos: bit n: ID n is
 * connected. Returns NULL if a file could not be read. */
stock_t *stock_new(const char *const *files, size_t count, const uint8_t *motions, uint32_t servos);
void stock_free(stock_t *robot);

/* Returns false if the processor stopped for good. */
bool stock_run(stock_t *robot, uint64_t cycles);

/* Sends bytes from the PC back to back at the line rate. */
void stock_type(stock_t *robot, const uint8_t *bytes, size_t count);
/* All bytes that the robot has sent to the PC since power-on. */
size_t stock_console(const stock_t *robot, const uint8_t **bytes);
size_t stock_frames(const stock_t *robot, const stock_frame_t **frames);
/* The 128 KiB of flash. */
const uint8_t *stock_flash(const stock_t *robot);
/* Number of status packets sent by servos. */
uint32_t stock_answers(const stock_t *robot);

#endif
