"""Tests the package as users install it: builds a wheel, and installs it with pip in a venv.

Needs no network.
"""

import os
import re
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import numpy as np
import pytest

HERE = Path(__file__).resolve().parents[1]
PROGRAM = "import dotpose; print(dotpose.__file__, dotpose.Locator().locate(dotpose.simulate(1)[0].image))"


# Libraries that a wheel for Linux may need under the manylinux_2_28 policy.
PERMITTED = {"libc.so.6", "libm.so.6", "libpthread.so.0", "libdl.so.2", "libgcc_s.so.1", "libstdc++.so.6",
             "ld-linux-x86-64.so.2"}
ONLY_LOCATES = """
import sys, dotpose
fix = dotpose.Locator().locate(dotpose.simulate(1)[0].image)
assert fix.ok, fix
assert "dotpose._tools" not in sys.modules
for use in (lambda: dotpose.print_sheet, lambda: fix.draw("a.svg"), lambda: dotpose.Camera.read("a")):
    try:
        use()
    except ImportError as error:
        assert "python3-dotpose" in str(error), error
    else:
        raise AssertionError("not refused")
print(dotpose.__file__)
"""


def run(*command, **environment):
    clean = {key: value for key, value in os.environ.items() if key != "PYTHONPATH"}
    result = subprocess.run(
        [str(word) for word in command], capture_output=True, text=True,
        env={**clean, **environment}, cwd="/",
    )
    assert result.returncode == 0, result.stdout + result.stderr
    return result.stdout


@pytest.fixture(scope="module")
def copy_of_sources(tmp_path_factory):
    """Returns a copy of this package's folder, because setuptools writes files next to the sources.
    Wheels are built from the compiled files in DOTPOSE_BUILD, so nothing is compiled again."""
    if not os.environ.get("DOTPOSE_BUILD"):
        pytest.skip("without DOTPOSE_BUILD, a build directory")
    root = tmp_path_factory.mktemp("checkout")
    (root / "CMakeLists.txt").write_text((HERE.parents[1] / "CMakeLists.txt").read_text())
    shutil.copytree(HERE.parents[1] / "include", root / "include")
    copy = root / "wrappers" / "python"
    copy.mkdir(parents=True)
    for name in ("setup.py", "pyproject.toml", "README.md"):
        (copy / name).write_text((HERE / name).read_text())
    (copy / "dotpose").mkdir()
    for file in (HERE / "dotpose").iterdir():
        if file.is_file():
            (copy / "dotpose" / file.name).write_bytes(file.read_bytes())
    return copy


def test_a_wheel_has_what_is_needed(copy_of_sources, tmp_path):
    pytest.importorskip("build")
    run(sys.executable, "-m", "build", "--wheel", "--no-isolation", "-o", tmp_path, copy_of_sources)
    (wheel,) = tmp_path.glob("dotpose-*.whl")
    names = {Path(name).name for name in zipfile.ZipFile(wheel).namelist()}
    assert {"__init__.py", "__init__.pyi", "py.typed", "METADATA"} <= names
    for module in ("_dotpose.", "_tools."):
        assert any(name.startswith(module) and name.endswith(".so") for name in names)


def test_pip_installs_it_in_a_virtual_environment(copy_of_sources, tmp_path):
    venv = tmp_path / "venv"
    run(sys.executable, "-m", "venv", "--system-site-packages", venv)
    run(venv / "bin" / "pip", "install", "--no-index", "--no-build-isolation", copy_of_sources)
    out = run(venv / "bin" / "python", "-c", PROGRAM)
    assert str(venv) in out and "<Fix ok" in out
    version = run(venv / "bin" / "python", "-c", "import dotpose; print(dotpose.__version__)")
    assert f"Version: {version.strip()}" in run(venv / "bin" / "pip", "show", "dotpose")
    run(venv / "bin" / "pip", "uninstall", "--yes", "dotpose")


def test_a_wheel_of_the_core_needs_numpy_only(tmp_path):
    pytest.importorskip("build")
    if not os.environ.get("DOTPOSE_BUILD"):
        pytest.skip("compiles the core, as the nightly tests do")
    # Builds a copy, because setuptools writes files next to the sources.
    copy = tmp_path / "checkout" / "wrappers" / "python"
    shutil.copytree(HERE, copy, ignore=shutil.ignore_patterns("build", "dist", "*.egg-info", "__pycache__"))
    os.symlink(HERE.parents[1], copy / "source")
    run(sys.executable, "-m", "build", "--wheel", "--no-isolation", "-o", tmp_path, copy,
        DOTPOSE_BUILD="", DOTPOSE_WHEEL="core")
    (wheel,) = tmp_path.glob("dotpose-*.whl")
    venv = tmp_path / "venv"
    run(sys.executable, "-m", "venv", venv)
    run(venv / "bin" / "pip", "install", "--no-index", "--no-deps", wheel)
    (packages,) = venv.glob("lib/python*/site-packages")
    numpy = Path(np.__file__).parent
    os.symlink(numpy, packages / "numpy")
    if (libraries := numpy.parent / "numpy.libs").exists():
        os.symlink(libraries, packages / "numpy.libs")
    assert str(venv) in run(venv / "bin" / "python", "-c", ONLY_LOCATES)
    (module,) = packages.glob("dotpose/*.so")
    needed = set(re.findall(r"NEEDED.*\[(.*)\]", run("readelf", "-d", module)))
    assert needed <= PERMITTED
