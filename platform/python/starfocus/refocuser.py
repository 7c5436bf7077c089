# SPDX-License-Identifier: Apache-2.0
"""Refocusing."""
from __future__ import annotations

import ctypes
import math
import threading
import weakref
from ctypes import byref
from typing import Any, Dict, List, Optional, Tuple, Union

import numpy as np

from . import _abi
from ._calls import (Pool, ProgressFunction, RegionOfPicture, Views, Watch, aligned, as_image, as_list, light_field,
                     output, part_of, pointer, positions_of, set_coverage, set_field, whole)
from ._abi import library
from .constants import Mode, Renderer, Status
from .errors import ArgumentError, check
from .images import DepthMap, Image
from .maps import measure_disparity


#: A disparity map as an array of (height, width), or depths in another form.
Disparity = Union[np.ndarray, DepthMap]
#: A picture as an array of (height, width, 3), or in another format.
Picture = Union[np.ndarray, Image]

#: What `config` switches on by names of its own: bits of starfocus_config.features.
_FEATURES = {"line_scan": 1, "coverage": 2, "images": 8, "fill_unknown": 16, "shapes": 32}


class Refocuser:
    """An engine for light fields of one size.

    Args:
        width, height: of the pictures, in pixels.
        views: 1, 5, 9 or 17, in the order of `view_positions`; with positions any number up to 17.
        disparity_min, disparity_max: what values disparity maps may hold, in pixels per unit of u.
        workers: threads that refocus; 0: one for each big core of the machine.
        positions: (u, v) of each view where they are not those of `view_positions`, from -1 to 1, the centre
            (0, 0) first: `[(0, 0), (1, 0)]` of a stereo pair.
        config: other fields of starfocus_config and starfocus_tuning (starfocus.h) and features by their names, such as `max_blur`,
            `transfer`, `highlights`, `fill_unknown=1`, `shapes=1` for lenses that are polygons or have cat's
            eyes, `images=1` for other formats than RGB, or `previews=3` for `Prepared.preview` down to an
            eighth of the size.

    Memory is taken here and nowhere else. Calls let other Python threads run; calls of several threads with
    the same refocuser take turns. The bytes of pictures depend on neither the machine nor `workers`.
    """

    def __init__(self, width: int, height: int, views: int = 5, *, disparity_min: float,
                 disparity_max: float, workers: int = 0, positions: Any = None, **config: Any):
        self._config = _abi.Config()
        library.starfocus_config_init_sized(byref(self._config), ctypes.sizeof(self._config))
        set_below = {"size", "max_workers", "positions", "problem", "tuning"}
        known = {field[0] for field in _abi.Config._fields_} - set_below
        tuning = {field[0] for field in _abi.Tuning._fields_}
        for name, value in {**config, "width": width, "height": height, "views": views,
                            "disparity_min": disparity_min, "disparity_max": disparity_max}.items():
            if name in _FEATURES:
                self._config.features = self._config.features & ~_FEATURES[name] | (_FEATURES[name] if value else 0)
            elif name in tuning:
                set_field(self._config.tuning, name, value)
            elif name in known:
                set_field(self._config, name, value)
            else:
                raise TypeError(f"Refocuser: unknown field of the configuration '{name}'")
        if positions is not None:
            self._config.positions = positions_of(positions, views)
        self._pool = Pool(workers)
        self._config.max_workers = self._pool.workers
        engine = ctypes.c_void_p()
        self._problem = _abi.Problem()
        self._config.problem = ctypes.addressof(self._problem)
        check(library.starfocus_create(byref(self._config), None, byref(engine)), self._problem)
        self._engine = engine.value
        weakref.finalize(self, library.starfocus_destroy, self._engine)
        self._lock = threading.Lock()
        #: What the last refocusing did: the fields of starfocus_report.
        self.report: Dict[str, Any] = {}

    @classmethod
    def for_light_field(cls, views: Views, disparity: np.ndarray, *, workers: int = 0,
                        **config: Any) -> "Refocuser":
        """A refocuser for this light field and others like it: of its size, number of views and range of
        disparities, with room for the blur of every focus among these."""
        stats = measure_disparity(disparity)
        height, width = np.shape(disparity)
        views = as_list(views)
        room = min(128.0, max(1.0, math.ceil(stats.max - stats.min)))
        return cls(width, height, len(views), disparity_min=stats.min, disparity_max=stats.max,
                   workers=workers, **{"max_blur": room, **config})

    @property
    def width(self) -> int:
        """Of the pictures, in pixels."""
        return self._config.width

    @property
    def height(self) -> int:
        """Of the pictures, in pixels."""
        return self._config.height

    @property
    def workers(self) -> int:
        """Threads that refocus."""
        return self._pool.workers

    def refocus(self, views: Views, disparity: Disparity, *, focus: float, aperture: float = 1.0,
                coverage: Optional[np.ndarray] = None, mode: Mode = Mode.BLOCK, renderer: Renderer = Renderer.AUTO,
                region: Optional[RegionOfPicture] = None, out: Optional[Picture] = None,
                progress: Optional[ProgressFunction] = None, **lens: Any) -> Picture:
        """The picture that a lens of the radius `aperture`, from 0 to 1, focused at the disparity `focus`
        would have taken, as (height, width, 3) uint8.

        Args:
            views: uint8 of (height, width, 3) or an Image each; Images other than RGB need `images=1` in the
                configuration. Where rows are contiguous they are read where they are.
            disparity: (height, width), of the centre view; float32, other floating-point types are converted. Or a
                DepthMap, which needs `images=1` unless it is of float32 disparities and as large as the picture.
            coverage: (height, width) uint8: how much of each pixel the nearer of two surfaces covers, 255: all,
                as a matting network finds it; it decides over the map near depth edges. None: there is none.
            region: only this part of the picture, with the same bytes. Four zeros, as None: the whole picture.
            out: an array, or with `images=1` an Image, that is written and returned in place of a new array.
            progress: is told of the rows done and of all; what counts as true calls it off (Cancelled).
            lens: other fields of starfocus_lens (starfocus.h): `shape`, `blades`, `theta`, `rotation`, `curvature`,
                `ring_inner`, `cats_eye`.

        Raises StarfocusError, of which there are kinds, and TypeError or ValueError for arrays.
        """
        field, kept = light_field(views, disparity, self._config.views, self.height, self.width)
        kept += set_coverage(field, coverage, self.height, self.width)
        *_, width, height = part_of(region, self.width, self.height)
        params = self._params(mode, renderer, region, focus=focus, aperture=aperture, **lens)
        return self._picture(params, out, (height, width), progress, library.starfocus_refocus, byref(field), keep=kept)

    def prepare(self, views: Views, disparity: Disparity, *, coverage: Optional[np.ndarray] = None,
                progress: Optional[ProgressFunction] = None) -> "Prepared":
        """What is the same for every lens, made once for many pictures of one light field."""
        return Prepared(self, views, disparity, progress, coverage)

    def _picture(self, params: _abi.Params, out: Optional[Picture], size: Tuple[int, int],
                 progress: Optional[ProgressFunction], function: Any, scene: Any, *, keep: List[Any]) -> Picture:
        """The picture of that height and width by starfocus_refocus or its like, of the scene, which reads the arrays
        to `keep`."""
        if isinstance(out, Image):
            picture, image = out, out.as_structure(size[1], size[0], "out", written=True)
        else:
            picture = output(out, (*size, 3), "out")
            image = as_image(picture)
        self._call(Watch(progress), function, byref(params), scene, byref(image))
        del keep
        return picture

    def _params(self, mode: Mode, renderer: Renderer, region: Optional[RegionOfPicture], **lens: Any) -> _abi.Params:
        params = _abi.Params()
        library.starfocus_params_init_sized(byref(params), ctypes.sizeof(params))
        set_field(params, "mode", mode)
        set_field(params, "renderer", renderer)
        known = {field[0] for field in _abi.Lens._fields_}
        for name, value in lens.items():
            if name not in known:
                raise TypeError(f"refocus: unknown field of the lens '{name}'")
            set_field(params.lens, name, value)
        if region is not None:
            set_field(params, "region", tuple(region))
        return params

    def _call(self, watch: Watch, function: Any, *arguments: Any) -> None:
        """Calls the function with the engine, the arguments and a report."""
        report = _abi.Report()
        self._run(watch, function, *arguments, byref(report))
        self.report = _as_dict(report)

    def _run(self, watch: Watch, function: Any, *arguments: Any) -> None:
        """Calls the function with the engine and the arguments; the watch receives its progress."""
        callbacks = _abi.Callbacks(self._pool.runner, self._pool.handle, watch.function)
        with self._lock:
            status = library.starfocus_set_callbacks(self._engine, byref(callbacks))
            if status == Status.OK:
                status = function(self._engine, *arguments)
        watch.check(status, library.starfocus_engine_problem(self._engine).contents)


class Prepared:
    """A light field of which all that is the same for every lens has been made: 3.89 bytes per pixel, and
    for previews of 5 views up to 5.9 more. It keeps the arrays; they must stay as they are."""

    def __init__(self, refocuser: Refocuser, views: Views, disparity: Disparity,
                 progress: Optional[ProgressFunction], coverage: Optional[np.ndarray] = None):
        # pylint: disable=protected-access
        config = refocuser._config
        self._refocuser = refocuser
        field, self._kept = light_field(views, disparity, config.views, config.height, config.width)
        self._kept += set_coverage(field, coverage, config.height, config.width)
        size = ctypes.c_size_t()
        check(library.starfocus_prepared_size(byref(config), byref(size)))
        self._memory = aligned(size.value)
        self._handle = ctypes.c_void_p()
        refocuser._run(Watch(progress), library.starfocus_prepare, byref(field), pointer(self._memory), size.value,
                       byref(self._handle))

    def refocus(self, *, focus: float, aperture: float = 1.0, mode: Mode = Mode.BLOCK,
                renderer: Renderer = Renderer.AUTO, region: Optional[RegionOfPicture] = None, out: Optional[Picture] = None,
                progress: Optional[ProgressFunction] = None, **lens: Any) -> Picture:
        """As Refocuser.refocus of the light field, with the same bytes."""
        # pylint: disable=protected-access
        *_, width, height = part_of(region, self._refocuser.width, self._refocuser.height)
        params = self._refocuser._params(mode, renderer, region, focus=focus, aperture=aperture, **lens)
        return self._refocuser._picture(params, out, (height, width), progress, library.starfocus_refocus_prepared,
                                        self._handle, keep=self._kept)

    def preview(self, shift: int, *, focus: float, aperture: float = 1.0, mode: Mode = Mode.BLOCK,
                renderer: Renderer = Renderer.AUTO, region: Optional[RegionOfPicture] = None, out: Optional[Picture] = None,
                progress: Optional[ProgressFunction] = None, **lens: Any) -> Picture:
        """As `refocus` at 1 / 2**shift of the size, from 1 to the `previews` of the refocuser's
        configuration. Focus and region are in pixels of the full size; the picture has the pixels that
        have a part of the region."""
        # pylint: disable=protected-access
        x, y, width, height = part_of(region, self._refocuser.width, self._refocuser.height)
        if not 1 <= whole(shift, "shift") <= self._refocuser._config.previews:
            raise ArgumentError(Status.PREPARED, _abi.Problem(Status.PREPARED, 0, b"shift", b"1 to previews", shift))
        side = 1 << shift
        size = -(-(y + height) // side) - y // side, -(-(x + width) // side) - x // side
        params = self._refocuser._params(mode, renderer, region, focus=focus, aperture=aperture, **lens)
        params.preview_shift = shift
        return self._refocuser._picture(params, out, size, progress, library.starfocus_refocus_prepared, self._handle,
                                        keep=self._kept)


def _as_dict(structure: ctypes.Structure) -> Dict[str, Any]:
    def plain(value: Any) -> Any:
        if isinstance(value, ctypes.Structure):
            return _as_dict(value)
        return [plain(one) for one in value] if isinstance(value, ctypes.Array) else value

    return {name: plain(getattr(structure, name)) for name, _ in structure._fields_}
