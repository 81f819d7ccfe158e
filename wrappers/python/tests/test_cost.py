"""Tests that Python adds at most 2 µs per frame."""

import os

import numpy as np
import pytest

import dotpose
from cost import cost_us


@pytest.mark.skipif("DOTPOSE_TIMES" not in os.environ, reason="times only with DOTPOSE_TIMES=1")
def test_python_adds_at_most_2_us():
    # The overhead of Python does not depend on the frame. It is easiest to measure with a blank
    # frame, which takes almost no time to locate.
    blank = np.full((64, 64), 200, np.uint8)
    for code in ("anoto", "auto"):
        cpp, python, _ = cost_us(blank, dotpose.Locator(code))
        print(f"{code}: {cpp:.2f} us in C++, {python:.2f} us in Python")
        assert python - cpp < 2.0
