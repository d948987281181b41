# SPDX-License-Identifier: MIT
"""What all proofs share: figures, work on all cores, pages.

A proof is a module of this folder with

    TITLE                       a heading
    PROMISE                     one sentence: what a user may rely on when every figure is kept
    __doc__                     its first paragraph appears below the heading of its page
    add_arguments(group)        its own options (argparse), such as the one that repeats a single state
    run(options) -> [Figure]    does the work; options.sample requests a minute's worth (CI), options.jobs is the number of
                                processes, options.seed selects the random choices

tools/prove runs the proofs and writes two kinds of pages: tests/PROOFS.md with a row for each part, and tests/proofs/<part>.md with a row
for each figure. A proof does not stop at the first fault. It counts all faults and says how to repeat each.
"""

import dataclasses
import hashlib
import json
import pathlib
import re
import shutil
import subprocess

from campaign import Progress, cores, each  # noqa: F401  (what proofs run their work with)

TOP = pathlib.Path(__file__).resolve().parents[2]
BUILD = TOP / "build"
RESULTS = BUILD / "prove"
PAGE = TOP / "tests" / "PROOFS.md"
DETAILS = TOP / "tests" / "proofs"


IMAGES = ("firmware", "hal", "linker", "motion")
MOTIONS = ("motion", "tools/body/src", "tools/body/humanoid.xml", "tools/motions", "tools/sim/servo")
JUDGED = {  # the parts, and the code that each one's figures judge
    "power": IMAGES,
    "fuzz": (*IMAGES, "tools/m512/src"),
    "faults": IMAGES,
    "links": ("tools/m512/src",),
    "physics": MOTIONS,
    "shape": ("firmware/common", "firmware/play", "hal", ":!hal/host", "linker", *MOTIONS),
    "sessions": IMAGES,
}
CODE = (".c", ".h", ".in", ".py", ".m512", ".xml", ".json")


@dataclasses.dataclass(frozen=True)
class Figure:
    """One promise and this run's measurement of it."""

    promise: str  # one sentence, as a user would read it
    how: str  # how it is tested
    measured: str  # this run's result, with units
    kept: bool  # the promise held in every case
    headline: bool = False  # `measured`, up to its first semicolon, appears on the short page


def commit():
    """Returns the commit of the tree, marked if the tree has changes. Changes of the pages themselves do not count."""

    def git(*words):
        return subprocess.run(["git", "-C", str(TOP), *words], capture_output=True, text=True, check=False).stdout.strip()

    if not shutil.which("git"):
        return "no commit"
    changed = [line for line in git("status", "--porcelain").splitlines() if PAGE.name not in line and f"{DETAILS.name}/" not in line]
    return (git("rev-parse", "--short=10", "HEAD") or "no commit") + (" and changes" if changed else "")


def git_files(*places):
    """Returns the existing files below these places that git tracks."""
    listed = subprocess.run(["git", "-C", str(TOP), "ls-files", "-z", *places], capture_output=True, text=True, check=False).stdout
    return [TOP / name for name in sorted(listed.split("\0")) if name and (TOP / name).exists()]


def code(part):
    """Returns ten digits that change when the part's subject changes: its code, without comments (docstrings of Python count)."""
    found = hashlib.sha256()
    for path in git_files(*JUDGED.get(part, ())):
        if path.suffix not in CODE or "tests" in path.relative_to(TOP).parts:
            continue
        text = path.read_text(encoding="utf-8")
        if path.suffix in (".c", ".h", ".in"):
            text = "".join(re.sub(r"/\*.*?\*/|//[^\n]*", "", text, flags=re.S).split())
        elif path.suffix == ".py":
            text = "\n".join(line.rstrip() for line in text.splitlines() if line.strip() and not line.lstrip().startswith("#"))
        found.update(f"{path.relative_to(TOP)}\0{text}\0".encode())
    return found.hexdigest()[:10]


class Kept:
    """Results of a whole run, saved as they arrive: one line per item in build/prove/PART.jsonl. An interrupted run resumes if the tree
    is still at the same commit without changes. A completed run deletes them."""

    def __init__(self, part, is_whole=True):
        self.path, self.commit, self.found = RESULTS / f"{part}.jsonl", commit(), {}
        self.is_on = is_whole and "changes" not in self.commit and self.commit != "no commit"
        if self.is_on and self.path.exists():
            lines = map(json.loads, self.path.read_text(encoding="utf-8").splitlines())
            self.found = {line["item"]: line["result"] for line in lines if line["commit"] == self.commit}

    def keep(self, item, result):
        """result: a JSON value. Tuples come back as lists."""
        self.found[repr(item)] = result
        if self.is_on:
            self.path.parent.mkdir(parents=True, exist_ok=True)
            with self.path.open("a", encoding="utf-8") as file:
                file.write(json.dumps({"commit": self.commit, "item": repr(item), "result": result}) + "\n")

    def each(self, work, items, what, jobs):
        """Runs campaign.each() over the items not done yet. Returns the results of all items."""
        items = list(items)
        each(work, [item for item in items if repr(item) not in self.found], what, jobs, done=self.keep)
        return [self.found[repr(item)] for item in items]

    def finish(self):
        """Deletes the saved results. Call it at the end of the run."""
        if self.is_on:
            self.path.unlink(missing_ok=True)


def keep(name, module, figures, command):
    """Writes the result of a complete part: build/prove/NAME.json and its page."""
    RESULTS.mkdir(parents=True, exist_ok=True)
    about = " ".join((module.__doc__ or "").split("\n\n")[0].split())
    part = {
        "title": module.TITLE,
        "promise": module.PROMISE,
        "about": about,
        "command": command,
        "commit": commit(),
        "code": code(name),
        "figures": [dataclasses.asdict(figure) for figure in figures],
    }
    (RESULTS / f"{name}.json").write_text(json.dumps(part, indent=1), encoding="utf-8")
    write_details(name, part)


def table(figures):
    """Returns the figures as rows of Markdown."""
    rows = ["| promise | how it is tested | measured | |", "| --- | --- | --- | --- |"]
    for figure in figures:
        cells = [figure["promise"], figure["how"], figure["measured"], "kept" if figure["kept"] else "**BROKEN**"]
        rows.append("| " + " | ".join(cell.replace("|", "\\|").replace("\n", " ") for cell in cells) + " |")
    return rows


def headline(figures):
    """Returns the text on the short page for a part's figures."""
    broken = [figure for figure in figures if not figure["kept"]]
    if broken:
        return f"**{len(broken)} of {len(figures)} broken**"
    short = [figure["measured"].split(";")[0] for figure in figures if figure["headline"]]
    return "; ".join(short or [f"{len(figures)} of {len(figures)} figures kept"])


FOUND = "Found: {found}; by `{command}` at commit {commit}, code {code}."


def pattern(line):
    """Returns the pattern that matches lines made from this template."""
    return re.compile("^" + re.sub(r"\\{(\w+)\\}", r"(?P<\1>.*?)", re.escape(line)) + "$", re.M)


def write_details(name, part):
    """Writes tests/proofs/NAME.md. row_of() makes the row of the short page from its head."""
    DETAILS.mkdir(exist_ok=True)
    found = FOUND.format(found=headline(part["figures"]), command=part["command"], commit=part["commit"], code=part["code"])
    lines = [f"# {part['title']}", "", part["promise"], "", found, "", part["about"], "", *table(part["figures"])]
    (DETAILS / f"{name}.md").write_text("\n".join(lines) + "\n", encoding="utf-8")


def is_current(name):
    """Returns whether the last whole run judged the present code."""
    return pattern(FOUND).search((DETAILS / f"{name}.md").read_text(encoding="utf-8"))["code"] == code(name)


def row_of(name):
    """Returns a part's row of the short page, made from the part's page."""
    text = (DETAILS / f"{name}.md").read_text(encoding="utf-8")
    title, promise = re.match(r"# (.*)\n\n(.*)\n", text).groups()
    found = pattern(FOUND).search(text)
    age = "" if is_current(name) else "\U0001f534 older than the code"
    return f"| [{title}](proofs/{name}.md) | {promise} | {found['found']} | `{found['command']}` | {found['commit']} | {age} |"


def write_page():
    """Writes tests/PROOFS.md: one row for each part that has a page in tests/proofs/."""
    rows = [row_of(name) for name in JUDGED if (DETAILS / f"{name}.md").exists()]
    PAGE.write_text(
        "\n".join(
            [
                "# Proofs",
                "",
                "What Motion512 promises, and what machines found when they tried to break it. `tools/prove` makes this page; "
                "do not edit it. A row is older than the code when the code that it judges has changed since.",
                "",
                "| | promise | found | command | at commit | |",
                "| --- | --- | --- | --- | --- | --- |",
                *rows,
            ]
        )
        + "\n",
        encoding="utf-8",
    )
