/* SPDX-License-Identifier: MIT */
#include "stack.h"

/* The guard belongs to the image that last set the stack pointer to the end of the SRAM, in its start-up code. A loader
 * function called by the application continues on the application's stack. */
static void set_up(stack_guard_t *stack, uint32_t pc)
{
    uint32_t end = stack->machine->symbols.variables_end[pc >= M128_NRWW_START];
    stack->set = true;
    stack->limit = (uint16_t)(end ? end : M128_RAM_START);
    stack->low = M128_RAM_END - 1;
}

uint16_t stack_pointer(const avr_t *avr) { return (uint16_t)(avr->data[M128_SPL] | avr->data[M128_SPH] << 8); }

void stack_reset(stack_guard_t *stack)
{
    stack->set = false;
    stack->low = M128_RAM_END - 1;
    stack->limit = M128_RAM_START;
}

/* Start-up code and function prologues write SPH first. Other code may write SPL first: then a half set pointer is
 * ignored here, and the next push checks again. */
void stack_moved(stack_guard_t *stack, uint32_t pc, bool pushed)
{
    uint16_t sp = stack_pointer(stack->machine->avr);
    if (sp == M128_RAM_END - 1) {
        set_up(stack, pc);
    }
    if (sp >= stack->low && stack->set) {
        return;
    }
    if (sp < M128_RAM_START - 1 || sp >= M128_RAM_END) {
        if (pushed) {
            violation_note(stack->machine, VIOLATION_STACK_UNSET, "stack used with SP = 0x%04X, outside the SRAM", sp);
        }
        return;
    }
    if (!stack->set) {
        set_up(stack, pc);
    }
    if (sp < stack->low) {
        stack->low = sp;
    }
    if (sp + 1 < stack->limit) {
        violation_note(stack->machine, VIOLATION_STACK, "stack down to 0x%04X, variables end at 0x%04X", sp + 1,
                       stack->limit);
    }
}

uint32_t stack_low(const stack_guard_t *stack) { return stack->low + 1u; }

uint32_t stack_headroom(const stack_guard_t *stack)
{
    uint32_t low = stack->low + 1u;
    return low > stack->limit ? low - stack->limit : 0;
}
