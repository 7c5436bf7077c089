# SPDX-License-Identifier: Apache-2.0
"""Builds the shared library by CMake, from the tree that this folder lies in, into the package.

Environment: STARFOCUS_BUILD names a folder where CMake has configured the tree already (default: one
of its own, build/python); CMAKE_ARGS are more arguments for configuring.
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


def version() -> str:
    """The version that the public header has."""
    text = (ROOT / "lib/include/starfocus/version.h").read_text(encoding="utf-8")
    parts = (re.search(rf"define STARFOCUS_VERSION_{part} (\d+)", text) for part in ("MAJOR", "MINOR", "PATCH"))
    return ".".join(part.group(1) for part in parts)


def build_library() -> Path:
    """Builds the library and says where it is."""
    given = os.environ.get("STARFOCUS_BUILD")
    folder = Path(given) if given else ROOT / "build/python"
    if not given:
        subprocess.run(
            ["cmake", "-S", ROOT, "-B", folder, "-DCMAKE_BUILD_TYPE=Release", "-DSTARFOCUS_PROGRAMS=OFF",
             "-DSTARFOCUS_TESTS=OFF", *shlex.split(os.environ.get("CMAKE_ARGS", ""))], check=True)
    subprocess.run(["cmake", "--build", folder, "--target", "starfocus_python", "--parallel",
                    str(os.cpu_count() or 1)], check=True)
    return folder / "lib" / LIBRARY


class BuildPackage(build_py):
    """The Python files, and the library among them."""

    def run(self):
        super().run()
        folder = HERE if getattr(self, "editable_mode", False) else Path(self.build_lib)
        shutil.copy2(build_library(), folder / "starfocus" / LIBRARY)


class BuildWheel(bdist_wheel):
    """A wheel of this machine's kind, for any Python 3: the library knows nothing of Python."""

    def finalize_options(self):
        super().finalize_options()
        self.root_is_pure = False

    def get_tag(self):
        return "py3", "none", super().get_tag()[2]


# What is made on the way stays out of the source tree.
PARTS = ROOT / "build/python-package"
PARTS.mkdir(parents=True, exist_ok=True)
setup(version=version(), cmdclass={"build_py": BuildPackage, "bdist_wheel": BuildWheel},
      options={"build": {"build_base": str(PARTS)}, "egg_info": {"egg_base": str(PARTS)}})
