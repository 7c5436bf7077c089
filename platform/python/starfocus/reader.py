# SPDX-License-Identifier: Apache-2.0
"""Reads light fields and photos by the program `starfocus`, which is a part of the package, and reads pictures."""
from __future__ import annotations

import json
import os
import re
import subprocess
import tempfile
import warnings
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Dict, List, Optional, Sequence, Tuple, Union

import numpy as np
from numpy.typing import ArrayLike

from ._types import Bytes, Floats
from .maps import view_positions

_GAP = rb"\s(?:\s|#[^\n]*\n)*"  # white space and comments
#: Width, height and scale, whose sign is the byte order. One byte separates the header from the values.
_PFM_HEADER = re.compile(rb"Pf%b([1-9]\d{0,8})%b([1-9]\d{0,8})%b([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)\s"
                         % (_GAP, _GAP, _GAP))
_PROGRAM = Path(__file__).parent / "bin" / "starfocus"
#: Path of a file or folder.
AnyPath = Union[str, bytes, "os.PathLike[str]", "os.PathLike[bytes]"]
#: Value of an option of `starfocus import`. True sets an option without a value. None and False do not set an option.
#: An array, or anything that `numpy.asarray` converts to one, replaces the file of `depth` or `matte`.
Option = Union[AnyPath, ArrayLike, None]


class InputError(ValueError):
    """A file or folder cannot be read as a light field. The message is that of the program `starfocus`."""


@dataclass(frozen=True)
class LightField:
    """A light field from a file or folder.

    Attributes:
        views: views, each uint8 of shape (height, width, 3). The first one is the centre view.
        disparity: disparity map of the centre view in pixels per unit of u, float32 of shape (height, width); None if
            the input has no map.
        coverage: alpha of the foreground, uint8 of shape (height, width), for `Refocuser.refocus`; None if neither the
            input, nor a matte, nor the repair of its map has coverage.
        positions: positions (u, v) of the views, each from -1 to 1, for `Refocuser.for_light_field`.
        format: name of the format of the input.
        facts: other facts in the files of the input, by name.
        widest_f_stop: f-stop of a lens with aperture 1, for `aperture_of_f_stop`; None if unknown.
    """

    views: List[Bytes]
    disparity: Optional[Floats]
    coverage: Optional[Bytes]
    positions: List[Tuple[float, float]]
    format: str
    facts: Dict[str, str]
    widest_f_stop: Optional[float]


def read_light_field(path: AnyPath, *,
                     views: Union[int, Sequence[Tuple[float, float]], None] = None, estimate: bool = False,
                     **options: Option) -> LightField:
    """Reads a light field, or a photo with depth or a matte, in any format that the program `starfocus` reads.

    docs/formats.md describes the formats.

    Args:
        path: folder of views, or photo.
        views: views to read: 1, 5, 9 or 17 for a star, or positions (u, v) that begin with (0, 0). None: all views.
        estimate: True estimates the disparity map of an input without a map, which must have several views.
        options: other options of `starfocus import`, with underscores for hyphens; `starfocus help import` describes
            them. For example, `depth="depth.png", near="white"` reads a photo and its depth picture, and
            `right="right.jpg"` reads a stereo pair. `matte="matte.png"` reads a photo and the matte of its subject,
            which gives two surfaces and their coverage; `floor=True` adds the ground below the subject. `depth` and
            `matte` may be arrays of shape (height, width), or of shape (height, width, 4), whose last channel is
            used, with further axes of length 1 before or after them. Lists of rows and pictures of the package pillow
            are converted to arrays. Values of a matte reach from 0 to 1, which also applies to integers up to 1; larger
            integers of 8 or 16 bits reach to the largest value of their type, and all other values to 255. Masked
            values are unknown depth, or the background of a matte. As in the program, maps of photos are repaired by
            default; `no_repair=True` returns them unchanged. `threads=4` uses 4 threads.

    The function writes the light field to a temporary folder. Notes of the program are issued as warnings.

    Raises InputError if the input cannot be read or an option is wrong, and RuntimeError if the package was built
    without the program.
    """
    source = os.fsdecode(path)
    source = os.path.join(os.curdir, source) if source.startswith("-") else source
    if views is None or isinstance(views, int):
        wanted: Option = views
    else:
        wanted = ":".join(f"{u},{v}" for u, v in views)
    with tempfile.TemporaryDirectory(prefix="starfocus-") as temporary:
        folder = Path(temporary) / "light_field"
        files = {name: _as_file(name, value, temporary) for name, value in options.items()}
        described = json.loads(_run(["import", source, str(folder)], {**files, "views": wanted, "json": True},
                                    temporary))
        if estimate and not (folder / "disparity.pfm").exists():
            _run(["disparity", str(folder)], {"threads": options.get("threads")}, temporary)
        return _read_folder(folder, described)


def read_picture(path: AnyPath) -> Bytes:
    """Reads a picture as uint8 of shape (height, width, 3) with the package pillow, which raises its own errors."""
    from PIL import Image  # type: ignore[import]  # pylint: disable=import-outside-toplevel
    with Image.open(os.fsdecode(path)) as image:
        return np.asarray(image.convert("RGB"))


def read_pfm(path: AnyPath) -> Floats:
    """Reads a PFM with one channel as float32 of shape (height, width).

    The first row of the array is the top row of the map. Raises ValueError for a malformed PFM.
    """
    path = os.fsdecode(path)
    data = Path(path).read_bytes()
    header = _PFM_HEADER.match(data)
    if header is None:
        raise ValueError(f"{path}: expected the header of a PFM with one channel, found {data[:32]!r}")
    width, height, scale = int(header[1]), int(header[2]), float(header[3])
    expected, found = 4 * width * height, len(data) - header.end()
    if found < expected:
        raise ValueError(f"{path}: expected {expected} bytes of values, found {found}")
    values = np.frombuffer(data, "<f4" if scale < 0 else ">f4", width * height, header.end()).reshape(height, width)
    return np.ascontiguousarray(values[::-1], np.float32)


def _as_file(name: str, value: Option, folder: str) -> Option:
    """Writes an array to a file in `folder`, and returns its path. Returns other values as they are."""
    is_array = hasattr(value, "__array__") or hasattr(value, "__array_interface__")
    if not is_array and not isinstance(value, (list, tuple)):
        return value
    array = plane = np.asanyarray(value)
    if array.ndim == 0:
        return value
    while plane.ndim > 2 and plane.shape[0] == 1:
        plane = plane[0]
    while plane.ndim > 2 and plane.shape[-1] == 1:
        plane = plane[..., 0]
    if plane.ndim == 3 and plane.shape[2] == 4:
        plane = plane[:, :, 3]
    if plane.ndim != 2:
        raise ValueError(f"{name}: expected an array of shape (height, width) or (height, width, 4), found shape "
                         f"{array.shape}")
    if plane.dtype == bool:
        plane = plane * np.uint8(255)
    if isinstance(plane, np.ma.MaskedArray):
        is_matte = name == "matte"
        values = np.asarray(plane, None if is_matte else np.float32)
        plane = np.where(np.asarray(plane.mask), values.dtype.type(0 if is_matte else np.nan), values)
    path = os.path.join(folder, f"{name}.npy")
    np.save(path, plane)
    return path


def _run(command: List[str], options: Dict[str, Option], temporary: str) -> str:
    """Runs a command of the program, and returns its output. Issues its notes as warnings.

    If the program fails, its error is the last line that starts with the name of the program. All texts name files in
    the folder `temporary` without the folder.
    """
    if not _PROGRAM.exists():
        raise RuntimeError("read_light_field: expected a package with the program starfocus, found one that was built "
                           "without it (STARFOCUS_PROGRAMS=OFF)")
    arguments = [str(_PROGRAM), *command]
    for name, value in options.items():
        if value is not None and value is not False:
            flag = "--" + name.replace("_", "-")
            text = os.fsdecode(value) if isinstance(value, (bytes, os.PathLike)) else value
            arguments.append(flag if value is True else f"{flag}={text}")
    done = subprocess.run(arguments, stdin=subprocess.DEVNULL, capture_output=True, text=True, errors="replace",
                          check=False)
    output, errors = (text.replace(os.path.join(temporary, ""), "") for text in (done.stdout, done.stderr))
    notes = errors.strip().splitlines()
    error = ""
    if done.returncode != 0:
        at = max((at for at, note in enumerate(notes) if note.startswith("starfocus: ")), default=None)
        unexplained = f"starfocus {command[0]}: expected the exit code 0, found {done.returncode}"
        error = unexplained if at is None else notes.pop(at)
    for note in notes:
        warnings.warn(note, stacklevel=3)
    if error:
        raise InputError(error.removeprefix("starfocus: "))
    return output


def _read_folder(folder: Path, described: Dict[str, Any]) -> LightField:
    """Reads a light-field folder that `starfocus import` has written with the description `described`."""
    if "positions" in described:
        positions = [(u, v) for u, v in described["positions"]]
    else:
        positions = view_positions(described["views"])
    disparity, coverage = folder / "disparity.pfm", folder / "coverage.png"
    return LightField([read_picture(folder / f"view_{_coordinate(u)}_{_coordinate(v)}.png") for u, v in positions],
                      read_pfm(disparity) if disparity.exists() else None,
                      np.ascontiguousarray(read_picture(coverage)[:, :, 0]) if coverage.exists() else None,
                      positions, described["format"], described.get("facts", {}), described.get("widest_f_stop"))


def _coordinate(value: float) -> str:
    """Returns a coordinate as in the names of views."""
    text = f"{round(value, 4) + 0.0:+.4f}".rstrip("0")
    return text + "0" if text.endswith(".") else text
