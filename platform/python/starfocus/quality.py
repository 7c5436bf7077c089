# SPDX-License-Identifier: Apache-2.0
"""Measures the error of a picture against the true picture."""
from __future__ import annotations

from typing import NamedTuple, Optional

import numpy as np
from numpy.typing import NDArray

from ._calls import as_map, rows_of, whole
from ._types import Array, Bytes

_TAPS = 11
_SIGMA = 1.5
_C1, _C2 = (0.01 * 255) ** 2, (0.03 * 255) ** 2
_LUMA = (0.299, 0.587, 0.114)


class Quality(NamedTuple):
    """Similarity of a picture to the true picture. Larger values are better.

    Attributes:
        psnr: PSNR of all R, G and B samples in dB; infinite for equal pictures.
        ssim: mean SSIM of the luma, at most 1.
        silhouette_psnr: PSNR in dB of the samples near silhouettes; infinite for equal samples. None: no disparity map
            was given, or the map has no silhouette.
    """

    psnr: float
    ssim: float
    silhouette_psnr: Optional[float]


def evaluate(result: Array, truth: Array, disparity: Optional[Array] = None, *, distance: int = 8,
             step: float = 1.0) -> Quality:
    """Measures the error of a picture against the true picture.

    Args:
        result, truth: pictures of one size, at least 11 x 11 pixels, uint8 of shape (height, width, 3).
        disparity: true disparity map of the pictures, of shape (height, width). None: silhouettes are not measured.
        distance: largest distance of a pixel from a silhouette in rows and in columns, at least 0.
        step: disparities of neighbouring pixels that differ by more than `step` pixels form a silhouette; at least 0.

    PSNR is 10 log10(255**2 / mean squared difference). SSIM is the index of Wang et al. (2004) with a Gaussian window
    of 11 x 11 pixels, a standard deviation of 1.5 pixels, K1 = 0.01 and K2 = 0.03. The mean SSIM covers all windows
    inside the picture. The luma is 0.299 R + 0.587 G + 0.114 B. `./do bench` uses the same definitions, with the largest
    blur radius as `distance`, and limits PSNR to 99 dB.

    Both pixels at a step of disparity are pixels of a silhouette. Steps to values that are not finite are ignored.

    Raises TypeError or ValueError for arrays of a wrong type or shape, and for numbers of a wrong type or out of range.
    """
    truth = np.asarray(truth)
    if truth.ndim != 3 or truth.shape[2] != 3 or min(truth.shape[:2]) < _TAPS:
        raise ValueError(f"truth: expected the shape (height, width, 3) of at least {_TAPS} x {_TAPS} pixels, found "
                         f"{truth.shape}")
    distance = whole(distance, "distance")
    for name, value in (("distance", distance), ("step", step)):
        if not value >= 0:
            raise ValueError(f"{name}: expected at least 0, found {value}")
    truth = rows_of(truth, np.uint8, truth.shape, "truth")
    result = rows_of(result, np.uint8, truth.shape, "result")
    squares = (result.astype(np.float64) - truth) ** 2
    near = None
    if disparity is not None:
        near = _near_silhouettes(rows_of(as_map(disparity), np.float32, truth.shape[:2], "disparity"), distance, step)
    return Quality(_psnr(squares), _ssim(_luma(result), _luma(truth)),
                   _psnr(squares[near]) if near is not None and near.any() else None)


def _psnr(squares: NDArray[np.float64]) -> float:
    mean = float(np.mean(squares))
    return float("inf") if mean == 0 else float(10 * np.log10(255**2 / mean))


def _luma(picture: Bytes) -> NDArray[np.float64]:
    luma: NDArray[np.float64] = picture @ np.array(_LUMA)
    return luma


def _window_means(plane: NDArray[np.float64]) -> NDArray[np.float64]:
    """Returns the weighted mean of each window that lies inside the plane."""
    taps = np.exp(-0.5 * ((np.arange(_TAPS) - _TAPS // 2) / _SIGMA) ** 2)
    taps /= taps.sum()
    height, width = plane.shape[0] - _TAPS + 1, plane.shape[1] - _TAPS + 1
    rows = np.zeros((height, plane.shape[1]))
    for i, tap in enumerate(taps):
        rows += tap * plane[i:i + height]
    means = np.zeros((height, width))
    for i, tap in enumerate(taps):
        means += tap * rows[:, i:i + width]
    return means


def _ssim(a: NDArray[np.float64], b: NDArray[np.float64]) -> float:
    mean_a, mean_b = _window_means(a), _window_means(b)
    covariance = _window_means(a * b) - mean_a * mean_b
    variances = _window_means(a * a) - mean_a**2 + _window_means(b * b) - mean_b**2
    index = (2 * mean_a * mean_b + _C1) * (2 * covariance + _C2)
    index /= (mean_a**2 + mean_b**2 + _C1) * (variances + _C2)
    return float(index.mean())


def _near_silhouettes(disparity: Array, distance: int, step: float) -> NDArray[np.bool_]:
    """Returns True for the pixels that are at most `distance` rows and columns from a silhouette."""
    near = np.zeros(disparity.shape, np.bool_)
    finite = np.isfinite(disparity)
    values = np.where(finite, disparity, 0)
    for axis in (0, 1):
        lines, known, depths = (np.swapaxes(array, 0, axis) for array in (near, finite, values))
        edges = known[1:] & known[:-1] & (np.abs(np.diff(depths, axis=0)) > step)
        lines[1:] |= edges
        lines[:-1] |= edges
    for axis in (0, 1):
        lines = np.swapaxes(near, 0, axis)
        counts = np.concatenate([np.zeros((1, lines.shape[1]), int), np.cumsum(lines, axis=0)])
        index = np.arange(lines.shape[0])
        after = np.minimum(index + distance + 1, lines.shape[0])
        lines[:] = counts[after] > counts[np.maximum(index - distance, 0)]
    return near
