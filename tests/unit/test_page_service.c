/* SPDX-License-Identifier: MIT
 * Who writes flash: our loader, the factory's, a mailbox, or nobody; and the mailbox itself. */
#include "fake_boot_call.h"
#include "fake_eeprom.h"
#include "crc16.h"
#include "page_service.h"
#include "memory_map.h"
#include "unity.h"

#include <string.h>

/* boot/ORIGINAL.md, section 7b: the used part 1E000-1FB8F, the rest FF. */
#define FACTORY_USED_BYTES 0x1B90u
#define FACTORY_USED_SUM 0x000B2F60ul
#define FACTORY_USED_CRC 0x7406u

static uint8_t data[512];
static boot_rx_t rx;

void setUp(void)
{
    fake_boot_call_reset();
    fake_eeprom_reset();
    for (unsigned i = 0; i < sizeof data; i++) {
        data[i] = (uint8_t)(i * 7);
    }
}

static uint8_t *boot(void)
{
    return fake_boot_call_flash() + MEM_BOOT_START;
}

static void install_ours(uint8_t version, uint16_t features)
{
    const uint8_t head[] = {'M', '5', 'B', 'L', version, 1, (uint8_t)features, (uint8_t)(features >> 8), 0, 1};
    memset(boot(), 0x55, 0x1000);
    memcpy(boot() + (MEM_BOOT_API - MEM_BOOT_START), head, sizeof head);
}

/* Installs made-up bytes with the factory loader's length, sum and CRC. Finds the last six bytes by search. */
static void install_factory(void)
{
    uint8_t *p = boot();
    unsigned end = FACTORY_USED_BYTES;
    uint32_t left = FACTORY_USED_SUM;
    for (unsigned i = 0; i < end; i++) {
        p[i] = (uint8_t)(left / (end - i));
        left -= p[i];
    }
    uint16_t before = crc16_bytes(CRC16_START, p, (uint16_t)(end - 6));
    for (int x = -50; x <= 50; x++) {
        for (int y = -50; y <= 50; y++) {
            for (int z = -50; z <= 50; z++) {
                uint8_t tail[6];
                memcpy(tail, p + end - 6, 6);
                tail[0] = (uint8_t)(tail[0] + x);
                tail[1] = (uint8_t)(tail[1] - x);
                tail[2] = (uint8_t)(tail[2] + y);
                tail[3] = (uint8_t)(tail[3] - y);
                tail[4] = (uint8_t)(tail[4] + z);
                tail[5] = (uint8_t)(tail[5] - z);
                if (crc16_bytes(before, tail, 6) == FACTORY_USED_CRC) {
                    memcpy(p + end - 6, tail, 6);
                    return;
                }
            }
        }
    }
    TEST_FAIL_MESSAGE("no bytes with the factory's sums found");
}

static void test_an_empty_boot_section_is_nobody(void)
{
    TEST_ASSERT_EQUAL(PAGE_SERVICE_NONE, page_service_init(&rx));
    TEST_ASSERT_EQUAL(FLASH_ERR_NO_WRITER, flash_write(0xE0, data, 256));
    TEST_ASSERT_EQUAL(FAKE_CALL_NONE, fake_boot_call_last()->who);
}

static void test_our_signature_is_our_loader(void)
{
    install_ours(1, 0x7F);
    TEST_ASSERT_EQUAL(PAGE_SERVICE_OURS, page_service_init(&rx));
    TEST_ASSERT_EQUAL(FLASH_OK, flash_write(0xE0, data, 256));
    const fake_boot_call_t *call = fake_boot_call_last();
    TEST_ASSERT_EQUAL(FAKE_CALL_OURS, call->who);
    TEST_ASSERT_EQUAL_HEX32(0xE000, call->addr);
    TEST_ASSERT_EQUAL_UINT16(256, call->bytes);
    TEST_ASSERT_EQUAL(BOOT_MODE_WRITE, call->mode);
    TEST_ASSERT_EQUAL_PTR(&rx, call->rx);
    TEST_ASSERT_EQUAL(FLASH_OK, flash_program(0x1DF, data, 12));
    TEST_ASSERT_EQUAL(BOOT_MODE_PROGRAM, fake_boot_call_last()->mode);
    TEST_ASSERT_EQUAL_HEX32(0x1DF00, fake_boot_call_last()->addr);
}

static void test_a_later_version_of_the_table_is_still_ours(void)
{
    install_ours(2, 0xFFFF);
    TEST_ASSERT_EQUAL(PAGE_SERVICE_OURS, page_service_init(NULL));
}

static void test_a_table_without_the_service_is_not(void)
{
    install_ours(1, 0x60);
    TEST_ASSERT_EQUAL(PAGE_SERVICE_MAILBOX, page_service_init(NULL));
    install_ours(0, 0x7F);
    TEST_ASSERT_EQUAL(PAGE_SERVICE_MAILBOX, page_service_init(NULL));
}

static void test_the_factory_loader_is_known_by_its_sums(void)
{
    install_factory();
    TEST_ASSERT_EQUAL_HEX16(0xD53E, crc16_bytes(CRC16_START, boot(), 0x2000)); /* the spec's second figure */
    TEST_ASSERT_EQUAL(PAGE_SERVICE_FACTORY, page_service_init(&rx));
    TEST_ASSERT_EQUAL(FLASH_OK, flash_write(0x1D0, data, 256));
    TEST_ASSERT_EQUAL(FAKE_CALL_FACTORY, fake_boot_call_last()->who);
    TEST_ASSERT_EQUAL_HEX32(0x1D000, fake_boot_call_last()->addr);
}

/* One bit of the used part and of the rest; and the polynomial's own bits, which leave the CRC as it is. */
static void test_changed_bits_are_not_the_factory_loader(void)
{
    const struct {
        uint16_t at;
        uint8_t bits[3];
    } changes[] = {{0x1238, {0x10, 0, 0}}, {FACTORY_USED_BYTES, {1, 0, 0}}, {0x1FFD, {0, 0, 0x80}},
                   {0x100, {0x01, 0x10, 0x21}}};
    for (unsigned i = 0; i < sizeof changes / sizeof changes[0]; i++) {
        fake_boot_call_reset();
        install_factory();
        for (unsigned k = 0; k < 3; k++) {
            boot()[changes[i].at + k] ^= changes[i].bits[k];
        }
        TEST_ASSERT_EQUAL(PAGE_SERVICE_MAILBOX, page_service_init(&rx));
        TEST_ASSERT_EQUAL(FLASH_ERR_NO_WRITER, flash_write(0x1D0, data, 256));
        TEST_ASSERT_EQUAL(FAKE_CALL_NONE, fake_boot_call_last()->who);
    }
}

static void test_swapped_bytes_are_not_the_factory_loader(void)
{
    install_factory();
    boot()[0x100] = (uint8_t)(boot()[0x100] + 1);
    boot()[0x101] = (uint8_t)(boot()[0x101] - 1);
    TEST_ASSERT_EQUAL(PAGE_SERVICE_MAILBOX, page_service_init(&rx));
}

static void test_ranges_are_checked_before_anyone_is_called(void)
{
    install_ours(1, 0x7F);
    (void)page_service_init(NULL);
    const uint16_t pages[] = {0x1E0, 0x1FF, 0x200, 0xFFFF};
    for (unsigned i = 0; i < 4; i++) {
        TEST_ASSERT_EQUAL(FLASH_ERR_RANGE, flash_write(pages[i], data, 256));
    }
    TEST_ASSERT_EQUAL(FLASH_ERR_RANGE, flash_write(0xE0, data, 0));
    TEST_ASSERT_EQUAL(FLASH_ERR_RANGE, flash_write(0xE0, data, 3));
    TEST_ASSERT_EQUAL(FLASH_ERR_RANGE, flash_write(0xE0, data, 258));
    TEST_ASSERT_EQUAL(FAKE_CALL_NONE, fake_boot_call_last()->who);
}

static void test_results_are_translated(void)
{
    install_ours(1, 0x7F);
    (void)page_service_init(NULL);
    fake_boot_call_answer(BOOT_ERR_VERIFY);
    TEST_ASSERT_EQUAL(FLASH_ERR_VERIFY, flash_write(0xE0, data, 256));
    fake_boot_call_answer(BOOT_ERR_RANGE);
    TEST_ASSERT_EQUAL(FLASH_ERR_RANGE, flash_write(0xE0, data, 256));
}

static void test_the_mailbox_is_filled_as_section_7a_says(void)
{
    TEST_ASSERT_TRUE(page_service_post(120, data));
    const uint8_t *ee = fake_eeprom_bytes();
    TEST_ASSERT_EQUAL_MEMORY(data, ee + 0x800, 512);
    TEST_ASSERT_EQUAL_HEX8(120, ee[0xFF5]);
    TEST_ASSERT_EQUAL_HEX8(0xAA, ee[0xFF4]);
    TEST_ASSERT_EQUAL_HEX8(0x11, ee[0xFFF]);
}

static void test_pages_above_127_are_not_posted(void)
{
    TEST_ASSERT_FALSE(page_service_post(128, data));
    TEST_ASSERT_EQUAL_UINT32(0, fake_eeprom_writes());
}

static void test_a_cut_before_the_end_posts_nothing(void)
{
    static jmp_buf cut;
    static volatile uint32_t operation;
    fake_eeprom_bytes()[0xFF4] = 0xAA; /* an older page is still stored */
    for (operation = 2; operation < 500; operation += 50) {
        fake_eeprom_reset();
        fake_eeprom_bytes()[0xFF4] = 0xAA;
        if (setjmp(cut) == 0) {
            fake_eeprom_cut(operation, 0x3C, &cut);
            TEST_ASSERT_FALSE_MESSAGE(page_service_post(5, data), "the cut did not come");
        }
        TEST_ASSERT_NOT_EQUAL_HEX8(0xAA, fake_eeprom_bytes()[0xFF4]);
    }
}

static void test_what_became_of_a_mailbox_is_told_once(void)
{
    const struct {
        uint8_t state;
        page_service_mail_t mail;
    } cases[] = {{0x55, PAGE_SERVICE_MAIL_WRITTEN}, {0xAA, PAGE_SERVICE_MAIL_IGNORED},
                 {0xFF, PAGE_SERVICE_MAIL_NONE}, {0x00, PAGE_SERVICE_MAIL_NONE}};
    for (unsigned i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        fake_eeprom_reset();
        fake_eeprom_bytes()[0xFF4] = cases[i].state;
        TEST_ASSERT_EQUAL(cases[i].mail, page_service_mail());
        TEST_ASSERT_EQUAL(PAGE_SERVICE_MAIL_NONE, page_service_mail());
    }
}
