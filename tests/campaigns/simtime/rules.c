/* SPDX-License-Identifier: MIT
 * rules.c - what must hold at every tick in any case: goals, torque, text, pages, settings, reports about servos. */
#include "session.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "linker/memory_map.h"

#define POSITIONS 1024u
#define RESET (4u * SECOND)        /* the steps that lead back after `shape reset`: from shaped positions in unshaped time */
#define STEP_MAX 19                /* units per tick: the mean of a shaped step is 8.7 at 11.1 V, its peak twice that */
#define START_MAX 24               /* units from a joint's position to its first goal: a holding servo yields so far */
#define FOLLOWS 20                 /* units from its goal: it holds, or follows by three ticks */
#define FORGOTTEN (4u * SECOND)    /* asking 18 servos before a play takes less */
#define SLOW_PAUSE (20u * SECOND)  /* a page's pause has no goals: 2 s at most, ten times as long at `rate 10` */
#define NEWS (6u * SECOND)         /* a servo that became silent is reported by then */
#define QUIET SECOND               /* longer than a request to a silent servo; meanwhile nothing is printed */
#define PROMPT_BACK (8u * SECOND)
#define SEARCHED (60u * SECOND)    /* the search waits at each ID for a port that has answered late */
#define LINE_WAY 20u               /* ticks from a typed line to its first packet */
#define LAST_FRAME 2u              /* ticks */
#define SETTLED 64u                /* ticks without a write: a save is over */
#define STEPS_AT 20u

static struct {
    uint8_t page[0x20000];         /* the pages after the last completed save */
    uint32_t write_tick;
    uint32_t silent_tick[IDS];     /* when it was reported silent: no goals until it is requested */
    uint32_t off_tick[IDS];
    uint32_t ended_tick;           /* a play was reported over; its last frame may follow; NEVER_TICK: none */
    unsigned ended_page;
    uint32_t over_tick;            /* the last report that a play is over */
    uint32_t deaf_tick;            /* the last time that a servo was deaf and silent */
    bool is_slow;                  /* a rate may be in force since the last start: longer pauses (SHAPING.md) */
    uint32_t reset_tick;           /* the last `shape reset` */
    bool is_shaped;                /* since the last start something other than the pages may decide where joints go */
    bool is_playing;               /* by the console's reports */
    bool is_starting;              /* the program has not printed yet */
    bool is_searching;             /* `servos find` was typed and its result is not printed yet */
    uint32_t searched_tick;        /* its result was printed */
    bool searches_again;           /* it was typed once more meanwhile */
    bool asked_in_search;          /* a request waits for the end of the search */
    bool pages_are_edited;
    bool is_first_frame;           /* no frame of goals has come for a second */
    bool checks_pages;
} rules;

/* ---- requests ---- */

static bool may_move(const char *line)
{
    static const char *const words[] = {"play", "p", "on", "aim", "swing", "layer", "resume", "code", "free",
                                        "move", "torque", "drive"};   /* at its end is a stop, which ends a pause */
    char word[16] = "";
    line += *line == '@' ? 1 : 0;
    (void)sscanf(line, "%15[^ ,.:;]", word);
    if (rules.is_playing && (strcmp(word, "stop") == 0 || strcmp(word, "s") == 0)) {
        return true;   /* it ends a pause, and the play goes on to its exit page */
    }
    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++) {
        if (strcmp(word, words[i]) == 0) {
            return true;
        }
    }
    return false;
}

/* Returns whether something other than the pages may decide where joints go after this line. */
static bool may_shape(const char *line)
{
    static const char *const words[] = {"amplitude", "blend", "drive", "layer", "aim", "swing", "settings", "remote"};
    line += *line == '@' ? 1 : 0;
    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++) {
        if (strncmp(line, words[i], strlen(words[i])) == 0) {
            return true;
        }
    }
    return false;
}

/* Returns whether steps and pauses may take longer after this line. */
static bool may_slow(const char *line)
{
    line += *line == '@' ? 1 : 0;
    return strncmp(line, "rate", 4) == 0 || strncmp(line, "drive", 5) == 0;
}

/* Something that may move was asked for. During a search it waits for the end of it. */
void rules_asked(void)
{
    session.asked_tick = session.tick;
    rules.asked_in_search = rules.asked_in_search || rules.is_searching;
}

/* Case does not matter, and there are five separators, also several in a row (edit/ORIGINAL.md section 5). The models
 * get small letters and single blanks. With an @ the blanks stay: a request is one only at the start of a line. */
static void line_typed(void)
{
    char line[LINE_BYTES];
    unsigned count = 0;
    bool has_capitals = false;
    session.typed[session.typed_count] = '\0';
    const bool keeps_blanks = strchr(session.typed, '@') != NULL;
    for (const char *from = session.typed; *from != '\0'; from++) {
        const char small = (char)tolower((unsigned char)*from);
        has_capitals = has_capitals || small != *from;
        if (keeps_blanks || strchr(" ,.:;", small) == NULL) {
            line[count++] = small;
        } else if (count > 0 && line[count - 1] != ' ') {
            line[count++] = ' ';
        }
    }
    count -= count > 0 && !keeps_blanks && line[count - 1] == ' ' ? 1 : 0;
    line[count] = '\0';
    if (has_capitals) {
        reached("words in capitals");
    }
    rules.is_shaped = rules.is_shaped || !session.typed_is_known || may_shape(line);
    rules.reset_tick = strstr(line, "shape reset") != NULL ? session.tick : rules.reset_tick;
    rules.is_slow = rules.is_slow || !session.typed_is_known || may_slow(line);
    if (session.is_edit || !session.typed_is_known || may_move(line)) {
        rules_asked();
    }
    if (session.is_edit && (!session.typed_is_known || strstr(line, "sav") != NULL)) {
        session.save_asked_tick = session.tick;
    }
    const bool searches = !session.is_edit && session.typed_is_known && strcmp(line, "servos find") == 0;
    rules.searches_again = rules.searches_again || (rules.is_searching && searches);
    rules.is_searching = rules.is_searching || searches;
    marks_typed(line);
    answers_typed(line);
    if (!session.is_edit) {
        rest_typed(line);
        law_typed(line);
        stops_typed(line);
        joins_typed(line);
        calls_typed(line);
        slopes_typed(line);
        kept_typed(line);
        views_typed(line);
    } else {
        editor_line(line);
        editor_play_line(line);
    }
    session.typed_count = 0;
    session.typed_is_known = true;
}

/* The program has read a byte from the user. */
void rules_typed(uint8_t byte)
{
    session.typed_tick = session.tick;
    if (session.is_edit) {
        rest_may_end();
        editor_typed(byte);
        editor_play_key(byte);
        if ((byte == ' ' || byte == 0x03) && session.tick - session.frame_tick <= LAST_FRAME) {
            rest_break();
            reached("play in Edit broken off");
        }
        session.asked_tick = session.tick;   /* a key may move a joint */
    }
    if (byte == '\r') {
        line_typed();
    } else if (byte == '\b' && session.typed_count > 0) {
        session.typed_count--;
    } else if (byte == 0x15) {
        session.typed_count = 0;
    } else if (byte >= ' ' && byte < 0x7F && session.typed_count < LINE_BYTES - 1) {
        session.typed[session.typed_count++] = (char)byte;
    } else if (byte != '\b') {
        session.typed_is_known = false;
    }
}

void rules_remote(unsigned buttons)
{
    rules.is_shaped = rules.is_shaped || buttons != 0;   /* left and right may steer */
    if (buttons != 0) {
        rules_asked();
    }
    law_remote(buttons);
    rest_remote(buttons);
    presses_remote(buttons);
    stops_pressed();
    joins_pressed();
}

/* ---- goals and torque ---- */

/* A fault for a number of answers ends by itself, possibly long after it was set. */
static void note_faults(void)
{
    for (unsigned id = 0; id < JOINTS; id++) {
        joint_t *joint = &session.joint[id];
        for (unsigned fault = 0; fault < SERVO_FAULTS && joint->servo != NULL; fault++) {
            if (servo_fault_is_on(joint->servo, (servo_fault_t)fault)) {
                joint->fault_tick = session.tick;
            }
        }
    }
}

bool rules_has_fault(const joint_t *joint)
{
    return !long_ago(joint->fault_tick, TROUBLE);
}

bool rules_is_searching(void)
{
    return rules.is_searching || !long_ago(rules.searched_tick, SECOND);
}

bool rules_is_well(void)
{
    for (unsigned id = 0; id < JOINTS; id++) {
        if (session.joint[id].servo != NULL && rules_has_fault(&session.joint[id])) {
            return false;
        }
    }
    return long_ago(session.trouble_tick, TROUBLE);
}

static void must_be_asked(uint8_t id, const char *what)
{
    const uint32_t last = session.asked_tick > session.goals_tick ? session.asked_tick : session.goals_tick;
    const uint32_t most = rules.is_slow && rules.over_tick < session.asked_tick ? SLOW_PAUSE : FORGOTTEN;
    if (session.asked_tick == NEVER_TICK || session.asked_tick < session.boot_tick || long_ago(last, most)) {
        session_fail("nothing moves unasked", "%s to servo %u", what, id);
    }
}

/* A late answer of one servo collides with those of others. */
bool rules_somebody_is_late(void)
{
    for (unsigned id = 0; id < JOINTS; id++) {
        const joint_t *joint = &session.joint[id];
        if (joint->servo != NULL &&
            (servo_fault_is_on(joint->servo, SERVO_FAULT_LATE) || !long_ago(joint->late_tick, TROUBLE))) {
            return true;
        }
    }
    return false;
}

static void must_not_be_out(uint8_t id)
{
    if (rules.off_tick[id] != NEVER_TICK && session.asked_tick + LINE_WAY < rules.off_tick[id]) {
        session_fail("a joint that was let go stays so", "a goal to servo %u", id);
    }
    const uint32_t silent = rules.silent_tick[id];
    /* The REG WRITEs of a tick go on while a late servo holds the bus. */
    const uint32_t most = session.joint[id].is_deaf && rules_somebody_is_late() ? SECOND : 2;
    if (silent != NEVER_TICK && session.asked_tick < silent && long_ago(silent, most)) {
        session_fail("a lost joint is not driven", "a goal to servo %u", id);
    }
}

/* True if nothing was requested since the joint's last goal. A page that the user has edited may then demand any
   speed. */
static bool goes_on_behind_a_pause(const joint_t *joint)
{
    return joint->goal_tick > session.boot_tick && session.asked_tick < joint->goal_tick;
}

/* A motion begins where the joint is, or goes on from the goal that was written to it a moment ago (servo_link_engage; the
 * pause of a page). */
static void must_begin_there(uint8_t id, uint16_t goal)
{
    const joint_t *joint = &session.joint[id];
    const int is = (int)joint->servo->position;
    const bool has_goal = joint->goal_tick > session.boot_tick && session.tick - joint->goal_tick <= SECOND;
    if (!long_ago(joint->pushed_tick, 2 * SECOND) || rules_has_fault(joint) || !long_ago(session.trouble_tick, TROUBLE) ||
        (has_goal && session.has_deaf) || (rules.pages_are_edited && !session.is_edit && goes_on_behind_a_pause(joint))) {
        return;
    }
    reached(to_page(id, is) == is - trim_of(id) ? "motion begins" : "motion begins outside the trimmed range");
    if (abs(goal - is) > START_MAX && (!has_goal || abs(goal - joint->goal) > START_MAX)) {
        session_fail("a motion begins where the joint is", "servo %u stands at %d, its first goal is %u", id, is, goal);
    }
}

static void must_not_leap(uint8_t id, uint16_t goal)
{
    const joint_t *joint = &session.joint[id];
    const uint32_t since = session.tick - joint->goal_tick;
    const int is = (int)joint->servo->position;
    /* A joint that could not follow begins where it is, just after its old goal was written back (servo_link_engage). */
    const bool could_follow = abs(joint->goal - is) <= FOLLOWS && long_ago(joint->pushed_tick, SECOND);
    const bool begins_anew = !could_follow && abs(goal - is) <= START_MAX;
    if (joint->goal_tick <= session.boot_tick || since > 2) {
        must_begin_there(id, goal);
    } else if (!begins_anew && long_ago(session.late_tick, SECOND)) {
        const int fastest = long_ago(rules.reset_tick, RESET) ? STEP_MAX : STEP_MAX * 3 / 2;
        const int most = fastest * (int)(since == 0 ? 1 : since);
        /* A tick's REG WRITEs take several ticks. */
        const bool waits = session.has_deaf && (session.latency != 0 || rules_somebody_is_late());
        if (!rules.pages_are_edited && !waits && abs(goal - joint->goal) > most) {
            session_fail("no goal leaps", "servo %u from %u to %u within %u ticks", id, joint->goal, goal, since);
        }
    }
}

static void take_goal(uint8_t id, uint16_t goal)
{
    if (id >= IDS || session.joint[id].servo == NULL) {
        session_fail("goals go to servos that are there", "a goal to servo %u", id);
    }
    if (goal >= POSITIONS) {
        session_fail("goals are within 0..1023", "%u to servo %u", goal, id);
    }
    must_be_asked(id, "a goal");
    must_not_be_out(id);
    rest_goal(id, goal);
    if (!session.is_edit) {
        must_not_leap(id, goal);
        joins_goal(id, goal);
    } else if (rules.is_first_frame) {   /* Edit moves joints at its own speed and plays random pages */
        must_begin_there(id, goal);
    }
    session.joint[id].goal = goal;
    session.joint[id].goal_tick = session.tick;
}

static void take_torque(uint8_t id, uint8_t on)
{
    if (id >= IDS && id != SERVO_BROADCAST) {
        return;
    }
    if (on) {
        must_be_asked(id, "torque on");
    }
    for (unsigned each = 0; each < IDS; each++) {
        if (id == SERVO_BROADCAST || each == id) {
            rules.off_tick[each] = on ? NEVER_TICK : session.tick;
        }
    }
}

/* Checks a write of `count` bytes to a servo's table from `address` on. */
static void take_write(uint8_t id, uint8_t address, const uint8_t *bytes, unsigned count)
{
    if (address < TORQUE_AT && !session.is_edit) {
        session_fail("a servo's own settings are not touched", "a write to %u of servo %u", address, id);
    }
    if (address <= TORQUE_AT && address + count > TORQUE_AT) {
        take_torque(id, bytes[TORQUE_AT - address]);
    }
    if (address <= GOAL_AT && address + count > GOAL_AT + 1u && id != SERVO_BROADCAST) {
        take_goal(id, (uint16_t)(bytes[GOAL_AT - address] | bytes[GOAL_AT + 1u - address] << 8));
    }
}

void rules_packet(const uint8_t *packet, uint16_t count)
{
    const uint8_t *params = packet + 5;
    const unsigned given = count - 6u;
    bool goals = false;
    rules.is_first_frame = false;
    if (packet[4] == INST_SYNC_WRITE) {
        goals = params[0] <= GOAL_AT && params[0] + params[1] > GOAL_AT;
        rules.is_first_frame = goals && long_ago(session.frame_tick, SECOND);
        session.frame_tick = goals ? session.tick : session.frame_tick;
        for (unsigned at = 2; at + params[1] < given; at += params[1] + 1u) {
            take_write(params[at], params[0], params + at + 1, params[1]);
        }
        if (params[0] == GOAL_AT && !session.is_edit && !session.has_deaf) {
            law_frame(params + 2, given - 2u, params[1]);
        }
    } else if ((packet[4] == INST_WRITE || packet[4] == INST_REG_WRITE) && given >= 2) {
        take_write(packet[2], params[0], params + 1, given - 1u);
        goals = params[0] <= GOAL_AT && params[0] + given - 1u > GOAL_AT;
    }
    if (packet[4] == INST_ACTION && session.has_deaf) {
        reached("goals by ACTION");
    }
    if (goals) {
        session.goals_tick = session.tick;
    }
}

/* ---- reports about servos ---- */

static void named_silent(unsigned id)
{
    joint_t *joint = id < IDS ? &session.joint[id] : NULL;
    if (joint == NULL || joint->servo == NULL) {
        session_fail("only servos that are there are news", "servo %u", id);
    }
    if (!rules_has_fault(joint) && !rules_somebody_is_late() && long_ago(session.trouble_tick, TROUBLE)) {
        session_fail("a servo that is well is not called lost", "servo %u", id);
    }
    joint->named_silent = true;
    rules.silent_tick[id] = session.tick;
}

/* Handles "No answer: ID 3, 5-7", the answer to a user's request. */
static void silent_ones_named(const char *list)
{
    unsigned first, last;
    for (int length; sscanf(list, "%u%n", &first, &length) == 1;) {
        list += length;
        last = first;
        if (sscanf(list, "-%u%n", &last, &length) == 1) {
            list += length;
        }
        for (; first <= last && first < JOINTS; first++) {
            session.joint[first].named_silent = true;
        }
        list += strspn(list, ", ");
    }
}

/* Servos that were well during the search become known. has_searched: the program has asked every ID; otherwise it
 * lists the servos it already knew. */
static void servos_are_listed(bool has_searched)
{
    for (unsigned id = 0; id < JOINTS; id++) {
        joint_t *joint = &session.joint[id];
        joint->is_known = (has_searched || joint->is_known) && joint->servo != NULL && !rules_has_fault(joint) &&
                          long_ago(session.trouble_tick, TROUBLE);
    }
}

/* Called when a play is over. Joints that it has moved must be at the last step of its last page. */
static void pose_must_be_there(unsigned page)
{
    const uint8_t *at = page_at(page);
    const unsigned steps = at[STEPS_AT];
    const bool is_plain = !rules.is_shaped && law_is_exact() && !session.is_edit && !session.has_deaf;
    if (!is_plain || page >= simtime_bytes(MACHINE_PAGES) / PAGE_BYTES || steps == 0 || steps > 7) {
        return;
    }
    for (unsigned id = 0; id < JOINTS; id++) {
        const uint8_t *word = at + STEP_BYTES * steps + 2 * id;   /* the steps follow a header of the same length */
        const unsigned to = word[0] | (unsigned)word[1] << 8;
        const joint_t *joint = &session.joint[id];
        if (joint->goal_tick != session.frame_tick || to >= POSITIONS || rules_has_fault(joint)) {
            continue;
        }
        reached("play ended where its page says");
        if (joint->goal != limited((int)to + trim_of(id))) {
            session_fail("a play ends in the pose of its page", "servo %u at %u, page %u says %u", id, joint->goal, page,
                         to);
        }
    }
}

void rules_printed(const char *line)
{
    static const char *const begun[] = {"Going to", "Moving, ", "Playing page", "Paused"};
    static const char *const over[] = {"Ended", "Stopped", "Broken off", "The pose"};
    unsigned id;
    int at = 0;
    for (unsigned i = 0; i < 4; i++) {
        rules.over_tick = strncmp(line, over[i], strlen(over[i])) == 0 ? session.tick : rules.over_tick;
        rules.is_playing = (rules.is_playing && strncmp(line, over[i], strlen(over[i])) != 0) ||
                           strncmp(line, begun[i], strlen(begun[i])) == 0;
    }
    if (sscanf(line, "Ended after page %u", &id) == 1) {
        rules.ended_page = id;
        rules.ended_tick = session.tick;
    }
    answers_printed(line);
    if (session.is_edit && line[0] == '@') {
        screen_put_away();   /* its line may have been typed before the table was painted */
    }
    if (!session.is_edit) {
        law_printed(line);
        rest_printed(line);
        presses_printed(line);
        stops_printed(line);
        joins_printed(line);
        calls_printed(line);
        slopes_printed(line);
        kept_printed(line);
        views_printed(line);
    }
    if (strncmp(line, "Busy", 4) == 0) {
        rules.is_searching = rules.searches_again = false;   /* refused */
    }
    if (strstr(line, " servos: ") != NULL || strncmp(line, "1 servo: ", 9) == 0) {
        servos_are_listed(rules.is_searching);
        rules.searched_tick = rules.is_searching ? session.tick : rules.searched_tick;
        rules.is_searching = rules.searches_again;
        rules.searches_again = false;
        session.asked_tick = rules.asked_in_search ? session.tick : session.asked_tick;
        rules.asked_in_search = rules.asked_in_search && rules.is_searching;
    }
    if (strncmp(line, "No answer: ID ", 14) == 0) {
        silent_ones_named(line + 14);
    } else if (strncmp(line, "Not obeyed: ID ", 15) == 0) {   /* silent ones as well */
        silent_ones_named(line + 15);
    }
    if (sscanf(line, "Servo %u does not answer%n", &id, &at) == 1 && at > 0) {
        named_silent(id);
    } else if (sscanf(line, "Servo %u answers again%n", &id, &at) == 1 && at > 0 && id < IDS) {
        session.joint[id].named_silent = false;
    }
}

/* ---- the user's text ---- */

static void text_must_stand(void)
{
    if (session.is_edit || !session.typed_is_known || !simtime_has_typed() || !long_ago(session.late_tick, SECOND)) {
        return;
    }
    const uint32_t last = session.typed_tick > session.printed_tick ? session.typed_tick : session.printed_tick;
    const bool has_prompt = strncmp(session.line, "] ", 2) == 0;
    const uint32_t most = rules.is_searching ? SEARCHED : PROMPT_BACK;
    if (session.tick - last < QUIET || (!has_prompt && session.tick - last < most)) {
        return;
    }
    session.typed[session.typed_count] = '\0';
    char shown[LINE_BYTES];
    snprintf(shown, sizeof shown, "%s", session.line);
    for (size_t end = strlen(shown); end > 2u + session.typed_count && shown[end - 1] == ' '; end--) {
        shown[end - 1] = '\0';
    }
    if (!has_prompt || strcmp(shown + 2, session.typed) != 0) {
        session_fail("typed text is untouched", "typed is \"%s\", the line is \"%s\"", session.typed, session.line);
    }
}

/* ---- pages ---- */

/* Every page must be unchanged or valid. */
static void pages_must_be_whole(void)
{
    const uint8_t *now = simtime_memory(MACHINE_PAGES);
    for (unsigned at = 0; at < simtime_bytes(MACHINE_PAGES); at += PAGE_BYTES) {
        if (memcmp(now + at, rules.page + at, PAGE_BYTES) == 0) {
            continue;
        }
        if (sum_of(now + at) != 0xFF) {
            session_fail("a page is old or new", "page %u is a mixture", at / PAGE_BYTES);
        }
        memcpy(rules.page + at, now + at, PAGE_BYTES);
    }
}

void rules_kept(machine_memory_t memory, uint32_t at, const uint8_t *bytes, uint32_t count)
{
    (void)bytes;
    rules.write_tick = session.tick;
    if (memory == MACHINE_EEPROM) {
        kept_write();
        return;
    }
    if (!rules.is_starting && (!session.is_edit || session.save_asked_tick == NEVER_TICK)) {
        session_fail("pages change when somebody saves", "%u bytes at %05x of memory %d", count, at, (int)memory);
    }
    rules.checks_pages = true;
    if (session.is_edit) {
        rules.pages_are_edited = true;
    }
}

void rules_said(const char *sentence)
{
    if (strstr(sentence, "cannot be completed") != NULL) {
        session_fail("a page is old or new", "\"%s\"", sentence);
    }
}

/* ---- time ---- */

void rules_boot(void)
{
    law_boot();
    screen_boot();
    editor_boot();
    answers_boot();
    calls_boot();
    views_boot();
    rest_boot();
    presses_boot();
    stops_boot();
    joins_boot();
    slopes_boot();
    kept_boot();
    editor_play_boot();
    rules.is_starting = true;
    rules.is_searching = true;
    rules.searches_again = rules.asked_in_search = false;
    rules.is_playing = rules.is_shaped = rules.is_slow = false;
    rules.ended_tick = NEVER_TICK;
    memset(rules.silent_tick, 0, sizeof rules.silent_tick);
    memset(rules.off_tick, 0, sizeof rules.off_tick);
    memset(session.line, 0, sizeof session.line);
    session.column = 0;
    session.typed_count = 0;
    session.typed_is_known = true;
    session.asked_tick = session.save_asked_tick = NEVER_TICK;
    session.typed_tick = session.printed_tick = session.tick;
    for (unsigned id = 0; id < IDS; id++) {
        session.joint[id].named_silent = false;
        session.joint[id].goal_tick = NEVER_TICK;
    }
    if (session.boots == 0) {
        memcpy(rules.page, simtime_memory(MACHINE_PAGES), sizeof rules.page);
    }
}

/* Called at each output. At the first one, interrupted saves must have been completed. */
void rules_started(void)
{
    if (rules.is_starting) {
        rules.is_starting = false;
        pages_must_be_whole();
        kept_started();
        servos_are_listed(true);
    }
}

/* On a PC, a servo that is deaf and silent delays the reports of faults until the motion ends (hal/host/README.md). */
static bool has_silent_deaf(void)
{
    for (unsigned id = 0; id < JOINTS; id++) {
        if (session.joint[id].is_deaf && session.joint[id].silent_since != NEVER_TICK) {
            return true;
        }
    }
    return false;
}

static void servos_must_be_named(void)
{
    rules.deaf_tick = has_silent_deaf() ? session.tick : rules.deaf_tick;
    if (session.is_edit || !long_ago(rules.deaf_tick, NEWS) || !long_ago(session.boot_tick, TROUBLE)) {
        return;
    }
    for (unsigned id = 0; id < JOINTS; id++) {
        const joint_t *joint = &session.joint[id];
        if (joint->is_known && joint->silent_since != NEVER_TICK && joint->silent_since > session.boot_tick + TROUBLE &&
            long_ago(joint->silent_since, NEWS) && !joint->named_silent && long_ago(session.trouble_tick, NEWS)) {
            session_fail("a silent servo is named", "servo %u is silent since tick %u", id, joint->silent_since);
        }
    }
}

void rules_tick(void)
{
    note_faults();
    text_must_stand();
    if (!session.has_deaf) {
        law_tick();
    }
    editor_tick();
    editor_play_tick();
    screen_tick();
    if (rules.ended_tick != NEVER_TICK && session.tick - rules.ended_tick > LAST_FRAME) {
        rules.ended_tick = NEVER_TICK;
        pose_must_be_there(rules.ended_page);
    }
    answers_tick();
    views_tick();
    presses_tick();
    slopes_tick();
    kept_tick();
    if (session.tick % 32 == 0) {
        servos_must_be_named();
        if (rules.checks_pages && long_ago(rules.write_tick, SETTLED) && !rules.is_starting) {
            rules.checks_pages = false;
            pages_must_be_whole();
        }
    }
}

void rules_end(void)
{
    pages_must_be_whole();
}
