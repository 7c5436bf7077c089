# SPDX-License-Identifier: Apache-2.0
"""Builds the Python package: the Python files, and the shared library and the program that CMake builds.

The C++ sources are in the tree that contains this folder. A source archive (sdist) has its own copy of the C++ sources
in the folder `sources`.

Environment variables:
    STARFOCUS_BUILD: a build folder that CMake has already configured for this tree (default: build/python, which
        this script configures).
    CMAKE_ARGS: additional arguments for configuring build/python. With -DSTARFOCUS_PROGRAMS=OFF, the package lacks the
        program, and cannot read light fields and photos.
"""
import os
import re
import shlex
import shutil
import subprocess
from pathlib import Path

from setuptools import Distribution, setup
from setuptools.command.build_py import build_py
from setuptools.command.sdist import sdist

try:
    from setuptools.command.bdist_wheel import bdist_wheel
except ImportError:  # setuptools before 70
    from wheel.bdist_wheel import bdist_wheel

HERE = Path(__file__).resolve().parent
COPY = HERE / "sources"
ROOT = COPY if COPY.exists() else HERE.parent.parent
# Files and folders of ROOT that building the library and the program requires.
SOURCES = ("CMakeLists.txt", "LICENSE", "cmake", "examples", "lib", "platform", "simd")
LIBRARY = "libstarfocus_python.so"
PROGRAM = "starfocus"


def version() -> str:
    """Returns the version in the public header."""
    text = (ROOT / "lib/include/starfocus/version.h").read_text(encoding="utf-8")
    parts = (re.search(rf"define STARFOCUS_VERSION_{part} (\d+)", text) for part in ("MAJOR", "MINOR", "PATCH"))
    return ".".join(part.group(1) for part in parts)


def build() -> Path:
    """Builds the library, and the program if the build folder is configured for it. Returns the build folder."""
    given = os.environ.get("STARFOCUS_BUILD")
    folder = Path(given) if given else ROOT / "build/python"
    if not given:
        subprocess.run(
            ["cmake", "-S", ROOT, "-B", folder, "-DCMAKE_BUILD_TYPE=Release", "-DSTARFOCUS_PROGRAMS=ON",
             "-DSTARFOCUS_TESTS=OFF", "-DSTARFOCUS_INSTALL=OFF",
             *shlex.split(os.environ.get("CMAKE_ARGS", ""))], check=True)
    targets = ["starfocus_python", PROGRAM] if has_program(folder) else ["starfocus_python"]
    subprocess.run(["cmake", "--build", folder, "--parallel", str(os.cpu_count() or 1), "--target", *targets],
                   check=True)
    return folder


def has_program(build_folder: Path) -> bool:
    """Returns True if the build folder is configured for the program."""
    return "STARFOCUS_PROGRAMS:BOOL=ON" in (build_folder / "CMakeCache.txt").read_text(encoding="utf-8")


class BuildPackage(build_py):
    """Builds the package: the Python files, the shared library and the program."""

    def run(self):
        shutil.rmtree(Path(self.build_lib) / "starfocus", ignore_errors=True)  # files of an earlier build
        super().run()
        folder = HERE if getattr(self, "editable_mode", False) else Path(self.build_lib)
        shutil.rmtree(folder / "starfocus" / "bin", ignore_errors=True)
        build_folder = build()
        shutil.copy2(build_folder / "lib" / LIBRARY, folder / "starfocus" / LIBRARY)
        if has_program(build_folder):
            (folder / "starfocus" / "bin").mkdir(exist_ok=True)
            shutil.copy2(build_folder / PROGRAM, folder / "starfocus" / "bin" / PROGRAM)


def unneeded(folder: str, names: list) -> list:
    """Returns the names in a folder of C++ sources that a source archive leaves out, for shutil.copytree. The Python
    package is at the top of the archive."""
    package = Path(folder) == ROOT / "platform/python"
    return [name for name in names if name == "__pycache__" or package and name != "CMakeLists.txt"]


class BuildSourceArchive(sdist):
    """Builds a source archive that contains the C++ sources."""

    def make_release_tree(self, base_dir, files):
        super().make_release_tree(base_dir, files)
        shutil.copy2(ROOT / "LICENSE", base_dir)
        for name in SOURCES:
            source, target = ROOT / name, Path(base_dir) / "sources" / name
            target.parent.mkdir(parents=True, exist_ok=True)
            if source.is_dir():
                shutil.copytree(source, target, ignore=unneeded)
            else:
                shutil.copy2(source, target)


class PlatformPackage(Distribution):
    """A package with files for one platform."""

    def has_ext_modules(self):
        return True


class BuildWheel(bdist_wheel):
    """Builds a wheel for this platform and any Python 3. The shared library does not depend on Python."""

    def get_tag(self):
        return "py3", "none", super().get_tag()[2]


# Folder for intermediate files, so that the build does not write to the source folder.
PARTS = ROOT / "build/python-package"
PARTS.mkdir(parents=True, exist_ok=True)
setup(version=version(), distclass=PlatformPackage,
      cmdclass={"build_py": BuildPackage, "sdist": BuildSourceArchive, "bdist_wheel": BuildWheel},
      options={"build": {"build_base": str(PARTS)}, "egg_info": {"egg_base": str(PARTS)}})
