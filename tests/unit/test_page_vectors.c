/* SPDX-License-Identifier: MIT
 * test_page_vectors.c - the C codec and m512's Python codec must agree on the pages of
 * tests/models/golden/page_vectors.py. */
#include "page.h"
#include "unity.h"

typedef struct {
    uint8_t step, joint;
    uint16_t word;
    uint8_t used;
} word_vector_t;

typedef struct {
    const char *name;
    const uint8_t *page;
    uint8_t fault, playable;
    const word_vector_t *words;
    uint8_t word_count;
} page_vector_t;

#include "page_vectors.h"

static void test_page_check_names_the_fault_of_every_vector(void)
{
    for (unsigned i = 0; i < sizeof page_vectors / sizeof page_vectors[0]; i++) {
        TEST_ASSERT_EQUAL_UINT8_MESSAGE(page_vectors[i].fault, page_check(page_vectors[i].page), page_vectors[i].name);
    }
}

static void test_page_playable_as_every_vector_says(void)
{
    for (unsigned i = 0; i < sizeof page_vectors / sizeof page_vectors[0]; i++) {
        TEST_ASSERT_EQUAL_MESSAGE(page_vectors[i].playable, page_is_playable(page_vectors[i].page), page_vectors[i].name);
    }
}

static void test_page_words_read_as_every_vector_says(void)
{
    for (unsigned i = 0; i < sizeof page_vectors / sizeof page_vectors[0]; i++) {
        for (unsigned w = 0; w < page_vectors[i].word_count; w++) {
            const word_vector_t *expect = &page_vectors[i].words[w];
            uint16_t word = page_pos(page_vectors[i].page, expect->step, expect->joint);
            TEST_ASSERT_EQUAL_HEX16_MESSAGE(expect->word, word, page_vectors[i].name);
            TEST_ASSERT_EQUAL_MESSAGE(expect->used, page_pos_is_used(word), page_vectors[i].name);
        }
    }
}
