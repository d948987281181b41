/* SPDX-License-Identifier: MIT
 * test_page_vectors.c - the C codec and the Python codec of m512 judge the same pages: tests/golden/page_vectors.json. */
#include <string.h>
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

void setUp(void)
{
}

void tearDown(void)
{
}

/* What page_check has to say of a page with a link above 127, which m512 reports and a play takes for 0: what it says of the
 * page without links. */
static uint8_t without_links(const uint8_t page[PAGE_BYTES])
{
    uint8_t copy[PAGE_BYTES];
    memcpy(copy, page, PAGE_BYTES);
    copy[PAGE_AT_NEXT_PAGE] = copy[PAGE_AT_EXIT_PAGE] = copy[PAGE_AT_LINKED1_PAGE] = copy[PAGE_AT_LINKED2_PAGE] = 0;
    page_seal(copy);
    return (uint8_t)page_check(copy);
}

static void test_page_check_names_the_fault_of_every_vector(void)
{
    for (unsigned i = 0; i < sizeof page_vectors / sizeof page_vectors[0]; i++) {
        uint8_t fault = page_vectors[i].fault;
        fault = fault == PAGE_ERR_LINK ? without_links(page_vectors[i].page) : fault;
        TEST_ASSERT_EQUAL_UINT8_MESSAGE(fault, page_check(page_vectors[i].page), page_vectors[i].name);
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

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_page_check_names_the_fault_of_every_vector);
    RUN_TEST(test_page_playable_as_every_vector_says);
    RUN_TEST(test_page_words_read_as_every_vector_says);
    return UNITY_END();
}
