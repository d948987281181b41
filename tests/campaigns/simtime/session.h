/* SPDX-License-Identifier: MIT
 * session.h - one session of Play or Edit in simulated time: how its files see each other.
 *
 *   main.c      reads the list of actions, runs the programs, says how it went
 *   world.c     the servos and the line; carries actions out
 *   rules.c     what must be so at every tick
 *   law.c       the exact law: every goal of a play that nothing shapes
 *   rest.c      what must rest: after a break, in a pause
 *   presses.c   which buttons are a press
 *   calls.c     what a play begins with
 *   slopes.c    how soft joints are that a play moves
 *   kept.c      settings in EEPROM
 *   answers.c   what requests are answered
 *   views.c     what lists show
 *   replies.c   the whole of what Play answers
 *   handed.c    when packets are handed to the bus
 *   screen.c    a terminal for Edit, and its table as it is shown
 *   table.c     such tables, from flash and compared
 *   editor*.c   a second model of Edit: what lines and keys do to its table, and to a play
 *   facts.c     pages as bytes, as PAGE_FORMAT.md has them; nothing of the firmware's
 *   marks.c     places that a campaign must have reached
 *
 * Rules and marks see what an outsider sees: the bus, the console, the memories. */
#ifndef SESSION_H
#define SESSION_H

#include <stdbool.h>
#include <stdint.h>

#include "hal/host/simtime/simtime.h"
#include "servo_bus.h"

#define IDS 254u
#define JOINTS 31u
#define LINE_BYTES 1200u           /* a page in hexadecimal */
#define SECOND 128u                /* ticks */
#define NEVER_TICK 0u
#define TROUBLE (6u * SECOND)      /* what the line and servos have done is past */
#define PAGES 256u
#define PAGE_BYTES 512u
#define STEP_BYTES 64u
#define TORQUE_AT 24u              /* registers of a servo */
#define GOAL_AT 30u

enum { INST_WRITE = 3, INST_REG_WRITE = 4, INST_ACTION = 5, INST_SYNC_WRITE = 0x83 };

/* What is known of one servo. */
typedef struct {
    servo_t *servo;
    uint32_t fault_tick;           /* the last time that a fault of it began, was there or ended */
    uint32_t late_tick;            /* the last time that its answers began or ceased to come late */
    uint32_t silent_since;         /* nothing that it says can be understood; NEVER_TICK: it is well */
    uint32_t pushed_tick;
    uint32_t goal_tick;            /* the last goal */
    uint16_t goal;
    bool is_deaf;                  /* to SYNC WRITE */
    bool is_known;                 /* the program has found it */
    bool named_silent;             /* what the person read last */
} joint_t;

/* One session. */
typedef struct {
    bool is_edit;
    bool is_over;
    bool has_deaf;                 /* a servo takes no notice of SYNC WRITE: goals come one after the other, and late */
    bool shows;                    /* console and bus, as they come */
    uint32_t tick;
    uint64_t random;
    servo_bus_t *bus;
    joint_t joint[IDS];
    uint32_t trouble_tick;         /* the last time that the line, the adapter or the computer failed */
    uint32_t late_tick;            /* the last time that the computer was late or the adapter gone */
    uint32_t pushed_tick;          /* the last time that a hand turned a joint */
    uint32_t goals_tick;           /* the last goals of any joint */
    uint32_t frame_tick;           /* the last goals of a tick, to all joints at once */
    uint32_t boot_tick;
    uint32_t boots;
    uint32_t writes;               /* of memory, so far */
    uint32_t cut_at_write;         /* the power is cut at this one; 0: at none */
    bool cut_now;
    uint32_t latency;              /* of the adapter, half microseconds */
    uint32_t typed_tick;           /* the last byte came from the person or the remote */
    uint32_t printed_tick;
    uint32_t asked_tick;           /* the last time that somebody asked for what may move since the last start */
    uint32_t save_asked_tick;      /* the same for a save of a page */
    char line[LINE_BYTES];         /* what the console shows in its newest line */
    uint16_t column;
    char typed[LINE_BYTES];        /* what the person has typed since the last line end */
    uint16_t typed_count;
    bool typed_is_known;           /* only letters and backspaces since then */
} session_t;

extern session_t session;

static inline bool long_ago(uint32_t tick, uint32_t most)
{
    return tick == NEVER_TICK || session.tick - tick > most;
}

/* main.c */
_Noreturn void session_fail(const char *rule, const char *format, ...) __attribute__((format(printf, 2, 3)));
uint32_t session_random(void);

/* world.c */
extern const simtime_callbacks_t world_callbacks;
void world_init(void);
void world_free(void);
void world_add_servo(unsigned id);
/* One action by its words. false: no such action, or not like this. */
bool world_do(char *words);
void world_power(bool on);
void world_forget_line(void);   /* what is still under way on the console is lost */

/* facts.c */
const uint8_t *page_at(unsigned page);   /* in flash; PAGE_BYTES. Numbers wrap at PAGES */
uint8_t sum_of(const uint8_t *page);     /* 0xFF: the page is whole */
uint16_t crc_of(const uint8_t *bytes, unsigned count);   /* CRC-16/CCITT-FALSE */
bool begins_with_one_of(const char *line, const char *const *texts);   /* NULL behind the last one */

/* rules.c */
void rules_boot(void);
void rules_tick(void);
void rules_packet(const uint8_t *packet, uint16_t count);
void rules_printed(const char *line);
void rules_said(const char *sentence);
void rules_started(void);
void rules_typed(uint8_t byte);
void rules_remote(unsigned buttons);
void rules_kept(machine_memory_t memory, uint32_t at, const uint8_t *bytes, uint32_t count);
void rules_end(void);
bool rules_has_fault(const joint_t *joint);   /* now, or lately */
bool rules_is_well(void);         /* no servo, line or computer fails, or has failed lately */

/* handed.c */
void handed_left(void);           /* a packet has left */
void handed_lost(void);           /* and what was under way is lost */

/* replies.c */
void replies_boot(void);
void replies_typed(const char *typed, const char *line);
void replies_printed(const char *line);
void replies_prompt(void);

/* law.c */
void law_boot(void);
void law_tick(void);
void law_frame(const uint8_t *ids_and_goals, unsigned count, unsigned bytes_each);
void law_printed(const char *line);
void law_typed(const char *line);
void law_remote(unsigned buttons);
bool law_is_exact(void);   /* else the classic one may be in force */
/* Which step plays now. false: not known. */
bool law_place(unsigned *page, unsigned *step, unsigned *repetition);

bool law_was_goal(unsigned id, unsigned goal, unsigned ticks);   /* within the last ticks */

/* rest.c */
void rest_boot(void);
void rest_typed(const char *line);
void rest_remote(unsigned buttons);   /* Start is a stop */
void rest_printed(const char *line);
void rest_break(void);
void rest_may_end(void);
void rest_goal(unsigned id, unsigned goal);

/* presses.c */
void presses_boot(void);
void presses_remote(unsigned buttons);
void presses_panel(unsigned buttons);
void presses_typed(void);
void presses_printed(const char *line);
void presses_tick(void);
bool presses_are_at_rest(void);    /* nothing plays: the console has said so */

/* slopes.c */
void slopes_boot(void);
void slopes_typed(const char *line);
void slopes_printed(const char *line);
void slopes_tick(void);

/* kept.c */
void kept_boot(void);
void kept_started(void);
void kept_write(void);
void kept_typed(const char *line);
void kept_printed(const char *line);
void kept_tick(void);

/* calls.c */
bool page_is_good(unsigned page);
bool calls_are_said(void);         /* plays say that they begin: the setting `talk` */
void calls_boot(void);
void calls_typed(const char *line);
void calls_pressed(unsigned code); /* a press, or `code` */
void calls_printed(const char *line);

/* views.c */
void views_boot(void);
void views_tick(void);
void views_typed(const char *line);
void views_printed(const char *line);
void views_list(const char *answer, int first, int last);

/* answers.c */
void answers_boot(void);
void answers_tick(void);
void answers_printed(const char *line);
void answers_typed(const char *line);

/* screen.c: Edit's screen, and its table as it is shown */
#define SCREEN_COLUMNS 96u
#define TABLE_STEPS 8u             /* 0: the work pose */
#define TABLE_ROWS 33u
#define TABLE_FIELDS 17u           /* bytes 14..30 of the page */
#define NAME_BYTES 13u
enum { NO_VALUE = -1, OFF = -2, UNKNOWN = -3 };   /* ----, ????, not shown or not known */
enum { ROW_PAUSE = 31, ROW_TIME = 32, FIELD_SCHEDULE = 2, FIELD_STEPS = 6 };
typedef struct {
    int cell[TABLE_STEPS][TABLE_ROWS];
    int softness[JOINTS];
    int field[TABLE_FIELDS];
    int live[JOINTS];              /* where the joint is, if that is shown */
    char name[NAME_BYTES + 1];
    int page, address, go_step;
    unsigned x, y;
    int is_time;                   /* 1: times, 0: speeds */
    bool is_saved, is_hex, has_go_step;
    char command[SCREEN_COLUMNS + 1];   /* its row */
} table_t;
void screen_boot(void);
void screen_byte(uint8_t byte);
/* false: the table is not there. */
bool screen_read(table_t *table);
const char *screen_row(unsigned row);
void screen_put_away(void);        /* a line for programs has been typed */

/* table.c */
void table_forget(table_t *table);                     /* its cells are UNKNOWN */
unsigned table_offset(unsigned x, unsigned y);         /* the byte's offset in page and work pose */
void table_load(table_t *table, unsigned page);        /* a page in flash; the work pose stays */
void table_compare(const char *rule, const table_t *shown, const table_t *right);   /* what is known of both is equal */
bool table_is_equal(const table_t *a, const table_t *b);   /* their pages, as far as both are known */

/* editor.c */
void editor_boot(void);
void editor_tick(void);
void editor_typed(uint8_t byte);
void editor_line(const char *line);   /* with the keys before it */

/* editor_play.c */
void editor_play_boot(void);
void editor_play_line(const char *line);
void editor_play_key(uint8_t key);
void editor_play_tick(void);

/* marks.c */
void reached(const char *place);
void marks_printed(const char *line);
void marks_said(const char *sentence);
void marks_typed(const char *line);
void marks_remote(unsigned buttons);
void marks_cut(const char *where);
void marks_boot(void);
void marks_print(void);

#endif
