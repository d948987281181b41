# SPDX-License-Identifier: MIT
"""What every proof has in common: its figures, its work on all cores, its page.

A proof is a module of this folder with

    TITLE                       a heading
    PROMISE                     one sentence: what a user may rely on when every figure is kept
    __doc__                     its first paragraph stands below the heading of its page
    add_arguments(group)        its own options (argparse), such as the one that repeats a single state
    run(options) -> [Figure]    does the work; options.sample asks for a minute's worth (CI), options.jobs is how many
                                processes may run, options.seed chooses what is left to chance

tools/prove runs them and writes two kinds of pages: tests/PROOFS.md, a row a part, and tests/proofs/<part>.md, a row a
figure. A proof never stops at the first fault: it counts all, and says of each how
to see it again.
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
MOTIONS = ("tools/body/src", "tools/body/humanoid.xml", "tools/motions", "tools/sim/servo")
JUDGED = {  # the code of which a part's figures speak
    "power": IMAGES,
    "fuzz": (*IMAGES, "tools/m512/src"),
    "faults": IMAGES,
    "links": ("firmware/boot", "firmware/common", "hal", "tools/m512/src"),
    "endurance": IMAGES,
    "static": IMAGES,
    "physics": MOTIONS,
    "shape": (*IMAGES, *MOTIONS),
    "sessions": IMAGES,
}
BY_GOALS = ("physics",)  # parts that judge the player by the goals that it makes (goals_of_motions), not by its source
STOP, STOP_TICK, TICKS = 255, 1200, 4000
CODE = (".c", ".h", ".in", ".py", ".m512", ".xml", ".json")


@dataclasses.dataclass(frozen=True)
class Figure:
    """One promise and what this run measured of it."""

    promise: str  # one sentence, as a user would read it
    how: str  # how it is tested
    measured: str  # what this run gave, with units
    kept: bool  # the promise held everywhere
    headline: bool = False  # `measured`, up to its first semicolon, stands on the short page


def commit():
    """The commit of the tree, marked when the tree differs from it; the page itself does not count."""

    def git(*words):
        return subprocess.run(["git", "-C", str(TOP), *words], capture_output=True, text=True, check=False).stdout.strip()

    if not shutil.which("git"):
        return "no commit"
    changed = [line for line in git("status", "--porcelain").splitlines() if PAGE.name not in line and f"{DETAILS.name}/" not in line]
    return (git("rev-parse", "--short=10", "HEAD") or "no commit") + (" and changes" if changed else "")


def git_files(*places):
    """The files below these places that git tracks and that are there."""
    listed = subprocess.run(["git", "-C", str(TOP), "ls-files", "-z", *places], capture_output=True, text=True, check=False).stdout
    return [TOP / name for name in sorted(listed.split("\0")) if name and (TOP / name).exists()]


def goals_of_motions():
    """A digest of the goals of our motion library: each page, played once by the exact law from its first pose, with a stop on the way, so
    that exit pages are played too. The C player must be built (host:played)."""
    from m512.files.formats import load  # here, because no other part needs the C player
    from tests.models.played import ENDED, EXACT, JOINTS, Played

    image, found = load(TOP / "tools" / "motions" / "motions.m512"), hashlib.sha256()
    for number, page in image.items():
        if not number or not page.is_playable:
            continue
        words = {joint: page.word(0, joint) for joint in range(JOINTS)}
        play = Played(image.to_bytes(), number, EXACT, positions={joint: word for joint, word in words.items() if word < 1024})
        for tick in range(TICKS):
            if tick == STOP_TICK:
                play.code(STOP)
            has_ended = play.tick() & ENDED
            found.update(f"{number} {tick} {play.goals()}".encode())
            if has_ended:
                break
    return found.hexdigest()


def code(part):
    """Ten digits that change when what this part judges changes: its code, but no comment or blank in C, or the goals of our motions."""
    found = hashlib.sha256((goals_of_motions() if part in BY_GOALS else "").encode())
    for path in git_files(*JUDGED.get(part, ())):
        if path.suffix not in CODE or "tests" in path.relative_to(TOP).parts:
            continue
        text = path.read_text(encoding="utf-8")
        if path.suffix in (".c", ".h", ".in"):
            text = "".join(re.sub(r"/\*.*?\*/|//[^\n]*", "", text, flags=re.S).split())
        found.update(f"{path.relative_to(TOP)}\0{text}\0".encode())
    return found.hexdigest()[:10]


class Kept:
    """Results of a whole run, kept as they come: a line an item in build/prove/PART.jsonl. A run that was interrupted goes on where it
    was, if the tree is still the same commit without changes; a run that ends forgets them."""

    def __init__(self, part, is_whole=True):
        self.path, self.commit, self.found = RESULTS / f"{part}.jsonl", commit(), {}
        self.is_on = is_whole and "changes" not in self.commit and self.commit != "no commit"
        if self.is_on and self.path.exists():
            lines = map(json.loads, self.path.read_text(encoding="utf-8").splitlines())
            self.found = {line["item"]: line["result"] for line in lines if line["commit"] == self.commit}

    def keep(self, item, result):
        """result: what JSON can say; tuples come back as lists."""
        self.found[repr(item)] = result
        if self.is_on:
            self.path.parent.mkdir(parents=True, exist_ok=True)
            with self.path.open("a", encoding="utf-8") as file:
                file.write(json.dumps({"commit": self.commit, "item": repr(item), "result": result}) + "\n")

    def each(self, work, items, what, jobs):
        """campaign.each() over what is not done yet; the results of all."""
        items = list(items)
        each(work, [item for item in items if repr(item) not in self.found], what, jobs, done=self.keep)
        return [self.found[repr(item)] for item in items]

    def finish(self):
        """Call at the end of the run: forgets the results kept for going on."""
        if self.is_on:
            self.path.unlink(missing_ok=True)


def keep(name, module, figures, command):
    """Writes the result of a whole part: build/prove/NAME.json, and its page."""
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
    """The figures as rows of Markdown."""
    rows = ["| promise | how it is tested | measured | |", "| --- | --- | --- | --- |"]
    for figure in figures:
        cells = [figure["promise"], figure["how"], figure["measured"], "kept" if figure["kept"] else "**BROKEN**"]
        rows.append("| " + " | ".join(cell.replace("|", "\\|").replace("\n", " ") for cell in cells) + " |")
    return rows


def figures_on_page(name):
    """The figures of tests/proofs/NAME.md, as write_details() got them but for their headlines; [] if there is no such page."""
    path = DETAILS / f"{name}.md"
    text = path.read_text(encoding="utf-8") if path.exists() else ""
    found = []
    for line in [line for line in text.splitlines() if line.startswith("| ")][2:]:
        promise, how, measured, kept = (cell.replace("\\|", "|") for cell in re.split(r" (?<!\\)\| ", line[2:-2]))
        found.append(dataclasses.asdict(Figure(promise, how, measured, kept == "kept")))
    return found


def headline(figures):
    """What stands on the short page of a part's figures."""
    broken = [figure for figure in figures if not figure["kept"]]
    if broken:
        return f"**{len(broken)} of {len(figures)} broken**"
    short = [figure["measured"].split(";")[0] for figure in figures if figure["headline"]]
    return "; ".join(short or [f"{len(figures)} of {len(figures)} figures kept"])


FOUND = "Found: {found}; by `{command}` at commit {commit}, code {code}."
AGAIN = "A sample again at commit {commit}: {found}."


def pattern(line):
    """The pattern that finds such a line."""
    return re.compile("^" + re.sub(r"\\{(\w+)\\}", r"(?P<\1>.*?)", re.escape(line)) + "$", re.M)


def write_details(name, part):
    """tests/proofs/NAME.md. The row of the short page is made from its head (row_of)."""
    DETAILS.mkdir(exist_ok=True)
    found = FOUND.format(found=headline(part["figures"]), command=part["command"], commit=part["commit"], code=part["code"])
    lines = [f"# {part['title']}", "", part["promise"], "", found, "", part["about"], "", *table(part["figures"])]
    (DETAILS / f"{name}.md").write_text("\n".join(lines) + "\n", encoding="utf-8")


def note_sample(name, figures):
    """What a sample found goes to the page of the last whole run, below what that found, in the place of the sample before."""
    path = DETAILS / f"{name}.md"
    text = path.read_text(encoding="utf-8")
    before = pattern(AGAIN).search(text)
    if before:
        text = text[: before.start()].rstrip() + text[before.end() :]
    found = pattern(FOUND).search(text)
    note = AGAIN.format(commit=commit(), found=headline([dataclasses.asdict(figure) for figure in figures]))
    path.write_text(f"{text[: found.end()]}\n\n{note}{text[found.end() :]}", encoding="utf-8")


def is_current(name):
    """Whether the last whole run judged the code that is here now."""
    return pattern(FOUND).search((DETAILS / f"{name}.md").read_text(encoding="utf-8"))["code"] == code(name)


def commit_on_page(name):
    """The commit of the last whole run, from the part's page."""
    return pattern(FOUND).search((DETAILS / f"{name}.md").read_text(encoding="utf-8"))["commit"]


def row_of(name):
    """The row of a part, from its page."""
    text = (DETAILS / f"{name}.md").read_text(encoding="utf-8")
    title, promise = re.match(r"# (.*)\n\n(.*)\n", text).groups()
    found, again = pattern(FOUND).search(text), pattern(AGAIN).search(text)
    at = found["commit"] + (f"; a sample again at {again['commit']}: {again['found']}" if again else "")
    age = "" if is_current(name) else "\U0001f534 older than the code"
    return f"| [{title}](proofs/{name}.md) | {promise} | {found['found']} | `{found['command']}` | {at} | {age} |"


def write_page(names):
    """tests/PROOFS.md: a row for each part that has a page in tests/proofs/, in the order of `names`."""
    rows = [row_of(name) for name in names if (DETAILS / f"{name}.md").exists()]
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
