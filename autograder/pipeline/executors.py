"""Judges submissions side by side, in processes of this machine or on a Dask cluster."""

import multiprocessing
import os
import signal
import threading
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import (
    FIRST_COMPLETED,
    BrokenExecutor,
    Executor,
    Future,
    ProcessPoolExecutor,
    wait,
)
from multiprocessing.connection import wait as wait_for_end
from typing import TypeVar

AHEAD = 3  # submissions under way per process
# Each process gets one thread, or they would take the cores from each other.
ONE_THREAD = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS")


Result = TypeVar("Result")


def outcomes(
    work: Callable[..., Result], tasks: Iterable[tuple[str, tuple]], pool
) -> Iterator[tuple[str, Result | Exception]]:
    """(name, what `work` returned or raised) of each (name, arguments), as they come.

    When a process dies, any task under way may be to blame. So each of them is tried again, alone, and
    only a task that kills its process again is given up.
    """
    waiting = iter(tasks)
    running: dict[Future, tuple[str, tuple]] = {}
    suspects: list[tuple[str, tuple]] = []
    while True:
        broken = False
        while len(running) < pool.window and not broken:
            task = next(waiting, None)
            if task is None:
                break
            try:
                running[pool.executor().submit(work, *task[1])] = task
            except BrokenExecutor:
                suspects.append(task)
                broken = True
        if not running and not broken:
            break
        for future in wait(running, return_when=FIRST_COMPLETED).done:
            name, arguments = running.pop(future)
            outcome: Result | Exception
            try:
                outcome = future.result()
            except BrokenExecutor:
                suspects.append((name, arguments))
                broken = True
            except Exception as error:
                outcome = error
            if (name, arguments) not in suspects:
                yield name, outcome
        if broken:
            suspects += running.values()
            running.clear()
            pool.close()
    for name, arguments in suspects:
        try:
            yield name, pool.executor().submit(work, *arguments).result()
        except Exception as error:
            yield name, error
            pool.close()


class Processes:
    """Processes of this machine; started when first needed, and again after one died.

    preload: what they import. share() is called here and gives a handle on something that is costly to
    start, or None; each process calls use_shared with that handle.
    """

    def __init__(self, jobs: int, preload: tuple[str, ...], share: Callable, use_shared: Callable):
        if jobs < 1:
            raise ValueError(f"jobs is {jobs}; it must be at least 1")
        self.window = AHEAD * jobs
        self._jobs, self._preload = jobs, preload
        self._share, self._use_shared = share, use_shared
        self._executor: Executor | None = None
        self._warming: threading.Thread | None = None
        self._shared = None

    def __enter__(self):
        return self

    def __exit__(self, *exception):
        self.close()

    def executor(self) -> Executor:
        self._wait()
        return self._started()

    def _wait(self) -> None:
        if self._warming is not None:
            self._warming.join()
            self._warming = None

    def _started(self) -> Executor:
        if self._executor is None:
            for name in ONE_THREAD:
                os.environ.setdefault(name, "1")
            # Not a fork of this process, which has threads and an open database.
            servers = "forkserver" in multiprocessing.get_all_start_methods()
            context = multiprocessing.get_context("forkserver" if servers else "spawn")
            if servers:
                context.set_forkserver_preload(list(self._preload))
                from multiprocessing import forkserver  # not on Windows

                forkserver.ensure_running()  # it imports while `share` starts what it shares
            self._shared = self._share()
            begin = (self._use_shared, self._shared)
            self._executor = ProcessPoolExecutor(self._jobs, context, _begin, begin)
        return self._executor

    def warm(self, load: Callable) -> None:
        """Start the processes now, and call `load` in each, while this process gets ready."""

        def start():
            for _ in range(self._jobs):
                self._started().submit(load)

        self._warming = threading.Thread(target=start)
        self._warming.start()

    def close(self) -> None:
        self._wait()
        if self._executor is not None:
            self._executor.shutdown(cancel_futures=True)
            self._executor = None
        if self._shared is not None:
            self._shared.close()
            self._shared = None


def _begin(use_shared: Callable, shared) -> None:
    """Prepare a new process: it leaves Ctrl-C to the parent, and ends with it."""
    use_shared(shared)
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    parent = multiprocessing.parent_process()
    assert parent is not None

    def follow():
        wait_for_end([parent.sentinel])
        os._exit(1)

    threading.Thread(target=follow, daemon=True).start()


class Cluster:
    """A Dask cluster; its scheduler gives the work of a lost worker to the others."""

    def __init__(self, address: str):
        try:
            from distributed import Client
        except ImportError:
            raise ValueError("--scheduler needs Dask: pip install 'armdyn[cluster]'") from None
        try:
            self._client = Client(address)
        except TypeError as error:  # what Dask raises where its settings name no certificate
            raise ValueError(
                f"{address} asks for a certificate, and Dask's settings name none; "
                "docs/workers.md says how to make one"
            ) from error
        self._executor = self._client.get_executor(pure=False)

    def __enter__(self):
        return self

    def __exit__(self, *exception):
        self.close()
        self._client.close()

    @property
    def window(self) -> int:
        return AHEAD * max(1, sum(self._client.nthreads().values()))

    def executor(self) -> Executor:
        return self._executor

    def warm(self, load: Callable) -> None:
        """Do nothing: the workers run already."""

    def close(self) -> None:
        self._executor.shutdown()
