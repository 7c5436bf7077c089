# SPDX-License-Identifier: Apache-2.0
"""Loads the shared library, declares its functions for ctypes, and builds the structures of the C API.

The library lists the fields of each structure (starfocus_fields), so this module contains no layouts.
"""
from __future__ import annotations

import ctypes
from ctypes import (CFUNCTYPE, POINTER, Structure, c_char_p, c_double, c_int, c_int32, c_int64, c_size_t, c_uint32,
                    c_uint64, c_void_p)
from functools import lru_cache
from pathlib import Path
from typing import Any, Type

ABI = 1
MAX_VIEWS = 17
MAX_SIZE = 65535
ALIGNMENT = 64
LAYERS = 3
#: Names and bits of STARFOCUS_FEATURE_*, which are keywords of Refocuser.
FEATURES = {"coverage": 1, "streaming": 2, "images": 4, "shapes": 8, "deep": 16}

Progress = CFUNCTYPE(c_int, c_void_p, c_int32, c_int32)

#: Types of the elements of fields, by starfocus_field_type. The types of structures are not listed.
_TYPES: Any = (c_int32, c_uint32, c_int64, c_uint64, c_double, c_void_p, None, c_char_p, c_void_p)
_POINTER = 5


class Field(Structure):
    """starfocus_field"""

    _fields_ = [("name", c_char_p), ("structure", c_char_p), ("offset", c_uint32), ("count", c_uint32),
                ("type", c_int32)]


def _load() -> ctypes.CDLL:
    """Loads the library. Calls of its functions release the GIL. Raises ImportError for another ABI."""
    loaded = ctypes.CDLL(str(Path(__file__).with_name("libstarfocus_python.so")))
    loaded.starfocus_version.restype, found = c_char_p, c_uint32()
    loaded.starfocus_version(ctypes.byref(found))
    if found.value != ABI:
        raise ImportError(f"libstarfocus_python.so: expected ABI {ABI}, found {found.value}")
    loaded.starfocus_fields.restype = c_size_t
    return loaded


library = _load()


@lru_cache(maxsize=None)
def structure(name: str, **functions: Any) -> Type[Structure]:
    """Returns the structure of the C API with this name. `functions` are the types of fields that point to functions;
    other such fields are c_void_p.

    Raises ImportError if the library has no such structure, or if ctypes places its fields differently.
    """
    first, count = POINTER(Field)(), c_int32()
    size = library.starfocus_fields(name.encode(), ctypes.byref(first), ctypes.byref(count))
    fields, members = first[:count.value], []
    for field in fields:
        kind = structure(field.structure.decode()) if field.structure else _TYPES[field.type]
        if field.structure and field.type == _POINTER:
            kind = POINTER(kind)
        kind = functions.get(field.name.decode(), kind)
        members.append((field.name.decode(), kind * field.count if field.count > 1 else kind))
    made: Type[Structure] = type(name, (Structure,), {"_fields_": members})
    places = [getattr(made, member).offset for member, _ in members]
    if ctypes.sizeof(made) != size or places != [field.offset for field in fields]:
        raise ImportError(f"libstarfocus_python.so: expected {name} of {ctypes.sizeof(made)} bytes, found {size}")
    return made


Position = structure("starfocus_position")
Tuning = structure("starfocus_tuning")
Config = structure("starfocus_config")
Problem = structure("starfocus_problem")
Callbacks = structure("starfocus_callbacks", progress=Progress)
Image = structure("starfocus_image")
DepthMap = structure("starfocus_depth_map")
LightField = structure("starfocus_light_field")
Previous = structure("starfocus_previous")
Region = structure("starfocus_region")
Study = structure("starfocus_study")
Params = structure("starfocus_params")
LayerReport = structure("starfocus_layer_report")
Report = structure("starfocus_report")
DisparityStats = structure("starfocus_disparity_stats")
DisparityOutput = structure("starfocus_disparity_output")
Matte = structure("starfocus_matte")
MatteStats = structure("starfocus_matte_stats")
MatteDepth = structure("starfocus_matte_depth")

#: Functions that return a starfocus_status, with the types of their arguments.
_CALLS = {
    "starfocus_defaults": (c_char_p, c_void_p, c_uint32),
    "starfocus_create": (POINTER(Config), c_void_p, POINTER(c_void_p), POINTER(Problem)),
    "starfocus_set_callbacks": (c_void_p, POINTER(Callbacks)),
    "starfocus_prepared_size": (POINTER(Config), POINTER(c_size_t), POINTER(Problem)),
    "starfocus_refocus": (c_void_p, POINTER(Params), POINTER(LightField), POINTER(Image), POINTER(Report)),
    "starfocus_prepare": (c_void_p, POINTER(LightField), c_void_p, c_size_t, POINTER(c_void_p)),
    "starfocus_largest_aperture": (c_void_p, POINTER(Params), POINTER(c_double)),
    "starfocus_stream_begin": (c_void_p, POINTER(Params)),
    "starfocus_stream_push": (c_void_p, POINTER(LightField), c_int32, POINTER(c_int32)),
    "starfocus_stream_pull": (c_void_p, POINTER(Image), c_int32, POINTER(c_int32), POINTER(Report)),
    "starfocus_refocus_prepared": (c_void_p, POINTER(Params), c_void_p, POINTER(Image), POINTER(Report)),
    "starfocus_measure_disparity": (POINTER(DepthMap), POINTER(DisparityStats), POINTER(Problem)),
    "starfocus_fill_disparity": (c_void_p, c_size_t, c_int32, c_int32, POINTER(Problem)),
    "starfocus_focus_at": (POINTER(DepthMap), c_int32, c_int32, c_int32, c_int32, POINTER(c_double), POINTER(Problem)),
    "starfocus_map_workspace_size": (POINTER(Config), c_int32, POINTER(c_size_t), POINTER(Problem)),
    "starfocus_estimate_disparity": (POINTER(Config), POINTER(Callbacks), POINTER(LightField),
                                     POINTER(DisparityOutput), c_void_p, c_size_t, POINTER(Problem)),
    "starfocus_repair_disparity": (POINTER(Config), POINTER(Callbacks), POINTER(LightField), POINTER(DisparityOutput),
                                   c_void_p, c_size_t, POINTER(Problem)),
    "starfocus_measure_matte": (POINTER(Matte), POINTER(MatteStats), POINTER(Problem)),
    "starfocus_matte_field": (POINTER(Matte), POINTER(MatteDepth), c_int32, c_int32, POINTER(Region),
                              POINTER(DisparityOutput), POINTER(Problem)),
    "starfocus_matte_coverage": (POINTER(Matte), POINTER(DepthMap), c_int32, c_int32, POINTER(Region),
                                 POINTER(DisparityOutput), POINTER(Problem)),
    "starfocus_view_position": (c_int32, POINTER(c_double), POINTER(c_double), POINTER(Problem)),
    "starfocus_plane_size": (POINTER(Image), c_int32, c_int32, c_int32, POINTER(c_int32), POINTER(c_size_t),
                             POINTER(Problem)),
}
#: Other functions, with the types of their results and arguments.
_OTHERS = {
    "starfocus_version": (c_char_p, POINTER(c_uint32)),
    "starfocus_line_scan_renderer": (c_void_p,),
    "starfocus_destroy": (None, c_void_p),
    "starfocus_engine_problem": (POINTER(Problem), c_void_p),
    "starfocus_status_string": (c_char_p, c_int),
    "starfocus_simd_target": (c_char_p,),
    "starfocus_pool_create": (c_void_p, c_int32),
    "starfocus_pool_workers": (c_int32, c_void_p),
    "starfocus_pool_destroy": (None, c_void_p),
}
for _name, _types in {**{name: (c_int, *types) for name, types in _CALLS.items()}, **_OTHERS}.items():
    _function = getattr(library, _name)
    _function.restype, _function.argtypes = _types[0], list(_types[1:])
run_on_pool = ctypes.cast(library.starfocus_pool_run, c_void_p)


def defaults(kind: Type[Structure]) -> Structure:
    """Returns a structure with the defaults of the library. The structure must have a field `size`."""
    made = kind()
    library.starfocus_defaults(kind.__name__.encode(), ctypes.byref(made), ctypes.sizeof(made))
    return made
