# SPDX-License-Identifier: Apache-2.0
"""Tests depth maps of every size, type and layout in memory, the arguments of functions for maps, and the lifetime of
arrays."""
import gc
import math
import os
import tempfile
import threading
import unittest
from pathlib import Path

import numpy as np

import starfocus


class DepthMaps(unittest.TestCase):
    """Maps are measured, tapped and repaired as they come."""

    def test_maps_of_distances_are_measured_and_tapped(self):
        distances = np.where(np.arange(40) < 20, 4000, 500).astype(np.uint16) * np.ones((30, 1), np.uint16)
        distances[0, 0] = 0
        depth = starfocus.DepthMap(distances, starfocus.DepthMeaning.RECIPROCAL, 8000, invalid=0)
        self.assertEqual(starfocus.measure_disparity(depth), (2, 16, 1))
        self.assertEqual(starfocus.focus_at(depth, 79, 0, size=(160, 120)), 2)
        self.assertEqual(starfocus.focus_at(depth, 80, 0, size=(160, 120)), 16)
        self.assertEqual(starfocus.focus_at(depth, 0, 0), 2)
        with self.assertRaises(starfocus.ArgumentError):
            starfocus.focus_at(depth, 40, 0)
        with self.assertRaises(starfocus.DisparityError):
            starfocus.focus_at(np.full((9, 9), np.nan, np.float32), 4, 4)

    def test_depth16_is_measured_without_its_confidence(self):
        distances = np.where(np.arange(40) < 20, 4000, 500).astype(np.uint16) * np.ones((30, 1), np.uint16)
        distances[0, 0] = 0
        codes = distances | (np.arange(40, dtype=np.uint16) % 8 << 13)
        depth = starfocus.DepthMap(codes, starfocus.DepthMeaning.RECIPROCAL, 8000, depth16=True)
        self.assertEqual(starfocus.measure_disparity(depth), (2, 16, 1))
        with self.assertRaisesRegex(TypeError, "expected uint16 for depth16, found float32"):
            starfocus.measure_disparity(starfocus.DepthMap(codes.astype(np.float32), depth16=True))

    def test_a_matte_gives_a_map_and_coverage(self):
        rows, columns = np.mgrid[:12, :20]
        matte = np.where((columns >= 5) & (columns < 15) & (rows >= 3), 255, 0).astype(np.uint8)
        rgba = np.zeros((12, 20, 4), np.uint8)
        rgba[..., 3] = matte
        stats = starfocus.measure_matte(matte)
        self.assertEqual(stats, (90 / 240, 0.25, 0.25, 0.75, 1, 0.5, 1))
        for given in (matte, rgba[..., 3], np.asfortranarray(matte), matte[None]):
            field = starfocus.matte_field(given, 20, 12, 9, -2)
            np.testing.assert_array_equal(field.coverage, matte)
            np.testing.assert_array_equal(field.disparity, np.where(matte > 0, 9, -2).astype(np.float32))
        field = starfocus.matte_field(matte, 40, 48, 10, horizon=stats.horizon, ground=stats.ground)
        np.testing.assert_array_equal(field.disparity[[0, 23], 0], 0)
        np.testing.assert_allclose(field.disparity[24:, 0], 10 * (np.arange(24) + 0.5) / 24, atol=1 / 64)
        self.assertEqual(set(np.unique(field.disparity[13:, 20])), {10})

    def test_a_matte_is_the_coverage_where_it_agrees_with_the_map(self):
        columns = np.arange(120) * np.ones((80, 1), np.int64)
        matte = np.clip(255 - 32 * (columns - 46), 0, 255).astype(np.uint8)
        depth = starfocus.DepthMap(np.where(columns[::2, ::2] < 50, 80, 0).astype(np.uint8), scale=0.25)
        coverage = starfocus.matte_coverage(matte, depth, 120, 80)
        np.testing.assert_array_equal(coverage[:, 25:75], matte[:, 25:75])
        implied = starfocus.matte_coverage(np.zeros_like(matte), depth, 120, 80)
        np.testing.assert_array_equal(implied[:, 25:75], np.where(columns < 50, 255, 0)[:, 25:75])
        with self.assertRaises(starfocus.DisparityError):
            starfocus.matte_coverage(matte, np.full((80, 120), np.nan, np.float32), 120, 80)
        for call, field, message in (
                (lambda: starfocus.matte_field(matte, 0, 80, 1), "width", "1 to 65535, found 0"),
                (lambda: starfocus.matte_field(matte, 9, 9, 501), "depth.subject", "-500.0 to 500.0, found 501"),
                (lambda: starfocus.matte_field(matte, 9, 9, 3, 4), "depth.background", "at most subject, found 4"),
                (lambda: starfocus.matte_field(matte, 9, 9, 3, horizon=0.5), "depth.horizon", "below ground, found 0.5"),
                (lambda: starfocus.matte_coverage(matte, depth, 59, 80), "depth.width", "expected 1 to width, found 60")):
            with self.assertRaisesRegex(starfocus.ArgumentError, message) as caught:
                call()
            self.assertEqual(caught.exception.field, field)
        with self.assertRaisesRegex(TypeError, "matte: expected uint8, found bool"):
            starfocus.measure_matte(matte > 0)

    def test_the_largest_aperture_is_accepted(self):
        engine = starfocus.Refocuser(8, 8, 1, disparity_min=2, disparity_max=16, max_blur=7)
        self.assertEqual(engine.largest_aperture(2), 0.5)
        with self.assertRaises(starfocus.ArgumentError):
            engine.largest_aperture(1e9)
        with self.assertRaisesRegex(TypeError, "'no_such'"):
            engine.largest_aperture(2, no_such=1)
        views, disparity = np.zeros((1, 8, 8, 3), np.uint8), np.full((8, 8), 2, np.float32)
        for focus, lens, expected in ((2, {}, 0.5), (4, {"focus_nearer": 2, "focus_farther": 1}, 0.7)):
            aperture = engine.largest_aperture(focus, **lens)
            self.assertEqual(aperture, expected)
            engine.refocus(views, disparity, focus=focus, aperture=aperture, **lens)
            with self.assertRaisesRegex(starfocus.ArgumentError, "aperture"):
                engine.refocus(views, disparity, focus=focus, aperture=math.nextafter(aperture, 1), **lens)

    def test_a_small_map_is_repaired(self):
        columns = np.arange(96)
        picture = np.where(columns < 40, 60, 200).astype(np.uint8)[None, :, None] * np.ones((64, 1, 3), np.uint8)
        truth = np.where(columns < 40, 5.0, -3.0)
        values = np.round((truth[2::4] + 10) * 64).astype(np.uint16) * np.ones((16, 1), np.uint16)
        small = starfocus.DepthMap(values, scale=1 / 64, offset=-10)
        made = starfocus.repair_disparity(picture, small)
        self.assertEqual(made.disparity.shape, (64, 96))
        self.assertLess(np.abs(made.disparity - truth).mean(), 0.2)


WIDTH, HEIGHT = 24, 18


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
                np.testing.assert_array_equal(given.reshape(self.disparity.shape), self.disparity)
                for made in (self.refocus(given), self.refocus(starfocus.DepthMap(given)),
                             self.engine.prepare(self.views, given).refocus(focus=0.5),
                             *self.engine.frames([(self.views, given)], focus=0.5)):
                    np.testing.assert_array_equal(made, expected)
                for one in (given, starfocus.DepthMap(given)):
                    self.assertEqual(starfocus.measure_disparity(one), stats)
                    self.assertEqual(starfocus.focus_at(one, 5, 6), focus)
                    self.assertEqual(starfocus.Refocuser.for_light_field(self.views, one, images=1).height, HEIGHT)
                np.testing.assert_array_equal(starfocus.fill_disparity(given), self.disparity)
        np.testing.assert_array_equal(np.concatenate(list(self.engine.stream(
            [(self.views, self.disparity[np.newaxis])], focus=0.5))), expected)

    def test_maps_of_every_type(self):
        for kind in (np.uint8, np.uint16, np.float16, np.float32, np.float64, ">u2", ">f2", ">f4", ">f8", np.longdouble):
            codes = np.arange(HEIGHT * WIDTH).reshape(HEIGHT, WIDTH) % 251 + 1
            expected = self.refocus((codes / np.float32(32)).astype(np.float32))
            for name, given in layouts(codes.astype(kind)):
                with self.subTest(name, kind=kind):
                    np.testing.assert_array_equal(self.refocus(starfocus.DepthMap(given, scale=1 / 32)), expected)

    def test_views_and_coverage(self):
        expected = self.refocus(self.disparity)
        for at, view in enumerate(self.views[:2]):
            for name, given in layouts(view):
                with self.subTest(name):
                    views = [*self.views[:at], given, *self.views[at + 1:]]
                    np.testing.assert_array_equal(self.engine.refocus(views, self.disparity, focus=0.5), expected)
        coverage = (np.arange(HEIGHT * WIDTH) % 256).astype(np.uint8).reshape(HEIGHT, WIDTH)
        expected = self.refocus(self.disparity, coverage=coverage)
        for name, given in layouts(coverage):
            with self.subTest(name):
                np.testing.assert_array_equal(self.refocus(self.disparity, coverage=given), expected)

    def test_one_picture_is_one_view(self):
        engine = starfocus.Refocuser(WIDTH, HEIGHT, 1, disparity_min=-2, disparity_max=2, images=1)
        view = self.views[0]
        expected = engine.refocus([view], self.disparity, focus=1)
        for one in (view, view[np.newaxis], [view[np.newaxis]], view.view(np.ma.MaskedArray), (view,),
                    starfocus.Image(starfocus.Format.RGB, [view])):
            np.testing.assert_array_equal(engine.refocus(one, self.disparity, focus=1), expected)
            self.assertEqual(starfocus.Refocuser.for_light_field(one, self.disparity).width, WIDTH)

    def test_masked_values_are_unknown_depth(self):
        masked = np.zeros((HEIGHT, WIDTH), bool)
        masked[4:9, 5:20] = True
        holes = np.where(masked, np.float32(np.nan), self.disparity)
        expected = self.refocus(holes)
        known = self.disparity[~masked]
        for one in (np.ma.array(self.disparity, mask=masked), np.ma.array(self.disparity.astype(np.float64), mask=masked),
                    np.ma.array(self.disparity[np.newaxis], mask=masked[np.newaxis])):
            for given in (one, starfocus.DepthMap(one)):
                np.testing.assert_array_equal(self.refocus(given), expected)
                self.assertEqual(starfocus.measure_disparity(given), (known.min(), known.max(), masked.sum()))
            np.testing.assert_array_equal(starfocus.fill_disparity(one), starfocus.fill_disparity(holes))
        for kind in (np.uint8, np.uint16, np.float16):
            codes = np.ma.array(np.full((HEIGHT, WIDTH), 5, kind), mask=masked)
            stats = starfocus.measure_disparity(starfocus.DepthMap(codes, starfocus.DepthMeaning.RECIPROCAL, 10))
            self.assertEqual(stats, (2, 2, masked.sum()))
        with self.assertRaises(starfocus.DisparityError):
            starfocus.Refocuser(WIDTH, HEIGHT, 5, disparity_min=-9, disparity_max=9).refocus(
                self.views, np.ma.array(self.disparity, mask=masked), focus=0)
        with self.assertRaisesRegex(ValueError, "view 1: expected no masked values, found 1"):
            view = np.ma.array(self.views[1])
            view[0, 0, 0] = np.ma.masked
            self.engine.refocus([self.views[0], view, *self.views[2:]], self.disparity, focus=0)


class Lifetimes(unittest.TestCase):
    """A call reads the arrays that it was given, and reports its own error."""

    def test_a_prepared_light_field_keeps_its_arrays(self):
        random = np.random.default_rng(1)
        views = [random.integers(0, 256, (HEIGHT, WIDTH, 3), np.uint8) for _ in range(5)]
        disparity = random.uniform(-2, 2, (HEIGHT, WIDTH)).astype(np.float32)
        coverage = random.integers(0, 256, (HEIGHT, WIDTH), np.uint8)
        engine = starfocus.Refocuser(WIDTH, HEIGHT, 5, disparity_min=-2, disparity_max=2, max_blur=4, images=1)
        expected = engine.refocus(views, disparity, focus=0.5, coverage=coverage)
        for flip in (1, -1):  # arrays that are read in place, and arrays that are copied
            planes = [[np.array(view[::flip])[::flip]] for view in views]
            images = [starfocus.Image(starfocus.Format.RGB, plane) for plane in planes] if flip == 1 else [
                plane[0] for plane in planes]
            prepared = engine.prepare(images, starfocus.DepthMap(np.array(disparity[::flip])[::flip]),
                                      coverage=np.array(coverage[::flip])[::flip])
            for plane in planes:
                plane[0] = np.zeros((1, 1), np.uint8)
            del images
            gc.collect()
            junk = [np.full((HEIGHT, WIDTH, 3), 7, np.uint8) for _ in range(300)]
            np.testing.assert_array_equal(prepared.refocus(focus=0.5), expected)
            del junk

    def test_threads_get_their_own_errors(self):
        view, disparity = np.zeros((1, HEIGHT, WIDTH, 3), np.uint8), np.zeros((HEIGHT, WIDTH), np.float32)
        engine = starfocus.Refocuser(WIDTH, HEIGHT, 1, disparity_min=0, disparity_max=0, workers=1)
        wrong = []

        def work(first):
            for value in range(first, first + 500):
                with self.assertRaises(starfocus.ArgumentError) as raised:
                    engine.refocus(view, disparity, focus=value)
                if str(value) not in str(raised.exception):
                    wrong.append(f"{value}: {raised.exception}")

        threads = [threading.Thread(target=work, args=(first,)) for first in (2000000, 3000000, 4000000, 5000000)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(wrong, [])


class Fields(unittest.TestCase):
    """Errors of functions without an engine name the field and its range."""

    def test_fields(self):
        flat, distances = np.zeros((9, 12), np.float32), np.ones((9, 12), np.uint16)
        cases = (
            (lambda: starfocus.focus_at(flat, 99999, 3), "x", r"inside the picture, found 99999"),
            (lambda: starfocus.focus_at(flat, -1, 3), "x", r"inside the picture, found -1"),
            (lambda: starfocus.focus_at(flat, 3, 9), "y", r"inside the picture, found 9"),
            (lambda: starfocus.focus_at(flat, 0, 0, size=(11, 20)), "depth.width", r"expected 1 to width, found 12"),
            (lambda: starfocus.focus_at(flat, 0, 0, size=(12, 65536)), "height", r"to 65535, found 65536"),
            (lambda: starfocus.aperture_of_f_stop(1, 2), "f_stop", r"at least 2, found 1"),
            (lambda: starfocus.aperture_of_f_stop(math.nan), "f_stop", r"at least 1"),
            (lambda: starfocus.aperture_of_f_stop(1, 0), "widest", r"above 0, found 0"),
            (lambda: starfocus.measure_disparity(starfocus.DepthMap(distances, scale=0)), "depth.scale", "other than 0"),
            (lambda: starfocus.measure_disparity(starfocus.DepthMap(distances, scale=1e-60)), "depth.scale", "other than 0"),
            (lambda: starfocus.focus_at(starfocus.DepthMap(distances, offset=1e39), 0, 0), "depth.offset", "finite float"),
        )
        for call, field, message in cases:
            with self.subTest(field), self.assertRaisesRegex(starfocus.ArgumentError, message) as raised:
                call()
            self.assertEqual((raised.exception.field, raised.exception.status), (field, starfocus.Status.RANGE))

    def test_a_refocuser_for_a_light_field_checks_its_sizes(self):
        views, disparity = np.zeros((5, 50, 40, 3), np.uint8), np.zeros((50, 40), np.float32)
        image = starfocus.Image(starfocus.Format.RGB, [np.zeros((50, 120), np.uint8)])
        half = starfocus.DepthMap(disparity[::2, ::2])
        for_light_field = starfocus.Refocuser.for_light_field
        for given, depth in ((views, disparity), ([image] * 5, disparity), ([image, *views[1:]], half), (views, half)):
            engine = for_light_field(given, depth)
            self.assertEqual((engine.width, engine.height), (40, 50))
        for given, depth, message in (
                (views, disparity[:10], r"disparity: expected the shape \(50, 40\), found \(10, 40\)"),
                ([*views[:4], views[4][:10]], disparity, r"view 4: expected the shape \(50, 40, 3\), found \(10, 40, 3\)"),
                ([image] * 5, np.zeros((60, 40)), "view 0, plane 0: expected 60 rows"),
                (views[:, :20], starfocus.DepthMap(disparity), "depth: expected at most 40 x 20 values, found 40 x 50"),
                (views[..., 0], disparity, "views?.*: expected .*shape")):
            with self.assertRaisesRegex(ValueError, message):
                for_light_field(given, depth)


class Paths(unittest.TestCase):
    """A path may be text, bytes or an object with a path, wherever a path is taken."""

    def test_paths(self):
        class Entry:
            """A path as os.scandir returns it."""

            def __init__(self, path):
                self.path = path

            def __fspath__(self):
                return self.path

        with tempfile.TemporaryDirectory() as folder:
            for name in ("a", "\xe4\u6df1", os.fsdecode(b"\xff\xfe")):
                path = os.path.join(folder, name)
                picture, pfm = path + ".ppm", path + ".pfm"
                Path(picture).write_bytes(b"P6 12 9 255\n" + bytes(range(216)) + bytes(108))
                Path(pfm).write_bytes(b"Pf 12 9 -1\n" + np.arange(108, dtype="<f4").tobytes())
                for kind in (str, os.fsencode, Path, Entry, lambda text: Entry(os.fsencode(text))):
                    self.assertEqual(starfocus.read_picture(kind(picture)).shape, (9, 12, 3))
                    self.assertEqual(starfocus.read_pfm(kind(pfm))[0, 0], 96)
                    scene = starfocus.read_light_field(kind(picture), depth=kind(pfm), depth_unit="disparity", no_repair=True)
                    self.assertEqual(scene.disparity.shape, (9, 12))


if __name__ == "__main__":
    unittest.main()
