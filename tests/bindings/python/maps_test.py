# SPDX-License-Identifier: Apache-2.0
"""Tests depth maps and mattes of the installed package: measures, repairs, every size, type and layout in memory, the
lifetime of arrays, and the arguments of functions for maps."""
import gc
import math
import os
import tempfile
import unittest
from pathlib import Path

import numpy as np

import starfocus
from starfocus import DepthMap, DepthMeaning, Format, Image

WIDTH, HEIGHT = 24, 18
same = np.testing.assert_array_equal


class Maps(unittest.TestCase):
    """Maps are measured, tapped, filled, estimated and repaired as they come."""

    def test_maps_are_measured_tapped_and_filled(self):
        distances = np.where(np.arange(40) < 20, 4000, 500).astype(np.uint16) * np.ones((30, 1), np.uint16)
        distances[0, 0] = 0
        codes = distances | (np.arange(40, dtype=np.uint16) % 8 << 13)
        depth = DepthMap(distances, DepthMeaning.RECIPROCAL, 8000, invalid=0)
        for one in (depth, DepthMap(codes, DepthMeaning.RECIPROCAL, 8000, depth16=True)):
            self.assertEqual(starfocus.measure_disparity(one), (2, 16, 1))
        for x, size, expected in ((79, (160, 120), 2), (80, (160, 120), 16), (0, None, 2)):
            self.assertEqual(starfocus.focus_at(depth, x, 0, size=size), expected)
        values = np.array([[1, np.nan, 3], [np.nan, np.inf, -2]], np.float32)
        self.assertEqual(starfocus.measure_disparity(values), (-2, 3, 3))
        same(starfocus.fill_disparity(values), [[1, 1, 3], [-2, -2, -2]])
        self.assertTrue(np.isnan(values[0, 1]))
        self.assertEqual(starfocus.aperture_of_f_stop(2.8, 1.4), 0.5)
        self.assertEqual(starfocus.view_positions(5), [(0, 0), (1, 0), (-1, 0), (0, 1), (0, -1)])

    def test_maps_are_estimated_and_repaired(self):
        texture, truth = np.random.default_rng(5).integers(0, 256, (64, 110, 3), np.uint8), np.full((64, 96), 3, np.float32)
        views = [texture[:, 5 + 3 * u:101 + 3 * u] for u in (0, 1, -1)]
        views = [*views, np.roll(views[0], -3, 0), np.roll(views[0], 3, 0)]
        for given, options in ((views, {}), (views[:2], {"positions": [(0, 0), (1, 0)]})):
            made = starfocus.estimate_disparity(given, 0, 6, **options)
            self.assertLess(np.median(np.abs(made.disparity - truth)), 0.5)
        with self.assertRaises(starfocus.Cancelled):
            starfocus.estimate_disparity(views, 0, 6, progress=lambda done, rows: True)
        truth[:, 40:] = -3
        holes = np.where((np.arange(96) > 50) & (np.arange(96) < 60), np.float32(np.nan), truth)
        small = DepthMap(np.round((truth[2::4, 2::4] + 10) * 64).astype(np.uint16), scale=1 / 64, offset=-10)
        picture = np.where(truth > 0, 60, 200).astype(np.uint8)[..., None] * np.ones(3, np.uint8)
        for one in (holes, small):
            repaired = starfocus.repair_disparity(picture, one)
            self.assertEqual((repaired.disparity.shape, repaired.confidence.shape), (truth.shape, truth.shape))
            self.assertLess(np.abs(repaired.disparity - truth).mean(), 0.2)

    def test_hair_with_a_closed_outline_gets_its_coverage(self):
        x, y = np.meshgrid(np.arange(240), np.arange(180))
        covered = np.where(y >= 110, 255, np.where(y >= 60, np.array([128, 255, 128, 0, 0, 0, 0])[x % 7], 0))
        share = covered[..., np.newaxis] / 255
        picture = np.round(share * [95, 54, 30] + (1 - share) * [160, 178, 190]).astype(np.uint8)
        closed = np.where(y >= 60, 9, -4).astype(np.float32)
        made = starfocus.repair_disparity(picture, closed)
        self.assertEqual(made.coverage.dtype, np.uint8)
        self.assertLess(np.abs(made.coverage.astype(int) - covered)[64:108].mean(), 48)  # 182 without coverage
        engine = starfocus.Refocuser.for_light_field(picture, closed)
        engine.refocus(picture, made.disparity, focus=-4, coverage=made.coverage)

    def test_a_matte_gives_a_map_and_coverage(self):
        rows, columns = np.mgrid[:12, :20]
        matte = np.where((columns >= 5) & (columns < 15) & (rows >= 3), 255, 0).astype(np.uint8)
        rgba = np.dstack([np.zeros((12, 20, 3), np.uint8), matte])
        stats = starfocus.measure_matte(matte)
        self.assertEqual(stats, (90 / 240, 0.25, 0.25, 0.75, 1, 0.5, 1))
        for given in (matte, rgba[..., 3], np.asfortranarray(matte), matte[None]):
            field = starfocus.matte_field(given, 20, 12, 9, -2)
            same(field.coverage, matte)
            same(field.disparity, np.where(matte > 0, 9, -2).astype(np.float32))
        field = starfocus.matte_field(matte, 40, 48, 10, horizon=stats.horizon, ground=stats.ground)
        same(field.disparity[[0, 23], 0], 0)
        np.testing.assert_allclose(field.disparity[24:, 0], 10 * (np.arange(24) + 0.5) / 24, atol=1 / 64)
        self.assertEqual(set(np.unique(field.disparity[13:, 20])), {10})

    def test_a_matte_is_the_coverage_where_it_agrees_with_the_map(self):
        columns = np.arange(120) * np.ones((80, 1), np.int64)
        matte = np.clip(255 - 32 * (columns - 46), 0, 255).astype(np.uint8)
        depth = DepthMap(np.where(columns[::2, ::2] < 50, 80, 0).astype(np.uint8), scale=0.25)
        for given, expected in ((matte, matte), (np.zeros_like(matte), np.where(columns < 50, 255, 0))):
            same(starfocus.matte_coverage(given, depth, 120, 80)[:, 25:75], expected[:, 25:75])

    def test_the_largest_aperture_is_accepted(self):
        engine = starfocus.Refocuser(8, 8, 1, disparity_min=2, disparity_max=16, max_blur=7)
        views, disparity = np.zeros((1, 8, 8, 3), np.uint8), np.full((8, 8), 2, np.float32)
        lens = {"focus_nearer": 2, "focus_farther": 1}
        self.assertEqual(engine.largest_aperture(2), 0.5)
        self.assertEqual(engine.largest_aperture(4, **lens), 0.7)
        engine.refocus(views, disparity, focus=4, aperture=0.7, **lens)
        with self.assertRaisesRegex(starfocus.ArgumentError, "aperture"):
            engine.refocus(views, disparity, focus=4, aperture=math.nextafter(0.7, 1), **lens)


def layouts(values: np.ndarray):
    """Yields the name and a view of each layout of an array in memory, with equal values."""
    itemsize = values.itemsize
    yield "columns first", np.asfortranarray(values)
    for axis in range(values.ndim):
        yield f"axis {axis} flipped", np.flip(np.ascontiguousarray(np.flip(values, axis)), axis)
        yield f"every second of axis {axis}", np.repeat(values, 2, axis)[(slice(None),) * axis + (np.s_[::2],)]
    yield "both flipped", np.ascontiguousarray(values[::-1, ::-1])[::-1, ::-1]
    yield "all rows equal", values if (values != values[:1]).any() else np.broadcast_to(values[0], values.shape)
    for shift in range(1, itemsize):
        raw = np.zeros(values.nbytes + itemsize, np.uint8)
        raw[shift:shift + values.nbytes] = np.frombuffer(values.tobytes(), np.uint8)
        yield f"unaligned by {shift}", raw[shift:shift + values.nbytes].view(values.dtype).reshape(values.shape)
    record = np.zeros(values.shape, np.dtype([("gap", np.uint8), ("value", values.dtype)]))
    record["value"] = values
    yield "field of records", record["value"]
    for before in range(3):
        for after in range(3):
            yield f"{before} axes before, {after} after", values.reshape((1,) * before + values.shape + (1,) * after)


class Layouts(unittest.TestCase):
    """Arrays of any layout are read as their values, in every call that takes a map, a view or coverage."""

    def setUp(self):
        random = np.random.default_rng(3)
        self.views = [random.integers(0, 256, (HEIGHT, WIDTH, 3), np.uint8) for _ in range(5)]
        self.disparity = random.uniform(-2, 2, (HEIGHT, WIDTH)).astype(np.float32)
        self.coverage = random.integers(0, 256, (HEIGHT, WIDTH), np.uint8)
        self.engine = starfocus.Refocuser(WIDTH, HEIGHT, 5, disparity_min=-9, disparity_max=9, workers=1, images=1,
                                          max_blur=10, streaming=1, fill_unknown=1)

    def refocus(self, disparity, **options):
        return self.engine.refocus(self.views, disparity, focus=0.5, **options)

    def test_maps(self):
        expected = self.refocus(self.disparity)
        stats = starfocus.measure_disparity(self.disparity)
        focus = starfocus.focus_at(self.disparity, 5, 6)
        for name, given in layouts(self.disparity):
            with self.subTest(name):
                same(given.reshape(self.disparity.shape), self.disparity)
                for made in (self.refocus(given), self.refocus(DepthMap(given)),
                             self.engine.prepare(self.views, given).refocus(focus=0.5),
                             *self.engine.frames([(self.views, given)], focus=0.5)):
                    same(made, expected)
                for one in (given, DepthMap(given)):
                    self.assertEqual(starfocus.measure_disparity(one), stats)
                    self.assertEqual(starfocus.focus_at(one, 5, 6), focus)
                    self.assertEqual(starfocus.Refocuser.for_light_field(self.views, one, images=1).height, HEIGHT)
                same(starfocus.fill_disparity(given), self.disparity)
        same(np.concatenate(list(self.engine.stream([(self.views, self.disparity[np.newaxis])], focus=0.5))), expected)

    def test_maps_of_every_type(self):
        codes = np.arange(HEIGHT * WIDTH).reshape(HEIGHT, WIDTH) % 251 + 1
        expected = self.refocus((codes / np.float32(32)).astype(np.float32))
        for kind in (np.uint8, np.uint16, np.float16, np.float32, np.float64, ">u2", ">f2", ">f4", ">f8", np.longdouble):
            for name, given in layouts(codes.astype(kind)):
                with self.subTest(name, kind=kind):
                    same(self.refocus(DepthMap(given, scale=1 / 32)), expected)
            if np.dtype(kind).kind == "f":
                same(self.refocus((codes / 32).astype(kind)), expected)

    def test_views_and_coverage(self):
        expected = self.refocus(self.disparity)
        for at, view in enumerate(self.views[:2]):
            for name, given in layouts(view):
                with self.subTest(name):
                    views = [*self.views[:at], given, *self.views[at + 1:]]
                    same(self.engine.refocus(views, self.disparity, focus=0.5), expected)
        expected = self.refocus(self.disparity, coverage=self.coverage)
        for name, given in layouts(self.coverage):
            with self.subTest(name):
                same(self.refocus(self.disparity, coverage=given), expected)

    def test_one_picture_is_one_view(self):
        engine = starfocus.Refocuser(WIDTH, HEIGHT, 1, disparity_min=-2, disparity_max=2, images=1)
        view = self.views[0]
        expected = engine.refocus([view], self.disparity, focus=1)
        for one in (view, view[np.newaxis], [view[np.newaxis]], view.view(np.ma.MaskedArray), (view,), Image(Format.RGB, [view])):
            same(engine.refocus(one, self.disparity, focus=1), expected)
            self.assertEqual(starfocus.Refocuser.for_light_field(one, self.disparity).width, WIDTH)

    def test_masked_values_are_unknown_depth(self):
        masked = np.zeros((HEIGHT, WIDTH), bool)
        masked[4:9, 5:20] = True
        holes = np.where(masked, np.float32(np.nan), self.disparity)
        expected, known = self.refocus(holes), self.disparity[~masked]
        for one in (np.ma.array(self.disparity, mask=masked), np.ma.array(self.disparity.astype(np.float64), mask=masked),
                    np.ma.array(self.disparity[np.newaxis], mask=masked[np.newaxis])):
            for given in (one, DepthMap(one)):
                same(self.refocus(given), expected)
                self.assertEqual(starfocus.measure_disparity(given), (known.min(), known.max(), masked.sum()))
            same(starfocus.fill_disparity(one), starfocus.fill_disparity(holes))
        for kind in (np.uint8, np.uint16, np.float16):
            codes = np.ma.array(np.full((HEIGHT, WIDTH), 5, kind), mask=masked)
            self.assertEqual(starfocus.measure_disparity(DepthMap(codes, DepthMeaning.RECIPROCAL, 10)), (2, 2, masked.sum()))
        with self.assertRaises(starfocus.DisparityError):
            starfocus.Refocuser(WIDTH, HEIGHT, 5, disparity_min=-9, disparity_max=9).refocus(
                self.views, np.ma.array(self.disparity, mask=masked), focus=0)
        with self.assertRaisesRegex(ValueError, "view 1: expected no masked values, found 1"):
            view = np.ma.array(self.views[1])
            view[0, 0, 0] = np.ma.masked
            self.engine.refocus([self.views[0], view, *self.views[2:]], self.disparity, focus=0)

    def test_a_prepared_light_field_keeps_its_arrays(self):
        expected = self.refocus(self.disparity, coverage=self.coverage)
        for flip in (1, -1):  # arrays that are read in place, and arrays that are copied
            planes = [[np.array(view[::flip])[::flip]] for view in self.views]
            images = [Image(Format.RGB, plane) for plane in planes] if flip == 1 else [plane[0] for plane in planes]
            prepared = self.engine.prepare(images, DepthMap(np.array(self.disparity[::flip])[::flip]),
                                           coverage=np.array(self.coverage[::flip])[::flip])
            for plane in planes:
                plane[0] = np.zeros((1, 1), np.uint8)
            del images
            gc.collect()
            junk = [np.full((HEIGHT, WIDTH, 3), 7, np.uint8) for _ in range(300)]
            same(prepared.refocus(focus=0.5), expected)
            del junk


class Arguments(unittest.TestCase):
    """Errors of functions without an engine name the field, its range, and the value."""

    def test_fields(self):
        flat, distances, matte = np.zeros((9, 12), np.float32), np.ones((9, 12), np.uint16), np.zeros((80, 120), np.uint8)
        engine, unknown = starfocus.Refocuser(8, 8, 1, disparity_min=2, disparity_max=16), np.full((9, 9), np.nan, np.float32)
        for call, field, message in (
                (lambda: starfocus.focus_at(flat, 99999, 3), "x", r"inside the picture, found 99999"),
                (lambda: starfocus.focus_at(flat, 0, 0, size=(11, 20)), "depth.width", r"expected 1 to width, found 12"),
                (lambda: starfocus.focus_at(DepthMap(distances, offset=1e39), 0, 0), "depth.offset", "finite float"),
                (lambda: starfocus.aperture_of_f_stop(1, 2), "f_stop", r"at least 2, found 1"),
                (lambda: starfocus.measure_disparity(DepthMap(distances, scale=1e-60)), "depth.scale", "other than 0"),
                (lambda: engine.largest_aperture(1e9), "focus", ""),
                (lambda: starfocus.matte_field(matte, 9, 9, 501), "depth.subject", "-500.0 to 500.0, found 501"),
                (lambda: starfocus.matte_coverage(matte, flat, 11, 80), "depth.width", "expected 1 to width, found 12")):
            with self.subTest(field, message=message), self.assertRaisesRegex(starfocus.ArgumentError, message) as raised:
                call()
            self.assertEqual((raised.exception.field, raised.exception.status), (field, starfocus.Status.RANGE))
        for call, kind, message in (
                (lambda: starfocus.focus_at(flat, 2**32, 0), ValueError, "expected a whole number"),
                (lambda: starfocus.focus_at(unknown, 4, 4), starfocus.DisparityError, ""),
                (lambda: starfocus.matte_coverage(matte, unknown, 120, 80), starfocus.DisparityError, ""),
                (lambda: starfocus.fill_disparity(np.full((2, 3), 1e200)), starfocus.DisparityError, ""),
                (lambda: starfocus.measure_matte(matte > 0), TypeError, "matte: expected uint8, found bool"),
                (lambda: starfocus.measure_disparity(DepthMap(flat, depth16=True)), TypeError,
                 "expected uint16 for depth16, found float32"),
                *((lambda shape=shape: starfocus.measure_disparity(np.zeros(shape, np.float32)), ValueError,
                   "disparity: expected the shape") for shape in ((0, 4), (4, 0), (4,), (2, 4, 4), (4, 4, 3))),
                (lambda: engine.largest_aperture(2, no_such=1), TypeError, "'no_such'"),
                (lambda: starfocus.view_positions(18), ValueError, ""),
                (lambda: starfocus.estimate_disparity(np.zeros((2, 9, 9, 3), np.uint8), 0, 1, positions=[(0, 0)]), ValueError, ""),
                (lambda: starfocus.estimate_disparity(np.zeros((2, 9, 9, 3), np.uint8), 0, 1), starfocus.StarfocusError, "")):
            with self.subTest(message), self.assertRaisesRegex(kind, message):
                call()

    def test_a_refocuser_for_a_light_field_checks_its_sizes(self):
        views, disparity = np.zeros((5, 50, 40, 3), np.uint8), np.zeros((50, 40), np.float32)
        image, half = Image(Format.RGB, [np.zeros((50, 120), np.uint8)]), DepthMap(disparity[::2, ::2])
        for_light_field = starfocus.Refocuser.for_light_field
        for given, depth in ((views, disparity), ([image] * 5, disparity), ([image, *views[1:]], half), (views, half)):
            engine = for_light_field(given, depth)
            self.assertEqual((engine.width, engine.height), (40, 50))
        for given, depth, message in (
                (views, disparity[:10], r"disparity: expected the shape \(50, 40\), found \(10, 40\)"),
                ([*views[:4], views[4][:10]], disparity, r"view 4: expected the shape \(50, 40, 3\), found \(10, 40, 3\)"),
                ([image] * 5, np.zeros((60, 40)), "view 0, plane 0: expected 60 rows"),
                (views[:, :20], DepthMap(disparity), "depth: expected at most 40 x 20 values, found 40 x 50"),
                (views[..., 0], disparity, "views?.*: expected .*shape")):
            with self.assertRaisesRegex(ValueError, message):
                for_light_field(given, depth)


class Entry:
    """A path as os.scandir returns it."""

    def __init__(self, path):
        self.path = path

    def __fspath__(self):
        return self.path


class Paths(unittest.TestCase):
    """A path may be text, bytes or an object with a path, wherever a path is taken."""

    def test_paths(self):
        with tempfile.TemporaryDirectory() as folder:
            for name in ("a", "\xe4\u6df1", os.fsdecode(b"\xff\xfe")):
                picture, pfm = (os.path.join(folder, name) + ending for ending in (".ppm", ".pfm"))
                Path(picture).write_bytes(b"P6 12 9 255\n" + bytes(range(216)) + bytes(108))
                Path(pfm).write_bytes(b"Pf 12 9 -1\n" + np.arange(108, dtype="<f4").tobytes())
                for kind in (str, os.fsencode, Path, Entry, lambda text: Entry(os.fsencode(text))):
                    self.assertEqual(starfocus.read_picture(kind(picture)).shape, (9, 12, 3))
                    self.assertEqual(starfocus.read_pfm(kind(pfm))[0, 0], 96)
                    scene = starfocus.read_light_field(kind(picture), depth=kind(pfm), depth_unit="disparity", no_repair=True)
                    self.assertEqual(scene.disparity.shape, (9, 12))


if __name__ == "__main__":
    unittest.main()
