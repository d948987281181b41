/* SPDX-License-Identifier: MIT
 * editor_undo.c - UNDO goes back through the pages that the screen has shown, one line after another (words of
 * `help`). The history is limited (edit/undo.h): once UNDO changes nothing, no more is asked of it. */
#include "editor.h"

#include <string.h>
#include <strings.h>

#define DEPTH 32u

static struct {
    table_t shown;                 /* at the last look */
    bool has_shown;
    table_t past[DEPTH];           /* before each line that changed the page */
    unsigned count;
    unsigned undone;               /* UNDO in a row */
} undo;

void editor_undo_lose(void)
{
    undo.count = undo.undone = 0;
    undo.has_shown = false;
}

static void line_was_undo(const table_t *shown)
{
    if (undo.count == 0) {
        return;
    }
    const table_t *right = &undo.past[--undo.count];
    undo.undone++;
    if (table_is_equal(shown, right)) {
        if (undo.undone == 3) {
            reached("three UNDO in a row");
        }
    } else if (table_is_equal(shown, &undo.shown)) {
        undo.count = 0;
    } else {
        table_compare("UNDO goes back to the page that was shown", shown, right);
    }
}

/* Called when all is painted and the model is known. */
void editor_undo_look(const table_t *shown)
{
    const bool is_line = editor.lines == 1 && editor.mode == TABLE && undo.has_shown && !editor.is_key_edit;
    const bool is_same_page = undo.has_shown && shown->page == undo.shown.page;
    if (is_line && is_same_page && strcasecmp(editor.line, "undo") == 0) {
        line_was_undo(shown);
    } else if (is_same_page && table_is_equal(shown, &undo.shown)) {
        /* what was typed has changed nothing */
    } else if (is_line && is_same_page && strncasecmp(editor.line, "redo", 4) != 0 && undo.count < DEPTH) {
        undo.past[undo.count++] = undo.shown;
        undo.undone = 0;
    } else {
        undo.count = undo.undone = 0;
    }
    undo.shown = *shown;
    undo.has_shown = true;
}
