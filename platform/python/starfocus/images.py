# SPDX-License-Identifier: Apache-2.0
"""Pictures and depth maps in the formats of cameras (starfocus_image and starfocus_depth_map)."""
from __future__ import annotations

from ctypes import Structure, byref, c_int32, c_size_t
from dataclasses import dataclass
from typing import Any, Optional, Sequence, Tuple

import numpy as np

from . import _abi
from ._abi import library
from ._calls import has_rows, map_values, stride_of, whole
from ._types import Array
from .constants import DepthMeaning, Format, Matrix, Range
from .errors import call

_DEPTH_TYPES = {np.dtype(np.float32): 0, np.dtype(np.uint16): 1, np.dtype(np.uint8): 2, np.dtype(np.float16): 3}
_DEPTH16 = 4


@dataclass(frozen=True)
class Image:
    """A picture in one of the formats of `Format`. The Image refers to the arrays of the caller and copies nothing.

    Attributes:
        format: layout of the picture.
        planes: arrays of uint8, one per plane; of float16 for RGB_HALF and RGBA_HALF, and of uint16 for the other
            formats with samples of 16 bits. The first axis of an array counts rows, which are contiguous. Planes of
            an output must be writable.
        matrix, range: matrix and code range of YUV formats; ignored for RGB formats.
        pixel_stride: bytes from pixel to pixel of an RGB format, at most 256, or bytes from chroma sample to chroma
            sample of YUV_420_888, 1 or 2. 0: the smallest value that the format allows.
    """

    format: Format
    planes: Sequence[Array]
    matrix: Matrix = Matrix.BT601
    range: Range = Range.LIMITED
    pixel_stride: int = 0

    @staticmethod
    def empty(form: Format, width: int, height: int, matrix: Matrix = Matrix.BT601,
              codes: Range = Range.LIMITED) -> "Image":
        """Returns a new picture without gaps between rows. Its contents are undefined.

        Args:
            form: layout of the picture.
            width, height: size in pixels.
            matrix, codes: matrix and code range of YUV formats.
        """
        kind = _sample_type(form)
        sizes = _plane_sizes(_abi.Image(form), width, height)
        return Image(form, [np.empty((rows, size // kind.itemsize), kind) for rows, size in sizes], matrix, codes)

    def as_structure(self, width: int, height: int, what: str,
                     written: bool = False) -> Tuple[Structure, Sequence[Array]]:
        """Returns the starfocus_image of a picture of this size, and the arrays that it points to.

        Raises TypeError or ValueError if a plane has the wrong type, is too small, or cannot be read or written in
        place. `what` names the picture in messages; `written` is True for outputs.
        """
        pixel_stride = whole(self.pixel_stride, f"{what}, pixel_stride")
        image = _abi.Image(Format(self.format), Matrix(self.matrix), Range(self.range), pixel_stride)
        sizes = _plane_sizes(image, width, height)
        planes = tuple(self.planes)
        if len(planes) != len(sizes):
            raise ValueError(f"{what}: expected {len(sizes)} planes, found {len(planes)}")
        for i, (plane, (rows, row_bytes)) in enumerate(zip(planes, sizes)):
            _check_plane(plane, _sample_type(self.format), (rows, row_bytes), f"{what}, plane {i}", written)
            image.planes[i], image.strides[i] = plane.ctypes.data, stride_of(plane)
        return image, planes


@dataclass(frozen=True)
class DepthMap:
    """Depth map of the centre view, as large as the picture or smaller.

    Attributes:
        values: array of shape (height, width), of float32, float16, uint16 or uint8. Arrays with aligned, contiguous
            rows are read in place, and all others are copied, for example flipped ones. Other floating-point types and
            byte orders are converted. Masked values are unknown depth.
        meaning: how a value z gives a disparity: scale * z + offset (LINEAR), or scale / z + offset for distances z
            (RECIPROCAL).
        scale: finite and not 0; rounded to float32.
        offset: finite; rounded to float32.
        invalid: value that stands for unknown depth; None: no such value. Maps with unknown values require
            `fill_unknown=1` in the configuration.
        depth16: True for uint16 values in Android's format DEPTH16: z is the distance in millimetres in the lower 13
            bits, where 0 is unknown, and the confidence in the upper 3 bits is ignored.
    """

    values: Array
    meaning: DepthMeaning = DepthMeaning.LINEAR
    scale: float = 1.0
    offset: float = 0.0
    invalid: Optional[float] = None
    depth16: bool = False

    def as_structure(self) -> Tuple[Structure, Array]:
        """Returns the starfocus_depth_map, and the array that it points to.

        Raises TypeError or ValueError if the values have the wrong type or shape.
        """
        values = map_values(self.values, _DEPTH_TYPES, "depth")
        if self.depth16 and values.dtype != np.uint16:
            raise TypeError(f"depth: expected uint16 for depth16, found {values.dtype}")
        height, width = values.shape
        kind = _DEPTH16 if self.depth16 else _DEPTH_TYPES[values.dtype]
        depth = _abi.DepthMap(values.ctypes.data, stride_of(values), width, height, kind,
                              DepthMeaning(self.meaning), self.scale, self.offset, self.invalid or 0.0,
                              self.invalid is not None)
        return depth, values


def _sample_type(form: Format) -> "np.dtype[Any]":
    """Returns the type of the samples of a format."""
    if form < Format.RGB16:
        return np.dtype(np.uint8)
    return np.dtype(np.float16 if form in (Format.RGB_HALF, Format.RGBA_HALF) else np.uint16)


def _plane_sizes(image: Structure, width: int, height: int) -> Sequence[Tuple[int, int]]:
    """Returns the number of rows and the bytes per row of each plane of a picture, whose planes are not read."""
    rows, row_bytes = c_int32(), c_size_t()
    sizes = []
    for plane in range(len(image.planes)):
        call(library.starfocus_plane_size, byref(image), plane, width, height, byref(rows), byref(row_bytes))
        if rows.value > 0:
            sizes.append((rows.value, row_bytes.value))
    return sizes


def _check_plane(plane: Array, kind: "np.dtype[Any]", size: Tuple[int, int], what: str, written: bool) -> None:
    """Raises an error unless the plane has this type and at least this size: rows, and bytes per row."""
    rows, row_bytes = size
    if plane.dtype != kind:
        raise TypeError(f"{what}: expected {kind}, found {plane.dtype}")
    if plane.ndim < 2 or 0 in plane.shape or not has_rows(plane):
        raise ValueError(f"{what}: expected contiguous rows, found the shape {plane.shape} with the strides "
                         f"{plane.strides}")
    found = plane.shape[0], plane[0].nbytes
    if found[0] < rows or found[1] < row_bytes:
        raise ValueError(f"{what}: expected {rows} rows of {row_bytes} bytes at least, found {found[0]} of "
                         f"{found[1]}")
    if written and not plane.flags.writeable:
        raise ValueError(f"{what}: expected to be writable")
