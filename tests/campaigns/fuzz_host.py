# SPDX-License-Identifier: MIT
"""The harnesses of tests/campaigns/fuzz, with libFuzzer or with random inputs. Used by fuzz.py."""

import dataclasses
import pathlib
import re
import shutil
import subprocess
import tarfile

from tests.campaigns import proof

HERE = proof.TOP / "tests" / "campaigns" / "fuzz"
FUZZERS = proof.BUILD / "fuzz"
REPLAYS = proof.BUILD / "host" / "tests" / "campaigns" / "fuzz"
CORPUS = REPLAYS / "corpus"  # the build unpacks it from the archives in fuzz/corpus
NAMES = sorted(path.stem[5:] for path in HERE.glob("fuzz_*.c") if path.stem not in ("fuzz_image", "fuzz_pages"))  # helpers, not harnesses
LONGEST = {
    "page": 513,
    "bus": 400,
    "remote": 200,
    "settings": 160,
    "journal": 140,
    "player": 500,
    "layers": 700,
    "loader": 1200,
    "play": 1000,
    "edit": 1000,
}
# libFuzzer uses wall-clock time. On a busy machine its limit of 10 s for a slow input is meaningless.
PATIENCE = ["-timeout=1200", "-report_slow_units=1200"]
ENVIRONMENT = {"ASAN_OPTIONS": "detect_leaks=0:handle_abort=1", "UBSAN_OPTIONS": "print_stacktrace=1"}


@dataclasses.dataclass(frozen=True)
class Run:
    """The result of one harness."""

    name: str
    executions: int
    edges: int
    corpus: int
    finding: str  # "", or the fault and how to repeat it


def build():
    """Builds the libFuzzer programs. Returns false if there is no clang or it has no libFuzzer."""
    host = proof.BUILD / "host"
    targets = subprocess.run(
        ["cmake", "--build", str(host), "--target", "fuzzers", *(f"fuzz_{name}" for name in NAMES)], capture_output=True, text=True, check=False
    )
    if targets.returncode:
        raise RuntimeError(f"the harnesses do not build:\n{(targets.stdout + targets.stderr)[-3000:]}")
    return all((FUZZERS / f"fuzz_{name}").exists() for name in NAMES)


def replay(task):
    """Runs the plain program on the corpus and on random variations of it. task: (name, number of variations, seed)."""
    name, runs, seed = task
    work = proof.RESULTS / "fuzz" / name
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir(parents=True)
    done = subprocess.run(
        [REPLAYS / f"fuzz_{name}", f"-runs={runs}", f"-seed={seed}", f"-max_len={LONGEST[name]}", f"-artifact_prefix={work}/", CORPUS / name],
        capture_output=True,
        text=True,
        errors="replace",
        check=False,
    )
    counted = re.search(r"^(\d+) inputs$", done.stdout, re.M)
    finding = ""
    if done.returncode or not counted:
        made = [path for path in work.iterdir() if path.is_file()]
        named = (made or [CORPUS / name])[0].relative_to(proof.TOP)
        finding = f"{name}: {what_was_said(done.stderr)}: {(REPLAYS / f'fuzz_{name}').relative_to(proof.TOP)} {named}"
    return Run(name, int(counted[1]) if counted else 0, 0, len(list((CORPUS / name).iterdir())), finding)


def what_was_said(output):
    """Returns the line of the output that names the finding."""
    said = re.search(r"ASSERT\(.*|runtime error: .*|ERROR: (?:AddressSanitizer|libFuzzer): .*", output)
    return said.group(0) if said else output.strip()[-200:]


def search(task):
    """Runs libFuzzer from the corpus. task: (name, limit, seed, keep). limit: an option of libFuzzer. keep: adds new inputs to the
    corpus."""
    name, limit, seed, keep = task
    work = proof.RESULTS / "fuzz" / name
    shutil.rmtree(work, ignore_errors=True)
    (work / "found").mkdir(parents=True)
    command = [
        FUZZERS / f"fuzz_{name}",
        limit,
        f"-seed={seed}",
        f"-max_len={LONGEST[name]}",
        *PATIENCE,
        "-len_control=0",
        "-print_final_stats=1",
        "-verbosity=1",
        f"-artifact_prefix={work}/",
    ]
    words = HERE / f"{name}.dict"
    command += [f"-dict={words}"] if words.exists() else []
    done = subprocess.run([*command, work / "found", CORPUS / name], capture_output=True, text=True, errors="replace", check=False, env=ENVIRONMENT)
    executions = re.findall(r"number_of_executed_units:\s*(\d+)", done.stderr)
    edges = re.findall(r"cov: (\d+)", done.stderr)
    artifacts = [path for path in work.iterdir() if path.is_file()]
    finding = ""
    if done.returncode or artifacts:
        finding = describe(name, artifacts, done.stderr)
    if keep:
        merge(name, work)
    return Run(name, int(executions[-1]) if executions else 0, int(edges[-1]) if edges else 0, len(list((CORPUS / name).iterdir())), finding)


def describe(name, artifacts, output):
    """Shrinks a finding. Returns it with the command that repeats it."""
    where = pathlib.Path(artifacts[0]) if artifacts else None
    if where:
        small = where.with_name("smallest")
        subprocess.run(
            [FUZZERS / f"fuzz_{name}", "-minimize_crash=1", "-runs=20000", "-max_total_time=20", f"-exact_artifact_path={small}", where],
            capture_output=True,
            check=False,
            env=ENVIRONMENT,
        )
        where = small if small.exists() else where
    return f"{name}: {what_was_said(output)}: {(REPLAYS / f'fuzz_{name}').relative_to(proof.TOP)} {where.relative_to(proof.TOP) if where else ''}"


def merge(name, work):
    """Replaces the corpus by the fewest inputs, old and new, that reach the same code."""
    small = work / "small"
    small.mkdir()
    subprocess.run(
        [FUZZERS / f"fuzz_{name}", "-set_cover_merge=1", "-use_counters=0", f"-max_len={LONGEST[name]}", small, CORPUS / name, work / "found"],
        capture_output=True,
        check=False,
        env=ENVIRONMENT,
    )
    if any(small.iterdir()):
        shutil.rmtree(CORPUS / name)
        (CORPUS / name).mkdir()
        for path in small.iterdir():
            shutil.copy(path, CORPUS / name / path.name[:12])
        pack(name)


def pack(name):
    """Writes the inputs of a harness to its archive. The same inputs give the same bytes."""
    with tarfile.open(HERE / "corpus" / f"{name}.tar.xz", "w:xz") as archive:
        for path in sorted((CORPUS / name).iterdir()):
            about = tarfile.TarInfo(path.name)
            about.size = path.stat().st_size
            with path.open("rb") as content:
                archive.addfile(about, content)
