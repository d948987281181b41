/* SPDX-License-Identifier: MIT */
#include "board_private.h"

/* The guard belongs to the image that set the stack pointer to the end of the SRAM last (its start-up code does):
 * a loader function called by the application goes on using the application's stack. */
static void set_up(board_t *board, uint32_t pc)
{
    uint32_t end = board->symbols.variables_end[pc >= M128_NRWW_START];
    board->stack.set = true;
    board->stack.limit = (uint16_t)(end ? end : M128_RAM_START);
    board->stack.low = M128_RAM_END - 1;
}

void stack_reset(board_t *board)
{
    board->stack.set = false;
    board->stack.low = M128_RAM_END - 1;
    board->stack.limit = M128_RAM_START;
}

/* pushed: by a push, a call or an interrupt; else by an OUT to SPL. Start-up code and function prologues write SPH
 * first; of others, that write SPL first, the half set pointer is passed over here and a push looks again. */
void stack_moved(board_t *board, uint32_t pc, bool pushed)
{
    stack_guard_t *stack = &board->stack;
    uint16_t sp = (uint16_t)(board->avr->data[M128_SPL] | board->avr->data[M128_SPH] << 8);
    if (sp == M128_RAM_END - 1) {
        set_up(board, pc);
    }
    if (sp >= stack->low && stack->set) {
        return;
    }
    if (sp < M128_RAM_START - 1 || sp >= M128_RAM_END) {
        if (pushed) {
            violation_note(board, VIOLATION_STACK_UNSET, "stack used with SP = 0x%04X, outside the SRAM", sp);
        }
        return;
    }
    if (!stack->set) {
        set_up(board, pc);
    }
    if (sp < stack->low) {
        stack->low = sp;
    }
    if (sp + 1 < stack->limit) {
        violation_note(board, VIOLATION_STACK, "stack down to 0x%04X, variables end at 0x%04X", sp + 1, stack->limit);
    }
}

uint32_t board_stack_low(const board_t *board) { return board->stack.low + 1u; }

uint32_t board_stack_headroom(const board_t *board)
{
    uint32_t low = board->stack.low + 1u;
    return low > board->stack.limit ? low - board->stack.limit : 0;
}
