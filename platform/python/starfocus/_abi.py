# SPDX-License-Identifier: Apache-2.0
"""The C ABI as ctypes sees it: the shared library, its structures and its functions.

The structures repeat those of the C headers field by field. Their sizes are compared with the
library's when it is loaded, so that one that has grown there is noticed here and nothing is read from
a wrong place.
"""
from __future__ import annotations

import ctypes
from ctypes import (CFUNCTYPE, POINTER, Structure, c_char_p, c_double, c_float, c_int, c_int32, c_int64,
                    c_size_t, c_uint32, c_uint64, c_void_p)
from pathlib import Path

MAX_VIEWS = 17
ALIGNMENT = 64
ABI_VERSION = 1

Progress = CFUNCTYPE(c_int, c_void_p, c_int32, c_int32)


class Timing(Structure):
    """sf_timing"""

    _fields_ = [(name, c_uint32) for name in ("block", "field", "a", "b", "c", "upsample", "span", "hole")]


class Position(Structure):
    """sf_position"""

    _fields_ = [("u", c_double), ("v", c_double)]


class Tuning(Structure):
    """sf_tuning"""

    _fields_ = [("max_layer", c_int32), ("deblocking", c_int32), ("skips", c_int32), ("gather", c_int32),
                ("n_scale", c_double), ("timing", Timing)]


class Config(Structure):
    """sf_config"""

    _fields_ = [
        ("size", c_uint32), ("width", c_int32), ("height", c_int32), ("views", c_int32),
        ("disparity_min", c_double), ("disparity_max", c_double), ("max_blur", c_double),
        ("superblock", c_int32), ("max_workers", c_int32), ("features", c_uint32), ("previews", c_int32),
        ("transfer", c_int32), ("highlights", c_double), ("positions", Position * MAX_VIEWS), ("tuning", Tuning),
        ("problem", c_void_p),
    ]


class Problem(Structure):
    """sf_problem"""

    _fields_ = [("status", c_int32), ("index", c_int32), ("field", c_char_p), ("expected", c_char_p),
                ("value", c_double), ("low", c_double), ("high", c_double)]


class Region(Structure):
    """sf_region"""

    _fields_ = [(name, c_int32) for name in ("x", "y", "width", "height")]


class Lens(Structure):
    """sf_lens"""

    _fields_ = [
        ("focus", c_double), ("aperture", c_double), ("shape", c_int32), ("blades", c_int32), ("theta", c_double),
        ("rotation", c_double), ("curvature", c_double), ("ring_inner", c_double), ("cats_eye", c_double),
    ]


class Params(Structure):
    """sf_params"""

    _fields_ = [
        ("size", c_uint32), ("mode", c_int32), ("renderer", c_int32), ("region", Region), ("lens", Lens),
        ("preview_shift", c_int32), ("previous", c_void_p),
    ]


class Callbacks(Structure):
    """sf_callbacks"""

    _fields_ = [
        ("runner", c_void_p), ("runner_data", c_void_p), ("progress", Progress), ("progress_data", c_void_p),
        ("clock", c_void_p), ("on_block", c_void_p), ("on_block_data", c_void_p),
    ]


class Image(Structure):
    """sf_image"""

    _fields_ = [
        ("format", c_int32), ("matrix", c_int32), ("range", c_int32), ("pixel_stride", c_int32),
        ("planes", c_void_p * 3), ("strides", c_size_t * 3),
    ]


class DepthMap(Structure):
    """sf_depth_map"""

    _fields_ = [
        ("data", c_void_p), ("stride", c_size_t), ("width", c_int32), ("height", c_int32),
        ("type", c_int32), ("meaning", c_int32), ("scale", c_double), ("offset", c_double),
        ("invalid", c_double), ("has_invalid", c_int32),
    ]


class LightField(Structure):
    """sf_light_field"""

    _fields_ = [("views", Image * MAX_VIEWS), ("depth", DepthMap), ("coverage", c_void_p),
                ("coverage_stride", c_size_t)]


class LayerReport(Structure):
    """sf_layer_report"""

    _fields_ = [(name, c_uint64) for name in
                ("blocks", "pixels", "views", "rendered_samples", "predicted_ps", "measured_ns")]


class Skipped(Structure):
    """sf_skipped"""

    _fields_ = [(name, c_uint64) for name in ("copied_blocks", "copied_pixels", "filled_blocks",
                                              "filled_pixels", "layer_columns", "boundaries")]


class Report(Structure):
    """sf_report"""

    _fields_ = [
        ("r_max", c_double), ("n", c_int32), ("rendered_views", c_int32), ("superblock", c_int32),
        ("rendered_samples", c_uint64), ("layers", LayerReport * 3), ("skipped", Skipped),
        ("centre_bytes", c_uint64), ("disparity_bytes", c_uint64), ("side_bytes", c_uint64),
        ("gathered_pixels", c_uint64), ("reused_blocks", c_uint64), ("unknown_pixels", c_uint64),
    ]


class DisparityStats(Structure):
    """sf_disparity_stats"""

    _fields_ = [("min", c_double), ("max", c_double), ("invalid", c_int64)]


class DepthConfig(Structure):
    """sf_depth_config"""

    _fields_ = [
        ("size", c_uint32), ("width", c_int32), ("height", c_int32), ("views", c_int32),
        ("disparity_min", c_double), ("disparity_max", c_double), ("max_workers", c_int32),
        ("runner", c_void_p), ("runner_data", c_void_p), ("progress", Progress), ("progress_data", c_void_p),
        ("problem", c_void_p),
    ]


class Map(Structure):
    """sf_map"""

    _fields_ = [
        ("disparity", c_void_p), ("disparity_stride", c_size_t), ("confidence", c_void_p),
        ("confidence_stride", c_size_t), ("coverage", c_void_p), ("coverage_stride", c_size_t),
        ("has_coverage", c_int32),
    ]


STRUCTURES = {
    "sf_problem": Problem, "sf_timing": Timing, "sf_tuning": Tuning, "sf_position": Position, "sf_config": Config,
    "sf_region": Region, "sf_lens": Lens, "sf_params": Params, "sf_light_field": LightField,
    "sf_layer_report": LayerReport,
    "sf_skipped": Skipped, "sf_report": Report, "sf_disparity_stats": DisparityStats,
    "sf_depth_config": DepthConfig, "sf_image": Image,
    "sf_depth_map": DepthMap, "sf_map": Map, "sf_callbacks": Callbacks,
}

_ENGINE_CALLS = {
    "sf_create": (POINTER(Config), c_void_p, POINTER(c_void_p)),
    "sf_set_callbacks": (c_void_p, POINTER(Callbacks)),
    "sf_prepared_size": (POINTER(Config), POINTER(c_size_t)),
    "sf_refocus": (c_void_p, POINTER(Params), POINTER(LightField), POINTER(Image), POINTER(Report)),
    "sf_prepare": (c_void_p, POINTER(LightField), c_void_p, c_size_t, POINTER(c_void_p)),
    "sf_refocus_prepared": (c_void_p, POINTER(Params), c_void_p, POINTER(Image), POINTER(Report)),
}
_MAP_CALLS = {
    "sf_measure_disparity": (c_void_p, c_size_t, c_int32, c_int32, POINTER(DisparityStats)),
    "sf_fill_disparity": (c_void_p, c_size_t, c_int32, c_int32),
    "sf_focus_at": (c_void_p, c_size_t, c_int32, c_int32, c_int32, c_int32, POINTER(c_double)),
    "sf_aperture_of_f_stop": (c_double, c_double, POINTER(c_double)),
    "sf_estimate_size": (POINTER(DepthConfig), POINTER(c_size_t)),
    "sf_repair_size": (POINTER(DepthConfig), POINTER(c_size_t)),
    "sf_estimate_disparity": (POINTER(DepthConfig), POINTER(LightField), POINTER(Map), c_void_p, c_size_t),
    "sf_repair_disparity": (POINTER(DepthConfig), POINTER(LightField), POINTER(Map), c_void_p, c_size_t),
    "sf_view_position": (c_int32, POINTER(c_double), POINTER(c_double)),
}
_OTHERS = {
    "sf_config_init_sized": (None, POINTER(Config), c_uint32),
    "sf_params_init_sized": (None, POINTER(Params), c_uint32),
    "sf_depth_config_init_sized": (None, POINTER(DepthConfig), c_uint32),
    "sf_destroy": (None, c_void_p),
    "sf_engine_problem": (POINTER(Problem), c_void_p),
    "sf_status_string": (c_char_p, c_int),
    "sf_simd_target": (c_char_p,),
    "sf_version": (c_char_p,),
    "sf_abi_version": (c_uint32,),
    "sf_struct_size": (c_size_t, c_char_p),
    "sf_pool_create": (c_void_p, c_int32),
    "sf_pool_workers": (c_int32, c_void_p),
    "sf_pool_destroy": (None, c_void_p),
}


def _load() -> ctypes.CDLL:
    """The library, whose calls let other Python threads run, with the types of its functions."""
    library = ctypes.CDLL(str(Path(__file__).with_name("libstarfocus_python.so")))
    for name, arguments in {**_ENGINE_CALLS, **_MAP_CALLS}.items():
        function = getattr(library, name)
        function.restype, function.argtypes = c_int, list(arguments)
    for name, (result, *arguments) in _OTHERS.items():
        function = getattr(library, name)
        function.restype, function.argtypes = result, arguments
    if library.sf_abi_version() != ABI_VERSION:
        raise ImportError(f"libstarfocus_python.so: expected ABI version {ABI_VERSION}, found "
                          f"{library.sf_abi_version()}")
    for name, structure in STRUCTURES.items():
        expected, found = ctypes.sizeof(structure), library.sf_struct_size(name.encode())
        if expected != found:
            raise ImportError(f"libstarfocus_python.so: expected {name} of {expected} bytes, found {found}")
    return library


library = _load()
run_on_pool = ctypes.cast(library.sf_pool_run, c_void_p)
