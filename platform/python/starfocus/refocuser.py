# SPDX-License-Identifier: Apache-2.0
"""Refocuses light fields: the engine and prepared light fields."""
from __future__ import annotations

import ctypes
import math
import threading
import weakref
from ctypes import Structure, byref
from typing import Any, Dict, Iterable, Iterator, List, Optional, Sequence, Set, Tuple, Type, Union, overload

import numpy as np

from . import _abi
from ._calls import (Pool, ProgressFunction, RegionOfPicture, Samples, Views, Watch, aligned, as_image, as_list,
                     as_map, callbacks_of, depth_map, light_field, output, part_of, pointer, positions_of, samples_of,
                     set_coverage, set_field, size_of_views, whole)
from ._abi import library
from ._types import Array, Pixels
from .constants import Mode, Renderer, Status, Transfer
from .errors import ArgumentError, StarfocusError, call
from .images import Image
from .maps import Disparity, measure_disparity


#: A picture as an array of shape (height, width, 3) or (height, width, 4), or an Image for other formats.
Picture = Union[Array, Image]


#: A light field: views, disparity map, and optionally coverage.
Scene = Union[Tuple[Views, Array], Tuple[Views, Array, Optional[Array]]]
#: Largest number of rows that `Refocuser.stream` yields at once.
_PULLED_ROWS = 64


class Refocuser:
    """An engine for light fields of one size.

    Args:
        width, height: size of the views in pixels, from 1 to 65535.
        views: number of views: 1, 5, 9 or 17 in the order of `view_positions`, or any number up to 17 with
            `positions`.
        disparity_min, disparity_max: range of the disparities of all maps, in pixels per unit of u, within +-500.
        workers: number of threads, up to 64; 0: one for each big core of the machine.
        positions: positions (u, v) of the views, each from -1 to 1, of which the first is (0, 0). For a stereo pair,
            pass `[(0, 0), (1, 0)]`. None: the positions of `view_positions`.
        config: other fields of starfocus_config and starfocus_tuning with their C names, for example `max_blur`
            (default 32 pixels), `transfer` (a `Transfer`, or "srgb", "none", "pq" or "hlg"), `highlights`, or
            `previews=3` for `Prepared.preview` down to 1/8 of the size. Keywords with the value 0 or 1: `shapes` for
            lenses that are polygons or have cat's eyes, `images` for formats other than RGB, `deep` for more than 8
            bits and alpha, `streaming` for `stream`, `fill_unknown`, `line_scan` (default 1) and `coverage` (default
            1).

    Views are uint8 of shape (height, width, 3). With `deep=1`, they may have one of these types and an alpha channel,
    shape (height, width, 4), which is refocused as well:

        uint16: codes from 0 to 65535 of the curve `transfer`. Colours are not multiplied with alpha.
        float16, float32: linear light up to 64, where white is 1 and negative values are black. Colours are multiplied
            with alpha. The engine computes with float16; float32 is converted.

    Pictures have the type and the channels of the views. If all views are Images, pictures are uint8 of three channels.

    Attributes:
        report: dictionary with the fields of starfocus_report of the last refocusing.

    Raises a subclass of StarfocusError for values out of range, TypeError for unknown fields, ValueError for
    integers that do not fit the C structure, and MemoryError.

    The engine allocates all its memory when it is created. Calls release the GIL. Several threads may use a
    refocuser; their calls take turns. The bytes of pictures depend neither on the machine nor on `workers`.
    """

    def __init__(self, width: int, height: int, views: int = 5, *, disparity_min: float,
                 disparity_max: float, workers: int = 0, positions: Any = None, **config: Any):
        self._config, tuning = _abi.defaults(_abi.Config), _abi.defaults(_abi.Tuning)
        tuning.line_scan = library.starfocus_line_scan_renderer()
        known = _names(_abi.Config) - {"size", "max_workers", "positions", "tuning", "unknown"}
        for name, value in {**config, "width": width, "height": height, "views": views,
                            "disparity_min": disparity_min, "disparity_max": disparity_max}.items():
            if name in _abi.FEATURES:
                bit = _abi.FEATURES[name]
                self._config.features = self._config.features & ~bit | (bit if value else 0)
            elif name == "transfer":
                set_field(self._config, name, _transfer_of(value))
            elif name == "fill_unknown":
                self._config.unknown = 1 if value else 0
            elif name == "line_scan":
                tuning.line_scan = tuning.line_scan if value else None
            elif name in _names(_abi.Tuning) - {"size"}:
                set_field(tuning, name, value)
            elif name in known:
                set_field(self._config, name, value)
            else:
                raise TypeError(f"Refocuser: unknown field of the configuration '{name}'")
        if positions is not None:
            self._config.positions = positions_of(positions, views)
        self._pool = Pool(workers)
        self._config.max_workers, self._config.tuning = self._pool.workers, ctypes.pointer(tuning)
        engine = ctypes.c_void_p()
        call(library.starfocus_create, byref(self._config), None, byref(engine))
        self._engine = engine.value
        weakref.finalize(self, library.starfocus_destroy, self._engine)
        self._lock = threading.Lock()
        self._stream: Optional[Watch] = None  # watch of the stream that began last
        #: Fields of the starfocus_report of the last refocus call, by name.
        self.report: Dict[str, Any] = {}

    @classmethod
    def for_light_field(cls, views: Views, disparity: Disparity, *, workers: int = 0,
                        **config: Any) -> "Refocuser":
        """Returns a refocuser for a light field. Other light fields may use it if they have the same size, number of
        views and disparity range.

        `max_blur` is large enough for every focus in the disparity range, up to 128 pixels. `deep` is 1 for arrays of
        other types than uint8.

        Args:
            views: views, as for `refocus`.
            disparity: disparity map, an array of the size of the views; or a DepthMap, at most of this size.
            workers: number of threads; 0: one for each big core of the machine.
            config: as for `Refocuser`; takes precedence over the derived fields.

        Raises TypeError or ValueError if a view or the map has another type or size. Images have no size: if all views
        are Images, the size is that of the map.
        """
        stats = measure_disparity(disparity)
        views = as_list(views)
        if all(isinstance(view, Image) for view in views):
            depth, _ = depth_map(disparity)
            height, width = depth.height, depth.width
        else:
            height, width = size_of_views(views)
        light_field(views, disparity, len(views), height, width)  # checks the types and sizes
        derived: Dict[str, Any] = {"max_blur": min(128.0, max(1.0, math.ceil(stats.max - stats.min)))}
        if samples_of(views)[0] != np.uint8:
            derived["deep"] = 1
        return cls(width, height, len(views), disparity_min=stats.min, disparity_max=stats.max,
                   workers=workers, **{**derived, **config})

    @property
    def width(self) -> int:
        """Width of the pictures in pixels."""
        return int(self._config.width)

    @property
    def height(self) -> int:
        """Height of the pictures in pixels."""
        return int(self._config.height)

    @property
    def workers(self) -> int:
        """Number of threads, including the calling thread."""
        return self._pool.workers

    @overload
    def refocus(self, views: Views, disparity: Disparity, *, focus: float, aperture: float = 1.0,
                coverage: Optional[Array] = None, mode: Mode = Mode.BLOCK, renderer: Renderer = Renderer.AUTO,
                region: Optional[RegionOfPicture] = None, out: Image,
                progress: Optional[ProgressFunction] = None, **lens: Any) -> Image: ...

    @overload
    def refocus(self, views: Views, disparity: Disparity, *, focus: float, aperture: float = 1.0,
                coverage: Optional[Array] = None, mode: Mode = Mode.BLOCK, renderer: Renderer = Renderer.AUTO,
                region: Optional[RegionOfPicture] = None, out: Optional[Array] = None,
                progress: Optional[ProgressFunction] = None, **lens: Any) -> Pixels: ...

    def refocus(self, views: Views, disparity: Disparity, *, focus: float, aperture: float = 1.0,
                coverage: Optional[Array] = None, mode: Mode = Mode.BLOCK, renderer: Renderer = Renderer.AUTO,
                region: Optional[RegionOfPicture] = None, out: Optional[Picture] = None,
                progress: Optional[ProgressFunction] = None, **lens: Any) -> Picture:
        """Refocuses a light field. Returns the picture, of the type and channels of the views.

        Args:
            views: the configured number of views, each an array, all of one type and shape, or an Image. `Refocuser`
                lists the types. Images in formats other than RGB require `images=1` or `deep=1` in the configuration.
                Arrays with contiguous rows are read in place, except float32.
            disparity: disparity map of the centre view, of shape (height, width). float32 is read in place; other
                floating-point types are converted. A DepthMap requires `images=1`, unless the map contains float32
                disparities and has the size of the picture.
            focus: disparity in focus, in pixels per unit of u.
            aperture: radius of the aperture, from 0 (the centre view) to 1 (as far as the outermost views).
            coverage: alpha of the foreground, uint8 of shape (height, width), as matting networks compute it: the part
                of each pixel that the nearer of two surfaces covers (255: all). Near depth edges, coverage takes
                precedence over the map. None: no coverage.
            mode: how the picture is divided.
            renderer: how views are rendered.
            region: x, y, width and height in pixels of the part to compute. The result has the same bytes as this part
                of the whole picture. None or four zeros: the whole picture.
            out: writable array of the type and channels of the views, or with `images=1` or `deep=1` an Image, of the
                size of the region. The picture is written to
                `out`, and `out` is returned instead of a new array. `out` must not overlap the light field.
            progress: receives the number of finished rows and the number of rows. If `progress` returns a true value,
                the call is cancelled and raises Cancelled. An exception in `progress` also cancels the call and is
                raised again.
            lens: other fields of starfocus_params with their C names: `focus_nearer`, `focus_farther`, `shape`,
                `blades`, `theta`, `rotation`, `curvature`, `ring_inner`, `cats_eye`.

        Raises a subclass of StarfocusError, and TypeError or ValueError for arrays of a wrong type or shape. After
        Cancelled the contents of `out` are unspecified.
        """
        field, kept = light_field(views, disparity, self._config.views, self.height, self.width)
        kept += set_coverage(field, coverage, self.height, self.width)
        *_, width, height = part_of(region, self.width, self.height)
        params = self._params(mode, renderer, region, focus=focus, aperture=aperture, **lens)
        return self._picture(params, out, (height, width), samples_of(views), progress, library.starfocus_refocus,
                             byref(field), keep=kept)

    def largest_aperture(self, focus: float, **lens: Any) -> float:
        """Returns the largest aperture, at most 1, whose blur radius never exceeds `max_blur`.

        Args:
            focus: disparity in focus, in pixels per unit of u.
            lens: other fields of starfocus_params, as for `refocus`. `focus_nearer` and `focus_farther` increase the
                result.
        """
        params, aperture = self._params(Mode.BLOCK, Renderer.AUTO, None, focus=focus, **lens), ctypes.c_double()
        self._run(Watch(None), library.starfocus_largest_aperture, byref(params), byref(aperture))
        return aperture.value

    def prepare(self, views: Views, disparity: Disparity, *, coverage: Optional[Array] = None,
                progress: Optional[ProgressFunction] = None) -> "Prepared":
        """Performs the work that does not depend on the lens, once for many pictures of one light field.

        Args and exceptions are those of `refocus`. The arrays must not change while the result is used.
        """
        return Prepared(self, views, disparity, progress, coverage)

    def stream(self, bands: Iterable[Scene], *, focus: float, aperture: float = 1.0, mode: Mode = Mode.BLOCK,
               renderer: Renderer = Renderer.AUTO, progress: Optional[ProgressFunction] = None,
               **lens: Any) -> Iterator[Pixels]:
        """Refocuses a light field that arrives in bands of rows. Yields the rows of the picture in bands.

        Requires `streaming=1` in the configuration. The memory of the engine does not grow with the height. The yielded
        bands are new arrays, which together have the bytes of `refocus`. Their heights differ from the heights of the
        input bands.

        Args:
            bands: bands from top to bottom, each with any number of rows: tuples (views, disparity) or (views,
                disparity, coverage) of arrays as for `refocus`, with the height of the band. Either all bands have
                coverage or none.

        The other arguments and exceptions are those of `refocus`. Errors are raised when the iterator reaches them:
        ValueError if the bands have more or fewer rows than the picture, and StarfocusError if another call of this
        refocuser, such as a second stream, has ended the stream.
        """
        watch = Watch(progress)
        params = self._params(mode, renderer, None, focus=focus, aperture=aperture, **lens)
        self._run(watch, library.starfocus_stream_begin, byref(params))
        left, consumed = self.height, ctypes.c_int32()
        for views, disparity, coverage in map(_with_coverage, bands):
            disparity = as_map(disparity)
            rows = len(disparity)
            if rows > left:
                found = self.height - left + rows
                raise ValueError(f"bands: expected {self.height} rows in all, found at least {found}")
            left -= rows
            field, kept = light_field(views, disparity, self._config.views, rows, self.width)
            kept += set_coverage(field, coverage, rows, self.width)
            field.depth.height = self.height
            while rows > 0:
                self._run(watch, library.starfocus_stream_push, byref(field), rows, byref(consumed))
                rows -= consumed.value
                _skip_rows(field, self._config.views, consumed.value)
                yield from self._finished_rows(watch, samples_of(views))
            del kept
        if left > 0:
            raise ValueError(f"bands: expected {self.height} rows in all, found {self.height - left}")

    def _finished_rows(self, watch: Watch, samples: Samples) -> Iterator[Pixels]:
        """Yields the rows of the stream that are finished."""
        kind, channels = samples
        written = ctypes.c_int32(1)
        while written.value > 0:
            rows = np.empty((_PULLED_ROWS, self.width, channels), _written_type(kind))
            image = as_image(rows)
            self._call(watch, library.starfocus_stream_pull, byref(image), _PULLED_ROWS, byref(written))
            if written.value > 0:
                yield rows[:written.value].astype(kind, copy=False)

    def frames(self, frames: Iterable[Scene], *, focus: float, aperture: float = 1.0, mode: Mode = Mode.BLOCK,
               renderer: Renderer = Renderer.AUTO, progress: Optional[ProgressFunction] = None,
               **lens: Any) -> Iterator[Pixels]:
        """Refocuses the frames of a video with one lens. Yields the picture of each frame, with the bytes of `refocus`.

        Superblocks that did not change since the previous frame are copied from the previous picture. The field
        `reused_blocks` of `report` counts these superblocks. With `deep=1`, no superblock is copied. The pictures are
        new arrays.

        Args:
            frames: light fields: tuples (views, disparity) or (views, disparity, coverage) of arrays as for `refocus`.
                The function copies the arrays, so the caller may reuse them for the next frame.

        The other arguments and the exceptions are those of `refocus`.
        """
        watch = Watch(progress)
        params = self._params(mode, renderer, None, focus=focus, aperture=aperture, **lens)
        last: List[Any] = []  # arrays of the previous frame, which the engine reads
        for views, disparity, coverage in map(_with_coverage, frames):
            field, kept = light_field([np.array(view) for view in as_list(views)], np.array(as_map(disparity)),
                                      self._config.views, self.height, self.width)
            kept += set_coverage(field, None if coverage is None else np.array(coverage), self.height, self.width)
            kind, channels = samples_of(views)
            picture = np.empty((self.height, self.width, channels), _written_type(kind))
            image = as_image(picture)
            self._call(watch, library.starfocus_refocus, byref(params), byref(field), byref(image))
            if not self._config.features & _abi.FEATURES["deep"]:
                previous = _abi.defaults(_abi.Previous)
                previous.light_field, previous.out = ctypes.pointer(field), ctypes.pointer(image)
                params.previous = ctypes.pointer(previous)
                last[:] = [picture, kept]
            yield picture.astype(kind)

    def _picture(self, params: Structure, out: Optional[Picture], size: Tuple[int, int], samples: Samples,
                 progress: Optional[ProgressFunction], function: Any, scene: Any, *, keep: List[Any]) -> Picture:
        """Calls starfocus_refocus or a similar function, and returns its picture.

        `size` is the height and width of the picture, and `samples` are its samples unless `out` is an Image. `scene`
        is the light field or prepared light field. `keep` contains the arrays that `scene` refers to.
        """
        if isinstance(out, Image):
            image, planes = out.as_structure(size[1], size[0], "out", written=True)
            self._call(Watch(progress), function, byref(params), scene, byref(image))
            del keep, planes
            return out
        kind, channels = samples
        picture = output(out, (*size, channels), kind, "out")
        written = picture if kind == _written_type(kind) else np.empty(picture.shape, _written_type(kind))
        image = as_image(written)
        self._call(Watch(progress), function, byref(params), scene, byref(image))
        del keep
        if written is not picture:
            picture[...] = written
        return picture

    def _params(self, mode: Mode, renderer: Renderer, region: Optional[RegionOfPicture], **lens: Any) -> Structure:
        params, study = _abi.defaults(_abi.Params), _abi.defaults(_abi.Study)
        set_field(study, "mode", mode)
        set_field(study, "renderer", renderer)
        params.study = ctypes.pointer(study)
        known = _names(_abi.Params) - {"size", "preview_shift", "region", "previous", "study"}
        for name, value in lens.items():
            if name not in known:
                raise TypeError(f"refocus: unknown field of the lens '{name}'")
            set_field(params, name, value)
        if region is not None:
            set_field(params, "region", tuple(region))
        return params

    def _call(self, watch: Watch, function: Any, *arguments: Any) -> None:
        """Calls the function with the engine, the arguments and a report, and stores the report."""
        report = _abi.defaults(_abi.Report)
        report.layers = (_abi.LayerReport * _abi.LAYERS)()
        self._run(watch, function, *arguments, byref(report))
        self.report = {**_as_dict(report), "layers": [_as_dict(layer) for layer in report.layers[:_abi.LAYERS]]}

    def _run(self, watch: Watch, function: Any, *arguments: Any) -> None:
        """Calls the function with the engine and the arguments, and reports its progress to `watch`."""
        callbacks = callbacks_of(self._pool, watch)
        with self._lock:
            if function is library.starfocus_stream_begin:
                self._stream = watch
            elif function in (library.starfocus_stream_push, library.starfocus_stream_pull) and watch is not self._stream:
                raise StarfocusError(Status.STATE, _abi.Problem(Status.STATE, 0, b"stream", b"no later stream", math.nan))
            status = library.starfocus_set_callbacks(self._engine, byref(callbacks))
            if status == Status.OK:
                status = function(self._engine, *arguments)
            # The next call, which may come from another thread, overwrites the problem of the engine.
            problem = _abi.Problem.from_buffer_copy(library.starfocus_engine_problem(self._engine).contents)
        watch.check(status, problem)


class Prepared:
    """A light field that is prepared for refocusing with any lens. Created by `Refocuser.prepare`.

    A prepared light field takes 3.89 bytes per pixel, and up to 5.9 more for previews of 5 views. A Prepared object
    keeps references to the arrays of the light field, which must not change.
    """

    def __init__(self, refocuser: Refocuser, views: Views, disparity: Disparity,
                 progress: Optional[ProgressFunction], coverage: Optional[Array] = None):
        # pylint: disable=protected-access
        config = refocuser._config
        self._refocuser, self._samples = refocuser, samples_of(views)
        field, self._kept = light_field(views, disparity, config.views, config.height, config.width)
        self._kept += set_coverage(field, coverage, config.height, config.width)
        size = ctypes.c_size_t()
        call(library.starfocus_prepared_size, byref(config), byref(size))
        self._memory = aligned(size.value)
        self._handle = ctypes.c_void_p()
        refocuser._run(Watch(progress), library.starfocus_prepare, byref(field), pointer(self._memory), size.value,
                       byref(self._handle))

    @overload
    def refocus(self, *, focus: float, aperture: float = 1.0, mode: Mode = Mode.BLOCK,
                renderer: Renderer = Renderer.AUTO, region: Optional[RegionOfPicture] = None,
                out: Image, progress: Optional[ProgressFunction] = None, **lens: Any) -> Image: ...

    @overload
    def refocus(self, *, focus: float, aperture: float = 1.0, mode: Mode = Mode.BLOCK,
                renderer: Renderer = Renderer.AUTO, region: Optional[RegionOfPicture] = None,
                out: Optional[Array] = None, progress: Optional[ProgressFunction] = None, **lens: Any) -> Pixels: ...

    def refocus(self, *, focus: float, aperture: float = 1.0, mode: Mode = Mode.BLOCK,
                renderer: Renderer = Renderer.AUTO, region: Optional[RegionOfPicture] = None,
                out: Optional[Picture] = None, progress: Optional[ProgressFunction] = None, **lens: Any) -> Picture:
        """Refocuses the light field. Returns the same picture as `Refocuser.refocus`, which describes the arguments."""
        # pylint: disable=protected-access
        *_, width, height = part_of(region, self._refocuser.width, self._refocuser.height)
        params = self._refocuser._params(mode, renderer, region, focus=focus, aperture=aperture, **lens)
        return self._refocuser._picture(params, out, (height, width), self._samples, progress,
                                        library.starfocus_refocus_prepared, self._handle, keep=self._kept)

    @overload
    def preview(self, shift: int, *, focus: float, aperture: float = 1.0, mode: Mode = Mode.BLOCK,
                renderer: Renderer = Renderer.AUTO, region: Optional[RegionOfPicture] = None,
                out: Image, progress: Optional[ProgressFunction] = None, **lens: Any) -> Image: ...

    @overload
    def preview(self, shift: int, *, focus: float, aperture: float = 1.0, mode: Mode = Mode.BLOCK,
                renderer: Renderer = Renderer.AUTO, region: Optional[RegionOfPicture] = None,
                out: Optional[Array] = None, progress: Optional[ProgressFunction] = None, **lens: Any) -> Pixels: ...

    def preview(self, shift: int, *, focus: float, aperture: float = 1.0, mode: Mode = Mode.BLOCK,
                renderer: Renderer = Renderer.AUTO, region: Optional[RegionOfPicture] = None,
                out: Optional[Picture] = None, progress: Optional[ProgressFunction] = None, **lens: Any) -> Picture:
        """Refocuses the light field at 1 / 2**shift of its size, in about 1 / 4**shift of the time.

        Args:
            shift: from 1 to the field `previews` of the refocuser's configuration; otherwise raises ArgumentError.

        The other arguments are those of `Refocuser.refocus`, in pixels of the full size. The preview of a region has
        all pixels that contain a part of the region.
        """
        # pylint: disable=protected-access
        x, y, width, height = part_of(region, self._refocuser.width, self._refocuser.height)
        if not 1 <= whole(shift, "shift") <= self._refocuser._config.previews:
            raise ArgumentError(Status.PREPARED, _abi.Problem(Status.PREPARED, 0, b"shift", b"1 to previews", shift))
        side = 1 << shift
        size = -(-(y + height) // side) - y // side, -(-(x + width) // side) - x // side
        params = self._refocuser._params(mode, renderer, region, focus=focus, aperture=aperture, **lens)
        params.preview_shift = shift
        return self._refocuser._picture(params, out, size, self._samples, progress, library.starfocus_refocus_prepared,
                                        self._handle, keep=self._kept)


def _transfer_of(value: Any) -> Any:
    """Returns the transfer with this name. Values that are not names are returned unchanged."""
    if not isinstance(value, str):
        return value
    names = {transfer.name.lower(): transfer for transfer in Transfer}
    if value not in names:
        raise ValueError(f"transfer: expected {', '.join(names)}, found {value!r}")
    return names[value]


def _written_type(kind: "np.dtype[Any]") -> "np.dtype[Any]":
    """Returns the type of the samples that the library writes for pictures of this type."""
    return np.dtype(np.float16) if kind == np.float32 else kind


def _with_coverage(scene: Sequence[Any]) -> Tuple[Views, Array, Optional[Array]]:
    """Returns views, disparity map and coverage. The coverage is None if the scene has none."""
    if not 2 <= len(scene) <= 3:
        raise ValueError(f"expected views, disparity map and optionally coverage, found a tuple of {len(scene)}")
    return scene[0], scene[1], scene[2] if len(scene) == 3 else None


def _skip_rows(field: Structure, views: int, rows: int) -> None:
    """Makes a starfocus_light_field of arrays point to a later row."""
    for view in field.views[:views]:
        view.planes[0] += rows * view.strides[0]
    field.depth.data += rows * field.depth.stride
    if field.coverage:
        field.coverage += rows * field.coverage_stride


def _names(kind: Type[Structure]) -> Set[str]:
    """Returns the names of the fields of a structure."""
    return {field[0] for field in kind._fields_}


def _as_dict(structure: Structure) -> Dict[str, Any]:
    """Returns the fields of a structure, without `size`."""
    return {name: getattr(structure, name) for name, _ in structure._fields_ if name != "size"}
