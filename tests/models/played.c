/* SPDX-License-Identifier: MIT
 * played.c - the player as a shared library for played.py: one main play over a motion area in memory, and a layer
 * over it. All functions use this one instance. */
#include <string.h>
#include "layers.h"
#include "link.h"
#include "player.h"
#include "shape.h"

static uint8_t pages[PAGE_COUNT][PAGE_BYTES];
static uint8_t status[PAGE_COUNT];
static player_t player;
static player_joint_t joint[PAGE_JOINTS];
static uint16_t goal_pos[PAGE_JOINTS];
static link_t links;
static shape_t shape;
static layers_t layers;
static uint8_t layer_events;
static bool alone, breaking;

static void read_page(void *context, uint8_t page, uint16_t offset, void *to, uint8_t count)
{
    (void)context;
    memcpy(to, &pages[page][offset], count);
}

static uint8_t check_page(void *context, uint8_t page)
{
    (void)context;
    return status[page];
}

static const page_source_t source = {.read = read_page, .check = check_page};

/* image: PAGE_COUNT pages. Afterwards nothing plays and nothing is shaped. */
void played_load(const uint8_t *image)
{
    memcpy(pages, image, sizeof pages);
    for (unsigned page = 0; page < PAGE_COUNT; page++) {
        status[page] = (uint8_t)page_check(pages[page]);
    }
    shape_init(&shape);
}

/* Calls a play; codes may arrive before it starts. call: 0 = by number. */
void played_call(int call)
{
    link_init(&links, LINK_LATCH);
    link_call(&links, (uint8_t)call);
}

/* Returns player_status_t. */
int played_start(int law, int page, uint32_t present, const uint16_t *pose_pos)
{
    player_init(&player, &source, joint);
    player.shape = &shape;
    alone = breaking = false;
    memcpy(goal_pos, pose_pos, sizeof goal_pos);
    layers_init(&layers, goal_pos);
    layers_bind(&layers, &player);
    return (int)player_start(&player, &links, (uint8_t)page, (player_law_t)law, pose_pos, present);
}

/* Receives a code, and its release. */
void played_code(int code)
{
    link_code(&links, (uint8_t)code);
    link_code(&links, LINK_CODE_NONE);
}

/* Plays one tick. A step's decisions are made in its first tick, so codes take effect until then. */
int played_tick(void)
{
    if (!alone) {
        return layers_tick(&layers, &links, &layer_events);
    }
    const int events = player_tick(&player, &links);
    if ((events & PLAYER_EV_OUTPUT) != 0) {
        player_goals(&player, UINT32_MAX, goal_pos);
    }
    return events;
}

/* Starts a layer. deg_s: speed of the hand-over in degrees/s. Returns layers_status_t. */
int played_layer(int page, uint32_t joints, int deg_s)
{
    layers_set_speed(&layers, (uint16_t)deg_s);
    return (int)layers_start(&layers, (uint8_t)page, joints);
}

void played_speed(int deg_s)
{
    layers_set_speed(&layers, (uint16_t)deg_s);
}

void played_layer_off(void)
{
    layers_end(&layers);
}

/* Plays `count` ticks from `first` on and records them: the goals (those of joint i start at i * all), and events, page
 * and step of both plays. Steps are planned after the goals, as the performer does. */
void played_run(int first, int count, int all, uint16_t *goals, uint8_t *events, uint8_t *places)
{
    for (int tick = first; tick < first + count; tick++) {
        events[2 * tick] = (uint8_t)played_tick();
        events[2 * tick + 1] = layer_events;
        const uint8_t place[4] = {player.now.page, player.now.step, layers.play.now.page, layers.play.now.step};
        memcpy(&places[4 * tick], place, 4);
        for (int i = 0; i < (int)PAGE_JOINTS; i++) {
            goals[i * all + tick] = goal_pos[i];
        }
        layers_plan(&layers, &links);
    }
}

/* From now on ticks are those of a program without layers, and nothing is shaped. Call it after played_start. */
void played_alone(void)
{
    alone = true;
    player.shape = NULL;
}

void played_stop(void)
{
    link_stop(&links);
}

/* Pauses both plays under the performer's conditions; otherwise no effect. */
void played_pause(void)
{
    if (player_is_moving(&player) && !player_is_paused(&player) && !breaking) {
        layers_pause(&layers);
        player_pause(&player);
    }
}

void played_resume(void)
{
    if (player_is_paused(&player)) {
        layers_resume(&layers);
        player_resume(&player);
    }
}

void played_break(void)
{
    breaking = true;
    layers_break(&layers);
    player_break(&player);
}

void played_drop(uint32_t joints)
{
    layers_drop_joints(&layers, joints);
    player_drop_joints(&player, joints);
}

/* Each returns layers_status_t. */
int played_aim(int id, int pos, int deg_s)
{
    return (int)layers_aim(&layers, (uint8_t)id, (uint16_t)pos, (uint16_t)deg_s);
}

int played_swing(int id, int centre, int amplitude, int ticks, int phase_deg)
{
    return (int)layers_swing(&layers, (uint8_t)id, (uint16_t)centre, (uint16_t)amplitude,
                             (uint16_t)ticks, (uint16_t)phase_deg);
}

void played_free(uint32_t joints)
{
    layers_free(&layers, joints);
}

const uint16_t *played_goals(void)
{
    return goal_pos;
}

void played_rate(int percent)
{
    shape.rate_percent = (uint16_t)percent;
}

void played_amplitude(int percent, uint32_t joints)
{
    shape_set_amplitude(&shape, (uint8_t)percent, joints);
}

void played_blend(int percent)
{
    shape.blend_percent = (int8_t)percent;
}

void played_centre(int page)
{
    shape.centre_page = (uint8_t)page;
}

void played_voltage(int decivolts)
{
    shape_set_voltage(&shape, (uint8_t)decivolts);
}

void played_reset(void)
{
    shape_reset(&shape);
}
