#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""usage: tag_wheel.py WHEEL FOLDER [PACKAGE...]

Checks that the programs and libraries in WHEEL need no libraries except the C library, and writes the wheel to FOLDER
with the tag manylinux_2_X, where 2.X is the oldest glibc that has all symbols that the files use. The Debian packages
PACKAGE are linked statically: the wheel gets their licences, and a list of the source packages. Requires readelf and
the Python package wheel. SOURCE_DATE_EPOCH is the time of the files in the wheel.
"""
import platform
import re
import shutil
import subprocess
import sys
import tempfile
import zipfile
from pathlib import Path

# Libraries of glibc.
ALLOWED = re.compile(r"(libc|libm|libpthread|libdl|librt)\.so\.\d+|ld-linux.*\.so\.\d+")


def run(*command: str) -> str:
    """Returns the output of a command."""
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def unpack(wheel: Path, folder: Path) -> None:
    """Unpacks a wheel with the permissions of its files, which `wheel unpack` ignores."""
    with zipfile.ZipFile(wheel) as archive:
        for member in archive.infolist():
            Path(archive.extract(member, folder)).chmod(member.external_attr >> 16 & 0o777)


def check(folder: Path) -> tuple:
    """Checks all ELF files of a folder. Returns the oldest version of glibc that the files accept."""
    files = [path for path in folder.rglob("*") if path.is_file() and path.read_bytes()[:4] == b"\x7fELF"]
    if not files:
        sys.exit("expected programs and libraries in the wheel, found none")
    newest = (2, 5)  # glibc of the oldest manylinux tag of this form
    for path in files:
        for needed in re.findall(r"\(NEEDED\).*\[(.*)\]", run("readelf", "-dW", str(path))):
            if not ALLOWED.fullmatch(needed):
                sys.exit(f"{path.relative_to(folder)}: expected only libraries of glibc, found {needed}")
        versions = re.findall(r"Name: GLIBC_(\d+)\.(\d+)", run("readelf", "-VW", str(path)))
        newest = max([newest, *((int(major), int(minor)) for major, minor in versions)])
    return newest


def add_licences(folder: Path, packages: list) -> None:
    """Copies the licences of Debian packages to a new folder, and lists the source packages with their versions."""
    folder.mkdir()
    for package in packages:
        shutil.copy(f"/usr/share/doc/{package}/copyright", folder / package)
    sources = run("dpkg-query", "-W", "-f", "${source:Package} ${source:Version}\\n", *packages)
    (folder / "SOURCES").write_text("".join(sorted(set(sources.splitlines(keepends=True)))), encoding="utf-8")


def main() -> None:
    wheel, target, packages = Path(sys.argv[1]), sys.argv[2], sys.argv[3:]
    with tempfile.TemporaryDirectory() as work:
        folder = Path(work)
        unpack(wheel, folder)
        (info,) = folder.glob("*.dist-info")
        major, minor = check(folder)
        description = (info / "WHEEL").read_text(encoding="utf-8")
        tag = f"py3-none-manylinux_{major}_{minor}_{platform.machine()}"
        (info / "WHEEL").write_text(re.sub("(?m)^Tag: .*", f"Tag: {tag}", description), encoding="utf-8")
        if packages:
            add_licences(info / "licenses", packages)
        run(sys.executable, "-m", "wheel", "pack", "--dest-dir", target, str(folder))
    print(f"{tag}: the wheel needs only glibc {major}.{minor} or newer")


if __name__ == "__main__":
    main()
