# SPDX-License-Identifier: Apache-2.0
"""Reads light-field folders of the program `starfocus`, pictures and PFM files."""
from __future__ import annotations

from pathlib import Path
from typing import Any, List, Optional, Sequence, Tuple, Union

import numpy as np

from ._types import Array, Bytes, Floats
from .maps import view_positions

_SETS = (17, 9, 5, 1)


def read_light_field(folder: Union[str, Path], positions: Optional[Sequence[Tuple[float, float]]] = None
                     ) -> Tuple[List[Bytes], Optional[Floats]]:
    """Reads a light-field folder (docs/formats.md).

    Args:
        folder: folder with views, for example view_+0.0_+0.0.png, and optionally disparity.pfm.
        positions: (u, v) of the views to read. None: the views of the largest complete star of 17, 9, 5 or 1 views in
            the folder, at the positions of `view_positions`.

    Returns the list of views and the disparity map. The map is None if the folder has no disparity.pfm.

    Raises FileNotFoundError if a view is missing, and ValueError for malformed files.
    """
    folder = Path(folder)
    wanted = view_positions() if positions is None else positions
    paths = [_view_path(folder, u, v) for u, v in wanted]
    sizes = _SETS if positions is None else (len(paths),)
    count = next((size for size in sizes if all(paths[:size])), None)
    if count is None:
        missing = _view_name(*wanted[paths.index(None)])
        raise FileNotFoundError(f"{folder}: expected a view named {missing} (png, ppm or jpg)")
    disparity = folder / "disparity.pfm"
    found = [path for path in paths[:count] if path is not None]
    return [read_picture(path) for path in found], read_pfm(disparity) if disparity.exists() else None


def read_picture(path: Union[str, Path]) -> Bytes:
    """Reads a picture as uint8 of shape (height, width, 3).

    Formats other than PPM require the package pillow. Raises ValueError for a malformed PPM.
    """
    path = Path(path)
    if path.suffix != ".ppm":
        from PIL import Image  # type: ignore[import]  # pylint: disable=import-outside-toplevel
        with Image.open(path) as image:
            return np.asarray(image.convert("RGB"))
    data = path.read_bytes()
    (magic, width, height, largest), first = _header(data, 4, path)
    if (magic, largest) != (b"P6", b"255"):
        raise ValueError(f"{path}: expected a binary PPM of 8 bits")
    return _values(data, first, np.dtype(np.uint8), (int(height), int(width), 3), path)


def read_pfm(path: Union[str, Path]) -> Floats:
    """Reads a PFM with one channel as float32 of shape (height, width).

    The first row of the array is the top row of the map. Raises ValueError for a malformed PFM.
    """
    path = Path(path)
    data = path.read_bytes()
    (magic, width, height, scale), first = _header(data, 4, path)
    if magic != b"Pf":
        raise ValueError(f"{path}: expected a PFM of one channel")
    kind = np.dtype("<f4" if float(scale) < 0 else ">f4")
    values = _values(data, first, kind, (int(height), int(width)), path)
    return np.ascontiguousarray(values[::-1], np.float32)


def _coordinate(value: float) -> str:
    text = f"{round(value, 4) + 0.0:+.4f}".rstrip("0")
    return text + "0" if text.endswith(".") else text


def _view_name(u: float, v: float) -> str:
    return f"view_{_coordinate(u)}_{_coordinate(v)}"


def _view_path(folder: Path, u: float, v: float) -> Optional[Path]:
    paths = (folder / (_view_name(u, v) + end) for end in (".png", ".ppm", ".jpg"))
    return next((path for path in paths if path.exists()), None)


def _header(data: bytes, words: int, path: Path) -> Tuple[List[bytes], int]:
    """Returns the first `words` words of a file without comments, and the offset of the data behind them."""
    found: List[bytes] = []
    at = 0
    while len(found) < words:
        end = at
        while end < len(data) and not data[end:end + 1].isspace():
            end += 1
        if end == len(data):
            raise ValueError(f"{path}: its header ends too early")
        if data[at:at + 1] == b"#":
            end = data.find(b"\n", at)
        elif end > at:
            found.append(data[at:end])
        at = end + 1
    return found, at


def _values(data: bytes, first: int, kind: Any, shape: Tuple[int, ...], path: Path) -> Array:
    expected = int(np.prod(shape)) * np.dtype(kind).itemsize
    if len(data) - first < expected:
        raise ValueError(f"{path}: expected {expected} bytes of values, found {len(data) - first}")
    return np.frombuffer(data, kind, int(np.prod(shape)), first).reshape(shape)
