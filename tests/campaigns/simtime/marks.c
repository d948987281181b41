/* SPDX-License-Identifier: MIT
 * marks.c - places that a campaign must reach, by the console's reports and the typed lines. */
#include "session.h"

#include <stdio.h>
#include <string.h>

/* Texts of the console and the places that they mark. */
static const struct {
    const char *text, *place;
} texts[] = {
    {"Going to the first pose", "approach"},
    {"Moving, ", "move"},
    {"The pose is reached", "move arrived"},
    {"Stopped after", "play stopped"},
    {"Ended after", "play ended"},
    {"The exit pages lead back", "exit pages in a loop"},
    {"is damaged: ", "damaged page met"},
    {"Link 1 to", "link 1 taken"},
    {"Link 2 to", "link 2 taken"},
    {"Ended for the fault of a servo", "play ended for a servo"},
    {"answers again", "servo back"},
    {"reports overload", "overload named"},
    {"reports overheating", "overheating named"},
    {"reports angle limit", "angle limit named"},
    {"reports voltage", "voltage named"},
    {"has lost its torque", "torque lost"},
    {" is hot: ", "hot servo named"},
    {"Battery is low", "low battery named"},
    {"The layer ended after", "layer ended by itself"},
    {"The computer came 0.1 s late", "computer late in a play"},
    {"Nobody drives any more", "drive lost"},
    {"The line is too long", "line too long"},
    {"No page has code", "code without a page"},
    {"Busy: stop what is playing", "play refused while playing"},
    {"No servo answers", "play refused without servos"},
    {"The servos were switched off", "play refused after off"},
    {"Four joints are moved already", "aim refused: four joints"},
};

#define PLACES_MAX 128u

static struct {
    const char *place[PLACES_MAX];
    unsigned count[PLACES_MAX];
    unsigned places;
    bool approach, playing, paused, stopping, layer, aim;
    bool is_line_typed;            /* the user is in the middle of a line */
    char last[LINE_BYTES];         /* the newest typed line, until it is answered */
} marks;

void reached(const char *place)
{
    unsigned i = 0;
    while (i < marks.places && strcmp(marks.place[i], place) != 0) {
        i++;
    }
    if (i == marks.places) {
        if (i == PLACES_MAX) {
            return;
        }
        marks.place[marks.places++] = place;
    }
    marks.count[i]++;
}

static bool begins(const char *line, const char *text)
{
    return strncmp(line, text, strlen(text)) == 0;
}

static void servo_lost(void)
{
    reached("servo lost");
    if (marks.layer && marks.stopping) {
        reached("servo lost in a layer during stop");
    } else if (marks.layer) {
        reached("servo lost in a layer");
    } else if (marks.stopping) {
        reached("servo lost during stop");
    }
    if (marks.approach) {
        reached("servo lost during approach");
    } else if (marks.paused) {
        reached("servo lost during pause");
    } else if (marks.playing) {
        reached("servo lost during play");
    }
}

static void play_over(void)
{
    marks.approach = marks.playing = marks.paused = marks.stopping = marks.layer = false;
}

static void answered(const char *typed)
{
    if (begins(typed, "layer off") || begins(typed, "@layer off")) {
        marks.layer = false;
    } else if (begins(typed, "layer ") || begins(typed, "@layer ")) {
        marks.layer = true;
        reached("layer");
    } else if (begins(typed, "aim ") || begins(typed, "swing ")) {
        marks.aim = true;
        reached(marks.playing ? "aim during play" : "aim without a play");
    } else if (begins(typed, "free") && marks.aim) {
        marks.aim = false;
        reached("joint given back");
    } else if (begins(typed, "resume") && marks.paused) {
        marks.paused = false;
        reached("resumed");
    } else if (begins(typed, "servos find")) {
        reached("search for servos");
    }
}

void marks_printed(const char *line)
{
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        if (strstr(line, texts[i].text) != NULL) {
            reached(texts[i].place);
        }
    }
    if (session.typed_count > 2 && (begins(line, "Page ") || begins(line, "Playing page "))) {
        reached("status line over a typed one");
    }
    if (begins(line, "Going to")) {
        play_over();
        marks.approach = true;
    } else if (begins(line, "Playing page")) {
        marks.approach = false;
        marks.playing = true;
    } else if (begins(line, "Paused")) {
        marks.paused = true;
        reached(marks.approach ? "paused on the way" : "paused");
    } else if (begins(line, "Broken off")) {
        reached(marks.paused ? "broken off in a pause" : marks.approach ? "broken off on the way" : "broken off");
        play_over();
    } else if (begins(line, "Ended") || begins(line, "Stopped") || begins(line, "The pose")) {
        play_over();
    } else if (strstr(line, "does not answer") != NULL) {
        servo_lost();
    } else if (strstr(line, "adapter is gone") != NULL) {
        reached(marks.layer ? "adapter gone in a layer" : marks.playing ? "adapter gone in a play" : "adapter gone");
        play_over();
    } else if (strstr(line, " OK") != NULL && marks.last[0] != '\0') {
        answered(marks.last);
        marks.last[0] = '\0';
    }
}

void marks_said(const char *sentence)
{
    if (strstr(sentence, "it is complete now") != NULL) {
        reached("save completed at the start");
    }
}

static void stop_asked(const char *how)
{
    if (marks.playing && !marks.stopping) {
        reached(how);
    }
    if (marks.stopping) {
        reached("stopped twice");
    }
    marks.stopping = marks.playing;
}

void marks_typed(const char *line)
{
    snprintf(marks.last, sizeof marks.last, "%s", line);
    if (strcmp(line, "stop") == 0 || strcmp(line, "@stop") == 0) {
        stop_asked(marks.layer ? "stop typed in a layer" : "stop typed");
    } else if (begins(line, "settings ") && marks.playing) {
        reached("setting changed during play");
    } else if (begins(line, "@save")) {
        reached("page saved by a program");
    } else if (session.is_edit && (strcmp(line, "save") == 0 || begins(line, "save "))) {
        reached("page saved by hand");
    } else if (session.is_edit && strcmp(line, "undo") == 0) {
        reached("undo");
    } else if (session.is_edit && begins(line, "play")) {
        reached("play in Edit");
    }
}

void marks_remote(unsigned buttons)
{
    if (buttons & 512u) {
        stop_asked("stop by the remote");
    } else if (buttons != 0 && buttons < 256) {
        reached(marks.playing ? "code during a play" : "code at rest");
    }
}

void marks_cut(const char *where)
{
    reached(where);
    if (marks.stopping) {
        reached("power cut during stop");
    } else if (marks.playing) {
        reached("power cut during play");
    }
}

void marks_boot(void)
{
    play_over();
    marks.aim = false;
    marks.last[0] = '\0';
}

void marks_print(void)
{
    for (unsigned i = 0; i < marks.places; i++) {
        printf("mark %u %s\n", marks.count[i], marks.place[i]);
    }
}
