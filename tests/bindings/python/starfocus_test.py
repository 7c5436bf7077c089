# SPDX-License-Identifier: Apache-2.0
"""Tests the installed Python package: starfocus_test.py PROGRAM FOLDER HEADERS.

PROGRAM is the program starfocus, FOLDER is a light field of five views, and HEADERS is the folder of the
public headers.
"""
import re
import subprocess
import sys
import tempfile
import threading
import unittest
from pathlib import Path

import numpy as np

import starfocus
from starfocus import _abi, _calls, constants

PROGRAM, FOLDER, HEADERS = (Path(argument).resolve() for argument in sys.argv[1:4])
SCENE = starfocus.read_light_field(FOLDER)
VIEWS, DISPARITY = SCENE.views, SCENE.disparity
HEIGHT, WIDTH = DISPARITY.shape


def by_program(*options: str) -> np.ndarray:
    """Returns the picture that the program makes of the light field."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "out.ppm"
        subprocess.run([PROGRAM, "refocus", FOLDER, "-o", path, *options], check=True, stdout=subprocess.DEVNULL)
        return starfocus.read_picture(path)


def refocuser(**config) -> starfocus.Refocuser:
    return starfocus.Refocuser.for_light_field(VIEWS, DISPARITY, **config)


class Bytes(unittest.TestCase):
    """All ways to refocus return the bytes of the program."""

    def test_block_mode_gives_the_program_s_bytes(self):
        for focus in (-2.5, 0.0, 2.0):
            made = refocuser(workers=2).refocus(VIEWS, DISPARITY, focus=focus)
            np.testing.assert_array_equal(made, by_program("--focus", str(focus)))

    def test_other_modes_and_lenses_give_the_program_s_bytes(self):
        expected = by_program("--focus", "1", "--aperture", "0.5", "--mode", "frame")
        made = refocuser(workers=1).refocus(VIEWS, DISPARITY, focus=1, aperture=0.5, mode=starfocus.Mode.FRAME)
        np.testing.assert_array_equal(made, expected)
        slices = refocuser(line_scan=0).refocus(VIEWS, DISPARITY, focus=1, aperture=0.5, mode=starfocus.Mode.FRAME)
        self.assertTrue((slices != made).any())
        with self.assertRaisesRegex(starfocus.StarfocusError, "renderer") as raised:
            refocuser(line_scan=0).refocus(VIEWS, DISPARITY, focus=1, renderer=starfocus.Renderer.LINE_SCAN)
        self.assertEqual(raised.exception.status, starfocus.Status.FEATURE)
        expected = by_program("--focus", "1", "--shape", "polygon:5,18,0.3", "--transfer", "none")
        engine = refocuser(shapes=1, transfer=starfocus.Transfer.NONE)
        five = {"shape": starfocus.Shape.POLYGON, "blades": 5, "rotation": 18, "curvature": 0.3}
        np.testing.assert_array_equal(engine.refocus(VIEWS, DISPARITY, focus=1, **five), expected)

    def test_a_range_in_focus_gives_the_program_s_bytes(self):
        expected = by_program("--focus-range", "2,-0.5")
        made = refocuser().refocus(VIEWS, DISPARITY, focus=1, focus_nearer=1, focus_farther=1.5)
        np.testing.assert_array_equal(made, expected)
        with self.assertRaisesRegex(starfocus.StarfocusError, "focus_farther"):
            refocuser().refocus(VIEWS, DISPARITY, focus=1, focus_farther=-1)

    def test_the_lens_of_a_refocuser_changes_its_shape(self):
        engine = refocuser(shapes=1)
        prepared = engine.prepare(VIEWS, DISPARITY)
        for option, lens in (("fall-off", {}), ("polygon:6", {"shape": starfocus.Shape.POLYGON, "blades": 6}),
                             ("ring:0.5", {"shape": starfocus.Shape.RING}), ("fall-off", {})):
            expected = by_program("--focus", "1", "--shape", option)
            np.testing.assert_array_equal(engine.refocus(VIEWS, DISPARITY, focus=1, **lens), expected)
            np.testing.assert_array_equal(prepared.refocus(focus=1, **lens), expected)
        with self.assertRaises(TypeError):
            prepared.refocus(focus=1, petals=5)
        with self.assertRaisesRegex(starfocus.StarfocusError, "blades"):
            prepared.refocus(focus=1, blades=99)
        with self.assertRaisesRegex(starfocus.StarfocusError, "cats_eye"):
            refocuser().refocus(VIEWS, DISPARITY, focus=1, cats_eye=0.5)

    def test_coverage_gives_the_program_s_bytes(self):
        coverage = np.tile(np.arange(WIDTH, dtype=np.uint8), (HEIGHT, 1))
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "coverage.pgm"
            path.write_bytes(b"P5 %d %d 255\n" % (WIDTH, HEIGHT) + coverage.tobytes())
            expected = by_program("--focus", "1", "--coverage", str(path))
        engine = refocuser()
        made = engine.refocus(VIEWS, DISPARITY, focus=1, coverage=coverage)
        np.testing.assert_array_equal(made, expected)
        made = engine.prepare(VIEWS, DISPARITY, coverage=coverage).refocus(focus=1)
        np.testing.assert_array_equal(made, expected)
        self.assertTrue((made != engine.refocus(VIEWS, DISPARITY, focus=1)).any())
        with self.assertRaises(ValueError):
            engine.refocus(VIEWS, DISPARITY, focus=1, coverage=coverage[1:])

    def test_a_pair_and_an_l_give_the_program_s_bytes(self):
        for positions in ([(0, 0), (1, 0)], [(0, 0), (0, -1), (-1, 0)]):
            scene = starfocus.read_light_field(FOLDER, views=positions)
            self.assertEqual(scene.positions, positions)
            engine = starfocus.Refocuser.for_light_field(scene.views, scene.disparity, positions=np.array(positions))
            expected = by_program("--focus", "1", "--views", ":".join(f"{u},{v}" for u, v in positions))
            np.testing.assert_array_equal(engine.refocus(scene.views, scene.disparity, focus=1), expected)

    def test_the_focus_at_a_pixel_is_the_program_s(self):
        focus = starfocus.focus_at(DISPARITY, WIDTH // 2, HEIGHT // 2)
        made = refocuser().refocus(VIEWS, DISPARITY, focus=focus)
        np.testing.assert_array_equal(made, by_program("--focus-at", f"{WIDTH // 2},{HEIGHT // 2}"))

    def test_prepared_light_fields_and_regions_give_the_same_bytes(self):
        engine = refocuser()
        whole = engine.refocus(np.stack(VIEWS), DISPARITY, focus=1.5)
        prepared = engine.prepare(VIEWS, DISPARITY)
        np.testing.assert_array_equal(prepared.refocus(focus=1.5), whole)
        part = prepared.refocus(focus=1.5, region=(40, 30, 50, 20))
        np.testing.assert_array_equal(part, whole[30:50, 40:90])

    def test_previews_have_a_size_and_regions_of_their_own(self):
        """The tests of the C API check the pixels of previews."""
        prepared = refocuser(previews=1).prepare(VIEWS, DISPARITY)
        half = prepared.preview(1, focus=2, aperture=0.75)
        self.assertEqual(half.shape, ((HEIGHT + 1) // 2, (WIDTH + 1) // 2, 3))
        whole = prepared.refocus(focus=2, aperture=0.75)
        self.assertLess(np.abs(half.astype(int) - whole[::2, ::2]).mean(), 8)
        part = prepared.preview(1, focus=2, aperture=0.75, region=(41, 30, 50, 21))
        np.testing.assert_array_equal(part, half[15:26, 20:46])
        for shift in (-1, 0, 2, 40):
            with self.assertRaisesRegex(starfocus.StarfocusError, "shift: .*expected 1 to previews"):
                prepared.preview(shift, focus=2)

    def test_images_give_the_same_bytes(self):
        engine = refocuser(images=1)
        whole = engine.refocus(VIEWS, DISPARITY, focus=1)
        turned = [starfocus.Image(starfocus.Format.BGR, [np.ascontiguousarray(view[:, :, ::-1])]) for view in VIEWS]
        out = starfocus.Image.empty(starfocus.Format.BGRX, WIDTH, HEIGHT)
        engine.refocus(turned, starfocus.DepthMap(DISPARITY), focus=1, out=out)
        pixels = out.planes[0].reshape(HEIGHT, WIDTH, 4)
        np.testing.assert_array_equal(pixels[:, :, 2::-1], whole)
        self.assertTrue((pixels[:, :, 3] == 255).all())

    def test_chroma_of_a_camera_comes_back(self):
        form = starfocus.Format.NV12
        view = starfocus.Image.empty(form, WIDTH, HEIGHT)
        view.planes[0][:] = 100
        view.planes[1][:] = (120, 140) * ((WIDTH + 1) // 2)
        millimetres = np.full((HEIGHT // 2, WIDTH // 2), 500, np.uint16)
        depth = starfocus.DepthMap(millimetres, starfocus.DepthMeaning.RECIPROCAL, scale=1000.0, invalid=0)
        out = starfocus.Image.empty(form, WIDTH, HEIGHT)
        starfocus.Refocuser(WIDTH, HEIGHT, 1, disparity_min=0, disparity_max=4, images=1).refocus(
            [view], depth, focus=0, out=out)
        for plane, expected in zip(out.planes, view.planes):
            self.assertLessEqual(np.abs(plane.astype(int) - expected).max(), 1)

    def test_arrays_are_read_where_they_are_or_copied(self):
        engine = refocuser()
        whole = engine.refocus(VIEWS, DISPARITY, focus=1)
        wide = [np.zeros((HEIGHT, WIDTH + 5, 3), np.uint8) for _ in VIEWS]
        for large, view in zip(wide, VIEWS):
            large[:, :WIDTH] = view
        inside = [large[:, :WIDTH] for large in wide]
        field, _ = _calls.light_field(inside, DISPARITY, 5, HEIGHT, WIDTH)
        self.assertEqual(field.views[0].planes[0], wide[0].ctypes.data)
        self.assertEqual(field.views[0].strides[0], 3 * (WIDTH + 5))
        np.testing.assert_array_equal(engine.refocus(inside, DISPARITY, focus=1), whole)
        flipped = [np.ascontiguousarray(view[::-1])[::-1] for view in VIEWS]
        every_second = np.repeat(DISPARITY, 2, axis=1)[:, ::2]
        np.testing.assert_array_equal(engine.refocus(flipped, every_second, focus=1), whole)
        frame = np.zeros((HEIGHT + 2, WIDTH + 4, 3), np.uint8)
        made = engine.refocus(VIEWS, DISPARITY, focus=1, out=frame[1:-1, 2:-2])
        np.testing.assert_array_equal(frame[1:-1, 2:-2], whole)
        self.assertTrue(np.shares_memory(made, frame))
        self.assertFalse(frame[0].any() or frame[:, :2].any() or frame[:, -2:].any() or frame[-1].any())


class Errors(unittest.TestCase):
    """Errors name their cause."""

    def test_configurations_and_arguments_out_of_range(self):
        with self.assertRaises(starfocus.ArgumentError) as raised:
            starfocus.Refocuser(0, 10, disparity_min=0, disparity_max=1)
        self.assertEqual(raised.exception.status, starfocus.Status.RANGE)
        self.assertEqual(raised.exception.field, "width")
        self.assertEqual(str(raised.exception), "width: a field or an argument is outside its range "
                                                "(expected 1 to 65535, found 0)")
        self.assertIsInstance(raised.exception, ValueError)
        with self.assertRaisesRegex(TypeError, "max_blurr"):
            refocuser(max_blurr=3)
        with self.assertRaisesRegex(starfocus.StarfocusError, "aperture"):
            refocuser().refocus(VIEWS, DISPARITY, focus=0, aperture=2)

    def test_arrays_of_a_wrong_kind_or_shape(self):
        engine = refocuser(images=1)
        with self.assertRaisesRegex(TypeError, "view 0: expected uint8, found float32"):
            engine.refocus([view.astype(np.float32) for view in VIEWS], DISPARITY, focus=0)
        with self.assertRaisesRegex(ValueError, "views: expected 5, found 4"):
            engine.refocus(VIEWS[:4], DISPARITY, focus=0)
        with self.assertRaisesRegex(ValueError, "disparity: expected the shape"):
            engine.refocus(VIEWS, DISPARITY[:-1], focus=0)
        with self.assertRaisesRegex(ValueError, "out: expected a writable array"):
            engine.refocus(VIEWS, DISPARITY, focus=0, out=np.zeros((HEIGHT, WIDTH, 3), np.uint8)[:, ::-1])
        image = [starfocus.Image(starfocus.Format.RGBX, [view]) for view in VIEWS]
        with self.assertRaisesRegex(ValueError, "view 0, plane 0: expected .* rows of"):
            engine.refocus(image, starfocus.DepthMap(DISPARITY), focus=0, out=image[0])

    def test_maps_that_are_not_finite(self):
        holes = DISPARITY.copy()
        holes[3, 4] = np.nan
        with self.assertRaisesRegex(starfocus.DisparityError, r"at \(4, 3\)") as raised:
            refocuser().refocus(VIEWS, holes, focus=0)
        self.assertEqual(raised.exception.status, starfocus.Status.NOT_FINITE)


class Arguments(unittest.TestCase):
    """Values have their meaning in C, and no value makes a call write outside its output."""

    def test_four_zeros_are_the_whole_picture(self):
        engine = refocuser(images=1, previews=2)
        whole = engine.refocus(VIEWS, DISPARITY, focus=1)
        zeros = (0, 0, 0, 0)
        np.testing.assert_array_equal(engine.refocus(VIEWS, DISPARITY, focus=1, region=zeros), whole)
        prepared = engine.prepare(VIEWS, DISPARITY)
        np.testing.assert_array_equal(prepared.refocus(focus=1, region=np.zeros(4, int)), whole)
        np.testing.assert_array_equal(prepared.preview(2, focus=1, region=zeros), prepared.preview(2, focus=1))
        views = [starfocus.Image(starfocus.Format.RGB, [view]) for view in VIEWS]
        backing = np.full((2 * HEIGHT, 3 * WIDTH), 0xEE, np.uint8)
        with self.assertRaisesRegex(ValueError, f"out, plane 0: expected {HEIGHT} rows"):
            engine.refocus(views, starfocus.DepthMap(DISPARITY), focus=1, region=zeros,
                                  out=starfocus.Image(starfocus.Format.RGB, [backing[:1]]))
        self.assertTrue((backing == 0xEE).all())

    def test_regions_beyond_the_picture_or_of_too_large_numbers(self):
        engine = refocuser(previews=1)
        prepared = engine.prepare(VIEWS, DISPARITY)
        calls = (lambda region: engine.refocus(VIEWS, DISPARITY, focus=1, region=region),
                 lambda region: prepared.refocus(focus=1, region=region),
                 lambda region: prepared.preview(1, focus=1, region=region))
        for call in calls:
            for region in ((0, 0, 0, 1), (5, 5, 0, 0), (-1, 0, 4, 4), (0, 0, WIDTH + 1, 1), (0, 0, -4, -4)):
                with self.assertRaises(starfocus.ArgumentError) as raised:
                    call(region)
                self.assertEqual(raised.exception.status, starfocus.Status.RANGE)
            for region in ((2**32, 0, 4, 4), (0, 0, 4 - 2**32, 4)):
                with self.assertRaisesRegex(ValueError, "region: expected a whole number of 32 bits"):
                    call(region)
            with self.assertRaisesRegex(TypeError, "region: expected a whole number, found 4.5"):
                call((0, 0, 4.5, 4))
            with self.assertRaisesRegex(ValueError, "region: expected x, y, width and height"):
                call((0, 0, 4))

    def test_numbers_that_do_not_fit_their_field(self):
        for name in ("width", "views", "max_layer", "previews"):
            for beyond in (2**16, 2**32, -2**40):
                with self.assertRaises(ValueError):
                    starfocus.Refocuser(**{"width": 9, "height": 9, "disparity_min": 0, "disparity_max": 1,
                                           name: 5 + beyond})
        with self.assertRaisesRegex(ValueError, "hole: expected a whole number that fits"):
            refocuser(timing=(0, 0, 0, 0, 0, 0, 0, 2**32))
        engine = refocuser(images=1, previews=1)
        prepared = engine.prepare(VIEWS, DISPARITY)
        for call in (lambda: engine.refocus(VIEWS, DISPARITY, focus=1, mode=2**32), lambda: refocuser(workers=2**32),
                     lambda: engine.refocus(VIEWS, DISPARITY, focus=1, blades=2**32 + 5),
                     lambda: starfocus.focus_at(DISPARITY, 2**32, 0), lambda: prepared.preview(2**32 + 1, focus=1),
                     lambda: starfocus.Image(starfocus.Format.RGB, VIEWS[:1], pixel_stride=256 - 2**32)
                     .as_structure(WIDTH, HEIGHT, "out")):
            with self.assertRaisesRegex(ValueError, "expected a whole number"):
                call()

    def test_maps_of_other_floating_point_types_are_converted(self):
        engine = refocuser(images=1)
        whole = engine.refocus(VIEWS, DISPARITY, focus=1)
        images = [starfocus.Image(starfocus.Format.RGB, [view]) for view in VIEWS]
        for kind in (np.float64, ">f4", ">f8"):
            given = DISPARITY.astype(kind)
            np.testing.assert_array_equal(engine.refocus(VIEWS, given, focus=1), whole)
            out = starfocus.Image.empty(starfocus.Format.RGB, WIDTH, HEIGHT)
            engine.refocus(images, starfocus.DepthMap(given), focus=1, out=out)
            np.testing.assert_array_equal(out.planes[0].reshape(whole.shape), whole)
        half = np.clip(DISPARITY, -2, 2).astype(np.float16)
        engine = refocuser()
        np.testing.assert_array_equal(engine.refocus(VIEWS, half, focus=1),
                                      engine.refocus(VIEWS, half.astype(np.float32), focus=1))
        self.assertEqual(starfocus.measure_disparity(half), (half.min(), half.max(), 0))
        for call in (lambda: engine.refocus(VIEWS, np.full((HEIGHT, WIDTH), 1e200), focus=1),
                     lambda: starfocus.fill_disparity(np.full((2, 3), 1e200))):
            with self.assertRaises(starfocus.DisparityError):
                call()
        with self.assertRaisesRegex(TypeError, "disparity: expected float32, found int64"):
            engine.refocus(VIEWS, DISPARITY.astype(np.int64), focus=1)
        for shape in ((0, 4), (4, 0), (4,), (2, 4, 4), (4, 4, 3)):
            with self.assertRaisesRegex(ValueError, "disparity: expected the shape"):
                starfocus.measure_disparity(np.zeros(shape, np.float32))

    def test_one_array_of_a_picture_is_one_view(self):
        for view in (VIEWS[0], VIEWS[0][np.newaxis]):
            engine = starfocus.Refocuser.for_light_field(view, DISPARITY.astype(float))
            np.testing.assert_array_equal(engine.refocus(view, DISPARITY, focus=1),
                                          engine.refocus(VIEWS[:1], DISPARITY, focus=1))
        repaired = starfocus.repair_disparity(VIEWS[0], DISPARITY)
        self.assertEqual(repaired.disparity.shape, DISPARITY.shape)
        with self.assertRaisesRegex(ValueError, "views: expected 5, found 1"):
            refocuser().refocus(VIEWS[0], DISPARITY, focus=1)

    def test_random_arguments_write_nothing_beyond_the_output(self):
        width, height, guard = 37, 23, 4096
        random = np.random.default_rng(71)
        engine = starfocus.Refocuser(width, height, 1, disparity_min=-1, disparity_max=1, workers=1, images=1,
                                     max_blur=2.0, previews=3)
        view = random.integers(0, 256, (height, width, 3), np.uint8)
        prepared = engine.prepare([view], np.zeros((height, width)))
        odd = [0, 0, 0, 1, -1, 2, 3, 17, 23, 37, 38, 2**16, 2**31 - 1, -2**31, 2**32, 2**32 + 1, 37 - 2**32, 256 - 2**32]
        counts = {"done": 0, "refused": 0}
        for _ in range(3000):
            backing = np.full(2 * guard + 4 * width * height, 0xEE, np.uint8)
            region = tuple(int(random.choice(odd)) for _ in range(4)) if random.integers(2) else None
            shape = [int(random.choice([0, 1, 3, 6, 12, height])), int(random.choice([0, 1, 5, 10, 19, width]))]
            if random.integers(2):
                shape = [height, width]
            pixel = int(random.choice([3, 3, 4]))
            out = backing[guard:guard + shape[0] * shape[1] * pixel].reshape(*shape, pixel)
            kind = random.integers(3)
            try:
                if kind == 0:
                    prepared.preview(int(random.choice(odd)), focus=0.5, region=region, out=out)
                elif kind == 1:
                    prepared.refocus(focus=0.5, region=region, out=out)
                else:
                    image = starfocus.Image(starfocus.Format(int(random.integers(4))), [out],
                                            pixel_stride=int(random.choice(odd)) * int(random.integers(2)))
                    engine.refocus([starfocus.Image(starfocus.Format.RGB, [view])],
                                          starfocus.DepthMap(np.zeros((height, width))), focus=0.5, out=image,
                                          region=region)
                counts["done"] += 1
            except (ValueError, TypeError):
                counts["refused"] += 1
            self.assertTrue((backing[:guard] == 0xEE).all() and (backing[guard + out.size:] == 0xEE).all(),
                            (kind, region, shape))
        self.assertGreater(counts["done"], 100)
        self.assertGreater(counts["refused"], 1000)


class Calls(unittest.TestCase):
    """Calls report progress, allow other threads, and fill reports."""

    def test_progress_is_told_and_calls_off(self):
        rows = []
        engine = refocuser(workers=2)
        whole = engine.refocus(VIEWS, DISPARITY, focus=1, progress=lambda done, all_rows: rows.append((done, all_rows)))
        self.assertEqual(rows[-1], (HEIGHT, HEIGHT))
        with self.assertRaises(starfocus.Cancelled):
            engine.refocus(VIEWS, DISPARITY, focus=1, progress=lambda done, all_rows: True)

        def fail(done, all_rows):
            raise KeyError("from the progress function")

        with self.assertRaisesRegex(KeyError, "from the progress function"):
            engine.prepare(VIEWS, DISPARITY, progress=fail)
        np.testing.assert_array_equal(engine.refocus(VIEWS, DISPARITY, focus=1), whole)

    def test_other_threads_run_during_a_call(self):
        engine = refocuser(workers=1)
        thread = threading.Thread(target=lambda: engine.refocus(VIEWS, DISPARITY, focus=1,
                                                                mode=starfocus.Mode.BENCHMARK))
        steps = 0
        thread.start()
        while thread.is_alive():
            steps += 1
        self.assertGreater(steps, 1000)

    def test_two_threads_may_share_a_refocuser(self):
        engine = refocuser(workers=1)
        made = [None, None]

        def work(index):
            made[index] = engine.refocus(VIEWS, DISPARITY, focus=index)

        threads = [threading.Thread(target=work, args=(index,)) for index in range(2)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for index in range(2):
            np.testing.assert_array_equal(made[index], engine.refocus(VIEWS, DISPARITY, focus=index))

    def test_the_report_tells_what_was_done(self):
        engine = refocuser()
        engine.refocus(VIEWS, DISPARITY, focus=1)
        self.assertGreater(engine.report["n"], 0)
        self.assertEqual(sum(layer["pixels"] for layer in engine.report["layers"]), WIDTH * HEIGHT)


class Maps(unittest.TestCase):
    """Disparity maps are measured, filled, estimated and repaired."""

    def test_measured_and_filled(self):
        values = np.array([[1, np.nan, 3], [np.nan, np.inf, -2]], np.float32)
        self.assertEqual(starfocus.measure_disparity(values), (-2, 3, 3))
        np.testing.assert_array_equal(starfocus.fill_disparity(values), [[1, 1, 3], [-2, -2, -2]])
        self.assertTrue(np.isnan(values[0, 1]))
        self.assertEqual(starfocus.aperture_of_f_stop(2.8, 1.4), 0.5)

    def test_estimated_and_repaired(self):
        views = [view[:64, :96] for view in VIEWS]
        low, high = starfocus.measure_disparity(DISPARITY)[:2]
        made = starfocus.estimate_disparity(views, low, high)
        self.assertTrue(((made.disparity >= low) & (made.disparity <= high)).all())
        truth = DISPARITY[:64, :96]
        self.assertLess(np.median(np.abs(made.disparity - truth)), 0.5)
        holes = truth.copy()
        holes[20:30, 20:30] = np.nan
        repaired = starfocus.repair_disparity(views, holes, low, high)
        self.assertTrue(np.isfinite(repaired.disparity).all())
        self.assertEqual(repaired.confidence.shape, truth.shape)
        self.assertIsNone(repaired.coverage)
        with self.assertRaises(starfocus.Cancelled):
            starfocus.estimate_disparity(views, low, high, progress=lambda done, rows: True)

    def test_estimated_from_a_pair(self):
        pair = [view[:64, :96] for view in VIEWS[:2]]
        low, high = starfocus.measure_disparity(DISPARITY)[:2]
        made = starfocus.estimate_disparity(pair, low, high, positions=[(0, 0), (1, 0)])
        self.assertLess(np.median(np.abs(made.disparity - DISPARITY[:64, :96])), 0.5)
        with self.assertRaises(ValueError):
            starfocus.estimate_disparity(pair, low, high, positions=[(0, 0)])
        with self.assertRaises(starfocus.StarfocusError):
            starfocus.estimate_disparity(pair, low, high)

    def test_hair_with_a_closed_outline_gets_its_coverage(self):
        x, y = np.meshgrid(np.arange(240), np.arange(180))
        covered = np.where(y >= 110, 255, np.where(y >= 60, np.array([128, 255, 128, 0, 0, 0, 0])[x % 7], 0))
        share = covered[..., np.newaxis] / 255
        picture = np.round(share * [95, 54, 30] + (1 - share) * [160, 178, 190]).astype(np.uint8)
        closed = np.where(y >= 60, 9, -4).astype(np.float32)
        made = starfocus.repair_disparity(picture, closed)
        self.assertEqual(made.coverage.dtype, np.uint8)
        hair = (y >= 64) & (y < 108)
        self.assertLess(np.abs(made.coverage.astype(int) - covered)[hair].mean(), 48)  # 182 without coverage
        np.testing.assert_array_equal(made.disparity[hair], 9)
        engine = starfocus.Refocuser.for_light_field(picture, closed)
        engine.refocus(picture, made.disparity, focus=-4, coverage=made.coverage)

    def test_views_lie_where_the_program_has_them(self):
        self.assertEqual(starfocus.view_positions(5), [(0, 0), (1, 0), (-1, 0), (0, 1), (0, -1)])
        with self.assertRaises(ValueError):
            starfocus.view_positions(18)


class Headers(unittest.TestCase):
    """The package declares the same values and structures as the C headers."""

    text = "\n".join((HEADERS / name).read_text(encoding="utf-8")
                     for name in ("experimental.h", "starfocus.h", "depth.h", "image.h", "matte.h"))
    text = re.sub(r"/\*.*?\*/", "", text, flags=re.S)

    def values(self, name: str) -> dict:
        body = re.search(rf"typedef enum {name} \{{(.*?)\}}", self.text, re.S).group(1)
        return {key: int(value) for key, value in re.findall(r"(\w+)\s*=\s*(\d+)", body)}

    def test_enumerations(self):
        kinds = {"starfocus_status": "STARFOCUS_(?:ERROR_)?", "starfocus_mode": "STARFOCUS_MODE_", "starfocus_renderer": "STARFOCUS_RENDERER_", "starfocus_shape": "STARFOCUS_SHAPE_",
                 "starfocus_transfer": "STARFOCUS_TRANSFER_", "starfocus_format": "STARFOCUS_FORMAT_", "starfocus_matrix": "STARFOCUS_MATRIX_",
                 "starfocus_range": "STARFOCUS_RANGE_", "starfocus_depth_meaning": "STARFOCUS_DEPTH_"}
        for name, prefix in kinds.items():
            expected = {re.sub("^" + prefix, "", key): value for key, value in self.values(name).items()}
            enumeration = getattr(constants, "".join(word.capitalize() for word in name.split("_")[1:]))
            self.assertEqual({one.name: one.value for one in enumeration}, expected, name)

    def test_structures(self):
        structures = [kind for kind in vars(_abi).values() if kind in _abi.Structure.__subclasses__()]
        self.assertGreater(len(structures), 18)
        for structure in structures:
            name = structure.__name__ if structure is not _abi.Field else "starfocus_field"
            body = re.search(rf"typedef struct {name} \{{(.*?)\}} {name};", self.text, re.S).group(1)
            names = [one for line in body.split(";")
                     for one in re.findall(r"(\w+)(?:\[\w+\])?\s*(?:,|$)", line.strip())]
            self.assertEqual([field[0] for field in structure._fields_], names, name)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
