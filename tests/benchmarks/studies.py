"""What a study costs: evaluations per hour of the suspended cat, its storage, and Dask.

python tests/benchmarks/studies.py [pybullet] [mujoco] [threads] [dask]
"""

import statistics
import sys
import tempfile
import time
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

from distributed import LocalCluster

from neuromech.study.dask_executor import DaskExecutor
from neuromech.study.database import Database
from neuromech.study.driver import Search
from neuromech.study.evaluate import Evaluator
from neuromech.study.evaluation import Job
from neuromech.study.executors import Executor, ProcessExecutor
from neuromech.study.plan import Plan
from neuromech.study.storage import StoredStudy

SPEC = Path(__file__).parents[2] / "specs" / "cat" / "suspended_tuning.yaml"
ENGINES = ("pybullet", "mujoco")
REPETITIONS = 6
EVALUATIONS = 120
JOBS = 40
JOB_SECONDS = 1.0


class Costs:
    """Seconds of processor time that storing took, counted while it is patched in."""

    def __init__(self) -> None:
        self.seconds = 0.0
        for name in ("begin", "finish", "set_boundary"):
            setattr(StoredStudy, name, self._counted(getattr(StoredStudy, name)))

    def _counted(self, write: Callable[..., None]) -> Callable[..., None]:
        def counted(*arguments: Any) -> None:
            before = time.thread_time()
            write(*arguments)
            self.seconds += time.thread_time() - before

        return counted


def say(text: str) -> None:
    """Write a line at once."""
    sys.stdout.write(f"{text}\n")
    sys.stdout.flush()


def own_jobs(plan: Plan, count: int) -> list[Job]:
    """Return jobs with the document's own values."""
    own = plan.space.parameters(plan.space.point(plan.document))
    return [Job(n, 0, n, own, plan.scenarios.seeds(0)) for n in range(count)]


def searched(evaluator: Evaluator, executor: Executor) -> float:
    """Return the seconds that a search takes, without starting processes and loading code."""
    plan = Plan.of(evaluator.document)
    list(executor.run(evaluator, own_jobs(plan, 4), lambda: False))
    with tempfile.TemporaryDirectory() as folder:
        stored = Database(f"{folder}/study.db").create("study", plan.header)
        search = Search(plan, stored, lambda standing: None)
        started = time.perf_counter()
        search.run(executor, evaluator, lambda: False)
        return time.perf_counter() - started


def cat(costs: Costs, engines: Sequence[str]) -> None:
    """Measure one and two workers in turn. The best of each counts: whatever else the machine does only slows them."""
    for engine in engines:
        evaluator = Evaluator(SPEC, [f"study.evaluations={EVALUATIONS}"], engine=engine)
        evaluator.prepare()
        before = costs.seconds
        pairs: list[tuple[float, float]] = []
        with ProcessExecutor(1) as one, ProcessExecutor(2) as two:
            for _ in range(REPETITIONS):
                pairs.append((searched(evaluator, one), searched(evaluator, two)))
        working = sum(alone + 2 * together for alone, together in pairs)
        alone, together = (min(pair[place] for pair in pairs) for place in (0, 1))
        hourly = (EVALUATIONS * 3600 / seconds for seconds in (alone, together))
        words = ", ".join(f"{workers} workers {rate:.0f}/h" for workers, rate in zip((1, 2), hourly, strict=True))
        middle = statistics.median(alone / together for alone, together in pairs)
        say(f"{engine}: {words}, ratio {alone / together:.2f} (median of pairs {middle:.2f})")
        say(f"{engine}: storing takes {(costs.seconds - before) / working:.2%} of the processor time")


def threads() -> None:
    """Measure evaluations in one and two threads of one process."""
    evaluator = Evaluator(SPEC, engine="mujoco")
    evaluator.prepare()
    plan = Plan.of(evaluator.document)
    jobs = own_jobs(plan, EVALUATIONS)
    for workers in (1, 2):
        with ThreadPoolExecutor(workers) as pool:
            started = time.perf_counter()
            list(pool.map(evaluator, jobs))
            say(f"mujoco: {workers} threads {EVALUATIONS * 3600 / (time.perf_counter() - started):.0f}/h")


def dask() -> None:
    """Measure jobs of a second on two workers, against processes and against nothing but the jobs."""
    with LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster:
        places: dict[str, Callable[[], Executor]] = {
            "processes": lambda: ProcessExecutor(2),
            "Dask": lambda: DaskExecutor(cluster.scheduler_address),
        }
        for name, place in places.items():
            with place() as executor:
                list(executor.run(time.sleep, [0.0] * 4, lambda: False))
                started = time.perf_counter()
                list(executor.run(time.sleep, [JOB_SECONDS] * JOBS, lambda: False))
                seconds = time.perf_counter() - started
                say(f"{name}: {seconds / (JOBS * JOB_SECONDS / 2) - 1:.2%} more than the jobs themselves")


def main() -> None:
    """Measure what is asked for, or all."""
    asked = sys.argv[1:] or [*ENGINES, "threads", "dask"]
    cat(Costs(), [engine for engine in ENGINES if engine in asked])
    if "threads" in asked:
        threads()
    if "dask" in asked:
        dask()


if __name__ == "__main__":
    main()
