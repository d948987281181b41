/* SPDX-License-Identifier: MIT
 * law.c - the next step of a play, the speed of an approach, where aims and swings go: motion/LAWS.md 2 and
 * PAGE_FORMAT.md, from the stored pages and the lines that name the steps. Goals within a step are tests/unit's
 * (test_player_exact.c). */
#include "session.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define KEPT 64u                   /* ticks */
#define LAST_COMES 20u             /* ticks after the report that a play is over; nothing moves any more */
#define DEGREES (1023.0 / 300.0)
#define NEAR_TICKS 64u             /* a code this close to the start of a step may or may not count */
#define ANY_CODE 0xFFFFu
#define SILENT 60u                 /* ticks without a packet: the buttons may count as released */
#define AT_ONCE 16u                /* ticks: lines that have waited are read together */
#define SLOWEST 30u                /* degrees/s, in the random settings */

enum { COUNT_AT = 15, STEPS_AT = 20, NEXT_AT = 25, EXIT_AT = 26, LINK1_AT = 27, LINK2_AT = 29 };

typedef struct {
    unsigned page, number, repetition;
} place_t;

static struct {
    int16_t now[JOINTS];           /* without trim; a joint may come from outside 0..1023 */
    int16_t goal[KEPT][JOINTS];    /* at the end of each tick */
    uint32_t now_tick[JOINTS];
    int twice[JOINTS];             /* a late tick sends two goals: the first of the last such pair */
    uint32_t ticks;
    uint32_t present;              /* joints of the last frame, one bit each */
    place_t last;
    uint32_t ended_tick;           /* when the play was reported over; NEVER_TICK: not yet */
    bool knows_place;
    bool is_judged;                /* only the pages decide about this play */
    bool is_called, is_stopped;    /* a code, a stop since the play was requested */
    bool is_shaped, is_classic, is_quiet, has_modes;       /* by typed lines of this session, or since the start */
    bool was_classic, was_quiet;   /* ever: after a power cut the old setting may be back */
    bool is_aimed;
    uint32_t approach_tick;        /* the first frame of an approach; NEVER_TICK: none */
    unsigned buttons;              /* by the newest packet, or at the panel */
    uint32_t buttons_tick;
    unsigned code, code_before;    /* in force now, and before the last change; ANY_CODE: not known */
    uint32_t code_tick, code_before_tick;   /* when they came into force */
    uint32_t step_tick, step_before_tick;   /* when the newest step and the one before were named */
    bool is_under_way;             /* from the approach to the end */
    bool was_paused;               /* since its start; then joints moved by code rest as well */
    double approach;               /* degrees/s, the highest value ever set */
    struct {
        uint32_t due;              /* the tick at which it must have arrived; NEVER_TICK: none */
        uint32_t period;           /* ticks of a swing from then on; an aim: 0 */
        unsigned to, amplitude, lowest, highest;
    } aim[JOINTS];
    char asked[LINE_BYTES];        /* the newest line, until it is answered */
    uint32_t asked_tick;
    bool is_mixed;                 /* typed before the last line was answered: unclear whose answer comes next */
} law;

static bool begins(const char *line, const char *word)
{
    const size_t length = strlen(word);
    return strncmp(line, word, length) == 0 && (line[length] == '\0' || line[length] == ' ');
}

static bool is_one_of(const char *line, const char *const *words)
{
    line += *line == '@' ? 1 : 0;
    for (; *words != NULL; words++) {
        if (begins(line, *words)) {
            return true;
        }
    }
    return false;
}

static void forget_aims(void)
{
    memset(law.aim, 0, sizeof law.aim);
}

static void judge_no_more(void)
{
    law.is_judged = law.knows_place = false;
    law.ended_tick = NEVER_TICK;
}

/* ---- the next step ---- */

/* Returns the page that plays; 0: the end. Pages without repetitions are passed over. */
static unsigned resolved(unsigned page)
{
    for (unsigned i = 0; i < PAGES && page != 0 && page_at(page)[COUNT_AT] == 0; i++) {
        page = page_at(page)[NEXT_AT];
    }
    return page;
}

static void put_code(unsigned code)
{
    if (code != law.code) {
        law.code_before = law.code;
        law.code_before_tick = law.code_tick;
        law.code = code;
        law.code_tick = session.tick;
    }
}

/* Returns the code in force when the newest step began, which is a page's last one. */
static unsigned code_of_step(void)
{
    if (law.code_tick + NEAR_TICKS < law.step_before_tick) {
        return law.code;
    }
    const bool is_later = law.code_tick > law.step_tick + NEAR_TICKS;
    return is_later && law.code_before_tick + NEAR_TICKS < law.step_before_tick ? law.code_before : ANY_CODE;
}

/* Returns whether a page may follow the last step of another one. */
static bool may_follow(place_t last, unsigned next)
{
    const uint8_t *at = page_at(last.page);
    const unsigned code = law.has_modes || law.is_stopped ? ANY_CODE : code_of_step();
    if (code != ANY_CODE && last.repetition == at[COUNT_AT]) {
        const bool is_first = code != 0 && code == at[LINK1_AT + 1], is_second = code != 0 && code == at[LINK2_AT + 1];
        const unsigned link = is_first ? LINK1_AT : is_second ? LINK2_AT : NEXT_AT;
        reached(link == NEXT_AT ? "next page by the code in force" : "linked page by the code in force");
        return next == resolved(at[link]);
    }
    const bool by_exit = law.is_stopped && next == resolved(at[EXIT_AT]);
    const bool by_code = law.is_called && (next == resolved(at[LINK1_AT]) || next == resolved(at[LINK2_AT]));
    return (last.repetition == at[COUNT_AT] || law.is_stopped) && (next == resolved(at[NEXT_AT]) || by_exit || by_code);
}

static void must_come(place_t next)
{
    const place_t last = law.last;
    const uint8_t *at = page_at(last.page);
    bool is_right;
    if (last.number < at[STEPS_AT]) {
        is_right = next.page == last.page && next.number == last.number + 1 && next.repetition == last.repetition;
    } else if (next.repetition > 1) {
        is_right = next.page == last.page && next.number == 1 && next.repetition == last.repetition + 1 &&
                   next.repetition <= at[COUNT_AT];
    } else {
        is_right = next.number == 1 && next.repetition == 1 && may_follow(last, next.page);
    }
    reached("next step as the page says");
    if (!is_right) {
        session_fail("steps come as the pages say", "after page %u step %u repetition %u: page %u step %u repetition %u",
                     last.page, last.number, last.repetition, next.page, next.number, next.repetition);
    }
}

/* A play is over: no page may follow. A chain of exit links that returns to itself also ends. */
static void must_be_over(unsigned page)
{
    const place_t last = law.last;
    if (page != last.page || last.number != page_at(page)[STEPS_AT] || (!law.is_stopped && !may_follow(last, 0))) {
        session_fail("steps come as the pages say", "the end after page %u, page %u step %u repetition %u was the last",
                     page, last.page, last.number, last.repetition);
    }
}

static int goal_at(uint32_t tick, unsigned id)
{
    return law.goal[tick % KEPT][id];
}

static void step_comes(place_t place)
{
    if (law.knows_place) {
        must_come(place);
    }
    law.last = place;
    law.knows_place = true;
    law.step_before_tick = law.step_tick;
    law.step_tick = session.tick;
}

/* ---- events ---- */

/* Handles a frame of goals. */
void law_frame(const uint8_t *ids_and_goals, unsigned count, unsigned bytes_each)
{
    uint32_t present = 0;
    for (unsigned at = 0; at + bytes_each < count; at += bytes_each + 1) {
        const unsigned id = ids_and_goals[at];
        if (id >= JOINTS) {
            continue;
        }
        const int goal = (ids_and_goals[at + 1] | ids_and_goals[at + 2] << 8) - trim_of(id);
        const double most = law.approach * DEGREES / SECOND + 1.01;
        const bool goes_on = law.approach_tick != NEVER_TICK && session.tick > law.approach_tick;
        if (law.is_judged && goes_on && (law.present >> id & 1u) != 0 && abs(goal - law.now[id]) > most) {
            session_fail("an approach keeps to its speed", "servo %u from %d to %d in a tick", id, law.now[id], goal);
        }
        if (law.now_tick[id] == session.tick) {
            law.twice[id] = law.now[id];
        }
        law.now_tick[id] = session.tick;
        law.now[id] = (int16_t)goal;
        present |= 1u << id;
    }
    if (present != law.present && law.knows_place) {
        judge_no_more();
    }
    law.present = present;
    law.approach_tick = law.approach_tick == UINT32_MAX ? session.tick : law.approach_tick;
}

static void play_begins(void)
{
    law.is_judged = !law.is_quiet && rules_is_well();
    law.knows_place = false;
    law.ended_tick = NEVER_TICK;
}

static void take_answer(void)
{
    unsigned id = JOINTS, to = 0, speed = SLOWEST, amplitude = 0, period_ms = 0;
    const bool is_swing = sscanf(law.asked, "swing %u %u %u %u", &id, &to, &amplitude, &period_ms) == 4;
    const bool is_aim = is_swing || sscanf(law.asked, "aim %u %u %u", &id, &to, &speed) >= 2;
    law.was_paused = law.was_paused || begins(law.asked, "pause");   /* "Paused" comes only when all joints rest */
    /* A stopped play also ends the aim. */
    if (is_aim && !law.is_mixed && id < JOINTS && speed > 0 && !law.is_stopped && !law.was_paused) {
        const double is = session.joint[id].servo == NULL ? to : session.joint[id].servo->position - trim_of(id);
        const double way = fabs(is - to) + amplitude + SECOND;
        law.aim[id].due = session.tick + SECOND + (uint32_t)(way / (speed * DEGREES) * SECOND);
        law.aim[id].to = law.aim[id].lowest = law.aim[id].highest = to;
        law.aim[id].amplitude = amplitude;
        law.aim[id].period = period_ms * SECOND / 1000;
    }
    law.asked[0] = '\0';
}

void law_printed(const char *line)
{
    place_t place;
    unsigned page;
    const char *step = strstr(line, " step ");
    if (strncmp(line, "Ended", 5) == 0 || strncmp(line, "Stopped", 7) == 0 || strncmp(line, "Broken", 6) == 0 ||
        strncmp(line, "The pose", 8) == 0) {
        law.is_under_way = law.was_paused = false;
    }
    law.was_paused = law.was_paused || strncmp(line, "Paused", 6) == 0;
    if (strncmp(line, "Going to", 8) == 0 || strncmp(line, "Moving, ", 8) == 0) {
        law.is_under_way = true;
        /* the buttons may have been let go before this line */
        law.is_stopped = law.is_stopped || (law.has_modes && law.is_called && law.buttons == 0);
        law.step_tick = law.step_before_tick = session.tick;
        play_begins();
        law.approach_tick = law.is_aimed ? NEVER_TICK : UINT32_MAX;   /* the next frame; starts where the joints are */
    } else if ((sscanf(line, "Playing page %u", &place.page) == 1 || sscanf(line, "Page %u step", &place.page) == 1) &&
               step != NULL && sscanf(step, " step %u repetition %u", &place.number, &place.repetition) == 2) {
        law.approach_tick = NEVER_TICK;
        if (law.ended_tick != NEVER_TICK) {
            play_begins();   /* without an approach, directly after the end of another play */
        }
        if (law.is_judged) {
            step_comes(place);
        }
    } else if (sscanf(line, "Ended after page %u", &page) == 1 || sscanf(line, "Stopped after page %u", &page) == 1) {
        if (law.is_judged && law.knows_place) {
            must_be_over(page);
            law.ended_tick = session.tick;
        }
        law.knows_place = law.is_called = law.is_stopped = false;
        if (line[0] == 'S') {
            forget_aims();   /* PROTOCOL.md: a stop ends them after the exit page, even if it was not typed */
        }
    } else if (strncmp(line, "Broken", 6) == 0 || strncmp(line, "Ended", 5) == 0 || strncmp(line, "The pose", 8) == 0) {
        judge_no_more();
        law.is_called = law.is_stopped = false;
        if (strncmp(line, "Ended", 5) == 0) {
            forget_aims();   /* a damaged page also ends them */
        }
    } else if (strcmp(line, " OK") == 0) {
        take_answer();
    } else if (strncmp(line, "Nobody drives", 13) == 0) {
        law.is_stopped = true;
        forget_aims();
    } else if (strstr(line, "dropped") != NULL || strstr(line, "Battery") != NULL || strncmp(line, "Servo ", 6) == 0 ||
               strncmp(line, "Paused", 6) == 0) {
        judge_no_more();
    }
}

/* Handles a typed line. Unless it only asks, the pages are no longer the only influence. */
void law_typed(const char *line)
{
    static const char *const asks[] = {"where", "pose", "ver", "version", "crcs", "list", "page", "dense", "help",
                                       "faults", "watch", NULL};
    static const char *const shapes[] = {"rate", "amplitude", "blend", "drive", "layer", "aim", "swing", NULL};
    unsigned number, code;
    /* Of three lines at once the first OK leaves two without an answer. */
    const uint32_t since = session.tick - law.asked_tick;
    const bool is_searching = rules_is_searching();
    law.is_mixed = (law.asked[0] != '\0' && (since < SECOND || is_searching)) ||
                   (law.is_mixed && (since < AT_ONCE || is_searching));
    if (law.is_mixed) {
        forget_aims();   /* either line may send a joint elsewhere, and it is unclear whose OK comes */
    }
    law.asked_tick = session.tick;
    snprintf(law.asked, sizeof law.asked, "%s", line);
    if (line[0] == '\0' || (session.typed_is_known && is_one_of(line, asks))) {
        return;
    }
    law.is_quiet = (law.is_quiet && !begins(line, "settings talk 1")) || begins(line, "settings talk 0");
    const bool is_exact = begins(line, "settings law 0") || begins(line, "law exact");
    law.is_classic = (law.is_classic && !is_exact) || begins(line, "settings law 1") || begins(line, "law classic");
    law.was_quiet = law.was_quiet || law.is_quiet;
    law.was_classic = law.was_classic || law.is_classic;
    law.has_modes = law.has_modes || begins(line, "settings remote");
    if (sscanf(line, "settings approach %u", &number) == 1 || sscanf(line, "@move %u", &number) == 1) {
        law.approach = fmax(law.approach, number);
    }
    if (!session.typed_is_known) {
        law.is_shaped = law.is_quiet = law.is_classic = law.was_quiet = law.was_classic = true;
        law.approach = 1000;
    }
    law.is_shaped = law.is_shaped || is_one_of(line, shapes);
    law.is_aimed = (law.is_aimed || begins(line, "aim") || begins(line, "swing")) && strcmp(line, "free") != 0;
    if (begins(line, "shape reset") && !law.is_under_way && !law.is_aimed) {
        law.is_shaped = false;
    }
    if (!begins(line, "aim") && !begins(line, "swing") && !begins(line, "play")) {
        forget_aims();
    }
    if ((begins(line, "stop") || begins(line, "@stop")) && !law.is_stopped) {
        law.is_stopped = true;
    } else if (begins(line, "play") || begins(line, "@play")) {
        if (!law.is_under_way) {
            put_code(sscanf(line, "%*s %u %u", &number, &code) == 2 ? code : 0);
            law.code_tick = NEVER_TICK;
        }
        law.is_called = law.is_called || strchr(line, ' ') != strrchr(line, ' ');
    } else if (begins(line, "code")) {
        put_code(ANY_CODE);
        law.is_called = true;
        judge_no_more();
    } else {
        judge_no_more();
        law.approach_tick = NEVER_TICK;
    }
}

/* Handles buttons of the remote or the panel: 256 pauses, 512 stops, the others are codes. */
void law_remote(unsigned buttons)
{
    const bool is_stop = is_stop_of(buttons) && (!is_stop_of(law.buttons) || session.tick - law.buttons_tick > SILENT);
    law.buttons = buttons;
    law.buttons_tick = session.tick;
    if (buttons == 0) {
        law.is_stopped = law.is_stopped || (law.has_modes && law.is_under_way);   /* with the setting `remote hold` */
        return;
    }
    put_code(buttons < 255 ? buttons : ANY_CODE);
    forget_aims();
    if (law.has_modes || buttons == 256 || (is_stop && law.is_stopped)) {
        judge_no_more();
        law.approach_tick = NEVER_TICK;
    }
    law.is_called = true;
    law.is_stopped = law.is_stopped || is_stop;
}

void law_boot(void)
{
    judge_no_more();
    law.is_shaped = law.is_called = law.is_stopped = law.is_aimed = false;
    law.is_classic = law.was_classic;
    law.is_quiet = law.was_quiet;
    law.approach_tick = NEVER_TICK;
    law.present = 0;
    law.is_under_way = law.was_paused = false;
    law.code = ANY_CODE;
    law.code_tick = law.code_before_tick = session.tick;
    law.asked[0] = '\0';
    forget_aims();
    for (unsigned id = 0; id < JOINTS; id++) {
        law.twice[id] = UNKNOWN;
    }
    if (session.boots == 0) {
        law.approach = 60;
    }
}

bool law_is_exact(void)
{
    return !law.is_classic;
}

bool law_was_goal(unsigned id, int goal, unsigned ticks)
{
    bool was = limited(law.now[id]) == goal || (law.twice[id] != UNKNOWN && limited(law.twice[id]) == goal);
    for (uint32_t i = 0; i < ticks && !was; i++) {
        was = limited(goal_at(law.ticks - i, id)) == goal;
    }
    return was;
}

/* Gets the last named step. The program may already be in the next one. */
bool law_place(unsigned *page, unsigned *step, unsigned *repetition)
{
    *page = law.last.page;
    *step = law.last.number;
    *repetition = law.last.repetition;
    return law.is_judged && law.knows_place && law.ended_tick == NEVER_TICK;
}

/* The joint must have arrived, or swing about its target. */
static void look_at_aim(unsigned id)
{
    const unsigned is = (unsigned)limited(law.now[id]), to = law.aim[id].to, amplitude = law.aim[id].amplitude;
    law.aim[id].lowest = is < law.aim[id].lowest ? is : law.aim[id].lowest;
    law.aim[id].highest = is > law.aim[id].highest ? is : law.aim[id].highest;
    if (session.tick - law.aim[id].due < law.aim[id].period) {
        return;
    }
    law.aim[id].due = NEVER_TICK;
    reached(law.aim[id].period == 0 ? "aim arrived" : "swing swung");
    const int most = law.aim[id].period == 0 ? 0 : 1;   /* the ticks may miss the peak of a sine */
    const int below = (int)law.aim[id].lowest - (int)(to - amplitude);
    const int above = (int)law.aim[id].highest - (int)(to + amplitude);
    if (abs(below) > most || abs(above) > most) {
        session_fail("aims and swings go where they were sent", "servo %u from %u to %u, asked: %u and %u to both sides",
                     id, law.aim[id].lowest, law.aim[id].highest, to, amplitude);
    }
}

/* Records the goals of this tick and checks ended plays and due aims. */
void law_tick(void)
{
    law.ticks++;
    memcpy(law.goal[law.ticks % KEPT], law.now, sizeof law.now);
    if (law.ended_tick != NEVER_TICK && session.tick > law.ended_tick + LAST_COMES) {
        judge_no_more();
    }
    for (unsigned id = 0; id < JOINTS; id++) {
        if (law.aim[id].due == NEVER_TICK) {
            continue;
        }
        if (!rules_is_well()) {
            law.aim[id].due = NEVER_TICK;
        } else if (session.tick >= law.aim[id].due) {
            look_at_aim(id);
        }
    }
}
