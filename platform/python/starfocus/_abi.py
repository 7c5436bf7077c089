# SPDX-License-Identifier: Apache-2.0
"""Declares the structures and functions of the C ABI for ctypes, and loads the shared library.

The structures have the same fields as the C structures. When this module loads the library, it compares the size of
each structure with the size that the library reports. A mismatch raises ImportError.
"""
from __future__ import annotations

import ctypes
from ctypes import (CFUNCTYPE, POINTER, Structure, c_char_p, c_double, c_float, c_int, c_int32, c_int64,
                    c_size_t, c_uint32, c_uint64, c_void_p)
from pathlib import Path

MAX_VIEWS = 17
MAX_SIZE = 65535
MAX_DISPARITY = 500.0
ALIGNMENT = 64
ABI_VERSION = 3
#: Names and bits of STARFOCUS_FEATURE_*, which are keywords of Refocuser.
FEATURES = {"line_scan": 1, "coverage": 2, "streaming": 4, "images": 8, "fill_unknown": 16, "shapes": 32}

Progress = CFUNCTYPE(c_int, c_void_p, c_int32, c_int32)


class Timing(Structure):
    """starfocus_timing"""

    _fields_ = [(name, c_uint32) for name in ("block", "field", "a", "b", "c", "upsample", "span", "hole")]


class Position(Structure):
    """starfocus_position"""

    _fields_ = [("u", c_double), ("v", c_double)]


class Tuning(Structure):
    """starfocus_tuning"""

    _fields_ = [("max_layer", c_int32), ("deblocking", c_int32), ("gather", c_int32),
                ("n_scale", c_double), ("timing", Timing)]


class Config(Structure):
    """starfocus_config"""

    _fields_ = [
        ("size", c_uint32), ("width", c_int32), ("height", c_int32), ("views", c_int32),
        ("disparity_min", c_double), ("disparity_max", c_double), ("max_blur", c_double),
        ("superblock", c_int32), ("max_workers", c_int32), ("features", c_uint32), ("previews", c_int32),
        ("transfer", c_int32), ("highlights", c_double), ("positions", Position * MAX_VIEWS), ("tuning", Tuning),
        ("problem", c_void_p),
    ]


class Problem(Structure):
    """starfocus_problem"""

    _fields_ = [("status", c_int32), ("index", c_int32), ("field", c_char_p), ("expected", c_char_p),
                ("value", c_double), ("low", c_double), ("high", c_double), ("x", c_int32), ("y", c_int32)]


class Region(Structure):
    """starfocus_region"""

    _fields_ = [(name, c_int32) for name in ("x", "y", "width", "height")]


class Lens(Structure):
    """starfocus_lens"""

    _fields_ = [
        ("focus", c_double), ("focus_nearer", c_double), ("focus_farther", c_double), ("aperture", c_double),
        ("shape", c_int32), ("blades", c_int32), ("theta", c_double), ("rotation", c_double), ("curvature", c_double),
        ("ring_inner", c_double), ("cats_eye", c_double),
    ]


class Params(Structure):
    """starfocus_params"""

    _fields_ = [
        ("size", c_uint32), ("mode", c_int32), ("renderer", c_int32), ("region", Region), ("lens", Lens),
        ("preview_shift", c_int32), ("previous", c_void_p),
    ]


class Callbacks(Structure):
    """starfocus_callbacks"""

    _fields_ = [
        ("runner", c_void_p), ("runner_data", c_void_p), ("progress", Progress), ("progress_data", c_void_p),
        ("clock", c_void_p), ("on_block", c_void_p), ("on_block_data", c_void_p),
    ]


class Image(Structure):
    """starfocus_image"""

    _fields_ = [
        ("format", c_int32), ("matrix", c_int32), ("range", c_int32), ("pixel_stride", c_int32),
        ("planes", c_void_p * 3), ("strides", c_size_t * 3),
    ]


class DepthMap(Structure):
    """starfocus_depth_map"""

    _fields_ = [
        ("data", c_void_p), ("stride", c_size_t), ("width", c_int32), ("height", c_int32),
        ("type", c_int32), ("meaning", c_int32), ("scale", c_double), ("offset", c_double),
        ("invalid", c_double), ("has_invalid", c_int32),
    ]


class LightField(Structure):
    """starfocus_light_field"""

    _fields_ = [("views", Image * MAX_VIEWS), ("depth", DepthMap), ("coverage", c_void_p),
                ("coverage_stride", c_size_t)]


class Previous(Structure):
    """starfocus_previous"""

    _fields_ = [("light_field", LightField), ("out", Image)]


class LayerReport(Structure):
    """starfocus_layer_report"""

    _fields_ = [(name, c_uint64) for name in
                ("blocks", "pixels", "views", "rendered_samples", "predicted_ps", "measured_ns")]


class Report(Structure):
    """starfocus_report"""

    _fields_ = [
        ("r_max", c_double), ("n", c_int32), ("rendered_views", c_int32), ("superblock", c_int32),
        ("rendered_samples", c_uint64), ("layers", LayerReport * 3),
        ("copied_pixels", c_uint64), ("gathered_pixels", c_uint64), ("reused_blocks", c_uint64), ("unknown_pixels", c_uint64),
    ]


class DisparityStats(Structure):
    """starfocus_disparity_stats"""

    _fields_ = [("min", c_double), ("max", c_double), ("invalid", c_int64)]


class DepthConfig(Structure):
    """starfocus_depth_config"""

    _fields_ = [
        ("size", c_uint32), ("width", c_int32), ("height", c_int32), ("views", c_int32),
        ("disparity_min", c_double), ("disparity_max", c_double), ("max_workers", c_int32),
        ("features", c_uint32), ("runner", c_void_p), ("runner_data", c_void_p), ("progress", Progress),
        ("progress_data", c_void_p), ("problem", c_void_p), ("positions", Position * MAX_VIEWS),
    ]


class Map(Structure):
    """starfocus_disparity_output"""

    _fields_ = [
        ("disparity", c_void_p), ("disparity_stride", c_size_t), ("confidence", c_void_p),
        ("confidence_stride", c_size_t), ("coverage", c_void_p), ("coverage_stride", c_size_t),
        ("has_coverage", c_int32),
    ]


class Matte(Structure):
    """starfocus_matte"""

    _fields_ = [("data", c_void_p), ("stride", c_size_t), ("pixel_stride", c_int32), ("width", c_int32),
                ("height", c_int32)]


class MatteStats(Structure):
    """starfocus_matte_stats"""

    _fields_ = [(name, c_double) for name in ("covered", "left", "top", "right", "bottom", "horizon", "ground")]


class MatteDepth(Structure):
    """starfocus_matte_depth"""

    _fields_ = [(name, c_double) for name in ("subject", "background", "horizon", "ground")]


STRUCTURES = {
    "starfocus_problem": Problem, "starfocus_timing": Timing, "starfocus_tuning": Tuning, "starfocus_position": Position, "starfocus_config": Config,
    "starfocus_region": Region, "starfocus_lens": Lens, "starfocus_params": Params, "starfocus_light_field": LightField,
    "starfocus_previous": Previous, "starfocus_layer_report": LayerReport,
    "starfocus_report": Report, "starfocus_disparity_stats": DisparityStats,
    "starfocus_depth_config": DepthConfig, "starfocus_image": Image,
    "starfocus_depth_map": DepthMap, "starfocus_disparity_output": Map, "starfocus_callbacks": Callbacks,
    "starfocus_matte": Matte, "starfocus_matte_stats": MatteStats, "starfocus_matte_depth": MatteDepth,
}

_ENGINE_CALLS = {
    "starfocus_create": (POINTER(Config), c_void_p, POINTER(c_void_p)),
    "starfocus_set_callbacks": (c_void_p, POINTER(Callbacks)),
    "starfocus_prepared_size": (POINTER(Config), POINTER(c_size_t)),
    "starfocus_refocus": (c_void_p, POINTER(Params), POINTER(LightField), POINTER(Image), POINTER(Report)),
    "starfocus_prepare": (c_void_p, POINTER(LightField), c_void_p, c_size_t, POINTER(c_void_p)),
    "starfocus_largest_aperture": (c_void_p, POINTER(Lens), POINTER(c_double)),
    "starfocus_stream_begin": (c_void_p, POINTER(Params)),
    "starfocus_stream_push": (c_void_p, POINTER(LightField), c_int32, POINTER(c_int32)),
    "starfocus_stream_pull": (c_void_p, POINTER(Image), c_int32, POINTER(c_int32), POINTER(Report)),
    "starfocus_refocus_prepared": (c_void_p, POINTER(Params), c_void_p, POINTER(Image), POINTER(Report)),
}
_MAP_CALLS = {
    "starfocus_measure_disparity": (POINTER(DepthMap), POINTER(DisparityStats)),
    "starfocus_fill_disparity": (c_void_p, c_size_t, c_int32, c_int32),
    "starfocus_focus_at": (POINTER(DepthMap), c_int32, c_int32, c_int32, c_int32, POINTER(c_double)),
    "starfocus_aperture_of_f_stop": (c_double, c_double, POINTER(c_double)),
    "starfocus_estimate_workspace_size": (POINTER(DepthConfig), POINTER(c_size_t)),
    "starfocus_repair_workspace_size": (POINTER(DepthConfig), POINTER(c_size_t)),
    "starfocus_estimate_disparity": (POINTER(DepthConfig), POINTER(LightField), POINTER(Map), c_void_p, c_size_t),
    "starfocus_repair_disparity": (POINTER(DepthConfig), POINTER(LightField), POINTER(Map), c_void_p, c_size_t),
    "starfocus_measure_matte": (POINTER(Matte), POINTER(MatteStats)),
    "starfocus_matte_field": (POINTER(Matte), POINTER(MatteDepth), c_int32, c_int32, POINTER(Region), POINTER(Map)),
    "starfocus_matte_coverage": (POINTER(Matte), POINTER(DepthMap), c_int32, c_int32, POINTER(Region), POINTER(Map)),
    "starfocus_view_position": (c_int32, POINTER(c_double), POINTER(c_double)),
}
_OTHERS = {
    "starfocus_config_init_sized": (None, POINTER(Config), c_uint32),
    "starfocus_params_init_sized": (None, POINTER(Params), c_uint32),
    "starfocus_depth_config_init_sized": (None, POINTER(DepthConfig), c_uint32),
    "starfocus_destroy": (None, c_void_p),
    "starfocus_engine_problem": (POINTER(Problem), c_void_p),
    "starfocus_status_string": (c_char_p, c_int),
    "starfocus_simd_target": (c_char_p,),
    "starfocus_version": (c_char_p,),
    "starfocus_abi_version": (c_uint32,),
    "starfocus_struct_size": (c_size_t, c_char_p),
    "starfocus_pool_create": (c_void_p, c_int32),
    "starfocus_pool_workers": (c_int32, c_void_p),
    "starfocus_pool_destroy": (None, c_void_p),
}


def _load() -> ctypes.CDLL:
    """Loads the library and declares the types of its functions. Calls release the GIL.

    Raises ImportError if the library has another ABI version or a structure of another size.
    """
    library = ctypes.CDLL(str(Path(__file__).with_name("libstarfocus_python.so")))
    for name, arguments in {**_ENGINE_CALLS, **_MAP_CALLS}.items():
        function = getattr(library, name)
        function.restype, function.argtypes = c_int, list(arguments)
    for name, types in _OTHERS.items():
        function = getattr(library, name)
        function.restype, function.argtypes = types[0], list(types[1:])
    if library.starfocus_abi_version() != ABI_VERSION:
        raise ImportError(f"libstarfocus_python.so: expected ABI version {ABI_VERSION}, found "
                          f"{library.starfocus_abi_version()}")
    for name, structure in STRUCTURES.items():
        expected, found = ctypes.sizeof(structure), library.starfocus_struct_size(name.encode())
        if expected != found:
            raise ImportError(f"libstarfocus_python.so: expected {name} of {expected} bytes, found {found}")
    return library


library = _load()
run_on_pool = ctypes.cast(library.starfocus_pool_run, c_void_p)
