/* SPDX-License-Identifier: MIT */
#include "opcode.h"

#include "m128.h"

#define OPCODE_ERASED 0xFFFFu
#define OPCODE_BREAK 0x9598u
enum { IO_PINE = 0x01, IO_UCSR0A = 0x0B, IO_PIND = 0x10, IO_EECR = 0x1C, IO_TCNT1L = 0x2C, IO_TCNT1H = 0x2D, IO_SPL = 0x3D,
       IO_SREG = 0x3F, UCSR1A = 0x9B };

/* 0x9000-0x91FF are loads, 0x9200-0x93FF stores; the low nibble selects the kind. 4-7 are (E)LPM among the loads and
 * the XMEGA exchange instructions among the stores. */
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
           || (opcode & 0xFE0Fu) == 0xBE0Du; /* OUT SPL: second half of setting the stack pointer */
}

/* Of the instructions that move the stack pointer, only OUT begins with 0xB. */
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

static bool jumps_back(uint16_t opcode)
{
    return (opcode & 0xFA00u) == 0xF200u      /* BRBS, BRBC */
           || (opcode & 0xF800u) == 0xC800u;  /* RJMP */
}

/* A read has no side effect, and the value changes only with an event or at a time that waits.c knows. */
static bool is_harmless_io(unsigned io)
{
    return io == IO_PINE || io == IO_UCSR0A || io == IO_PIND || io == IO_EECR || io == IO_TCNT1L || io == IO_TCNT1H ||
           (io >= IO_SPL && io <= IO_SREG);
}

/* Whether an instruction accesses device registers or memory by pointer, that is, what changes by itself or has side
 * effects. */
static bool touches(uint16_t opcode, uint16_t operand)
{
    if ((opcode & 0xF800u) == 0xB000u) { /* IN */
        return !is_harmless_io((opcode >> 5 & 0x30u) | (opcode & 0xFu));
    }
    if ((opcode & 0xFE0Fu) == 0x9000u && (operand == UCSR1A || operand == M128_SPMCSR)) { /* LDS */
        return false;
    }
    if ((opcode & 0xFC0Fu) == 0x9000u) { /* LDS, STS */
        return operand < M128_RAM_START;
    }
    if ((opcode & 0xFD00u) == 0x9900u) { /* SBIC, SBIS */
        return !is_harmless_io(opcode >> 3 & 0x1Fu);
    }
    if ((opcode & 0xFC00u) == 0x9000u) { /* loads and stores except PUSH and POP */
        return (opcode & 0xFu) != 0xFu;
    }
    return (opcode & 0xF800u) == 0xB800u                      /* OUT */
           || (opcode & 0xFD00u) == 0x9800u                   /* CBI, SBI */
           || (opcode & 0xD000u) == 0x8000u                   /* LDD, STD */
           || opcode == 0x9518u || opcode == 0x9588u          /* RETI, SLEEP */
           || (opcode & 0xFFCFu) == 0x95C8u;                  /* LPM, ELPM, SPM */
}

uint16_t opcode_note(uint16_t opcode, uint16_t next_word)
{
    unsigned note = 0;
    note |= moves_stack(opcode) ? NOTE_STACK : 0u;
    note |= reads_or_writes_flash(opcode) ? NOTE_FLASH : 0u;
    note |= opcode == 0x9588 ? NOTE_SLEEP : 0u;
    note |= opcode == 0x9518 ? NOTE_RETI : 0u;
    note |= opcode == OPCODE_BREAK || !opcode_is_legal(opcode) ? NOTE_WRONG : 0u;
    note |= may_touch_device(opcode) ? NOTE_DEVICE : 0u;
    note |= jumps_back(opcode) ? NOTE_BACK : 0u;
    note |= touches(opcode, next_word) ? NOTE_TOUCHES : 0u;
    return (uint16_t)note;
}
