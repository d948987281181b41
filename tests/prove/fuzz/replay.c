/* SPDX-License-Identifier: MIT
 * replay.c - runs a harness once for each file of a folder (or each file named): the corpus as a test, without libFuzzer.
 * A harness that finds something aborts; the file's name is the last line before that. */
#include "fuzz.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#define INPUT_MAX (1u << 20)

static unsigned run_file(const char *path)
{
    FILE *file = fopen(path, "rb");
    if (file == NULL) {
        perror(path);
        exit(2);
    }
    /* Exactly as long as the file, so that a read beyond its end is seen. */
    static uint8_t buffer[INPUT_MAX];
    const size_t size = fread(buffer, 1, sizeof buffer, file);
    fclose(file);
    uint8_t *input = malloc(size > 0 ? size : 1);
    if (input == NULL) {
        exit(2);
    }
    memcpy(input, buffer, size);
    fprintf(stderr, "%s\n", path);
    (void)LLVMFuzzerTestOneInput(input, size);
    free(input);
    return 1;
}

static unsigned run_folder(const char *folder)
{
    struct dirent **entries;
    const int count = scandir(folder, &entries, NULL, alphasort);
    unsigned done = 0;
    if (count < 0) {
        perror(folder);
        exit(2);
    }
    for (int i = 0; i < count; i++) {
        char path[4096];
        struct stat about;
        snprintf(path, sizeof path, "%s/%s", folder, entries[i]->d_name);
        if (stat(path, &about) == 0 && S_ISREG(about.st_mode)) {
            done += run_file(path);
        }
        free(entries[i]);
    }
    free(entries);
    return done;
}

int main(int count, char **arguments)
{
    unsigned done = 0;
    for (int i = 1; i < count; i++) {
        struct stat about;
        const int is_folder = stat(arguments[i], &about) == 0 && S_ISDIR(about.st_mode);
        done += is_folder ? run_folder(arguments[i]) : run_file(arguments[i]);
    }
    printf("%u inputs\n", done);
    return done > 0 ? 0 : 2;
}
