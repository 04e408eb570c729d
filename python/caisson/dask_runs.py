# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs of a study on the workers of Dask (python3-distributed), which share the folder
of the results and can import this package. Nothing else needs Dask."""
from collections.abc import Sequence
from typing import Any

from caisson.needed import DASK, sentence
from caisson.runner import RunError
from caisson.study import StudyError, StudyRun, longest_first

WAIT = 10  # s, for an answer of the scheduler


def client_of(address: str) -> Any:
    """Return a client of the scheduler at an address, as tcp://host:8786. Raises
    StudyError where there is none, or no Dask."""
    try:
        from distributed import Client
    except ModuleNotFoundError as error:
        raise StudyError(f"--dask: {sentence(DASK, 'python')}") from error
    try:
        client = Client(address, timeout=WAIT)
    except (OSError, ValueError, TimeoutError) as error:
        raise StudyError(
            f"--dask: no scheduler answers at {address}; start one by dask-scheduler,"
            " and workers by dask-worker"
        ) from error
    if not client.nthreads():
        client.close()
        raise StudyError(
            f"--dask: the scheduler at {address} has no worker; start some by"
            f" `PYTHONPATH=python dask-worker {address}`"
        )
    return client


def run_there(
    run: StudyRun, again: bool, limit: float | None
) -> tuple[str | None, str]:
    """Run it on a worker; return its trouble, and what it says."""
    said = list[str]()
    try:
        run.execute(again, limit, say=said.append)
    except (RunError, OSError) as error:
        run.trouble = f"{type(error).__name__}: {error}"
    return run.trouble, "".join(said)


def execute(
    runs: Sequence[StudyRun], address: str, again: bool, limit: float | None
) -> None:
    """Run all, the longest first, as study.execute() does. limit: of the time of each
    (s). Raises StudyError."""
    client = client_of(address)
    from distributed import as_completed

    with client:
        workers = sum(client.nthreads().values())
        print(f"runs to do: {len(runs)}, {workers} at a time by Dask", flush=True)
        waiting = {
            client.submit(run_there, run, again, limit, pure=False): run
            for run in longest_first(runs)
        }
        for future in as_completed(waiting):
            run = waiting[future]
            try:
                run.trouble, said = future.result()
            except Exception as error:  # whatever a worker hands on
                run.trouble = f"{type(error).__name__}: {error}"
                said = f"{run.study} {run.name}: {run.trouble}"
            print(said, flush=True)
