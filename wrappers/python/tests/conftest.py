"""Helpers shared by the tests."""

import os
from pathlib import Path

import numpy as np
import pytest

import dotpose


@pytest.fixture(scope="session")
def frames():
    """Returns five nominal frames. All of them have a fix."""
    return dotpose.simulate(5, seed=3)


@pytest.fixture(scope="session")
def golden():
    """Returns the folder of the golden files (wrappers/golden)."""
    folder = Path(os.environ.get("DOTPOSE_GOLDEN", ""))
    if not (folder / "vga.csv").exists():
        pytest.skip("without golden files: build and run dotpose_golden_files")
    return folder


def bits_of(fix):
    """Returns the part of a golden line that describes the fix. Reverses the little-endian bytes of
    numbers, because golden lines are written with the most significant digit first."""
    return ",".join(n[::-1].hex() if isinstance(n, bytes) else str(n) for n in fix._bits)


def images_in(path):
    """Returns the images in a file that contains a sequence of binary PGM images."""
    data = memoryview(Path(path).read_bytes())
    at = 0
    while at < len(data):
        header = bytes(data[at : at + 32]).split(b"\n", 3)
        assert header[0] == b"P5" and header[2] == b"255"
        width, height = map(int, header[1].split())
        at += len(b"\n".join(header[:3])) + 1
        yield np.frombuffer(data[at : at + width * height], np.uint8).reshape(height, width)
        at += width * height
