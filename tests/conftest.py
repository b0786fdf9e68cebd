"""Settings of all tests: the same examples in every run, long sweeps by a sample, workers that start fast."""

from __future__ import annotations

import os

# before numpy is loaded, here and in every worker and command that a test starts: threads of BLAS wait for each other
# spinning, and splines take twice as long
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
# a worker or a command that may keep no bytecode compiles every file anew: a third of what a small build takes
os.environ.pop("PYTHONDONTWRITEBYTECODE", None)

import atexit
import gc
import random
import sys
from collections.abc import Generator, Hashable
from contextlib import suppress
from inspect import isfunction
from typing import Any

import pytest
from _pytest.runner import runtestprotocol
from hypothesis import core, is_hypothesis_test, settings

from tests.sampling import chosen, some_of, take_all_examples

# collected by pytest as hooks of this file
from tests.skips import pytest_runtest_logreport, pytest_sessionfinish, pytest_terminal_summary  # noqa: F401

# examples are the same in every run; HYPOTHESIS_SEED=random draws others, HYPOTHESIS_SEED=NUMBER those of a run again
if os.environ.get("HYPOTHESIS_SEED") == "random":
    os.environ["HYPOTHESIS_SEED"] = str(random.SystemRandom().randrange(2**32))
if _SEED := os.environ.get("HYPOTHESIS_SEED", ""):
    core.global_force_seed = int(_SEED)
settings.register_profile("ours", derandomize=not _SEED, deadline=None)
settings.load_profile("ours")
# nor do they depend on what a worker has imported so far: hypothesis parses every file of the product for its numbers
# and words, three seconds of each worker, and draws of those it has found; a test names the words it wants.
# No setting turns it off; a hypothesis without these names draws as it does by itself
with suppress(ImportError, AttributeError):
    from hypothesis.internal.conjecture import providers

    providers._get_local_constants = lambda none=providers._local_constants: none


# as much garbage as a heavy test makes: looked for sooner, it costs each run seconds and frees nothing
gc.set_threshold(50_000, 20, 20)


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """What is told is listed behind the tests of the pages, by the worker that has made the pages."""
    behind = max((k for k, item in enumerate(items) if "/documents/test_calc" in item.nodeid), default=len(items)) + 1
    for item in [item for item in items[behind:] if "/test_contents.py::" in item.nodeid]:
        items.remove(item)
        items.insert(behind, item)
        behind += 1


def pytest_collection_finish() -> None:
    """What collection made stays to the end: garbage is not sought there any more."""
    gc.collect()
    gc.freeze()


def pytest_sessionstart() -> None:
    """Tells the seed of fresh examples, once."""
    if _SEED and "PYTEST_XDIST_WORKER" not in os.environ:
        print(f"the same examples again: HYPOTHESIS_SEED={_SEED}", file=sys.stderr)


def pytest_configure(config: pytest.Config) -> None:
    """Workers of xdist take assertions as they stand and show the locals of a failure.

    To rewrite the assertions of all files takes a worker twice as long as all else before its first test. A failing
    test that is run alone shows its values as ever, and so does ``--assert=rewrite``.
    """
    if _heavy_alone(config):
        take_all_examples()
    if "PYTEST_XDIST_WORKER" in os.environ:
        # it has told all: what it holds need not be taken apart piece by piece, for four seconds
        atexit.register(os._exit, 0)
    asked = any(str(argument).startswith("--assert") for argument in config.invocation_params.args)
    if config.getoption("numprocesses", None) and not asked and "PYTEST_XDIST_WORKER" not in os.environ:
        # the one way to a worker's options
        os.environ["PYTEST_ADDOPTS"] = f"{os.environ.get('PYTEST_ADDOPTS', '')} --assert=plain --showlocals"


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_make_scheduler(config: pytest.Config, log: Any) -> Any:
    """Each worker takes one run of neighbouring tests, which share what is made once; the first that is done helps."""
    from xdist.scheduler import WorkStealingScheduling

    return WorkStealingScheduling(config, log) if config.getoption("dist") == "load" else None


@pytest.hookimpl(specname="pytest_runtest_protocol")
def pytest_tell_what_is_worth_it(item: pytest.Item, nextitem: pytest.Item | None) -> bool | None:
    """A worker tells of a test that has passed once, where xdist sends five messages of it.

    They cost the one that counts them as much as a twentieth of all tests. Who asks for durations has them all.
    """
    if "PYTEST_XDIST_WORKER" not in os.environ or item.config.getoption("durations"):
        return None
    for report in runtestprotocol(item, log=False, nextitem=nextitem):
        if report.when == "call" or not report.passed:
            if report.passed:
                report.keywords = {}
            item.ihook.pytest_runtest_logreport(report=report)
    return True


@pytest.hookimpl(specname="pytest_pycollect_makeitem", tryfirst=True)
def pytest_make_nothing_heavy(obj: object, collector: pytest.Collector) -> list[pytest.Item] | None:
    """Heavy tests are not even made where only the others are asked for: half of all cases, and of their time."""
    heavy = isfunction(obj) and any(mark.name == "heavy" for mark in getattr(obj, "pytestmark", []))
    return [] if heavy and _without_heavy(collector.config) else None


@pytest.hookimpl(specname="pytest_pycollect_makeitem", wrapper=True)
def pytest_make_samples(name: str, collector: pytest.Collector) -> Generator[None, Any, Any]:
    """Of the cases of a test those outside its ``sampled(count)`` are heavy.

    Where the heavy tests are asked for, the searches by hypothesis and what draws by ``some_of`` are among them, whole.
    """
    found = yield
    if not isinstance(found, list):
        return found
    cases = [item for item in found if isinstance(item, pytest.Function)]
    if _heavy_alone(collector.config) and cases and _is_drawn(cases[0].obj):
        for case in cases:
            case.add_marker(pytest.mark.heavy)
    light = [case for case in cases if not case.get_closest_marker("heavy")]
    sampled = light[0].get_closest_marker("sampled") if light else None
    if sampled is not None:
        keep = set(chosen([_values(case) for case in light], sampled.args[0], name))
        for place, case in enumerate(light):
            if place not in keep:
                case.add_marker(pytest.mark.heavy)
    without = _without_heavy(collector.config)
    return [item for item in found if not item.get_closest_marker("heavy")] if without else found


def _heavy_alone(config: pytest.Config) -> bool:
    return str(config.getoption("markexpr")).strip() == "heavy"


def _without_heavy(config: pytest.Config) -> bool:
    """Whether nothing heavy can be among what is asked for, whatever else is: ``not heavy``, ``... and not heavy``."""
    wanted = str(config.getoption("markexpr")).strip()
    return wanted == "not heavy" or (wanted.endswith(" and not heavy") and " or " not in wanted)


def _is_drawn(test: Any) -> bool:
    return is_hypothesis_test(test) or some_of.__name__ in test.__code__.co_names


def _values(case: pytest.Function) -> dict[str, Hashable]:
    """Which value each parameter has: words and numbers by themselves, other things by their place in the list."""
    found = case.callspec
    return {k: v if _is_plain(v) else found.indices[k] for k, v in found.params.items()}


def _is_plain(value: Any) -> bool:
    return isinstance(value, str | int | float) or (isinstance(value, tuple) and all(map(_is_plain, value)))
