# SPDX-License-Identifier: Apache-2.0
"""Disparity maps: measuring, filling, estimating and repairing them, and what they say of a lens."""
from __future__ import annotations

import ctypes
from ctypes import byref
from typing import Any, List, NamedTuple, Optional, Tuple

import numpy as np

from . import _abi
from ._calls import (Pool, ProgressFunction, Views, Watch, aligned, as_list, as_map, light_field, pointer,
                     set_field, stride_of, whole)
from ._abi import library
from .errors import check


class DisparityStats(NamedTuple):
    """Smallest and largest finite value of a map, and how many are not finite."""

    min: float
    max: float
    invalid: int


class DisparityMap(NamedTuple):
    """A map (float32) and how sure each of its pixels is (uint8): 0 means that another disparity is as good.

    coverage (uint8; None: there is none) goes with a map that was repaired by one view and has hair as a closed
    outline: how much of each pixel the nearer surface covers. Pass it to refocus, or prepare."""

    disparity: np.ndarray
    confidence: np.ndarray
    coverage: Optional[np.ndarray] = None


def view_positions(count: int = 17) -> List[Tuple[float, float]]:
    """Where the first `count` views lie, as (u, v): the centre comes first."""
    u, v = ctypes.c_double(), ctypes.c_double()
    positions = []
    for index in range(count):
        if not library.starfocus_view_position(index, byref(u), byref(v)):
            raise ValueError(f"view_positions: expected at most {_abi.MAX_VIEWS} views, found {count}")
        positions.append((u.value, v.value))
    return positions


def measure_disparity(disparity: np.ndarray) -> DisparityStats:
    """The range of a map."""
    disparity = as_map(disparity)
    stats = _abi.DisparityStats()
    check(library.starfocus_measure_disparity(*_rows(disparity), byref(stats)))
    return DisparityStats(stats.min, stats.max, stats.invalid)


def fill_disparity(disparity: np.ndarray) -> np.ndarray:
    """A copy whose values that are not finite are those of the farther neighbour in their row."""
    filled = np.array(as_map(disparity), order="C")
    check(library.starfocus_fill_disparity(*_rows(filled)))
    return filled


def focus_at(disparity: np.ndarray, x: int, y: int) -> float:
    """The focus for what is at the pixel (x, y): the median of its surface around there."""
    focus = ctypes.c_double()
    check(library.starfocus_focus_at(*_rows(as_map(disparity)), whole(x, "x"), whole(y, "y"), byref(focus)))
    return focus.value


def aperture_of_f_stop(f_stop: float, widest: float = 1.0) -> float:
    """The aperture of a lens stopped down to `f_stop`, where `widest` is the f-stop of aperture 1."""
    aperture = ctypes.c_double()
    check(library.starfocus_aperture_of_f_stop(f_stop, widest, byref(aperture)))
    return aperture.value


def estimate_disparity(views: Views, disparity_min: float, disparity_max: float, *, workers: int = 0,
                       progress: Optional[ProgressFunction] = None) -> DisparityMap:
    """The disparity of each pixel of the centre view, from 5, 9 or 17 views, looked for in this range."""
    return _make_map(library.starfocus_estimate_workspace_size, library.starfocus_estimate_disparity, views, None,
                     (disparity_min, disparity_max), workers, progress)


def repair_disparity(views: Views, disparity: np.ndarray, disparity_min: Optional[float] = None,
                     disparity_max: Optional[float] = None, *, workers: int = 0,
                     progress: Optional[ProgressFunction] = None) -> DisparityMap:
    """A map whose edges are wrong or blurred, which is noisy or has unknown (not finite) values, repaired by
    1, 5, 9 or 17 views; all within this range, which is the map's own unless it is given. With one view it may have
    coverage, without which it is no better where there is hair."""
    stats = measure_disparity(disparity)
    span = (stats.min if disparity_min is None else disparity_min,
            stats.max if disparity_max is None else disparity_max)
    return _make_map(library.starfocus_repair_workspace_size, library.starfocus_repair_disparity, views, disparity, span, workers,
                     progress)


def _make_map(size_of: Any, make: Any, views: Views, given: Optional[np.ndarray], span: Tuple[float, float],
              workers: int, progress: Optional[ProgressFunction]) -> DisparityMap:
    views = as_list(views)
    shape = np.asarray(views[0]).shape if len(views) > 0 else ()
    if len(shape) != 3:
        raise ValueError(f"views: expected arrays of the shape (height, width, 3), found {len(views)} of {shape}")
    height, width = shape[:2]
    pool, watch, size = Pool(workers), Watch(progress), ctypes.c_size_t()
    config, problem = _abi.DepthConfig(), _abi.Problem()
    library.starfocus_depth_config_init_sized(byref(config), ctypes.sizeof(config))
    config.problem = ctypes.addressof(problem)
    for name, value in (("width", width), ("height", height), ("views", len(views))):
        set_field(config, name, value)
    config.disparity_min, config.disparity_max = span
    config.max_workers, config.progress = pool.workers, watch.function
    config.runner, config.runner_data = pool.runner, pool.handle
    check(size_of(byref(config), byref(size)), problem)
    field, kept = light_field(views, given, len(views), height, width)
    memory = aligned(size.value)
    disparity, confidence, coverage = (np.empty((height, width), kind) for kind in (np.float32, np.uint8, np.uint8))
    made = _abi.Map()
    for name, plane in (("disparity", disparity), ("confidence", confidence), ("coverage", coverage)):
        setattr(made, name, plane.ctypes.data)
        setattr(made, name + "_stride", stride_of(plane))
    status = make(byref(config), byref(field), byref(made), pointer(memory), size.value)
    del kept
    watch.check(status, problem)
    return DisparityMap(disparity, confidence, coverage if made.has_coverage else None)


def _rows(disparity: np.ndarray) -> Tuple[Any, int, int, int]:
    """Where a map begins, its stride, width and height, as calls of the library take them."""
    return pointer(disparity), stride_of(disparity), disparity.shape[1], disparity.shape[0]
