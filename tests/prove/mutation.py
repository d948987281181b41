# SPDX-License-Identifier: MIT
"""Mistakes that a tired programmer could make, written into a copy of the sources one at a time: the tests have to notice.

The table is mutations.ini. Of each mistake the copy is built and the tests are run that should notice it (`by`); only
when they do not, everything else that tools/test runs. What gets through all of it survives, and says that a test is
missing. Nothing is ever written into this tree: each process works on its own copy in a temporary folder.
"""
import configparser
import dataclasses
import os
import pathlib
import queue
import random
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time
from concurrent.futures import ThreadPoolExecutor

import proof

TITLE = "Seeded mistakes"
PROMISE = "The tests notice the mistakes that a tired programmer makes."
TABLE = pathlib.Path(__file__).with_name("mutations.ini")
LOG = proof.RESULTS / "mutation.txt"
KEYS = {"file", "was", "is", "why", "by", "only", "build", "reason"}
LEAST_CAUGHT = 0.95
SAMPLE_RUNS = 3
TEST_SECONDS, BUILD_SECONDS, REST_SECONDS = 240, 900, 3600
TIMED_OUT = 124
NO_CASE = "`only` chooses no case"
BUILD_CHECK = "build"  # of `by`: a static assertion or a linker's limit is what has to notice
# What the simulated board's tests need besides the images.
SIM_TARGETS = ["cm5sim_shared", "cm5sim", "target_runner"]
IMAGE_FOLDERS = ("motion/", "hal/", "firmware/", "linker/")  # what images are made of
NEVER_COPIED = {"build", ".git", "__pycache__", ".pytest_cache"}


@dataclasses.dataclass(frozen=True)
class Mutation:
    """An entry of the table (its head says what the fields mean)."""

    name: str
    file: str
    was: str
    becomes: str
    why: str
    by: str
    only: str = ""
    build: tuple = ()
    reason: str = ""

    def pattern(self):
        """Finds `was`, however it is indented."""
        return re.compile(r"[ \t]*\n[ \t]*".join(re.escape(line) for line in self.was.split("\n")))

    def places(self, top):
        """How often the text stands in the file; -1: no such file."""
        path = top / self.file
        return len(self.pattern().findall(path.read_text(encoding="utf-8"))) if path.exists() else -1

    @property
    def needs_board(self):
        """Whether the tests that should notice need images and the simulated board."""
        return not re.match(r"unit\.|body$|m512\.(?!flash|simulated|term)|" + BUILD_CHECK + r"$", self.by)


def read_table(path=TABLE):
    """The entries, in order. Faults of the table itself are errors."""
    parser = configparser.ConfigParser(interpolation=None, delimiters=("=",), comment_prefixes=("# ",), strict=True,
                                       empty_lines_in_values=False)
    parser.read_string(path.read_text(encoding="utf-8"))
    entries = []
    for name in parser.sections():
        section = parser[name]
        odd = set(section) - KEYS
        if odd or not all(section.get(key) for key in ("file", "was", "why", "by")) or "is" not in section:
            raise SystemExit(f"{path.name}: [{name}] needs file, was, is, why, by; unknown: {' '.join(odd) or 'nothing'}")
        entries.append(Mutation(name, section["file"], section["was"].strip(), section["is"].strip(),
                                " ".join(section["why"].split()), section["by"], section.get("only", ""),
                                tuple(section.get("build", "").split()), " ".join(section.get("reason", "").split())))
    return entries


@dataclasses.dataclass(frozen=True)
class Result:
    """The result of one mutation."""

    mutation: Mutation
    caught: bool
    by: str  # the test that failed, or what else happened
    seconds: float
    is_fault: bool = False  # of the table: it tells nothing about the tests


class Tree:
    """A copy of this tree that is built and tested with one mistake in it at a time."""

    rest_lock = threading.Lock()  # tests that keep real time are not run twice at once

    def __init__(self, folder, cores, named_only):
        self.top, self.cores, self.named_only = folder, cores, named_only
        self.stale = None  # images that were built with the last mistake in them; None: all, or nothing was built yet
        folder.mkdir(parents=True, exist_ok=True)
        self.sync()
        (self.top / "build").mkdir(exist_ok=True)
        for name in ("venv", "unity"):
            link = self.top / "build" / name
            if (proof.BUILD / name).exists() and not link.exists():
                link.symlink_to(proof.BUILD / name)
        self.environment = dict(os.environ, PYTHONDONTWRITEBYTECODE="1", PYTEST_ADDOPTS="-x")
        shared = pathlib.Path(os.environ.get("M512_SHARED", proof.TOP.parent / "shared")).resolve()
        if shared.exists():
            self.environment["M512_SHARED"] = str(shared)

    def sync(self):
        """The files of this tree, those that git knows or would (all, without git); a file that is the same keeps its time."""
        names = [str(path.relative_to(proof.TOP)) for path in proof.TOP.rglob("*")
                 if path.is_file() and not NEVER_COPIED & set(path.relative_to(proof.TOP).parts)]
        if shutil.which("git"):
            listed = subprocess.run(["git", "-C", str(proof.TOP), "ls-files", "-z", "-co", "--exclude-standard"],
                                    capture_output=True, check=False)
            if listed.returncode == 0:
                names = [name for name in listed.stdout.decode().split("\0") if name]
        known = set(names)
        for name in names:
            source, target = proof.TOP / name, self.top / name
            if source.is_file() and not (target.exists() and target.read_bytes() == source.read_bytes()):
                target.parent.mkdir(parents=True, exist_ok=True)
                shutil.copy(source, target)
        for path in self.top.rglob("*"):
            inside = path.relative_to(self.top)
            if inside.parts[0] not in NEVER_COPIED and path.is_file() and str(inside) not in known:
                path.unlink()

    def run(self, seconds, *command, **variables):
        """(output, exit status) of a command; one that takes too long is ended, with its children: TIMED_OUT."""
        with subprocess.Popen(command, cwd=self.top, env={**self.environment, **variables}, text=True, errors="replace",
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, start_new_session=True) as process:
            try:
                return process.communicate(timeout=seconds)[0], process.returncode
            except BaseException as error:
                os.killpg(process.pid, signal.SIGKILL)
                if not isinstance(error, subprocess.TimeoutExpired):
                    raise
                return process.communicate()[0], TIMED_OUT

    def configure(self, world):
        """Configures a world, once."""
        if not (self.top / "build" / world / "build.ninja").exists():
            text, status = self.run(BUILD_SECONDS, "cmake", "--preset", world, "--log-level=WARNING")
            if status != 0:
                raise SystemExit(f"mutation: cannot configure: {text}")

    def build(self, world, targets=()):
        """Builds targets of one world, or all. Returns what went wrong, or nothing."""
        self.configure(world)
        wanted = ["--target", *sorted(targets)] if targets else []
        text, status = self.run(BUILD_SECONDS, "cmake", "--build", f"build/{world}", "-j", str(self.cores), *wanted)
        if status == 0:
            return ""
        lines = [line for line in text.splitlines() if re.search(r" error: |undefined reference|overflowed| assertion", line)]
        return (lines or text.splitlines() or ["took too long"])[0].replace(f"{self.top}/", "")

    def build_for(self, mutation):
        """What the tests of `by` need. Returns what went wrong, or nothing."""
        if mutation.by == BUILD_CHECK:
            return self.build("avr", mutation.build)
        self.configure("host")
        units = [f"test_{name}" for name in re.findall(r"unit\.(\w+)", mutation.by)]
        if not mutation.needs_board:
            units += ["m512quick", "played"] if mutation.by == "body" else []
            return self.build("host", units) if units else ""
        # An image that was built with the mistake before is built anew, even if this mistake does not concern it.
        is_image = mutation.file.startswith(IMAGE_FOLDERS)
        targets = {*(mutation.build if is_image else ()), *(self.stale or ())}
        wrong = ""
        if self.stale is None or targets or (is_image and not mutation.build):
            everything = self.stale is None or (is_image and not mutation.build)
            self.stale = (set(mutation.build) or None) if is_image else set()
            wrong = self.build("avr", () if everything else targets)
        return wrong or self.build("host", [*SIM_TARGETS, *units])

    def failing(self, seconds, only, *choice):
        """The test that fails, of those that ctest's arguments choose; nothing when all pass; NO_CASE: a file has none called `only`."""
        options = "-x" + (f" -k '{only}'" if only else "")
        text, status = self.run(seconds, "ctest", "--test-dir", "build/host", "--stop-on-failure", "--no-tests=error",
                                "--output-on-failure", "--timeout", str(TEST_SECONDS), *choice, PYTEST_ADDOPTS=options)
        if status == 0:
            return ""
        if re.search(r"^\d+ deselected in ", text, re.M):   # for pytest a failure, and here the table's
            return NO_CASE
        names = re.findall(r"Test +#\d+: (\S+) .*\*\*\*", text)
        cases = re.findall(r"^FAILED \S+::(\w+)|:(test_\w+):FAIL", text, re.M)
        case = next((a or b for a, b in cases), "")
        return (names[-1] if names else "took too long" if status == TIMED_OUT else text.strip()[-200:]) + (case and f" ({case})")

    def judge(self, mutation):
        """(caught, by what, is it a fault of the table) with the mistake in the copy."""
        wrong = self.build_for(mutation)
        if wrong:
            return (True, f"build: {wrong}", False) if mutation.by == BUILD_CHECK else (False, f"does not build: {wrong}", True)
        failed = mutation.by != BUILD_CHECK and self.failing(TEST_SECONDS, mutation.only, "-R", f"^({mutation.by})$")
        if failed:
            return failed != NO_CASE, failed, failed == NO_CASE
        if mutation.reason or self.named_only:
            return False, mutation.reason or "the tests named pass", False
        with self.rest_lock:
            self.stale = None
            wrong = self.build("avr") or self.build("host")
            # What is left of chance and of real time in the tests must fail twice.
            failed = wrong and f"build: {wrong}" or self.failing(
                REST_SECONDS, "", "-E", r"^prove\.mutation$", "--repeat", "until-pass:2", "-j", str(self.cores))
        return (True, f"{failed} (not by {mutation.by})", False) if failed else (False, "every test passes", False)

    def evaluate(self, mutation):
        """Makes the mistake, finds the test that notices it, and takes it back."""
        begun = time.monotonic()
        places = mutation.places(self.top)
        if places != 1:
            return Result(mutation, False, f"its text stands {places} times in {mutation.file}", 0, True)
        path = self.top / mutation.file
        good = path.read_text(encoding="utf-8")
        found = mutation.pattern().search(good)
        indent = re.match(r"[ \t]*", good[good.rfind("\n", 0, found.start()) + 1:])[0]
        path.write_text(good[:found.start()] + mutation.becomes.replace("\n", "\n" + indent) + good[found.end():],
                        encoding="utf-8")
        try:
            caught, by, is_fault = self.judge(mutation)
        finally:
            path.write_text(good, encoding="utf-8")
        return Result(mutation, caught, by, time.monotonic() - begun, is_fault)

    def check_good(self, mutation):
        """The same tests without the mistake: they must pass, or their failing means nothing."""
        begun = time.monotonic()
        wrong = self.build_for(mutation) or self.failing(REST_SECONDS, mutation.only, "-R", f"^({mutation.by})$")
        return Result(mutation, False, f"fails without a mistake: {wrong}", time.monotonic() - begun, True) if wrong else None


def unspoilt(mutations):
    """One pseudo mutation for each test file that the mistakes name, with all of its cases that they name."""
    cases = {}
    for mutation in mutations:
        for name in mutation.by.split("|") if mutation.by != BUILD_CHECK else ():
            cases.setdefault(name, set()).add(mutation.only)
    return [Mutation("the tests without a mistake", "", "", "", "", name, "" if "" in only else " or ".join(sorted(only)))
            for name, only in sorted(cases.items())]


def run_all(mutations, options, scratch):
    """The results, in the order of the table; mistakes that unit tests notice come first, then what needs the board."""
    trees, lock, jobs = queue.SimpleQueue(), threading.Lock(), max(1, options.jobs)
    kept = proof.Kept("mutation", options.keep and not options.sample)
    work = []
    for board in (False, True):
        part = [mutation for mutation in mutations if mutation.needs_board == board]
        work += [(Tree.check_good, one) for one in unspoilt(part)] if not options.sample else []
        work += [(Tree.evaluate, one) for one in part]
    for number in range(min(jobs, len(work))):
        trees.put(Tree(scratch / f"tree{number}", max(1, proof.cores() // jobs), options.named_only))
    progress = proof.Progress("mistakes and checks", len(work))

    def do(item):
        work, mutation = item
        key = (work.__name__, mutation.name, mutation.by)
        if repr(key) in kept.found:
            result = kept.found[repr(key)] and Result(mutation, *kept.found[repr(key)])
        else:
            tree = trees.get()
            try:
                result = work(tree, mutation)
            finally:
                trees.put(tree)
        with lock:
            if repr(key) not in kept.found:
                kept.keep(key, result and [result.caught, result.by, result.seconds, result.is_fault])
            progress.advance()
            if result and not result.caught:
                print(f"   {result.mutation.name} ({result.mutation.by}): {result.by}", file=sys.stderr, flush=True)
        return result

    with ThreadPoolExecutor(max_workers=jobs) as pool:
        try:
            results = [result for result in pool.map(do, work) if result]
        except BaseException:
            pool.shutdown(cancel_futures=True)  # Ctrl-C ends it with what is under way
            raise
    kept.finish()
    order = {mutation: at for at, mutation in enumerate(mutations)}
    return sorted(results, key=lambda result: order.get(result.mutation, -1))


def add_arguments(group):
    """Options of this part."""
    group.add_argument("--only", action="append", metavar="NAME", help="of mutation: this mistake alone (again for more; a "
                       "regular expression)")
    group.add_argument("--named-only", action="store_true", help="of mutation: not the rest of the tests, when those named "
                       "do not notice")
    group.add_argument("--scratch", metavar="DIR", type=pathlib.Path, help="of mutation: keep the copies here, for a "
                       "faster next time")


def kinds(results):
    """How many mistakes which kind of test noticed."""
    count = {}
    for result in results:
        kind = re.match(r"[a-z0-9]+", result.by)[0]
        count[kind] = count.get(kind, 0) + 1
    return ", ".join(f"{number} by {kind}" for kind, number in sorted(count.items(), key=lambda item: -item[1]))


def judge_all(results, total):
    """The figures of a run."""
    caught = [result for result in results if result.caught]
    faults = [result for result in results if result.is_fault]
    survivors = [result for result in results if not result.caught and not result.is_fault]
    known = [result for result in survivors if result.mutation.reason]
    late = sum("(not by" in result.by for result in caught)
    told = "; ".join(f"{result.mutation.name}: {result.by}" for result in survivors) or "none"
    return [proof.Figure(
        f"Of seeded mistakes at least {LEAST_CAUGHT:.0%} do not get past tools/test, and each of the others has its reason",
        "each written into a copy of the sources, built, tested; --only NAME repeats one",
        f"{len(caught)} of {total} caught ({len(caught) / max(total, 1):.1%}); {kinds(caught)}; {late} of them by other tests "
        f"than expected. Survivors: {told}", len(caught) >= LEAST_CAUGHT * total and len(known) == len(survivors) and not faults, headline=True)]


def table_figure(mutations):
    """Every entry fits the sources as they are."""
    odd = [f"{mutation.name} ({mutation.places(proof.TOP)} times)" for mutation in mutations if mutation.places(proof.TOP) != 1]
    return proof.Figure("Every entry of the table fits the sources", "its text stands in its file, once",
                        f"{len(mutations) - len(odd)} of {len(mutations)} entries" + (f"; not: {', '.join(odd)}" if odd else ""),
                        not odd)


def chosen(mutations, options):
    """Returns the mutations of this run."""
    if options.only:
        found = [mutation for mutation in mutations if any(re.fullmatch(name, mutation.name) for name in options.only)]
        if not found:
            raise SystemExit(f"mutation: no mistake is called {' or '.join(options.only)} (tests/prove/{TABLE.name})")
        return found
    if options.sample:
        quick = [mutation for mutation in mutations
                 if re.fullmatch(r"unit\.\w+", mutation.by) and mutation.file.endswith(".c") and not mutation.reason]
        return random.Random(options.seed).sample(quick, min(SAMPLE_RUNS, len(quick)))
    return mutations


def run(options):
    """Runs the part and returns its figures."""
    mutations = read_table()
    fits = table_figure(mutations)
    if not fits.kept and not options.only:
        return [fits]
    picked = chosen(mutations, options)
    options.keep = not (options.only or options.named_only or options.scratch)
    with tempfile.TemporaryDirectory(prefix="m512-mutation-") as temporary:
        scratch = options.scratch.resolve() if options.scratch else pathlib.Path(temporary)
        results = run_all(picked, options, scratch)
    lines = [f"{'caught' if result.caught else 'FAULT ' if result.is_fault else 'PASSED'} {result.seconds:6.1f} s  "
             f"{result.mutation.name:<40} {result.by}" for result in results]
    if options.only or options.sample:
        print("\n".join(lines))
    else:
        proof.RESULTS.mkdir(parents=True, exist_ok=True)
        LOG.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return [fits, *judge_all(results, len(picked))]
