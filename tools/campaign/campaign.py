# SPDX-License-Identifier: MIT
"""Runs many jobs of one kind, on the cores of this machine or on the machines of a Dask scheduler.

    from campaign import each
    results = each(work, items, "bodies", jobs=4)                      # processes of this machine
    results = each(work, items, "bodies", scheduler="tcp://10.0.0.5:8786")

work(item) is a function of a module (or a functools.partial of one). It and the items are pickled. Results come in the order of
the items, wherever they were computed. So a job must take all randomness from its item (a seed) and depend on nothing local.

With a scheduler, every machine needs a tree like this one, built and with Dask (`tools/dev/setup campaign`), at any path. Its
build/venv/bin/dask starts a worker.
"""

import concurrent.futures
import os
import pickle
import sys

ANSWER_S = 10  # how long each() waits for a scheduler
_scheduler = None


class Progress:
    """Shows the progress of a campaign as one line on standard error; as a few separate lines if that is no terminal."""

    def __init__(self, what, total):
        self.what, self.total, self.done = what, total, 0
        self.step = max(1, total // (200 if sys.stderr.isatty() else 10))

    def advance(self, count=1):
        """Adds `count` to the completed items."""
        before, self.done = self.done // self.step, self.done + count
        if self.done // self.step != before or self.done >= self.total:
            start, end = ("\r", "" if self.done < self.total else "\n") if sys.stderr.isatty() else ("", "\n")
            print(f"{start}   {self.what}: {self.done} of {self.total}", end=end, file=sys.stderr, flush=True)


def cores():
    """How many processes can run at once."""
    return len(os.sched_getaffinity(0))


def use(scheduler):
    """Sets the default for each(): the address of a Dask scheduler, or None for this machine."""
    global _scheduler
    _scheduler = scheduler


def each(work, items, what, jobs=None, scheduler=None, done=None):
    """[work(item) for item in items], in the order of the items, with progress. An exception in a job ends the campaign.

    jobs: processes at once (None: one per core); with a scheduler its workers decide. ConnectionError: no scheduler answers.
    done(item, result): called in this process as soon as a job has ended, so that an interrupted campaign keeps its results.
    """
    items = list(items)
    address = scheduler or _scheduler
    progress = Progress(what, len(items))
    results = [None] * len(items)
    for index, result in (_on_scheduler if address else _here)(work, items, address or jobs):
        results[index] = result
        if done:
            done(items[index], result)
        progress.advance()
    return results


def _here(work, items, jobs):
    with concurrent.futures.ProcessPoolExecutor(max_workers=jobs or cores()) as pool:
        waiting = {pool.submit(work, item): index for index, item in enumerate(items)}
        try:
            for done in concurrent.futures.as_completed(waiting):
                yield waiting[done], done.result()
        finally:
            pool.shutdown(cancel_futures=True)


def _on_scheduler(work, items, address):
    try:
        import cloudpickle
        from distributed import Client, as_completed
    except ModuleNotFoundError as missing:
        raise ConnectionError(f"a scheduler needs Dask ({missing}); run: tools/dev/setup campaign") from None
    cloudpickle.register_pickle_by_value(sys.modules[__name__])  # so that _call can report what a worker lacks
    try:
        client = Client(address, timeout=ANSWER_S)
    except OSError as error:
        raise ConnectionError(f"no Dask scheduler answers at {address} ({error})") from None
    with client:
        futures = client.map(_call, [pickle.dumps((work, item)) for item in items], pure=False)
        index_of = {future.key: index for index, future in enumerate(futures)}
        for future, result in as_completed(futures, with_results=True):
            yield index_of[future.key], result


def _call(pickled):
    """Runs one job on a worker. It is sent by value, so it has its own imports."""
    import pickle

    try:
        work, item = pickle.loads(pickled)
    except ModuleNotFoundError as missing:
        raise ModuleNotFoundError(f"{missing}: this worker lacks Motion512; start it with build/venv/bin/dask of a tree that is built") from None
    return work(item)
