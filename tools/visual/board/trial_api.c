/* SPDX-License-Identifier: MIT */
#include "trial_api.h"

#include "imported_body.h"
#include "quick.h"
#include "shape_of.h"

#define BITS_PER_SECOND 1000000u /* of an AX-12 */

_Static_assert(TRIAL_API_IMAGE_BYTES == QUICK_IMAGE_BYTES, "trial_api.h tells the size of quick.h's image");

static struct {
    quick_t *robot;
    uint8_t image[TRIAL_API_IMAGE_BYTES];
    double positions[PAGE_JOINTS];
} api;

uint8_t *trial_api_image(void) { return api.image; }

bool trial_api_new(double volts)
{
    quick_free(api.robot);
    api.robot = quick_new(api.image);
    if (api.robot) {
        servo_bus_supply(quick_bus(api.robot), 0, volts);
    }
    return api.robot != NULL;
}

bool trial_api_add_servo(int id)
{
    return api.robot && id >= 0 && id < (int)PAGE_JOINTS && quick_bus(api.robot)->count < (int)PAGE_JOINTS &&
           servo_bus_add(quick_bus(api.robot), (uint8_t)id, SERVO_AX12, BITS_PER_SECOND) != NULL;
}

void trial_api_stand(void)
{
    if (api.robot) {
        servo_bus_body(quick_bus(api.robot), quick_now(api.robot), imported_body());
        quick_torque_on(api.robot);
    }
}

bool trial_api_shape(int rate, int amplitude, int blend)
{
    shape_t shape;
    if (!api.robot || !shape_of(&shape, rate, amplitude, blend)) {
        return false;
    }
    quick_shape(api.robot, &shape);
    return true;
}

int trial_api_start(int page, int law)
{
    if (!api.robot || page < 0 || page >= (int)PAGE_COUNT) {
        return -1;
    }
    return quick_start(api.robot, (uint8_t)page, law ? PLAYER_LAW_CLASSIC : PLAYER_LAW_EXACT);
}

void trial_api_keys(int code)
{
    if (api.robot) {
        quick_keys(api.robot, (uint8_t)code);
    }
}

bool trial_api_run(int ticks) { return api.robot && ticks > 0 && quick_run(api.robot, (uint32_t)ticks); }

int trial_api_page(void) { return api.robot ? quick_page(api.robot) : 0; }

int trial_api_step(void) { return api.robot ? quick_step(api.robot) : 0; }

const double *trial_api_positions(void)
{
    for (int i = 0; api.robot && i < quick_bus(api.robot)->count; i++) {
        api.positions[i] = quick_bus(api.robot)->servos[i]->position;
    }
    return api.positions;
}
