"""Settings of all tests: the same examples in every run, long sweeps by a sample, workers that start fast."""

from __future__ import annotations

import os

# before numpy is loaded, here and in every worker and command that a test starts: threads of BLAS wait for each other
# spinning, and splines take twice as long
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import random
import sys
from collections.abc import Hashable
from typing import Any

import pytest
from hypothesis import core, is_hypothesis_test, settings

from tests.sampling import chosen, take_all_examples

# collected by pytest as hooks of this file
from tests.skips import pytest_runtest_logreport, pytest_sessionfinish, pytest_terminal_summary  # noqa: F401

# examples are the same in every run; HYPOTHESIS_SEED=random draws others, HYPOTHESIS_SEED=NUMBER those of a run again
if os.environ.get("HYPOTHESIS_SEED") == "random":
    os.environ["HYPOTHESIS_SEED"] = str(random.SystemRandom().randrange(2**32))
if _SEED := os.environ.get("HYPOTHESIS_SEED", ""):
    core.global_force_seed = int(_SEED)
settings.register_profile("ours", derandomize=not _SEED, deadline=None)
settings.load_profile("ours")


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
    asked = any(str(argument).startswith("--assert") for argument in config.invocation_params.args)
    if config.getoption("numprocesses", None) and not asked and "PYTEST_XDIST_WORKER" not in os.environ:
        # the one way to a worker's options
        os.environ["PYTEST_ADDOPTS"] = f"{os.environ.get('PYTEST_ADDOPTS', '')} --assert=plain --showlocals"


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_make_scheduler(config: pytest.Config, log: Any) -> Any:
    """Each worker takes one run of neighbouring tests, which share what is made once; the first that is done helps."""
    from xdist.scheduler import WorkStealingScheduling

    return WorkStealingScheduling(config, log) if config.getoption("dist") == "load" else None


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Mark as heavy what is outside the sample of a test with ``@pytest.mark.sampled(count)``.

    Where the heavy tests are asked for, the searches by hypothesis are among them, with all their examples.
    """
    sweeps: dict[tuple[str, str], list[pytest.Function]] = {}
    for item in items:
        if _heavy_alone(config) and isinstance(item, pytest.Function) and is_hypothesis_test(item.obj):
            item.add_marker(pytest.mark.heavy)
        sampled, heavy = item.get_closest_marker("sampled"), item.get_closest_marker("heavy")
        if isinstance(item, pytest.Function) and sampled and not heavy:
            assert item.parent is not None
            sweeps.setdefault((item.parent.nodeid, item.originalname), []).append(item)
    for (_, name), cases in sweeps.items():
        mark = cases[0].get_closest_marker("sampled")
        assert mark is not None
        keep = set(chosen([_values(case) for case in cases], mark.args[0], name))
        for place, case in enumerate(cases):
            if place not in keep:
                case.add_marker(pytest.mark.heavy)


def _heavy_alone(config: pytest.Config) -> bool:
    return str(config.getoption("markexpr")).strip() == "heavy"


def _values(case: pytest.Function) -> dict[str, Hashable]:
    """Which value each parameter has: words and numbers by themselves, other things by their place in the list."""
    found = case.callspec
    return {k: v if _is_plain(v) else found.indices[k] for k, v in found.params.items()}


def _is_plain(value: Any) -> bool:
    return isinstance(value, str | int | float) or (isinstance(value, tuple) and all(map(_is_plain, value)))
