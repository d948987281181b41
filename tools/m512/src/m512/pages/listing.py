# SPDX-License-Identifier: MIT
"""One line per page, as text or as data."""

from __future__ import annotations

from typing import Any

from m512.files.image import Image, is_erased
from m512.files.page import SCHEDULE_TIME, Fault, Page
from m512.files.text.words import code_text
from m512.motion.player import page_seconds


def describe(image: Image, number: int, page: Page) -> dict[str, Any]:
    links = {
        name: getattr(page, field)
        for name, field in (
            ("next", "next"),
            ("exit", "exit"),
            ("link1", "link1_page"),
            ("link2", "link2_page"),
            ("right", "blend_right"),
            ("left", "blend_left"),
        )
        if getattr(page, field)
    }
    fault = "" if is_erased(page) else page.fault_text(image.kind)
    good = page.fault(image.kind) is Fault.OK
    return {
        "page": number,
        "name": page.title if good else "",
        "steps": page.steps,
        "repeat": page.repeat,
        "base": "time" if page.schedule == SCHEDULE_TIME else "speed",
        "speed": page.speed,
        "accel": page.accel,
        "code": page.code,
        "link1_code": page.link1_code,
        "link2_code": page.link2_code,
        "links": links,
        "seconds": round(page_seconds(page, bits=image.bits), 3) if good else None,
        "valid": good,
        "erased": is_erased(page),
        "fault": fault,
    }


def table(rows: list[dict[str, Any]]) -> str:
    lines = [f"{'page':>4}  {'name':13}  {'steps':>5}  {'times':>5}  {'seconds':>7}  {'code':6}  links"]
    for row in rows:
        if row["erased"]:
            lines.append(f"{row['page']:4}  (erased flash)")
        elif row["fault"]:
            lines.append(f"{row['page']:4}  DAMAGED: {row['fault']}")
        elif not row["page"]:
            lines.append(f"{row['page']:4}  (trim)")
        else:
            lines.append(
                f"{row['page']:4}  {row['name']:13}  {row['steps']:5}  {row['repeat']:5}  {row['seconds']:7.2f}  "
                f"{code_text(row['code']) if row['code'] else '':6}  {_links(row)}".rstrip()
            )
    return "\n".join(lines)


def _links(row: dict[str, Any]) -> str:
    out = []
    for name, target in row["links"].items():
        code = f"({code_text(row[name + '_code'])})" if name.startswith("link") else ""
        out.append(f"{name}{code} {target}")
    return "  ".join(out)
