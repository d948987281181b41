# SPDX-License-Identifier: MIT
"""Run by pack.mjs in Pyodide: packs the modules in use into /python.zip. Sources are in /pack and the standard library."""

import importlib._bootstrap_external as external
import sys
import zipfile
import zipimport

sys.path.insert(0, "/pack")
import bridge  # noqa: E402

STANDARD = next(path for path in sys.path if path.endswith(".zip"))
WHEN = (2005, 1, 1, 0, 0, 0)


def use_everything():
    """Loads the modules that are imported only on use: every format, both ways, and what error reports need."""
    empty = bytes(bridge.raw.Image.empty().to_bytes())
    for name in ("a.bin", "a.hex", "a.m512", "a.mtn"):
        file = bridge.saved(name, empty)["file"]
        bridge.opened(name, file)
        bridge.opened(name, file[:-2] + "\ufffd".encode())  # a checksum damaged by an editor: needs other encodings
    assert "error" in bridge.opened("a.txt", b"?")
    bridge.checked(empty)
    bridge.differences(empty, empty)
    import traceback  # noqa: F401


def modules():
    """{path in the zip: source}"""
    library = zipimport.zipimporter(STANDARD)
    found = {}
    for module in list(sys.modules.values()):
        file = getattr(module, "__file__", None) or ""
        if file.startswith(STANDARD + "/"):
            found[file[len(STANDARD) + 1 :]] = library.get_data(file)
        elif file.startswith("/pack/"):
            with open(file, "rb") as source:
                found[file[len("/pack/") :]] = source.read()
    return found


def compiled(name, source):
    code = compile(source, name, "exec", dont_inherit=True)
    return external._code_to_hash_pyc(code, bytes(8), False)  # the hash is not checked: the zip has no sources


use_everything()
with zipfile.ZipFile("/python.zip", "w", zipfile.ZIP_DEFLATED) as zip:
    for name, source in sorted(modules().items()):
        zip.writestr(zipfile.ZipInfo(name + "c", WHEN), compiled(name, source), zipfile.ZIP_DEFLATED, 9)
