/* SPDX-License-Identifier: MIT */
#include "cli_leave.h"

#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

#define ROBOT_ROWS 35   /* of Edit's screen, the largest (edit/ORIGINAL.md section 3) */
#define SILENT_CYCLES (300u * BOARD_CYCLES_PER_MS)

#define KEEP_TITLE "\x1b[22;2t"
#define TITLE_BACK "\x1b[23;2t"
#define TITLE "\x1b]2;cm5sim: Ctrl-] ends it, Ctrl-T ? shows its keys\a"

static const char hint[] = "Ctrl-] ends the simulator";

static bool has_title(const session_t *session)
{
    const char *term = getenv("TERM");
    /* Consoles of older kernels print it. */
    return term != NULL && session_is_on_terminal(session) && strncmp(term, "linux", 5) != 0;
}

void leave_open(session_t *session)
{
    session->leave.titled = has_title(session);
    if (session->leave.titled) {
        overlay_add(KEEP_TITLE TITLE);
    }
}

void leave_close(session_t *session)
{
    if (session->leave.titled) {
        overlay_add(TITLE_BACK);
        session->leave.titled = false;
    }
}

void leave_show(session_t *session)
{
    struct winsize size;
    char text[100];
    const bool silent = board_now(session->board) - session->last_traffic > SILENT_CYCLES;
    if (!session->console.cleared || !silent || session->overlay.kind != OVERLAY_NONE || !session_is_on_terminal(session)) {
        return;
    }
    session->console.cleared = false;
    if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col < 2 * strlen(hint)) {
        return;
    }
    const uint32_t starts = board_resets(session->board) + 1u;
    if (size.ws_row > ROBOT_ROWS || session->leave.shown_at_start != starts) {
        /* The cursor comes back to where the robot has put it. */
        snprintf(text, sizeof text, "\x1b" "7\x1b[%u;%zuH%s\x1b" "8", size.ws_row, size.ws_col + 1 - strlen(hint), hint);
        overlay_add(text);
    }
    session->leave.shown_at_start = starts;
}

void leave_explain(session_t *session)
{
    if (!session->leave.explained) {
        session->leave.explained = true;
        session_note(session, "Ctrl-C goes to the robot. Ctrl-] ends the simulator, Ctrl-T ? shows its keys.");
    }
}
