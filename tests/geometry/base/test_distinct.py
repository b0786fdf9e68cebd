"""The different values of an array, beside numpy's own."""

from __future__ import annotations

import subprocess
import sys

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from geometry.base.distinct import distinct
from tests.sampling import examples


@examples(100)
@given(st.lists(st.integers(-5, 5), max_size=30))
def test_like_numpy_s(values: list[int]) -> None:
    assert distinct(np.array(values, dtype=np.int64)).tolist() == np.unique(values).tolist()
    assert distinct(np.array(values, dtype=np.float64)).tolist() == np.unique(values).tolist()


def test_any_shape() -> None:
    assert distinct(np.array([[3.0, 1.0], [1.0, 2.0]])).tolist() == [1.0, 2.0, 3.0]


@pytest.mark.sampled(1)
@pytest.mark.parametrize("call", ["distinct(np.arange(3.0))", "np.unique(np.arange(3.0))"])
def test_masked_arrays_are_not_loaded(call: str) -> None:
    """numpy.unique is the negative control, where this numpy still loads them."""
    code = f"import sys; import numpy as np; from geometry.base.distinct import distinct; before = 'numpy.ma' in sys.modules; {call}; print(before, 'numpy.ma' in sys.modules)"  # noqa: E501
    done = subprocess.run([sys.executable, "-c", code], text=True, capture_output=True, timeout=60, check=True)
    before, after = done.stdout.split()
    if before == "True" or (call.startswith("np") and after == "False"):
        pytest.skip("this numpy loads them anyway, or never")
    assert (after == "True") is call.startswith("np")
