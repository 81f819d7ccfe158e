"""Tests that the type stubs and docstrings describe the module completely."""

import inspect
import pydoc
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import dotpose

PACKAGE = Path(dotpose.__file__).parent

PROGRAM = """
import numpy as np
import dotpose

locator = dotpose.Locator("anoto", 0.508, options=dotpose.Options(min_dots=60))
image = dotpose.read_image("frame.png")
fix = locator.locate(image)
x_mm: float = fix.x_mm
variances = np.diag(fix.covariance)
if fix.status == "no_grid":
    print(fix.message)
with dotpose.SheetFile("sheets.json") as file:
    name: str = file.allocate("table", dotpose.make_sheet())[0].name
"""


def mypy(*arguments, path):
    if not shutil.which("mypy"):
        pytest.skip("without mypy")
    folder = str(PACKAGE.parent)
    environment = {"PATH": "/usr/bin:/bin", "MYPYPATH": folder, "PYTHONPATH": folder}
    command = ["/usr/bin/python3", "-m", *arguments]
    return subprocess.run(
        command, cwd=path, capture_output=True, text=True, env=environment
    )


def test_programs_are_checked_by_the_stubs(tmp_path):
    options = ["--strict", "--cache-dir", str(tmp_path / "cache"), "program.py"]
    (tmp_path / "program.py").write_text(PROGRAM)
    result = mypy("mypy", *options, path=tmp_path)
    assert result.returncode == 0, result.stdout + result.stderr
    wrong = ['dotpose.Locator("nota")', "fix.x_inch", "locator.locate([1])"]
    (tmp_path / "program.py").write_text(PROGRAM + "\n".join(wrong) + "\n")
    assert "Found 3 errors" in mypy("mypy", *options, path=tmp_path).stdout


def test_the_stubs_say_what_there_is(tmp_path):
    """stubtest compares the stubs with the module. The permitted differences are classes and
    constructors of pybind11, and names of types that do not exist at run time."""
    lines = [r"dotpose\.[A-Z]\w+", r"dotpose\.\w+\.__init__", r"dotpose\._dotpose.*"]
    (tmp_path / "allow").write_text("\n".join(lines) + "\n")
    result = mypy("mypy.stubtest", "dotpose", "--allowlist", "allow", "--ignore-missing-stub",
                  "--ignore-unused-allowlist", path=tmp_path)
    assert result.returncode == 0, result.stdout + result.stderr


def public(owner):
    for name, member in vars(owner).items():
        if not name.startswith("_"):
            yield name, member


def test_everything_public_is_in_the_stubs_and_has_a_docstring():
    stub = (PACKAGE / "__init__.pyi").read_text()
    assert (PACKAGE / "py.typed").exists()
    for name in dotpose.__all__:
        assert f"class {name}" in stub or f"def {name}(" in stub or f"{name}:" in stub, name
        thing = getattr(dotpose, name)
        if name == "__version__":
            continue
        assert inspect.getdoc(thing), name
        if inspect.isclass(thing) and not issubclass(thing, Exception):
            assert thing.__module__ == "dotpose"
            for member_name, member in public(thing):
                assert f"{member_name}:" in stub or f"def {member_name}(" in stub, member_name
                if (name, member_name) not in {("WorldPose", "x_m")}:
                    assert inspect.getdoc(member), f"{name}.{member_name}"


def test_help_is_readable():
    text = pydoc.plain(pydoc.render_doc(dotpose))
    for wanted in ("class Locator", "locate(", "with the shape (height, width)", "simulate(",
                   "in mm", "print_sheet("):
        assert wanted in text, wanted
    for unwanted in ("0x", "std::", "dotpose::", "_dotpose.", "array_t", "_bits"):
        assert unwanted not in text, unwanted
