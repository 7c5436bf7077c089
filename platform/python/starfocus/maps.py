# SPDX-License-Identifier: Apache-2.0
"""Measures, fills, estimates and repairs disparity maps, and finds the focus and aperture of a lens."""
from __future__ import annotations

import ctypes
import math
from ctypes import byref
from typing import Any, List, NamedTuple, Optional, Tuple, Union

import numpy as np

from . import _abi
from ._calls import (Pool, ProgressFunction, Views, Watch, aligned, as_list, as_map, callbacks_of, depth_map,
                     light_field, pointer, positions_of, samples_of, set_field, size_of_views, stride_of, whole)
from ._abi import library
from ._types import Array, Bytes, Floats
from .errors import call, out_of_range
from .images import DepthMap

#: A disparity map: an array of floats of shape (height, width), or a DepthMap.
Disparity = Union[Array, DepthMap]


class DisparityStats(NamedTuple):
    """Range of a disparity map.

    Attributes:
        min, max: smallest and largest known disparity; 0 if no disparity is known.
        invalid: number of unknown disparities, which are NaN, infinite, or the invalid value of a DepthMap.
    """

    min: float
    max: float
    invalid: int


class DisparityMap(NamedTuple):
    """An estimated or repaired disparity map. All arrays have the shape (height, width).

    Attributes:
        disparity: disparities, float32.
        confidence: confidence of each disparity, uint8; 0 means that another disparity fits as well.
        coverage: alpha of the foreground, uint8: the part of each pixel that the nearer surface covers. Pass the
            coverage to `Refocuser.refocus` or `Refocuser.prepare` together with the map. None, except for maps that
            were repaired from one view that shows hair.
    """

    disparity: Floats
    confidence: Bytes
    coverage: Optional[Bytes] = None


def view_positions(count: int = 17) -> List[Tuple[float, float]]:
    """Returns the positions (u, v) of the first `count` views of the star, at most 17. The first one is the centre.

    u grows to the right and v downwards, each from -1 to 1.
    """
    u, v = ctypes.c_double(), ctypes.c_double()
    positions = []
    for index in range(count):
        call(library.starfocus_view_position, index, byref(u), byref(v))
        positions.append((u.value, v.value))
    return positions


def measure_disparity(disparity: Disparity) -> DisparityStats:
    """Measures the range of the disparities of an array or a DepthMap."""
    depth, kept = depth_map(disparity)
    stats = _abi.DisparityStats()
    call(library.starfocus_measure_disparity, byref(depth), byref(stats))
    del kept
    return DisparityStats(stats.min, stats.max, stats.invalid)


def fill_disparity(disparity: Array) -> Floats:
    """Returns a copy of a disparity map in which values that are NaN or infinite are filled.

    A missing value is replaced by the nearest finite value to its left or right. If finite values exist on both sides,
    the smaller value is used, because it belongs to the farther surface. Rows without a finite value are filled from
    the rows above and below in the same way. Raises DisparityError if no value is finite.
    """
    filled = np.array(as_map(disparity), order="C")
    height, width = filled.shape
    call(library.starfocus_fill_disparity, pointer(filled), stride_of(filled), width, height)
    return filled


def focus_at(disparity: Disparity, x: int, y: int, size: Optional[Tuple[int, int]] = None) -> float:
    """Returns the disparity to focus at for the pixel (x, y) of the picture, for example where a user tapped.

    This disparity is the median of the known disparities up to 3 values away that belong to the surface of the pixel.

    Args:
        disparity: array or DepthMap.
        x, y: pixel of the picture.
        size: width and height of the picture; None: the size of the map.

    Raises ArgumentError if the pixel lies outside the picture, and DisparityError if all 7 x 7 disparities are unknown.
    """
    depth, kept = depth_map(disparity)
    width, height = (depth.width, depth.height) if size is None else (whole(length, "size") for length in size)
    focus = ctypes.c_double()
    call(library.starfocus_focus_at, byref(depth), width, height, whole(x, "x"), whole(y, "y"), byref(focus))
    del kept
    return focus.value


def aperture_of_f_stop(f_stop: float, widest: float = 1.0) -> float:
    """Returns the aperture of an f-stop: widest / f_stop.

    Args:
        f_stop: f-stop of the lens, finite and at least `widest`.
        widest: f-stop of a lens with aperture 1, above 0. With 1, f-stops are relative to that lens.

    Raises ArgumentError for values out of range.
    """
    if not 0 < widest < math.inf:
        raise out_of_range("widest", "a number above 0", widest)
    if not widest <= f_stop < math.inf:
        raise out_of_range("f_stop", f"a number of at least {widest:.9g}", f_stop)
    return widest / f_stop


def estimate_disparity(views: Views, disparity_min: float, disparity_max: float, *, positions: Any = None,
                       workers: int = 0, progress: Optional[ProgressFunction] = None) -> DisparityMap:
    """Estimates the disparity of each pixel of the centre view.

    Args:
        views: 5, 9 or 17 views at the positions of `view_positions`, or 2 to 17 views with `positions`, each uint8 of
            shape (height, width, 3).
        disparity_min, disparity_max: range of the disparities in pixels per unit of u, within +-500.
        positions: positions (u, v) of the views, each from -1 to 1, of which the first is (0, 0). For a stereo pair,
            pass `[(0, 0), (1, 0)]`. None: the positions of `view_positions`.
        workers: number of threads; 0: one for each big core of the machine.
        progress: receives the number of finished rows and the number of rows; a true result cancels the call.

    Raises a subclass of StarfocusError, and TypeError or ValueError for arrays of a wrong type or shape.
    """
    return _make_map(library.starfocus_estimate_disparity, views, None, (disparity_min, disparity_max), workers,
                     progress, positions)


def repair_disparity(views: Views, disparity: Disparity, disparity_min: Optional[float] = None,
                     disparity_max: Optional[float] = None, *, workers: int = 0,
                     progress: Optional[ProgressFunction] = None) -> DisparityMap:
    """Repairs a disparity map: noise, values that are not finite, and edges that are blurred or displaced.

    Args:
        views: 1, 5, 9 or 17 views at the positions of `view_positions`, each uint8 of shape (height, width, 3).
        disparity: map to repair: an array of shape (height, width), or a DepthMap that may be smaller than the views.
            The function does not change this map.
        disparity_min, disparity_max: range of the result in pixels per unit of u, within +-500. The range must contain
            all finite values of the map. None: the smallest and the largest finite value of the map.
        workers: number of threads; 0: one for each big core of the machine.
        progress: receives the number of finished rows and the number of rows; a true result cancels the call.

    With one view that shows hair, the result may have coverage. Refocusing renders the hair better only if it receives
    this coverage with the map.

    Raises a subclass of StarfocusError, and TypeError or ValueError for arrays of a wrong type or shape.
    """
    stats = measure_disparity(disparity)
    span = (stats.min if disparity_min is None else disparity_min,
            stats.max if disparity_max is None else disparity_max)
    return _make_map(library.starfocus_repair_disparity, views, disparity, span, workers, progress)


def _make_map(make: Any, views: Views, given: Optional[Disparity], span: Tuple[float, float], workers: int,
              progress: Optional[ProgressFunction], positions: Any = None) -> DisparityMap:
    """Calls starfocus_estimate_disparity or starfocus_repair_disparity. `given` is the map to repair, if any."""
    views = as_list(views)
    height, width = size_of_views(views)
    kind, _ = samples_of(views)
    if kind != np.uint8:
        raise TypeError(f"views: expected uint8, found {kind}")
    pool, watch, size = Pool(workers), Watch(progress), ctypes.c_size_t()
    config, problem = _abi.defaults(_abi.Config), _abi.Problem()
    for name, value in (("width", width), ("height", height), ("views", len(views))):
        set_field(config, name, value)
    if positions is not None:
        config.positions = positions_of(positions, len(views))
    config.disparity_min, config.disparity_max = span
    config.features = _abi.FEATURES["images"] if isinstance(given, DepthMap) else 0
    config.max_workers = pool.workers
    call(library.starfocus_map_workspace_size, byref(config), given is not None, byref(size))
    field, kept = light_field(views, given, len(views), height, width)
    memory = aligned(size.value)
    disparity, confidence, coverage = (np.empty((height, width), kind) for kind in (np.float32, np.uint8, np.uint8))
    made = _abi.DisparityOutput()
    for name, plane in (("disparity", disparity), ("confidence", confidence), ("coverage", coverage)):
        setattr(made, name, plane.ctypes.data)
        setattr(made, name + "_stride", stride_of(plane))
    callbacks = callbacks_of(pool, watch)
    status = make(byref(config), byref(callbacks), byref(field), byref(made), pointer(memory), size.value,
                  byref(problem))
    del kept
    watch.check(status, problem)
    return DisparityMap(disparity, confidence, coverage if made.has_coverage else None)
