# SPDX-License-Identifier: Apache-2.0
"""Builds the Python package: the Python files, and the shared library and the program that CMake builds from this tree.

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

from setuptools import setup
from setuptools.command.build_py import build_py

try:
    from setuptools.command.bdist_wheel import bdist_wheel
except ImportError:  # setuptools before 70
    from wheel.bdist_wheel import bdist_wheel

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
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
             "-DSTARFOCUS_TESTS=OFF", *shlex.split(os.environ.get("CMAKE_ARGS", ""))], check=True)
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


class BuildWheel(bdist_wheel):
    """Builds a wheel for this platform and any Python 3. The shared library does not depend on Python."""

    def finalize_options(self):
        super().finalize_options()
        self.root_is_pure = False

    def get_tag(self):
        return "py3", "none", super().get_tag()[2]


# Folder for intermediate files, so that the build does not write to the source folder.
PARTS = ROOT / "build/python-package"
PARTS.mkdir(parents=True, exist_ok=True)
setup(version=version(), cmdclass={"build_py": BuildPackage, "bdist_wheel": BuildWheel},
      options={"build": {"build_base": str(PARTS)}, "egg_info": {"egg_base": str(PARTS)}})
