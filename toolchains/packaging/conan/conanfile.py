# SPDX-License-Identifier: Apache-2.0
"""Conan 2 recipe. Run `conan create toolchains/packaging/conan` in a checkout."""
import re
from pathlib import Path

from conan import ConanFile
from conan.tools.cmake import CMake, CMakeDeps, CMakeToolchain, cmake_layout
from conan.tools.files import copy


class StarfocusRecipe(ConanFile):
    name = "starfocus"
    license = "Apache-2.0"
    description = "Refocusing of sparse light fields"
    topics = ("light field", "refocusing", "depth of field")
    settings = "os", "compiler", "build_type", "arch"
    options = {"shared": [True, False]}
    default_options = {"shared": False}
    package_type = "library"
    requires = "highway/[>=1.0.3 <2]"

    def set_version(self):
        header = Path(self.recipe_folder, "../../../lib/include/starfocus/version.h").read_text(encoding="utf-8")
        parts = (re.search(rf"VERSION_{part} (\d+)", header).group(1) for part in ("MAJOR", "MINOR", "PATCH"))
        self.version = ".".join(parts)

    def export_sources(self):
        root = Path(self.recipe_folder, "../../..")
        for pattern in ("CMakeLists.txt", "LICENSE", "cmake/*", "lib/*", "simd/*", "platform/pool/*", "platform/java/*",
                        "platform/python/CMakeLists.txt"):
            copy(self, pattern, root, self.export_sources_folder)

    def layout(self):
        cmake_layout(self)

    def generate(self):
        toolchain = CMakeToolchain(self)
        toolchain.cache_variables.update({"STARFOCUS_PROGRAMS": False, "STARFOCUS_TESTS": False})
        toolchain.generate()
        CMakeDeps(self).generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def package(self):
        copy(self, "LICENSE", self.source_folder, Path(self.package_folder, "licenses"))
        CMake(self).install()

    def package_info(self):
        self.cpp_info.set_property("cmake_find_mode", "none")
        self.cpp_info.builddirs.append("lib/cmake/starfocus")
