"""Tests the package as users install it, without a network: a wheel, and pip in a virtual environment."""

import os
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

HERE = Path(__file__).resolve().parents[1]
PROGRAM = "import dotpose; print(dotpose.__file__, dotpose.Locator().locate(dotpose.simulate(1)[0].image))"


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
    """Returns a copy of the folder, because setuptools writes beside the sources. DOTPOSE_BUILD is
    the build directory of this test, so that nothing is compiled twice."""
    if not os.environ.get("DOTPOSE_BUILD"):
        pytest.skip("without DOTPOSE_BUILD, a build directory")
    root = tmp_path_factory.mktemp("checkout")
    (root / "CMakeLists.txt").write_text((HERE.parents[1] / "CMakeLists.txt").read_text())
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
    assert any(name.startswith("_dotpose.") and name.endswith(".so") for name in names)


def test_pip_installs_it_in_a_virtual_environment(copy_of_sources, tmp_path):
    venv = tmp_path / "venv"
    run(sys.executable, "-m", "venv", "--system-site-packages", venv)
    run(venv / "bin" / "pip", "install", "--no-index", "--no-build-isolation", copy_of_sources)
    out = run(venv / "bin" / "python", "-c", PROGRAM)
    assert str(venv) in out and "<Fix ok" in out
    version = run(venv / "bin" / "python", "-c", "import dotpose; print(dotpose.__version__)")
    assert f"Version: {version.strip()}" in run(venv / "bin" / "pip", "show", "dotpose")
    run(venv / "bin" / "pip", "uninstall", "--yes", "dotpose")
