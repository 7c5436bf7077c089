# SPDX-License-Identifier: Apache-2.0
"""The enumerations of the C headers, where what each value means is told."""
from enum import IntEnum


class Mode(IntEnum):
    """How a picture is refocused: sf_mode."""

    FRAME = 0
    BENCHMARK = 1
    BLOCK = 2
    BLUR = 3


class Rule(IntEnum):
    """How many views a blur radius needs: sf_rule."""

    DEFAULT = 0
    PAPER = 1
    SUBAPERTURE = 2


class Shape(IntEnum):
    """The opening of the lens, for the configuration's aperture_shape: sf_shape."""

    FALL_OFF = 0
    DISC = 1
    POLYGON = 2
    RING = 3


class Transfer(IntEnum):
    """How codes of pictures stand for light, for the configuration's transfer: sf_transfer."""

    SRGB = 0
    NONE = 1


class Format(IntEnum):
    """Where the bytes of an image lie: sf_format."""

    RGB = 0
    BGR = 1
    RGBX = 2
    BGRX = 3
    NV12 = 4
    NV21 = 5
    I420 = 6
    YUV_420_888 = 7


class Matrix(IntEnum):
    """How luma and chroma are made of R, G, B: sf_matrix."""

    BT601 = 0
    BT709 = 1


class Range(IntEnum):
    """Which codes luma and chroma have: sf_range."""

    LIMITED = 0
    FULL = 1


class DepthMeaning(IntEnum):
    """What a value z of a depth map means, disparity = scale z + offset or scale / z + offset: sf_depth_meaning."""

    LINEAR = 0
    RECIPROCAL = 1


class Status(IntEnum):
    """What calls of the library answer with: sf_status, without its prefix SF_ERROR_."""

    OK = 0
    NULL = 1
    VERSION = 2
    RESERVED = 3
    SIZE = 4
    VIEWS = 5
    DISPARITY_RANGE = 6
    MAX_BLUR = 7
    BLOCK = 8
    WORKERS = 9
    THETA = 10
    WORKSPACE_SMALL = 11
    WORKSPACE_ALIGNMENT = 12
    MODE = 13
    FOCUS = 14
    APERTURE = 15
    BLUR_TOO_LARGE = 16
    STRIDE = 17
    NOT_FINITE = 18
    DISPARITY = 19
    STATE = 20
    COUNT = 21
    RUNNER = 22
    OVERLAP = 23
    ALL_INVALID = 24
    LAYER = 25
    DEBLOCKING = 26
    TIMING = 27
    RULE = 28
    N_SCALE = 29
    SKIPS = 30
    REGION = 31
    PREPARED = 32
    GATHER = 33
    TOO_LARGE = 34
    MEMORY = 35
    POSITION = 36
    F_STOP = 37
    TRANSFER = 38
    SHAPE = 39
    BLADES = 40
    ROTATION = 41
    CURVATURE = 42
    RING = 43
    CATS_EYE = 44
    HIGHLIGHTS = 45
    FILL = 46
    CANCELLED = 47
    IMAGES = 48
    FORMAT = 49
    PIXEL_STRIDE = 50
    DEPTH_TYPE = 51
    DEPTH_SCALE = 52
    DEPTH_SIZE = 53
    PREVIEW = 54
    VIEW_POSITIONS = 55
    STAR = 56
