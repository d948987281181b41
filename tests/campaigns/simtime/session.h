/* SPDX-License-Identifier: MIT
 * session.h - one session of Play or Edit in simulated time: the interfaces between its files.
 *
 *   main.c      reads the list of actions, runs the programs, reports the result
 *   world.c     the servos and the serial line; carries out actions
 *   rules.c     what must hold at every tick
 *   law.c       steps, links and approaches of unshaped plays; aims
 *   rest.c      what must not move: after a break, in a pause
 *   presses.c   which buttons are a press
 *   calls.c     the page that a play begins with
 *   stops.c     which stops are a break
 *   joins.c     how fast a joint goes over to a layer
 *   slopes.c    the softness of joints in a play
 *   kept.c      settings in EEPROM
 *   answers.c   answers to requests
 *   views.c     contents of lists
 *   handed.c    when packets are handed to the bus
 *   screen.c    a terminal for Edit, and the table shown on it
 *   table.c     such tables: loaded from flash, and compared
 *   editor*.c   a second model of Edit: what lines and keys do to its table, and to a play
 *   facts.c     pages as bytes, by PAGE_FORMAT.md; independent of the firmware
 *   marks.c     places that a campaign must reach
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
#define TROUBLE (6u * SECOND)      /* faults of the line or the servos have no effect after that */
#define PAGES 256u
#define PAGE_BYTES 512u
#define STEP_BYTES 64u
#define TORQUE_AT 24u              /* registers of a servo */
#define GOAL_AT 30u

enum { INST_WRITE = 3, INST_REG_WRITE = 4, INST_ACTION = 5, INST_SYNC_WRITE = 0x83 };

/* What is known of one servo. */
typedef struct {
    servo_t *servo;
    uint32_t fault_tick;           /* the last time that a fault of it began, was present or ended */
    uint32_t late_tick;            /* the last time that its answers began or stopped to be late */
    uint32_t silent_since;         /* its answers cannot be understood since then; NEVER_TICK: it is well */
    uint32_t pushed_tick;
    uint32_t goal_tick;            /* the last goal */
    uint16_t goal;
    bool is_deaf;                  /* to SYNC WRITE */
    bool is_known;                 /* the program has found it */
    bool named_silent;             /* by the newest report to the user */
} joint_t;

/* One session. */
typedef struct {
    bool is_edit;
    bool is_over;
    bool has_deaf;                 /* a servo ignores SYNC WRITE: goals are sent one by one, and late */
    bool shows;                    /* prints console and bus as they come */
    uint32_t tick;
    uint64_t random;
    servo_bus_t *bus;
    joint_t joint[IDS];
    uint32_t trouble_tick;         /* the last time that the line, the adapter or the computer failed */
    uint32_t late_tick;            /* the last time that the computer was late or the adapter gone */
    uint32_t plug_tick;            /* the last time that the adapter came or went */
    uint32_t pushed_tick;          /* the last time that a joint was turned by hand */
    uint32_t goals_tick;           /* the last goals of any joint */
    uint32_t frame_tick;           /* the last goals of a tick, sent to all joints at once */
    uint32_t boot_tick;
    uint32_t boots;
    uint32_t writes;               /* writes to memory so far */
    uint32_t cut_at_write;         /* the power is cut at this write; 0: never */
    bool cut_now;
    uint32_t latency;              /* of the adapter, half microseconds */
    uint32_t typed_tick;           /* the last byte from the user or the remote */
    uint32_t printed_tick;
    uint32_t asked_tick;           /* the last request for something that may move, since the last start */
    uint32_t save_asked_tick;      /* the last request to save a page */
    char line[LINE_BYTES];         /* the newest line of the console */
    uint16_t column;
    char typed[LINE_BYTES];        /* what the user has typed since the last line end */
    uint16_t typed_count;
    bool typed_is_known;           /* since then only printable characters and backspaces */
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
/* Does one action, given as words. false: no such action, or bad words. */
bool world_do(char *words);
void world_power(bool on);
void world_forget_line(void);   /* discards what is in transit on the console */

/* facts.c */
const uint8_t *page_at(unsigned page);   /* in flash, PAGE_BYTES; numbers wrap at PAGES */
uint8_t sum_of(const uint8_t *page);     /* 0xFF: the page is undamaged */
uint16_t crc_of(const uint8_t *bytes, unsigned count);   /* CRC-16/CCITT-FALSE */
uint32_t joints_named(const char *words);   /* a bit for each joint number, until a word that is none */
int trim_of(unsigned id);                /* the trim in flash (PAGE_FORMAT.md); 0: none */
int limited(int pos);                    /* to the positions of pages, 0..1023 */
int to_page(unsigned id, double servo_pos);   /* a servo's position without its trim, limited */
bool is_stop_of(unsigned buttons);       /* button 6, or the first eight together (REMOTE.md) */
bool begins_with_one_of(const char *line, const char *const *texts);   /* texts: ends with NULL */

/* rules.c */
void rules_boot(void);
void rules_tick(void);
void rules_packet(const uint8_t *packet, uint16_t count);
void rules_printed(const char *line);
void rules_said(const char *sentence);
void rules_started(void);
void rules_asked(void);           /* for something that may move */
void rules_typed(uint8_t byte);
void rules_remote(unsigned buttons);
void rules_kept(machine_memory_t memory, uint32_t at, const uint8_t *bytes, uint32_t count);
void rules_end(void);
bool rules_has_fault(const joint_t *joint);   /* now or recently */
bool rules_is_searching(void);    /* or did so until a second ago; lines wait */
bool rules_somebody_is_late(void);   /* a servo answers late, or did so recently: it collides with others */
bool rules_is_well(void);         /* no fault of servo, line or computer, now or recently */

/* handed.c */
void handed_left(void);           /* a packet has left the adapter */
void handed_lost(void);           /* packets in transit are lost */

/* law.c */
void law_boot(void);
void law_tick(void);
void law_frame(const uint8_t *ids_and_goals, unsigned count, unsigned bytes_each);
void law_printed(const char *line);
void law_typed(const char *line);
void law_remote(unsigned buttons);
bool law_is_exact(void);   /* otherwise the classic law may be in force */
/* Gets the step that plays now. false: not known. */
bool law_place(unsigned *page, unsigned *step, unsigned *repetition);

bool law_was_goal(unsigned id, int goal, unsigned ticks);   /* as it is shown, within the last ticks */

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
bool presses_are_at_rest(void);    /* nothing plays, by the console's reports */

/* stops.c */
void stops_boot(void);
void stops_typed(const char *line);
void stops_pressed(void);
void stops_printed(const char *line);

/* joins.c */
void joins_boot(void);
void joins_typed(const char *line);
void joins_pressed(void);
void joins_printed(const char *line);
void joins_goal(unsigned id, unsigned goal);

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
int kept_value(const char *setting);   /* in EEPROM now, or its default */

/* calls.c */
bool page_is_good(unsigned page);
bool calls_are_said(void);         /* plays report that they begin: setting `talk` */
void calls_boot(void);
void calls_typed(const char *line);
void calls_pressed(unsigned code); /* a press, or the word `code` */
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

/* screen.c: Edit's screen, and the table shown on it */
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
    int live[JOINTS];              /* position of the joint, if shown */
    char name[NAME_BYTES + 1];
    int page, address, go_step;
    unsigned x, y;
    int is_time;                   /* 1: times, 0: speeds */
    bool is_saved, is_hex, has_go_step;
    char command[SCREEN_COLUMNS + 1];   /* the command row */
} table_t;
void screen_boot(void);
void screen_byte(uint8_t byte);
/* false: the table is not shown. */
bool screen_read(table_t *table);
const char *screen_row(unsigned row);
bool screen_has_said(const char *text);   /* in this tick */
void screen_tick(void);            /* a tick is over */
void screen_put_away(void);        /* a line of a program has been typed */

/* table.c */
void table_forget(table_t *table);                     /* all cells become UNKNOWN */
unsigned table_offset(unsigned x, unsigned y);         /* offset of the byte in page and work pose */
void table_load(table_t *table, unsigned page);        /* loads a page from flash; the work pose stays */
void table_compare(const char *rule, const table_t *shown, const table_t *right);   /* fails if known values differ */
bool table_is_equal(const table_t *a, const table_t *b);   /* the pages are equal as far as both are known */

/* editor.c */
void editor_boot(void);
void editor_tick(void);
void editor_typed(uint8_t byte);
void editor_line(const char *line);   /* includes the keys before it */

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
