"""Conan 2 recipe for the core and the light libraries: `conan create packaging/conan`."""

from conan import ConanFile
from conan.tools.build import check_min_cppstd
from conan.tools.cmake import CMake, CMakeToolchain, cmake_layout
from conan.tools.files import copy
from conan.tools.scm import Git


class Dotpose(ConanFile):
    name = "dotpose"
    version = "0.2.0"
    license = "MIT"
    url = "https://example.org/dotpose"
    description = "Locates a camera on a sheet printed with tiny dots, to microns"
    settings = "os", "arch", "compiler", "build_type"
    options = {"shared": [True, False], "print": [True, False], "files": [True, False]}
    default_options = {"shared": False, "print": False, "files": False}
    generators = "CMakeDeps"

    def layout(self):
        cmake_layout(self)

    def requirements(self):
        if self.options.print or self.options.files:
            self.requires("fmt/[>=9 <12]")
        if self.options.print:
            self.requires("libpng/[>=1.6 <2]")
        if self.options.files:
            self.requires("yaml-cpp/[>=0.7 <1]")
            self.requires("nlohmann_json/[>=3.11 <4]")

    def validate(self):
        check_min_cppstd(self, 20)

    def source(self):
        Git(self).clone("https://example.org/dotpose.git", target=".", args=["--branch", f"v{self.version}"])

    def generate(self):
        toolchain = CMakeToolchain(self)
        toolchain.cache_variables["DOTPOSE_PARTS"] = "CORE"
        toolchain.cache_variables["DOTPOSE_WITH_PRINT"] = "ON" if self.options.print else "OFF"
        toolchain.cache_variables["DOTPOSE_WITH_FILES"] = "ON" if self.options.files else "OFF"
        toolchain.generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def package(self):
        copy(self, "LICENSE", self.source_folder, self.package_folder)
        CMake(self).install()

    def package_info(self):
        # The package provides its own files for find_package(dotpose), with a target for each
        # library.
        self.cpp_info.builddirs = ["lib/cmake/dotpose"]
        self.cpp_info.set_property("cmake_find_mode", "none")
