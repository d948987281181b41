/* SPDX-License-Identifier: MIT */
#include "play.h"

#include "console.h"
#include "panel.h"
#include "system.h"
#include "tick.h"

#define LAMP_TICKS 6u       /* a traffic lamp stays lit for 47 ms */
#define BLINK_TICKS_LOG2 5u /* the Play lamp blinks during a pause, 250 ms on, 250 ms off */

/* ---- lamps ---- */

typedef struct {
    uint8_t count;      /* bytes so far, modulo 256 */
    uint8_t ticks_left; /* until the lamp goes off */
} traffic_t;

static void show_traffic(uint8_t led, uint8_t count, traffic_t *traffic)
{
    if (count != traffic->count) {
        traffic->count = count;
        traffic->ticks_left = LAMP_TICKS;
    } else if (traffic->ticks_left > 0) {
        traffic->ticks_left--;
    }
    panel_set(led, traffic->ticks_left > 0);
}

static void show_lamps(const performer_t *performer)
{
    static traffic_t sent, received;
    show_traffic(PANEL_LED_TXD, console_sent(), &sent);
    show_traffic(PANEL_LED_RXD, console_received(), &received);
    const bool dark = performer_is_paused(performer) && (tick_now16() >> BLINK_TICKS_LOG2) % 2 != 0;
    panel_set(PANEL_LED_PLAY, !performer_is_still(performer) && !dark);
    panel_set(PANEL_LED_AUX, performer->faulty != 0 || performer->battery_reported || performer->is_hot);
}

/* ---- urgent work ---- */

void play_service(void)
{
    if (tick_take()) {
        performer_tick(&the_play.performer);
        panel_tick();
        inputs_tick(&the_play.inputs);
        show_lamps(&the_play.performer);
    }
    inputs_take(&the_play.inputs);
    performer_poll(&the_play.performer);
    settings_save_poll(&the_play.store);
    system_kick();
}

void play_find_servos(void)
{
    int16_t trim_pos[PAGE_JOINTS];
    console_xoff();
    servo_link_scan(&the_play.servos);
    (void)page_store_trim(&the_play.pages, trim_pos);
    servo_link_set_trim(&the_play.servos, trim_pos);
    console_xon();
    tick_forgive();
}
