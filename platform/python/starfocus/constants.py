# SPDX-License-Identifier: Apache-2.0
"""Enumerations of the C headers. The headers describe the values."""
from enum import IntEnum


class Mode(IntEnum):
    """How the picture is divided, and how many views are rendered (starfocus_mode).

    FRAME: one number of views for the whole picture. BENCHMARK: as FRAME, with more views. BLOCK: blocks of
    different sizes, each with its own number of views. BLUR: the blurred centre view, without other views.
    """

    FRAME = 0
    BENCHMARK = 1
    BLOCK = 2
    BLUR = 3


class Renderer(IntEnum):
    """How views are rendered (starfocus_renderer).

    AUTO: line scan for Mode.FRAME of a star of 5 or more views, slices otherwise. LINE_SCAN: the paper's line scan.
    SLICES: slices of the scene, with fewer views.
    """

    AUTO = 0
    LINE_SCAN = 1
    SLICES = 2


class Shape(IntEnum):
    """Shape of the aperture (starfocus_shape).

    FALL_OFF: a disc that is darker towards its rim. DISC: a disc of constant brightness. POLYGON: a polygon, as of
    a shutter with blades. RING: a disc with a hole, as of a mirror lens.
    """

    FALL_OFF = 0
    DISC = 1
    POLYGON = 2
    RING = 3


class Transfer(IntEnum):
    """How the codes of a picture represent light (starfocus_transfer).

    The field `transfer` of the configuration has one of these values, or its name in small letters. SRGB: the sRGB
    curve. NONE: light is the code itself. PQ, HLG: the curves of ITU-R BT.2100; they require `deep=1`.
    """

    SRGB = 0
    NONE = 1
    PQ = 2
    HLG = 3


class Format(IntEnum):
    """Layout of a picture (starfocus_format).

    RGB formats are named by the order of bytes in memory. YUV formats have chroma planes of half the width and, except
    P210, half the height. The formats from RGB16 on have samples of 16 bits and require `deep=1`.
    """

    RGB = 0
    BGR = 1
    RGBX = 2
    BGRX = 3
    NV12 = 4
    NV21 = 5
    I420 = 6
    YUV_420_888 = 7
    RGB16 = 8
    RGBA16 = 9
    RGB_HALF = 10
    RGBA_HALF = 11
    P010 = 12
    P210 = 13


class Matrix(IntEnum):
    """Matrix of YUV formats (starfocus_matrix): ITU-R BT.601 or BT.709."""

    BT601 = 0
    BT709 = 1


class Range(IntEnum):
    """Range of the codes of YUV formats (starfocus_range).

    LIMITED: luma codes from 16 to 235. FULL: codes from 0 to 255, as in JPEG and Android's cameras.
    """

    LIMITED = 0
    FULL = 1


class DepthMeaning(IntEnum):
    """How a value z of a depth map gives a disparity (starfocus_depth_meaning).

    LINEAR: scale * z + offset. RECIPROCAL: scale / z + offset, for distances z.
    """

    LINEAR = 0
    RECIPROCAL = 1


class Status(IntEnum):
    """Result of a call of the library (starfocus_status), named without the prefix STARFOCUS_ERROR_."""

    OK = 0
    NULL = 1
    STRUCTURE = 2
    RANGE = 3
    FEATURE = 4
    STATE = 5
    WORKSPACE = 6
    TOO_LARGE = 7
    MEMORY = 8
    STRIDE = 9
    OVERLAP = 10
    BLUR = 11
    DISPARITY = 12
    NOT_FINITE = 13
    ALL_INVALID = 14
    PREPARED = 15
    RUNNER = 16
    CANCELLED = 17
