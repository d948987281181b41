#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Converts page_vectors.json to a C table for test_page_vectors.c: page_vectors_table.py page_vectors.json out.h"""

import json
import sys


def rows(vectors):
    for number, vector in enumerate(vectors):
        data = ", ".join(f"0x{byte:02X}" for byte in bytes.fromhex(vector["hex"]))
        yield f"static const uint8_t page_{number}[512] = {{{data}}};"
        words = ", ".join(f"{{{w['step']}, {w['joint']}, {w['word']}, {int(w['used'])}}}" for w in vector["words"])
        yield f"static const word_vector_t words_{number}[] = {{{words or '{0, 0, 0, 0}'}}};"
    yield "static const page_vector_t page_vectors[] = {"
    for number, vector in enumerate(vectors):
        name = vector["name"].replace('"', "'")
        yield (f'    {{"{name}", page_{number}, {vector["fault_number"]}, {int(vector["playable"])}, words_{number}, {len(vector["words"])}}},')
    yield "};"


def main(source, target):
    with open(source, encoding="utf-8") as file:
        vectors = json.load(file)["vectors"]
    with open(target, "w", encoding="utf-8") as file:
        file.write("/* Made by page_vectors_table.py from page_vectors.json. */\n" + "\n".join(rows(vectors)) + "\n")


if __name__ == "__main__":
    main(*sys.argv[1:])
