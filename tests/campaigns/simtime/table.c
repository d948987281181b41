/* SPDX-License-Identifier: MIT
 * table.c - tables of Edit: a page of flash as the table shows it (firmware/edit/ORIGINAL.md 1), and the comparison
 * of two tables. */
#include "session.h"

#include <stdio.h>
#include <string.h>

#define FIRST_FIELD 14u
#define SOFTNESS_AT 32u
#define SCHEDULE_AT 16u
#define TIME_BASE 10u

void table_forget(table_t *table)
{
    int *const cells = &table->cell[0][0];
    for (unsigned i = 0; i < TABLE_STEPS * TABLE_ROWS; i++) {
        cells[i] = UNKNOWN;
    }
    for (unsigned i = 0; i < JOINTS; i++) {
        table->softness[i] = table->live[i] = UNKNOWN;
    }
    for (unsigned i = 0; i < TABLE_FIELDS; i++) {
        table->field[i] = UNKNOWN;
    }
    table->name[0] = '\0';
    table->page = table->address = table->go_step = table->is_time = UNKNOWN;
}

unsigned table_offset(unsigned x, unsigned y)
{
    const unsigned in_step = y < ROW_PAUSE ? 2 * y : y == ROW_PAUSE ? 62 : 63;
    return x == 0 ? PAGE_BYTES + in_step : x < TABLE_STEPS ? STEP_BYTES * x + in_step : x == 8 ? SOFTNESS_AT + y : 11 + y;
}

static int of_word(const uint8_t *at)
{
    const unsigned word = at[0] | (unsigned)at[1] << 8;
    return word < 1024 ? (int)word : word & 0x2000u ? OFF : NO_VALUE;
}

void table_load(table_t *table, unsigned page)
{
    const uint8_t *at = page_at(page);
    for (unsigned step = 1; step < TABLE_STEPS; step++) {
        for (unsigned id = 0; id < JOINTS; id++) {
            table->cell[step][id] = of_word(at + STEP_BYTES * step + 2 * id);
        }
        table->cell[step][ROW_PAUSE] = at[STEP_BYTES * step + 62];
        table->cell[step][ROW_TIME] = at[STEP_BYTES * step + 63];
    }
    for (unsigned id = 0; id < JOINTS; id++) {
        table->softness[id] = at[SOFTNESS_AT + id];
    }
    for (unsigned i = 0; i < TABLE_FIELDS; i++) {
        table->field[i] = at[FIRST_FIELD + i];
    }
    table->is_time = at[SCHEDULE_AT] == TIME_BASE;
    memcpy(table->name, at, NAME_BYTES);
    for (unsigned i = 0; i < NAME_BYTES; i++) {
        table->name[i] = (char)(table->name[i] == '\0' ? ' ' : table->name[i]);
        if (memchr(at, '\0', i + 1) != NULL) {
            table->name[i] = ' ';   /* old data after the end of the name */
        }
    }
    table->page = (int)page;
}

/* ---- comparing ---- */

static bool is_other(int a, int b)
{
    return a != UNKNOWN && b != UNKNOWN && a != b;
}

/* Returns the first difference of two pages from column `first` on (0: with the work pose), or NULL. */
static const char *difference(const table_t *a, const table_t *b, unsigned first)
{
    static char text[80];
    for (unsigned step = first; step < TABLE_STEPS; step++) {
        for (unsigned row = 0; row < TABLE_ROWS; row++) {
            if (is_other(a->cell[step][row], b->cell[step][row])) {
                snprintf(text, sizeof text, "X%u Y%u %d, right is %d", step, row, a->cell[step][row], b->cell[step][row]);
                return text;
            }
        }
    }
    for (unsigned id = 0; id < JOINTS; id++) {
        if (is_other(a->softness[id], b->softness[id])) {
            snprintf(text, sizeof text, "X8 Y%u %d, right is %d", id, a->softness[id], b->softness[id]);
            return text;
        }
    }
    for (unsigned i = 0; i < TABLE_FIELDS; i++) {
        if (is_other(a->field[i], b->field[i])) {
            snprintf(text, sizeof text, "X9 Y%u %d, right is %d", i + 3, a->field[i], b->field[i]);
            return text;
        }
    }
    if (a->name[0] != '\0' && b->name[0] != '\0' && strncmp(a->name, b->name, NAME_BYTES) != 0) {
        snprintf(text, sizeof text, "name \"%.13s\", right is \"%.13s\"", a->name, b->name);
        return text;
    }
    if (is_other(a->is_time, b->is_time)) {
        return "Time or Speed";
    }
    return NULL;
}

bool table_is_equal(const table_t *a, const table_t *b)
{
    return difference(a, b, 1) == NULL;
}

void table_compare(const char *rule, const table_t *shown, const table_t *right)
{
    const char *found = difference(shown, right, 0);
    if (found != NULL) {
        session_fail(rule, "page %d: %s", shown->page, found);
    }
    if (shown->page != right->page || is_other(shown->go_step, right->go_step)) {
        session_fail(rule, "page %d, Go Step %d, and page %d, Go Step %d is right", shown->page, shown->go_step, right->page,
                     right->go_step);
    }
}
