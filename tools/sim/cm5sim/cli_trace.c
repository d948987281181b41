/* SPDX-License-Identifier: MIT */
#include "cli_trace.h"

#include <inttypes.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

bool trace_open(trace_t *trace, const char *path, const servo_bus_t *bus)
{
    trace->file = fopen(path, "w");
    if (trace->file == NULL) {
        return false;
    }
    trace->bus = bus;
    trace->columns = bus->count;
    fputs("tick,ms", trace->file);
    for (int i = 0; i < trace->columns; i++) {
        const int id = bus->servos[i]->table[SERVO_ID];
        fprintf(trace->file, ",goal%d,present%d", id, id);
    }
    fputc('\n', trace->file);
    return true;
}

void trace_row(trace_t *trace, uint64_t tick, uint64_t now_cycles)
{
    fprintf(trace->file, "%" PRIu64 ",%.3f", tick, (double)now_cycles / SERVO_CYCLES_PER_MS);
    for (int i = 0; i < trace->columns; i++) {
        servo_t *servo = trace->bus->servos[i];
        servo_advance(servo, now_cycles);
        if (servo->powered && servo->table[SERVO_TORQUE_ENABLE]) {
            fprintf(trace->file, ",%u", servo_get(servo, SERVO_GOAL, 2));
        } else {
            fputc(',', trace->file);
        }
        fprintf(trace->file, ",%.0f", servo->position);
    }
    fputc('\n', trace->file);
}

bool trace_close(trace_t *trace)
{
    const bool good = ferror(trace->file) == 0;
    return fclose(trace->file) == 0 && good;
}

bool trace_plot(const char *trace_path, const char *picture_path)
{
    const char *python = getenv("M512_PYTHON");
    if (python == NULL) {
        python = access(CM5SIM_PYTHON, X_OK) == 0 ? CM5SIM_PYTHON : "python3";
    }
    const char *script = getenv("M512_PLOT_SCRIPT");
    script = script ? script : CM5SIM_PLOT_SCRIPT;
    const pid_t child = fork();
    if (child == 0) {
        sigset_t none;
        sigemptyset(&none);
        (void)sigprocmask(SIG_SETMASK, &none, NULL);
        execlp(python, python, script, trace_path, picture_path, (char *)NULL);
        fprintf(stderr, "cm5sim: cannot run %s for --plot\n", python);
        _exit(127);
    }
    int status = -1;
    return child > 0 && waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}
