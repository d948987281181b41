/* SPDX-License-Identifier: MIT
 * replay.c - runs a harness once for each file of a folder (or each named file): the corpus as a test, without
 * libFuzzer. libFuzzer's options -runs=N -seed=N -max_len=N -artifact_prefix=FOLDER/ before the files add N random
 * variations of these inputs (vary.h). A harness that finds something aborts. The last line before that names the
 * file; a varied input is in the named file. */
#include "fuzz.h"
#include "vary.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#define INPUT_MAX (1u << 20)
#define INPUTS_MAX 1000u

static input_t corpus[INPUTS_MAX];
static size_t corpus_count;

/* Uses a copy of exactly this size, so that a read beyond it is found. */
static void run_bytes(const uint8_t *bytes, size_t size, const char *name)
{
    uint8_t *input = malloc(size > 0 ? size : 1);
    if (input == NULL) {
        exit(2);
    }
    memcpy(input, bytes, size);
    fprintf(stderr, "%s\n", name);
    (void)LLVMFuzzerTestOneInput(input, size);
    free(input);
}

static unsigned run_file(const char *path)
{
    FILE *file = fopen(path, "rb");
    static uint8_t buffer[INPUT_MAX];
    if (file == NULL || corpus_count == INPUTS_MAX) {
        perror(path);
        exit(2);
    }
    input_t *kept = &corpus[corpus_count++];
    kept->size = fread(buffer, 1, sizeof buffer, file);
    fclose(file);
    kept->bytes = malloc(kept->size + 1);
    if (kept->bytes == NULL) {
        exit(2);
    }
    memcpy(kept->bytes, buffer, kept->size);
    run_bytes(buffer, kept->size, path);
    return 1;
}

/* The file exists while its input runs. After an abort it holds the finding. */
static void run_made(const input_t *input, const char *prefix)
{
    char path[4096];
    snprintf(path, sizeof path, "%smade", prefix);
    FILE *file = fopen(path, "wb");
    if (file == NULL || fwrite(input->bytes, 1, input->size, file) != input->size || fclose(file) != 0) {
        perror(path);
        exit(2);
    }
    run_bytes(input->bytes, input->size, path);
    remove(path);
}

static unsigned run_varied(unsigned runs, size_t size_max, const char *prefix)
{
    static uint8_t buffer[INPUT_MAX];
    for (unsigned i = 0; i < runs && corpus_count > 0; i++) {
        const input_t *from = &corpus[vary_chance(corpus_count)], *other = &corpus[vary_chance(corpus_count)];
        input_t made = {.bytes = buffer, .size = from->size < size_max ? from->size : size_max};
        memcpy(buffer, from->bytes, made.size);
        vary(&made, size_max, other);
        run_made(&made, prefix);
    }
    return corpus_count > 0 ? runs : 0;
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

/* Returns the value of -NAME=VALUE, or NULL. */
static const char *option(const char *word, const char *name)
{
    const size_t length = strlen(name);
    return strncmp(word, name, length) == 0 ? word + length : NULL;
}

int main(int count, char **arguments)
{
    unsigned long runs = 0, size_max = 4096;
    const char *prefix = "./", *value;
    unsigned done = 0;
    int i = 1;
    for (; i < count && arguments[i][0] == '-'; i++) {
        if ((value = option(arguments[i], "-runs=")) != NULL) {
            runs = strtoul(value, NULL, 10);
        } else if ((value = option(arguments[i], "-seed=")) != NULL) {
            vary_seed((uint32_t)strtoul(value, NULL, 10));
        } else if ((value = option(arguments[i], "-max_len=")) != NULL) {
            size_max = strtoul(value, NULL, 10);
        } else if ((value = option(arguments[i], "-artifact_prefix=")) != NULL) {
            prefix = value;
        } else {
            fprintf(stderr, "replay: no option %s\n", arguments[i]);
            return 2;
        }
    }
    for (; i < count; i++) {
        struct stat about;
        const int is_folder = stat(arguments[i], &about) == 0 && S_ISDIR(about.st_mode);
        done += is_folder ? run_folder(arguments[i]) : run_file(arguments[i]);
    }
    done += run_varied((unsigned)runs, size_max < INPUT_MAX ? size_max : INPUT_MAX, prefix);
    printf("%u inputs\n", done);
    return done > 0 ? 0 : 2;
}
