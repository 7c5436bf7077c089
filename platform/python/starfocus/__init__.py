# SPDX-License-Identifier: Apache-2.0
"""starfocus: refocusing of sparse light fields.

    scene = starfocus.read_light_field("demo/portrait")
    refocuser = starfocus.Refocuser.for_light_field(scene.views, scene.disparity)
    focus = starfocus.focus_at(scene.disparity, 422, 414)
    picture = refocuser.refocus(scene.views, scene.disparity, focus=focus)

A light field consists of 1 to 17 rectified views and the disparity map of the centre view. Views and pictures
are arrays of uint8 with the shape (height, width, 3), or have more bits or alpha (`Refocuser`). Disparity maps
are arrays of float32 with the shape (height, width). Disparities are in pixels per unit of u; nearer points
have larger disparities. Views lie at the positions that `view_positions` returns, or at positions that the
caller passes to `Refocuser`.

The package calls the C library through ctypes, and returns pictures with the same bytes as the C library. The
documentation of the C headers (starfocus/starfocus.h) applies to all fields that are mentioned here by their C names.
"""
from ._abi import library as _library
from .constants import (DepthMeaning, Format, Matrix, Mode, Range, Renderer, Shape, Status, Transfer)
from .errors import ArgumentError, Cancelled, DisparityError, OutOfMemory, StarfocusError
from .images import DepthMap, Image
from .maps import (DisparityMap, DisparityStats, aperture_of_f_stop, estimate_disparity, fill_disparity,
                   focus_at, measure_disparity, repair_disparity, view_positions)
from .mattes import MatteField, MatteStats, matte_coverage, matte_field, measure_matte
from .quality import Quality, evaluate
from .reader import InputError, LightField, read_light_field, read_pfm, read_picture
from .refocuser import Prepared, Refocuser

__version__: str = _library.starfocus_version(None).decode()


def simd_target() -> str:
    """Returns the name of the SIMD target that the kernels use on this machine, for example "AVX2"."""
    name: bytes = _library.starfocus_simd_target()
    return name.decode()


__all__ = [
    "ArgumentError", "Cancelled", "DepthMap", "DepthMeaning", "DisparityError", "DisparityMap", "DisparityStats",
    "Format", "Image", "InputError", "LightField", "MatteField", "MatteStats", "Matrix", "Mode", "OutOfMemory",
    "Prepared", "Quality", "Range", "Refocuser", "Renderer", "Shape", "StarfocusError", "Status", "Transfer",
    "aperture_of_f_stop", "estimate_disparity", "evaluate", "fill_disparity", "focus_at", "matte_coverage",
    "matte_field", "measure_disparity", "measure_matte", "read_light_field", "read_pfm", "read_picture",
    "repair_disparity", "simd_target", "view_positions",
]
