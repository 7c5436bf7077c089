# SPDX-License-Identifier: Apache-2.0
"""The enumerations of the C headers, where what each value means is told."""
from enum import IntEnum


class Mode(IntEnum):
    """How a picture is refocused: starfocus_mode."""

    FRAME = 0
    BENCHMARK = 1
    BLOCK = 2
    BLUR = 3


class Renderer(IntEnum):
    """What renders views, and so how many of them a blur radius needs: starfocus_renderer."""

    AUTO = 0
    LINE_SCAN = 1
    SLICES = 2


class Shape(IntEnum):
    """The opening of the lens: starfocus_shape."""

    FALL_OFF = 0
    DISC = 1
    POLYGON = 2
    RING = 3


class Transfer(IntEnum):
    """How codes of pictures stand for light, for the configuration's transfer: starfocus_transfer."""

    SRGB = 0
    NONE = 1


class Format(IntEnum):
    """Where the bytes of an image lie: starfocus_format."""

    RGB = 0
    BGR = 1
    RGBX = 2
    BGRX = 3
    NV12 = 4
    NV21 = 5
    I420 = 6
    YUV_420_888 = 7


class Matrix(IntEnum):
    """How luma and chroma are made of R, G, B: starfocus_matrix."""

    BT601 = 0
    BT709 = 1


class Range(IntEnum):
    """Which codes luma and chroma have: starfocus_range."""

    LIMITED = 0
    FULL = 1


class DepthMeaning(IntEnum):
    """What a value z of a depth map means, disparity = scale z + offset or scale / z + offset: starfocus_depth_meaning."""

    LINEAR = 0
    RECIPROCAL = 1


class Status(IntEnum):
    """What calls of the library answer with: starfocus_status, without its prefix STARFOCUS_ERROR_."""

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
