/* SPDX-License-Identifier: MIT
 * editor_play.c - the keys of a play in Edit, by edit/ORIGINAL.md section 10, edit/DIFFERENCES.md and edit/keys.h:
 * the message for each key, and that [Exit] ends the play after this repetition. */
#include "session.h"

#include <string.h>

#define ON 2u                      /* ticks: goals were sent */
#define ROWS 36u                   /* of the screen; one of them is the command line */
#define LONE 7u                    /* ticks: an ESC followed by nothing was the ESC key */
#define SAID (SECOND / 4u)
#define SLOW (2u * SECOND)         /* a late adapter or computer delays messages */
#define REPETITION (40u * SECOND)  /* seven steps with pauses, or an approach and a break */

static struct {
    bool is_play;                  /* by the last typed line */
    bool breaks;                   /* a break was requested: a stop after it has no effect */
    char sequence[4];
    unsigned count;
    uint32_t key_tick, exit_tick;
    const char *said;              /* must soon appear in the command row */
} play;

static bool is_on(void)
{
    return play.is_play && session.frame_tick > session.boot_tick && session.tick - session.frame_tick <= ON;
}

static void expect(const char *said)
{
    play.count = 0;
    play.said = said;
    play.key_tick = session.tick;
    play.exit_tick = said[1] == 'E' ? session.tick : NEVER_TICK;
}

/* A program's line in band hides the screen until the robot stands still. */
static bool is_plain(void)
{
    table_t shown;
    return screen_read(&shown) && rules_is_well() && session.tick - session.late_tick > SLOW && session.latency == 0;
}

static bool is_shown(const char *text)
{
    for (unsigned row = 0; row < ROWS; row++) {
        if (strstr(screen_row(row), text) != NULL) {
            return true;
        }
    }
    return false;
}

/* The program has read a byte from the user. */
void editor_play_key(uint8_t key)
{
    play.said = NULL;
    if (!is_on() || !is_plain()) {
        play.count = 0;
        play.exit_tick = NEVER_TICK;
        return;
    }
    if (play.count > 0 || key == 0x1B) {
        play.sequence[play.count++] = (char)key;
        play.key_tick = session.tick;
        if (play.count == 3 && play.sequence[1] == '[' && key >= 'A' && key <= 'D') {
            expect("[Exit]");
        } else if (play.count == 3) {
            play.count = 0;
        }
    } else if (key == '\r' && !play.breaks) {
        expect("[STOP]");
    } else if (key == ' ' || key == 0x03) {
        expect("[BREAK]");
        play.breaks = true;
    } else {
        play.exit_tick = NEVER_TICK;
    }
}

void editor_play_tick(void)
{
    if (!session.is_edit || !play.is_play) {
        return;
    }
    play.breaks = play.breaks && is_on();
    if (play.count == 1 && session.tick - play.key_tick > LONE) {
        expect("[Exit]");
    }
    if (play.said != NULL && (!is_on() || !is_plain())) {
        play.said = NULL;   /* the play was over before the key, or something has happened */
    } else if (play.said != NULL && (is_shown(play.said) || screen_has_said(play.said))) {
        reached("key in a play of Edit");
        play.said = NULL;   /* the end of the play, or its next step, may erase it */
    } else if (play.said != NULL && session.tick - play.key_tick > SAID) {
        session_fail("a key in a play of Edit does what its pages say", "%s is not said", play.said);
    }
    if (play.exit_tick != NEVER_TICK && !is_on()) {
        play.exit_tick = NEVER_TICK;
    } else if (play.exit_tick != NEVER_TICK && session.tick - play.exit_tick > REPETITION) {
        session_fail("[Exit] ends a play after this repetition", "it goes on for %u ticks", session.tick - play.exit_tick);
    }
}

void editor_play_line(const char *line)
{
    play.is_play = strncmp(line, "play", 4) == 0 || (play.is_play && line[0] == '\0');
}

void editor_play_boot(void)
{
    memset(&play, 0, sizeof play);
}
