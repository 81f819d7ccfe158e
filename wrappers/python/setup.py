"""Builds the package: CMake compiles its module from the sources of dotpose around this folder.

DOTPOSE_BUILD names a configured build directory, so that nothing is compiled twice.
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
# Names that are generated in the source tree, including the source distribution itself.
UNWANTED = ["build", "dist", "dotpose-[0-9]*", "node_modules", "*.egg-info", "__pycache__"]


class BuildWithCMake(build_ext):
    def build_extension(self, extension):
        build = os.environ.get("DOTPOSE_BUILD")
        if not build:
            build = str(Path(self.build_temp).resolve())
            generator = ["-G", "Ninja"] if shutil.which("ninja") else []
            options = ["CMAKE_BUILD_TYPE=Release", "DOTPOSE_WITH_TESTS=OFF", "DOTPOSE_WITH_TOOL=OFF"]
            options += ["DOTPOSE_BUILD_PYTHON=ON", f"Python_EXECUTABLE={sys.executable}"]
            configure = ["cmake", "-S", str(ROOT), "-B", build, *generator]
            subprocess.run(configure + [f"-D{option}" for option in options], check=True)
        jobs = str(os.cpu_count())
        compile_it = ["cmake", "--build", build, "--target", "dotpose_python", "-j", jobs]
        subprocess.run(compile_it, check=True)
        (module,) = Path(build, "wrappers/python/dotpose").glob("_dotpose.*.so")
        target = Path(self.get_ext_fullpath(extension.name))
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(module, target)


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
