/* SPDX-License-Identifier: MIT */
#include "board_private.h"

#define OPCODE_ERASED 0xFFFFu
#define OPCODE_BREAK 0x9598u

/* 0x9000-0x91FF loads, 0x9200-0x93FF stores: the low nibble says which. 4-7 are (E)LPM as loads, and the exchange
 * instructions of XMEGA as stores. */
static bool load_store_is_legal(uint16_t opcode)
{
    unsigned nibble = opcode & 0xFu;
    bool store = opcode >= 0x9200;
    return nibble != 3 && nibble != 8 && nibble != 11 && !(store && nibble >= 4 && nibble <= 7);
}

/* 0x9400-0x95FF: one-operand instructions, flags, returns, indirect and long jumps. */
static bool one_operand_is_legal(uint16_t opcode)
{
    switch (opcode & 0xFu) {
    case 4:
    case 11: /* DES */
        return false;
    case 8:
        return opcode < 0x9500 || opcode == 0x9508 || opcode == 0x9518 || opcode == 0x9588 || opcode == 0x95A8 ||
               opcode == 0x95C8 || opcode == 0x95D8 || opcode == 0x95E8;
    case 9:
        return opcode == 0x9409 || opcode == 0x9509;
    default:
        return true;
    }
}

bool opcode_is_legal(uint16_t opcode)
{
    if (opcode < 0x0100) {
        return opcode == 0;
    }
    if (opcode >= 0x9000 && opcode < 0x9400) {
        return load_store_is_legal(opcode);
    }
    if (opcode >= 0x9400 && opcode < 0x9600) {
        return one_operand_is_legal(opcode);
    }
    return opcode < 0xF800 || (opcode & 0x8u) == 0; /* BLD, BST, SBRC, SBRS have bit 3 clear */
}

static bool moves_stack(uint16_t opcode)
{
    return (opcode & 0xFE0Fu) == 0x920Fu     /* PUSH */
           || (opcode & 0xF000u) == 0xD000u  /* RCALL */
           || (opcode & 0xFE0Eu) == 0x940Eu  /* CALL */
           || opcode == 0x9509              /* ICALL */
           || (opcode & 0xFE0Fu) == 0xBE0Du; /* OUT SPL: the second half of setting the stack pointer */
}

/* Of the instructions that move the stack pointer only the OUT begins with 0xBx. */
bool opcode_is_push(uint8_t high_byte) { return (high_byte & 0xF0u) != 0xB0u; }

static bool reads_or_writes_flash(uint16_t opcode)
{
    unsigned nibble = opcode & 0xFu;
    return opcode == 0x95C8 || opcode == 0x95D8 || opcode == 0x95E8 ||
           ((opcode & 0xFE00u) == 0x9000u && nibble >= 4 && nibble <= 7);
}

static bool may_touch_device(uint16_t opcode)
{
    return (opcode & 0xF000u) == 0xB000u              /* IN, OUT */
           || (opcode & 0xFC00u) == 0x9000u           /* loads, stores, PUSH, POP */
           || (opcode & 0xFC00u) == 0x9800u           /* SBI, CBI, SBIC, SBIS */
           || (opcode & 0xD000u) == 0x8000u           /* LDD, STD */
           || (opcode & 0xFF0Fu) == 0x9408u           /* SEI, CLI and the other flags */
           || (opcode & 0xFFEFu) == 0x9508u           /* RET, RETI */
           || opcode == 0x95A8u;                      /* WDR */
}

bool opcode_jumps_back(uint16_t opcode)
{
    return (opcode & 0xFA00u) == 0xF200u      /* BRBS, BRBC */
           || (opcode & 0xF800u) == 0xC800u;  /* RJMP */
}

uint16_t opcode_note(uint16_t opcode)
{
    unsigned note = 0;
    note |= moves_stack(opcode) ? NOTE_STACK : 0u;
    note |= reads_or_writes_flash(opcode) ? NOTE_FLASH : 0u;
    note |= opcode == 0x9588 ? NOTE_SLEEP : 0u;
    note |= opcode == 0x9518 ? NOTE_RETI : 0u;
    note |= opcode == OPCODE_BREAK || !opcode_is_legal(opcode) ? NOTE_WRONG : 0u;
    note |= may_touch_device(opcode) ? NOTE_DEVICE : 0u;
    note |= opcode_jumps_back(opcode) ? NOTE_BACK : 0u;
    return (uint16_t)note;
}
