"""What the tests share."""

import os
import struct
from pathlib import Path

import numpy as np
import pytest

import dotpose


@pytest.fixture(scope="session")
def frames():
    """Five nominal frames, which all have a fix."""
    return dotpose.simulate(5, seed=3)


@pytest.fixture(scope="session")
def golden():
    """The folder of the golden files (wrappers/golden)."""
    folder = Path(os.environ.get("DOTPOSE_GOLDEN", ""))
    if not (folder / "vga.csv").exists():
        pytest.skip("without golden files: build and run dotpose_golden_files")
    return folder


def bits_of(fix):
    """The part of a line of a golden file that tells of the fix."""
    single = lambda value: struct.pack(">f", value).hex()
    double = lambda value: struct.pack(">d", value).hex()
    status = STATUS_NUMBERS[fix.status]
    line = [str(status), str(fix.dots_seen)]
    if fix.ok:
        numbers = fix._bits
        line += [str(number) for number in numbers[:-10]]
        line += [double(fix.x_mm), double(fix.y_mm), double(fix.theta_rad)]
        line += [single(number) for number in numbers[-10:]]
    return ",".join(line)


STATUS_NUMBERS = {
    "ok": 0,
    "no_contrast": 4,
    "too_few_dots": 5,
    "no_grid": 6,
    "no_displacement": 7,
    "grid_too_small": 8,
    "mirrored": 10,
    "not_in_code": 12,
    "ambiguous": 13,
    "not_certain": 14,
    "not_tracked": 15,
    "ambiguous_code": 16,
}


def images_in(path):
    """The binary PGM images that stand one after the other in a file."""
    data = memoryview(Path(path).read_bytes())
    at = 0
    while at < len(data):
        header = bytes(data[at : at + 32]).split(b"\n", 3)
        assert header[0] == b"P5" and header[2] == b"255"
        width, height = map(int, header[1].split())
        at += len(b"\n".join(header[:3])) + 1
        yield np.frombuffer(data[at : at + width * height], np.uint8).reshape(height, width)
        at += width * height
