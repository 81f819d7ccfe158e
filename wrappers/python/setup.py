"""Builds the package: CMake compiles its modules from the dotpose source tree around this folder.

Environment variables:
    DOTPOSE_BUILD   a configured build directory, whose compiled files are reused
    DOTPOSE_WHEEL   "core": only the module that locates, tracks and simulates. It needs no system
                    libraries, so its wheel runs on other systems.
"""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext
from setuptools.command.sdist import sdist

HERE = Path(__file__).resolve().parent
# In a source distribution, this folder contains the sources of dotpose.
PACKED = HERE / "source"
ROOT = PACKED if PACKED.exists() else HERE.parents[1]
NEEDED = ["CMakeLists.txt", "LICENSE", "README.md", "CHANGELOG.md", "CONTRIBUTING.md"]
NEEDED += ["apps", "cmake", "docs", "examples", "include", "src", "wrappers"]
# Files and folders that builds and source distributions leave in the source tree.
UNWANTED = ["build", "dist", "dotpose-[0-9]*", "node_modules", "*.egg-info", "__pycache__"]


class BuildWithCMake(build_ext):
    def configured(self):
        """Returns the build directory."""
        if build := os.environ.get("DOTPOSE_BUILD"):
            return Path(build)
        build = Path(self.build_temp).resolve()
        generator = ["-G", "Ninja"] if shutil.which("ninja") else []
        options = ["CMAKE_BUILD_TYPE=Release", "DOTPOSE_WITH_TESTS=OFF", "DOTPOSE_WITH_TOOL=OFF"]
        options += ["DOTPOSE_BUILD_PYTHON=ON", f"Python_EXECUTABLE={sys.executable}"]
        if os.environ.get("DOTPOSE_WHEEL") == "core":
            options += ["DOTPOSE_PARTS=CORE", "DOTPOSE_WITH_BASE=ON", "DOTPOSE_WITH_SIMULATE=ON"]
            options += ["DOTPOSE_FMT_HEADER_ONLY=ON"]
        try:
            import pybind11

            options += [f"pybind11_DIR={pybind11.get_cmake_dir()}"]
        except ModuleNotFoundError:
            pass  # CMake finds the system's pybind11 by default.
        configure = ["cmake", "-S", str(ROOT), "-B", str(build), *generator]
        subprocess.run(configure + [f"-D{option}" for option in options], check=True)
        return build

    def build_extension(self, extension):
        build = self.configured()
        command = ["cmake", "--build", str(build), "--target", "dotpose_python"]
        subprocess.run(command + ["-j", str(os.cpu_count())], check=True)
        package = Path(self.get_ext_fullpath(extension.name)).parent
        package.mkdir(parents=True, exist_ok=True)
        for name in ("_dotpose", "_tools"):
            for module in Path(build, "wrappers/python/dotpose").glob(f"{name}.*"):
                if module.suffix in (".so", ".pyd"):
                    shutil.copy(module, package)


class PackSources(sdist):
    def make_release_tree(self, base_dir, files):
        super().make_release_tree(base_dir, files)
        unwanted = shutil.ignore_patterns(*UNWANTED)
        for name in NEEDED:
            source, target = ROOT / name, Path(base_dir, "source", name)
            if source.is_dir():
                shutil.copytree(source, target, ignore=unwanted)
            else:
                target.parent.mkdir(parents=True, exist_ok=True)
                shutil.copy(source, target)


setup(
    version=re.search(r'DOTPOSE_VERSION "(.*)"', (ROOT / "include/dotpose/version.hpp").read_text())[1],
    ext_modules=[Extension("dotpose._dotpose", sources=[])],
    cmdclass={"build_ext": BuildWithCMake, "sdist": PackSources},
)
