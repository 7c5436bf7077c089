# SPDX-License-Identifier: Apache-2.0
"""Computes disparity maps and coverage from mattes: the alpha of a subject, as segmentation networks compute it."""
from __future__ import annotations

from ctypes import Structure, byref
from typing import Any, NamedTuple, Tuple

import numpy as np

from . import _abi
from ._abi import library
from ._calls import depth_map, map_values, stride_of, whole
from ._types import Array, Bytes, Floats
from .errors import call, out_of_range
from .maps import Disparity


class MatteStats(NamedTuple):
    """Place of the subject in a matte. Positions are fractions of the width and the height.

    Attributes:
        covered: mean alpha, from 0 to 1.
        left, top, right, bottom: box around all samples of at least 128; 0 if none exist.
        horizon, ground: proposed floor for `matte_field`.
    """

    covered: float
    left: float
    top: float
    right: float
    bottom: float
    horizon: float
    ground: float


class MatteField(NamedTuple):
    """Map and coverage of a photo with a matte. Both arrays have the shape (height, width).

    Attributes:
        disparity: disparities, float32.
        coverage: alpha of the subject, uint8. Pass the coverage to `Refocuser.refocus` or `Refocuser.prepare`.
    """

    disparity: Floats
    coverage: Bytes


def measure_matte(matte: Array) -> MatteStats:
    """Measures the place of the subject in a matte, an array of uint8 of shape (height, width)."""
    given, kept = _matte(matte)
    stats = _abi.MatteStats()
    call(library.starfocus_measure_matte, byref(given), byref(stats))
    del kept
    return MatteStats(*(getattr(stats, name) for name in MatteStats._fields))


def matte_field(matte: Array, width: int, height: int, subject: float, background: float = 0.0, *,
                horizon: float = 0.0, ground: float = 0.0) -> MatteField:
    """Returns the map and the coverage of a photo of width x height pixels that has a matte and no depth.

    Args:
        matte: alpha of the subject, uint8 of shape (height, width) and of any size.
        width, height: size of the photo.
        subject, background: disparities in pixels per unit of u, within +-500, of which `subject` is not smaller.
        horizon, ground: rows at which the floor begins and on which the subject stands, as fractions of the height.
            Between these rows the disparity of the background rises to `subject`. Both 0: no floor.

    Raises ArgumentError for values out of range, and TypeError or ValueError for arrays of a wrong type or shape.
    """
    width, height = _size(width, height)
    given, kept = _matte(matte)
    disparity, coverage = np.empty((height, width), np.float32), np.empty((height, width), np.uint8)
    out = _output(coverage)
    out.disparity, out.disparity_stride = disparity.ctypes.data, stride_of(disparity)
    depth = _abi.MatteDepth(subject, background, horizon, ground)
    call(library.starfocus_matte_field, byref(given), byref(depth), width, height, None, byref(out))
    del kept
    return MatteField(disparity, coverage)


def matte_coverage(matte: Array, disparity: Disparity, width: int, height: int) -> Bytes:
    """Returns the coverage of a photo of width x height pixels that has a matte and a disparity map.

    The coverage is the matte at the outlines of the subject. Where the matte and the map contradict each other, and at
    all other edges, the coverage is what the map implies.

    Args:
        matte: alpha of the subject, uint8 of shape (height, width) and of any size.
        disparity: array or DepthMap without unknown values, at most as large as the photo.
        width, height: size of the photo.

    Raises ArgumentError or DisparityError for values out of range, and TypeError or ValueError for arrays of a wrong
    type or shape.
    """
    width, height = _size(width, height)
    depth, kept_map = depth_map(disparity)
    given, kept = _matte(matte)
    coverage = np.empty((height, width), np.uint8)
    call(library.starfocus_matte_coverage, byref(given), byref(depth), width, height, None, byref(_output(coverage)))
    del kept, kept_map
    return coverage


def _size(width: int, height: int) -> Tuple[int, int]:
    for name, length in (("width", whole(width, "width")), ("height", whole(height, "height"))):
        if not 1 <= length <= _abi.MAX_SIZE:
            raise out_of_range(name, f"1 to {_abi.MAX_SIZE}", length)
    return width, height


def _matte(matte: Any) -> Tuple[Structure, Array]:
    """Returns a starfocus_matte, and the array that must stay alive while it is read."""
    values = map_values(matte, (np.dtype(np.uint8),), "matte")
    height, width = values.shape
    return _abi.Matte(values.ctypes.data, stride_of(values), 1, width, height), values


def _output(coverage: Bytes) -> Structure:
    out = _abi.DisparityOutput()
    out.coverage, out.coverage_stride = coverage.ctypes.data, stride_of(coverage)
    return out
