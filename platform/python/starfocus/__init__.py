# SPDX-License-Identifier: Apache-2.0
"""starfocus: refocusing of sparse light fields.

    views, disparity = starfocus.read_light_field("demo/portrait")
    refocuser = starfocus.Refocuser.for_light_field(views, disparity)
    picture = refocuser.refocus(views, disparity, focus=starfocus.focus_at(disparity, 422, 414))

Pictures are arrays of uint8 and of the shape (height, width, 3), disparity maps of float32 and
(height, width). A disparity is in pixels per unit of u, larger is nearer; views lie where
`view_positions` tells, or at positions that are given.
"""
from ._abi import library as _library
from .constants import (DepthMeaning, Format, Matrix, Mode, Range, Renderer, Shape, Status, Transfer)
from .errors import ArgumentError, Cancelled, DisparityError, OutOfMemory, StarfocusError
from .folder import read_light_field, read_pfm, read_picture
from .images import DepthMap, Image
from .maps import (DisparityMap, DisparityStats, aperture_of_f_stop, estimate_disparity, fill_disparity,
                   focus_at, measure_disparity, repair_disparity, view_positions)
from .refocuser import Prepared, Refocuser

__version__: str = _library.starfocus_version().decode()


def simd_target() -> str:
    """The SIMD instructions that this machine refocuses with, such as "AVX2"."""
    return _library.starfocus_simd_target().decode()


__all__ = [
    "ArgumentError", "Cancelled", "DepthMap", "DepthMeaning", "DisparityError", "DisparityMap",
    "DisparityStats", "Format", "Image", "Matrix", "Mode", "OutOfMemory", "Prepared", "Range", "Refocuser",
    "Renderer", "Shape", "StarfocusError", "Status", "Transfer", "aperture_of_f_stop", "estimate_disparity",
    "fill_disparity", "focus_at", "measure_disparity", "read_light_field", "read_pfm", "read_picture",
    "repair_disparity", "simd_target", "view_positions",
]
