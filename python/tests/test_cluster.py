"""A Dask cluster of two worker processes, one of which is killed in the middle of a sweep."""

import os
import signal
import sys
import threading
import time
from pathlib import Path

import numpy as np
import pytest

import signorini as sg

distributed = pytest.importorskip("distributed")
sys.path.insert(0, str(Path(__file__).parent))
import cluster

# Dask's own warnings are none of ours.
pytestmark = [
    pytest.mark.filterwarnings("default"),
    pytest.mark.skipif(os.name == "nt", reason="Windows has no SIGKILL"),
]

POINTS = sg.grid(gap=np.linspace(2e-3, 8e-3, 400), restitution=[0.5, 0.8])


def test_a_killed_worker_changes_no_bit() -> None:
    whole = sg.sweep(cluster.make, POINTS, "event", threads=1)
    path = str(Path(__file__).parent)
    with (
        distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as local,
        distributed.Client(local) as client,
    ):
        client.run(sys.path.insert, 0, path)
        pids = client.run(os.getpid)
        assert len(pids) == 2 and os.getpid() not in pids.values()
        executor = client.get_executor(pure=False)
        # Many small tasks, of which some are done and some are under way when the worker dies.
        done = threading.Event()

        def kill() -> None:
            started = time.monotonic()
            while not client.run_on_scheduler(_finished) > 5 and time.monotonic() - started < 30:
                time.sleep(0.01)
            os.kill(next(iter(pids.values())), signal.SIGKILL)
            done.set()

        killer = threading.Thread(target=kill)
        killer.start()
        table = sg.sweep(cluster.make, POINTS, "event", executor=executor, chunk=4)
        killer.join()
        assert done.is_set()
        # The nanny has started another worker by now, or is about to: one of the two pids is gone.
        client.wait_for_workers(2, timeout=60)
        assert set(client.run(os.getpid).values()) != set(pids.values())
        assert list(table) == list(whole)
        for name, column in whole.items():
            same = list(table[name]) == list(column) if column.dtype == object else False
            assert same or table[name].tobytes() == column.tobytes(), name
        # The same with the size of the tasks found from their cost.
        found = sg.sweep(cluster.make, POINTS, "event", executor=client.get_executor(pure=False))
        assert found["impulse_stop-upper_N_s"].tobytes() == whole["impulse_stop-upper_N_s"].tobytes()


def _finished(dask_scheduler: object) -> int:
    """Tasks that have a result, on the scheduler."""
    tasks = dask_scheduler.tasks.values()  # type: ignore[attr-defined]
    return sum(task.state == "memory" for task in tasks)
