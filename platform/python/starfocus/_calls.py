# SPDX-License-Identifier: Apache-2.0
"""Converts arrays, regions and fields for calls of the library, and wraps its thread pool and progress callback."""
from __future__ import annotations

import ctypes
import operator
import weakref
from ctypes import Structure
from functools import partial
from typing import Any, Callable, Collection, List, Optional, Sequence, Tuple, Union

import numpy as np

from . import _abi
from ._abi import library
from ._types import Array, Pixels
from .constants import Format
from .errors import check, out_of_range

#: Progress callback: receives the number of finished rows and the number of all rows. If the callback returns a true
#: value, the call is cancelled.
ProgressFunction = Callable[[int, int], Any]
#: An array of shape (views, height, width, 3), or a sequence whose items are arrays of shape (height, width, 3) or
#: Images. A single array of shape (height, width, 3) is one view. `Refocuser` describes the types of the elements.
Views = Union[Array, Sequence[Any]]
#: Type and number of the samples of a pixel.
Samples = Tuple["np.dtype[Any]", int]
#: Formats of arrays in the memory of the caller. Arrays of float32 are converted to float16.
_FORMATS = {(np.dtype(np.uint8), 3): Format.RGB, (np.dtype(np.uint16), 3): Format.RGB16,
            (np.dtype(np.uint16), 4): Format.RGBA16, (np.dtype(np.float16), 3): Format.RGB_HALF,
            (np.dtype(np.float16), 4): Format.RGBA_HALF}
_SAMPLE_TYPES = (np.uint8, np.uint16, np.float16, np.float32)
_MAX_LIGHT = 64  # largest light that the library represents; white is 1
#: A region of the picture: x, y, width and height in pixels.
RegionOfPicture = Tuple[int, int, int, int]


def whole(value: Any, what: str) -> int:
    """Returns the value as an int. Raises ValueError if it does not fit an int32_t, which ctypes would truncate."""
    try:
        number = operator.index(value)
    except TypeError:
        raise TypeError(f"{what}: expected a whole number, found {value!r}") from None
    if not -2**31 <= number < 2**31:
        raise ValueError(f"{what}: expected a whole number of 32 bits, found {number}")
    return number


def set_field(structure: Structure, name: str, value: Any) -> None:
    """Sets a field of a structure. Raises ValueError for an integer that ctypes would truncate."""
    setattr(structure, name, value)
    stored = getattr(structure, name)
    if isinstance(stored, Structure) and isinstance(value, tuple):
        for (part, _), number in zip(stored._fields_, value):
            set_field(stored, part, number)
    elif isinstance(stored, int) and stored != value:
        raise ValueError(f"{name}: expected a whole number that fits the field of the C structure, found {value}")


def part_of(region: Optional[RegionOfPicture], width: int, height: int) -> RegionOfPicture:
    """Returns the region of a picture of this size as (x, y, width, height).

    None and, as in starfocus_params, four zeros mean the whole picture.
    """
    if region is None:
        return 0, 0, width, height
    if len(region) != 4:
        raise ValueError(f"region: expected x, y, width and height, found {region!r}")
    x, y, columns, rows = (whole(value, "region") for value in region)
    if not (x or y or columns or rows):
        return 0, 0, width, height
    if min(x, y) < 0 or min(columns, rows) < 1 or x + columns > width or y + rows > height:
        raise out_of_range("region", "inside the picture", np.nan)
    return x, y, columns, rows


def rows_of(array: Any, dtype: Any, shape: Tuple[int, ...], what: str) -> Array:
    """Returns the array if the library can read it in place, otherwise a copy.

    Raises TypeError or ValueError if the array has another type or shape, or masked values.
    """
    given: Array = np.asarray(array)
    masked = _mask_of(array)
    if masked is not None:
        raise ValueError(f"{what}: expected no masked values, found {masked.sum()}")
    if given.dtype != dtype:
        raise TypeError(f"{what}: expected {np.dtype(dtype)}, found {given.dtype}")
    given = _without_batch(given, len(shape))
    if given.shape != shape:
        raise ValueError(f"{what}: expected the shape {shape}, found {given.shape}")
    return readable(given)


def _without_batch(array: Array, axes: int) -> Array:
    """Returns the array without axes of length 1 before or after the wanted number of axes, which networks add."""
    while array.ndim > axes and array.shape[0] == 1:
        array = array[0]
    while array.ndim > axes and array.shape[-1] == 1:
        array = array[..., 0]
    return array


def _mask_of(array: Any) -> Optional[Array]:
    """Returns True for each masked value of an array, or None if no value is masked."""
    masked: Array = np.asarray(array.mask if isinstance(array, np.ma.MaskedArray) else False)
    return np.broadcast_to(masked, array.shape) if masked.any() else None


def readable(array: Array) -> Array:
    """Returns the array if the library can read it in place, otherwise a copy."""
    return array if has_rows(array) else np.array(array, order="C")


def map_values(given: Any, types: Collection[Any], what: str) -> Array:
    """Returns a depth map of two axes with one of the types that the library can read in place, if necessary as a copy.

    Other floating-point types are converted to float32, and other byte orders to the native one. Masked values become
    NaN, which is unknown depth. Raises TypeError or ValueError for other types and shapes.
    """
    values, masked = _without_batch(np.asarray(given), 2), _mask_of(given)
    if values.ndim != 2 or 0 in values.shape:
        raise ValueError(f"{what}: expected the shape (height, width), found {values.shape}")
    kind = values.dtype.newbyteorder("=")
    is_float = np.issubdtype(kind, np.floating)
    if is_float and kind not in types or masked is not None and not is_float and kind in types:
        kind = np.dtype(np.float32)
    if kind not in types:
        raise TypeError(f"{what}: expected {' or '.join(str(one) for one in types)}, found {values.dtype}")
    if values.dtype != kind:
        with np.errstate(over="ignore"):  # the library rejects infinite values
            values = values.astype(kind)
    if masked is not None:
        values = values.copy()
        values[_without_batch(masked, 2)] = np.nan
    return readable(values)


def has_rows(array: Array) -> bool:
    """Returns True if the library can read or write the array in place: aligned, with contiguous rows."""
    inner = array.itemsize
    for size, stride in zip(array.shape[:0:-1], array.strides[:0:-1]):
        if size != 1 and stride != inner:
            return False
        inner *= size
    aligned = array.ctypes.data % array.itemsize == 0 and array.strides[0] % array.itemsize == 0
    return aligned and (array.shape[0] == 1 or array.strides[0] >= inner)


def stride_of(array: Array) -> int:
    """Returns the bytes from row to row: at least the size of a row, even if numpy reports less for a single row."""
    return max(array.strides[0], array.nbytes // array.shape[0])


def samples_of(views: Views) -> Samples:
    """Returns the samples of the first view that is an array, or those of RGB with 8 bits if all views are Images.

    Raises TypeError if the library has no format for their type.
    """
    for i, view in enumerate(as_list(views)):
        if not hasattr(view, "as_structure"):
            array = np.asarray(view)
            if array.dtype not in _SAMPLE_TYPES:
                raise TypeError(f"view {i}: expected uint8, uint16, float16 or float32, found {array.dtype}")
            has_alpha = array.dtype != np.uint8 and _without_batch(array, 3).shape[-1:] == (4,)
            return array.dtype, 4 if has_alpha else 3
    return np.dtype(np.uint8), 3


def _as_light(array: Array, what: str) -> Array:
    """Returns linear light as float16. Raises ValueError for values that the library does not represent.

    Negative values, which wide gamuts may contain, are black to the library.
    """
    if array.dtype == np.float16:
        # Positive numbers have the order of their bits, and so have negative ones by magnitude; infinities and NaN are
        # the last. For 36 million samples, the limits of bits take 0.01 s, and the limits of halves take 0.7 s.
        most, least = np.array([_MAX_LIGHT, -np.inf], np.float16).view(np.uint16)
        fits = array.view(np.int16).max() <= most and array.view(np.uint16).max() < least
    else:
        # The maximum and the minimum of values with a NaN are NaN.
        fits = array.max() <= _MAX_LIGHT and array.min() > -np.inf
    if not fits:
        at = np.argmin((array <= _MAX_LIGHT) & (array > -np.inf))
        y, x = (int(i) for i in np.unravel_index(at, array.shape)[:2])
        raise ValueError(f"{what}: expected finite values up to {_MAX_LIGHT}, found {array.flat[at]} at ({x}, {y})")
    return np.maximum(array, 0).astype(np.float16) if array.dtype == np.float32 else array


def output(out: Optional[Array], shape: Tuple[int, ...], kind: "np.dtype[Any]", what: str) -> Pixels:
    """Returns `out`, or a new picture if `out` is None. Raises an error if the library cannot write `out` in place."""
    if out is None:
        return np.empty(shape, kind)
    if not isinstance(out, np.ndarray) or out.dtype != kind:
        raise TypeError(f"{what}: expected an array of {kind}")
    if out.shape != shape or not has_rows(out) or not out.flags.writeable:
        raise ValueError(f"{what}: expected a writable array of the shape {shape} with contiguous rows, found "
                         f"the shape {out.shape} with the strides {out.strides}")
    return out


def as_list(views: Views) -> Sequence[Any]:
    """Returns the views as a sequence. A single Image or array of three axes becomes one view."""
    if isinstance(views, (list, tuple)):
        return views
    return [views] if hasattr(views, "as_structure") or np.ndim(views) == 3 else views  # type: ignore[return-value]


def size_of_views(views: Sequence[Any]) -> Tuple[int, int]:
    """Returns the height and width of the first view that is an array. Raises ValueError if no view is one."""
    shape = next((np.shape(view) for view in views if not hasattr(view, "as_structure")), ())
    if len(shape) < 3:
        raise ValueError(f"views: expected arrays of the shape (height, width, 3), found {len(views)} of {shape}")
    height, width = shape[-3:-1]
    return height, width


def as_map(disparity: Any) -> Array:
    """Returns a disparity map as float32. Maps of other floating-point types are converted."""
    return map_values(disparity, (np.dtype(np.float32),), "disparity")


def set_coverage(field: Structure, coverage: Any, height: int, width: int) -> List[Array]:
    """Sets the coverage of a starfocus_light_field, unless it is None.

    Returns the arrays that must stay alive while the library may read the light field.
    """
    if coverage is None:
        return []
    coverage = rows_of(coverage, np.uint8, (height, width), "coverage")
    field.coverage, field.coverage_stride = coverage.ctypes.data, stride_of(coverage)
    return [coverage]


def as_image(array: Array) -> Structure:
    """Returns a starfocus_image for an array of one of the `_FORMATS`."""
    image = _abi.Image(_FORMATS[array.dtype, array.shape[-1]])
    image.planes[0], image.strides[0] = array.ctypes.data, stride_of(array)
    return image


def light_field(views: Views, disparity: Any, count: int, height: int,
                width: int) -> Tuple[Structure, List[Any]]:
    """Returns a starfocus_light_field, and the arrays that must stay alive while the library may read it.

    The views are arrays or Images. The disparity map is an array, a DepthMap, or None if there is no map. The arrays
    of an Image are kept instead of the Image, because its list of planes may change.
    """
    views = as_list(views)
    if len(views) != count:
        raise ValueError(f"views: expected {count}, found {len(views)}")
    kind, channels = samples_of(views)
    field = _abi.defaults(_abi.LightField)
    kept: List[Any] = []
    for i, view in enumerate(views):
        if hasattr(view, "as_structure"):
            field.views[i], planes = view.as_structure(width, height, f"view {i}")
            kept += planes
        else:
            pixels = rows_of(view, kind, (height, width, channels), f"view {i}")
            kept.append(_as_light(pixels, f"view {i}") if kind.kind == "f" else pixels)
            field.views[i] = as_image(kept[-1])
    if disparity is not None:
        if not hasattr(disparity, "as_structure"):
            disparity = rows_of(as_map(disparity), np.float32, (height, width), "disparity")
        field.depth, values = depth_map(disparity)
        kept.append(values)
        if field.depth.width > width or field.depth.height > height:
            raise ValueError(f"depth: expected at most {width} x {height} values, found "
                             f"{field.depth.width} x {field.depth.height}")
    return field, kept


def depth_map(disparity: Any) -> Tuple[Structure, Array]:
    """Returns a starfocus_depth_map for a DepthMap or an array, and the array that must stay alive while it is read."""
    if hasattr(disparity, "as_structure"):
        structure, kept = disparity.as_structure()
        return structure, kept
    values = as_map(disparity)
    height, width = values.shape
    return _abi.DepthMap(values.ctypes.data, stride_of(values), width, height, scale=1), values


def positions_of(positions: Any, count: int) -> Any:
    """Returns the positions of `count` views as an array for starfocus_config.positions."""
    places = np.asarray(positions, np.float64)
    if places.shape != (count, 2):
        raise ValueError(f"positions: expected the shape ({count}, 2), found {places.shape}")
    return (_abi.Position * _abi.MAX_VIEWS)(*(_abi.Position(u, v) for u, v in places[:_abi.MAX_VIEWS]))


def aligned(size: int) -> Array:
    """Allocates `size` bytes aligned to STARFOCUS_ALIGNMENT."""
    memory = np.empty(size + _abi.ALIGNMENT, np.uint8)
    first = -memory.ctypes.data % _abi.ALIGNMENT
    return memory[first:first + size]


class Pool:
    """Owns a pool of threads of the library (starfocus/pool.h).

    If the number of workers is 0, the pool has one worker for each big core. With one worker there is no pool, and the
    calling thread does the work.
    """

    def __init__(self, workers: int):
        self.handle = None
        self.runner = None
        self.workers = 1
        if workers != 1:
            self.handle = library.starfocus_pool_create(whole(workers, "workers"))
            if not self.handle:
                raise MemoryError("no memory for a pool of threads")
            weakref.finalize(self, library.starfocus_pool_destroy, self.handle)
            self.runner = _abi.run_on_pool
            self.workers = library.starfocus_pool_workers(self.handle)


class Watch:
    """Wraps a progress function of the caller for the library, which may call it from any thread of the pool.

    An exception in the function cancels the call, and `check` raises the exception again.
    """

    def __init__(self, callback: Optional[ProgressFunction]):
        self._error: Optional[BaseException] = None
        if callback is None:
            self.function = ctypes.cast(0, _abi.Progress)
        else:
            self.function = _abi.Progress(partial(self._ask, callback))

    def _ask(self, callback: ProgressFunction, _data: Any, done: int, rows: int) -> int:
        try:
            return 1 if callback(done, rows) else 0
        except BaseException as error:  # pylint: disable=broad-except
            self._error = error
            return 1

    def check(self, status: int, problem: Optional[Structure] = None) -> None:
        """Raises the exception of the progress function, if there was one, otherwise the error of the status."""
        if self._error is not None:
            raise self._error
        check(status, problem)


def callbacks_of(pool: Pool, watch: Watch) -> Structure:
    """Returns the starfocus_callbacks of a call."""
    return _abi.Callbacks(pool.runner, pool.handle, watch.function)


def pointer(array: Optional[Array]) -> Optional[ctypes.c_void_p]:
    """Returns the address of an array, or None if the array is None."""
    return None if array is None else ctypes.c_void_p(array.ctypes.data)
