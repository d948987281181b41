/* SPDX-License-Identifier: MIT */
#include "packets.h"

#include <stddef.h>
#include "bus_call.h"
#include "dxl.h"
#include "dxl_packet.h"
#include "shell.h"
#include "text.h"

enum { TRIES = 2 };

uint8_t packets_say(const char *line_P)
{
    text_P(line_P);
    text_line_end();
    return SHELL_ERR_REPORTED;
}

void packets_print_bytes(const char *before_P, const uint8_t *bytes, uint8_t count)
{
    text_P(before_P);
    while (count-- > 0) {
        text_put(' ');
        text_hex(*bytes++, 2);
    }
}

uint8_t packets_say_status(bus_status_t status)
{
    return packets_say(status == BUS_ERR_TIMEOUT    ? TEXT_P("[Err:RxD Timeout]")
                       : status == BUS_ERR_CHECKSUM ? TEXT_P("[Err:Wrong CheckSum]")
                       : status == BUS_ERR_FRAMING  ? TEXT_P("[Err:Wrong Header]")
                       : status == BUS_ERR_WRONG_ID ? TEXT_P("[Err:TxID != RxID]")
                       : status == BUS_ERR_REJECTED ? TEXT_P("[Err:Rejected]")
                                                    : TEXT_P("[Err:Wrong Length]"));
}

uint8_t *packets_params(void)
{
    return bus_packet() + DXL_PARAMS_AT;
}

bool packets_exchange(uint8_t id, uint8_t instruction, uint8_t count)
{
    bus_answer_t answer = { 0, 0, 0, NULL };
    bool silent = id == DXL_BROADCAST && instruction != DXL_PING;
    uint8_t expected = silent ? BUS_NO_ANSWER : instruction == DXL_READ ? packets_params()[1] : 0;
    bus_status_t status = bus_call(id, instruction, packets_params(), count, expected, silent ? 1 : TRIES, &answer);
    packets_print_bytes(TEXT_P("->[Dynamixel]:"), bus_packet(), bus_packet()[3] + 4u);
    text_line_end();
    if (silent) {
        return false;
    }
    if (status == BUS_OK || status == BUS_ERR_REJECTED) {
        packets_print_bytes(TEXT_P("<-[Dynamixel]: ID"), &answer.id, 1);
        packets_print_bytes(TEXT_P(" error"), &answer.error, 1);
        packets_print_bytes(TEXT_P(" :"), answer.params, answer.count);
        text_line_end();
    } else {
        (void)packets_say_status(status);
    }
    return status == BUS_OK;
}
