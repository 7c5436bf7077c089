# SPDX-License-Identifier: Apache-2.0
"""Tests pictures, streams and frames of the installed package: pictures_test.py PROGRAM FOLDER HEADERS.

PROGRAM is the program starfocus, FOLDER is a light field of five views, and HEADERS is the folder of the
public headers.
"""
import math
import re
import subprocess
import sys
import tempfile
import threading
import unittest
from pathlib import Path

import numpy as np

import starfocus
from starfocus import Format, Image, Shape, _calls, constants

PROGRAM, FOLDER, HEADERS = (Path(argument).resolve() for argument in sys.argv[1:4])
SCENE = starfocus.read_light_field(FOLDER)
VIEWS, DISPARITY = SCENE.views, SCENE.disparity
HEIGHT, WIDTH = DISPARITY.shape
COVERAGE = np.add.outer(3 * np.arange(HEIGHT), np.arange(WIDTH)).astype(np.uint8)
RANDOM = np.random.default_rng(71)
same = np.testing.assert_array_equal


def by_program(*options: str) -> np.ndarray:
    """Returns the picture that the program makes of the light field."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "out.ppm"
        subprocess.run([PROGRAM, "refocus", FOLDER, "-o", path, *options], check=True, stdout=subprocess.DEVNULL)
        return starfocus.read_picture(path)


def refocuser(**config) -> starfocus.Refocuser:
    return starfocus.Refocuser.for_light_field(VIEWS, DISPARITY, **config)


class Pictures(unittest.TestCase):
    """All ways to refocus return the bytes of the program."""

    def test_settings_and_lenses_give_the_program_s_bytes(self):
        pixel = WIDTH // 2, HEIGHT // 2
        engines = {name: refocuser(**config) for name, config in (
            ("plain", {"workers": 2}), ("shapes", {"shapes": 1}), ("linear", {"transfer": starfocus.Transfer.NONE, "shapes": 1}))}
        for options, engine, lens in (
                (["--focus", "-2.5"], "plain", {"focus": -2.5}), (["--focus", "2"], "plain", {"focus": 2}),
                (["--focus-at", f"{pixel[0]},{pixel[1]}"], "plain", {"focus": starfocus.focus_at(DISPARITY, *pixel)}),
                (["--focus", "1", "--aperture", "0.5", "--mode", "frame"], "plain",
                 {"focus": 1, "aperture": 0.5, "mode": starfocus.Mode.FRAME}),
                (["--focus-range", "2,-0.5"], "plain", {"focus": 1, "focus_nearer": 1, "focus_farther": 1.5}),
                (["--focus", "1", "--shape", "polygon:5,18,0.3", "--transfer", "none"], "linear",
                 {"focus": 1, "shape": Shape.POLYGON, "blades": 5, "rotation": 18, "curvature": 0.3}),
                (["--focus", "1", "--shape", "ring:0.5"], "shapes", {"focus": 1, "shape": Shape.RING}),
                (["--focus", "1"], "shapes", {"focus": 1})):  # after another shape
            with self.subTest(options):
                expected = by_program(*options)
                same(engines[engine].refocus(VIEWS, DISPARITY, **lens), expected)
                same(engines[engine].prepare(VIEWS, DISPARITY).refocus(**lens), expected)

    def test_coverage_gives_the_program_s_bytes(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "coverage.pgm"
            path.write_bytes(b"P5 %d %d 255\n" % (WIDTH, HEIGHT) + COVERAGE.tobytes())
            expected = by_program("--focus", "1", "--coverage", str(path))
        engine = refocuser()
        same(engine.refocus(VIEWS, DISPARITY, focus=1, coverage=COVERAGE), expected)
        same(engine.prepare(VIEWS, DISPARITY, coverage=COVERAGE).refocus(focus=1), expected)
        self.assertTrue((expected != engine.refocus(VIEWS, DISPARITY, focus=1)).any())

    def test_a_pair_and_an_l_give_the_program_s_bytes(self):
        for positions in ([(0, 0), (1, 0)], [(0, 0), (0, -1), (-1, 0)]):
            scene = starfocus.read_light_field(FOLDER, views=positions)
            self.assertEqual(scene.positions, positions)
            engine = starfocus.Refocuser.for_light_field(scene.views, scene.disparity, positions=np.array(positions))
            expected = by_program("--focus", "1", "--views", ":".join(f"{u},{v}" for u, v in positions))
            same(engine.refocus(scene.views, scene.disparity, focus=1), expected)

    def test_regions_and_previews_are_parts_of_the_picture(self):
        engine, zeros = refocuser(previews=2), (0, 0, 0, 0)
        prepared, whole = engine.prepare(VIEWS, DISPARITY), engine.refocus(np.stack(VIEWS), DISPARITY, focus=1.5)
        same(prepared.refocus(focus=1.5, region=(40, 30, 50, 20)), whole[30:50, 40:90])
        same(engine.refocus(VIEWS, DISPARITY, focus=1.5, region=zeros), whole)
        same(prepared.refocus(focus=1.5, region=np.zeros(4, int)), whole)
        # The tests of the C API check the pixels of previews.
        half = prepared.preview(1, focus=1.5)
        self.assertEqual(half.shape, ((HEIGHT + 1) // 2, (WIDTH + 1) // 2, 3))
        self.assertLess(np.abs(half.astype(int) - whole[::2, ::2]).mean(), 8)
        same(prepared.preview(1, focus=1.5, region=(41, 30, 50, 21)), half[15:26, 20:46])
        same(prepared.preview(1, focus=1.5, region=zeros), half)

    def test_images_give_the_same_bytes(self):
        engine = refocuser(images=1)
        turned = [Image(Format.BGR, [np.ascontiguousarray(view[:, :, ::-1])]) for view in VIEWS]
        out = Image.empty(Format.BGRX, WIDTH, HEIGHT)
        engine.refocus(turned, starfocus.DepthMap(DISPARITY), focus=1, out=out)
        pixels = out.planes[0].reshape(HEIGHT, WIDTH, 4)
        same(pixels[:, :, 2::-1], engine.refocus(VIEWS, DISPARITY, focus=1))
        self.assertTrue((pixels[:, :, 3] == 255).all())
        view, out = Image.empty(Format.NV12, WIDTH, HEIGHT), Image.empty(Format.NV12, WIDTH, HEIGHT)
        view.planes[0][:] = 100
        view.planes[1][:] = (120, 140) * ((WIDTH + 1) // 2)
        depth = starfocus.DepthMap(np.full((HEIGHT // 2, WIDTH // 2), 500, np.uint16), starfocus.DepthMeaning.RECIPROCAL,
                                   scale=1000.0, invalid=0)
        starfocus.Refocuser(WIDTH, HEIGHT, 1, disparity_min=0, disparity_max=4, images=1).refocus([view], depth, focus=0, out=out)
        for plane, expected in zip(out.planes, view.planes):
            self.assertLessEqual(np.abs(plane.astype(int) - expected).max(), 1)

    def test_arrays_are_read_and_written_where_they_are(self):
        engine, wide = refocuser(), np.zeros((5, HEIGHT, WIDTH + 5, 3), np.uint8)
        wide[:, :, :WIDTH] = VIEWS
        field, _ = _calls.light_field(list(wide[:, :, :WIDTH]), DISPARITY, 5, HEIGHT, WIDTH)
        self.assertEqual((field.views[0].planes[0], field.views[0].strides[0]), (wide.ctypes.data, 3 * (WIDTH + 5)))
        frame, whole = np.zeros((HEIGHT + 2, WIDTH + 4, 3), np.uint8), engine.refocus(VIEWS, DISPARITY, focus=1)
        made = engine.refocus(list(wide[:, :, :WIDTH]), DISPARITY, focus=1, out=frame[1:-1, 2:-2])
        self.assertTrue(np.shares_memory(made, frame))
        same(frame, np.pad(whole, ((1, 1), (2, 2), (0, 0))))

    def test_wrong_arguments_name_their_cause(self):
        engine, slices, twisted = refocuser(images=1, previews=1), refocuser(line_scan=0), np.zeros((HEIGHT, WIDTH, 3), np.uint8)
        prepared, holes = engine.prepare(VIEWS, DISPARITY), DISPARITY.copy()
        holes[3, 4] = np.nan
        images = [Image(Format.RGBX, [view]) for view in VIEWS]
        refocus = engine.refocus
        rows = [
            (lambda: starfocus.Refocuser(0, 10, disparity_min=0, disparity_max=1), starfocus.ArgumentError,
             r"^width: a field or an argument is outside its range \(expected 1 to 65535, found 0\)$"),
            (lambda: starfocus.Refocuser(9, 9, 2**32 + 5, disparity_min=0, disparity_max=1), ValueError, "views"),
            (lambda: refocuser(max_blurr=3), TypeError, "max_blurr"),
            (lambda: refocuser(timing=(0,) * 7 + (2**32,)), ValueError, "hole: expected a whole number that fits"),
            (lambda: refocus(VIEWS, DISPARITY, focus=0, aperture=2), starfocus.ArgumentError, "aperture"),
            (lambda: refocus(VIEWS, DISPARITY, focus=1, focus_farther=-1), starfocus.ArgumentError, "focus_farther"),
            (lambda: refocus(VIEWS, DISPARITY, focus=1, cats_eye=0.5), starfocus.StarfocusError, "cats_eye"),
            (lambda: refocus(VIEWS, DISPARITY, focus=1, blades=2**32 + 5), ValueError, "expected a whole number"),
            (lambda: slices.refocus(VIEWS, DISPARITY, focus=1, renderer=starfocus.Renderer.LINE_SCAN),
             starfocus.StarfocusError, "renderer"),
            (lambda: refocus(VIEWS[:4], DISPARITY, focus=0), ValueError, "views: expected 5, found 4"),
            (lambda: refocus(VIEWS[0], DISPARITY, focus=0), ValueError, "views: expected 5, found 1"),
            (lambda: refocus(VIEWS, DISPARITY[:-1], focus=0), ValueError, "disparity: expected the shape"),
            (lambda: refocus(VIEWS, DISPARITY.astype(np.int64), focus=1), TypeError, "disparity: expected float32, found int64"),
            (lambda: refocus(VIEWS, holes, focus=0), starfocus.DisparityError, r"at \(4, 3\)"),
            (lambda: refocus(VIEWS, DISPARITY.astype(float) * 1e200, focus=0), starfocus.DisparityError, ""),
            (lambda: refocus(VIEWS, DISPARITY, focus=1, coverage=COVERAGE[1:]), ValueError, "coverage"),
            (lambda: refocus(VIEWS, DISPARITY, focus=0, out=twisted[:, ::-1]), ValueError, "out: expected a writable array"),
            (lambda: refocus(images, starfocus.DepthMap(DISPARITY), focus=0, out=images[0]), ValueError,
             "view 0, plane 0: expected .* rows of"),
            (lambda: Image(Format.RGB, VIEWS[:1], pixel_stride=256 - 2**32).as_structure(WIDTH, HEIGHT, "out"), ValueError,
             "expected a whole number"),
            (lambda: prepared.refocus(focus=1, petals=5), TypeError, "petals"),
            (lambda: prepared.refocus(focus=1, blades=99), starfocus.ArgumentError, "blades"),
            (lambda: prepared.preview(2, focus=2), starfocus.ArgumentError, "shift: .*expected 1 to previews"),
            (lambda: prepared.preview(2**32 + 1, focus=1), ValueError, "expected a whole number"),
        ]
        for call in (lambda region: refocus(VIEWS, DISPARITY, focus=1, region=region),
                     lambda region: prepared.refocus(focus=1, region=region),
                     lambda region: prepared.preview(1, focus=1, region=region)):
            for region, kind, message in (
                    ((5, 5, 0, 0), starfocus.ArgumentError, ""), ((-1, 0, 4, 4), starfocus.ArgumentError, ""),
                    ((2**32, 0, 4, 4), ValueError, "region: expected a whole number of 32 bits"),
                    ((0, 0, 4.5, 4), TypeError, "region: expected a whole number, found 4.5"),
                    ((0, 0, 4), ValueError, "region: expected x, y, width and height")):
                rows.append((lambda call=call, region=region: call(region), kind, message))
        for number, (call, kind, message) in enumerate(rows):
            with self.subTest(number, message=message), self.assertRaisesRegex(kind, message):
                call()
        with self.assertRaises(ValueError) as raised:
            starfocus.Refocuser(0, 10, disparity_min=0, disparity_max=1)
        self.assertEqual((raised.exception.field, raised.exception.status), ("width", starfocus.Status.RANGE))

    def test_outputs_of_another_size_are_rejected(self):
        """The bytes beyond an output keep their values, because only outputs of the size of the region are accepted."""
        width, height, odd = 37, 23, (0, 1, -1, 2, 23, 38, 2**16, 2**31 - 1, -2**31, 2**32, 37 - 2**32)
        engine = starfocus.Refocuser(width, height, 1, disparity_min=-1, disparity_max=1, workers=1, images=1, previews=3)
        view, flat = RANDOM.integers(0, 256, (height, width, 3), np.uint8), np.zeros((height, width))
        prepared, images = engine.prepare([view], flat), [Image(Format.RGB, [view])]
        calls = {
            (height, width, 3): lambda out: prepared.refocus(focus=0.5, out=out),
            (5, 9, 3): lambda out: prepared.refocus(focus=0.5, region=(3, 2, 9, 5), out=out),
            (6, 10, 3): lambda out: prepared.preview(2, focus=0.5, out=out)}
        for shape, call in calls.items():
            call(np.zeros(shape, np.uint8))
            for wrong in ((*shape[:2], 4), (shape[0] - 1, *shape[1:]), (shape[0], shape[1] - 1, 3), (0, *shape[1:]), (1, 1, 3)):
                with self.assertRaises(ValueError):
                    call(np.zeros(wrong, np.uint8))
        for number in odd:
            for change in ({"region": (0, 0, number, number)}, {"region": (number, number, 1, 1)}, {"pixel_stride": number}):
                backing, stride = np.full(2 * view.size, 0xEE, np.uint8), change.pop("pixel_stride", 0)
                out = Image(Format.RGB, [backing[:view.size].reshape(view.shape)], pixel_stride=stride)
                try:
                    engine.refocus(images, starfocus.DepthMap(flat), focus=0.5, out=out, **change)
                except (ValueError, TypeError):
                    pass
                self.assertTrue((backing[view.size:] == 0xEE).all(), (number, change, stride))

class Calls(unittest.TestCase):
    """Calls report progress, allow other threads, and fill reports."""

    def test_progress_is_told_and_calls_off(self):
        rows, engine = [], refocuser(workers=2)
        whole = engine.refocus(VIEWS, DISPARITY, focus=1, progress=lambda *values: rows.append(values))
        self.assertEqual(rows[-1], (HEIGHT, HEIGHT))
        with self.assertRaises(starfocus.Cancelled):
            engine.refocus(VIEWS, DISPARITY, focus=1, progress=lambda done, all_rows: True)

        def fail(done, all_rows):
            raise KeyError("from the progress function")

        with self.assertRaisesRegex(KeyError, "from the progress function"):
            engine.prepare(VIEWS, DISPARITY, progress=fail)
        same(engine.refocus(VIEWS, DISPARITY, focus=1), whole)
        self.assertGreater(engine.report["n"], 0)
        self.assertEqual(sum(layer["pixels"] for layer in engine.report["layers"]), WIDTH * HEIGHT)

    def test_threads_may_share_a_refocuser_and_run_during_its_calls(self):
        engine, made, steps = refocuser(workers=1), [None, None], 0

        def work(index):
            made[index] = engine.refocus(VIEWS, DISPARITY, focus=index, mode=starfocus.Mode.BENCHMARK)

        threads = [threading.Thread(target=work, args=(index,)) for index in range(2)]
        for thread in threads:
            thread.start()
        while any(thread.is_alive() for thread in threads):
            steps += 1
        self.assertGreater(steps, 1000)
        for index in range(2):
            same(made[index], engine.refocus(VIEWS, DISPARITY, focus=index, mode=starfocus.Mode.BENCHMARK))

    def test_threads_get_their_own_errors(self):
        engine, wrong = refocuser(workers=1), []

        def work(first):
            for value in range(first, first + 500):
                with self.assertRaises(starfocus.ArgumentError) as raised:
                    engine.refocus(VIEWS, DISPARITY, focus=value)
                if str(value) not in str(raised.exception):
                    wrong.append(f"{value}: {raised.exception}")

        threads = [threading.Thread(target=work, args=(first,)) for first in (2000000, 3000000, 4000000, 5000000)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(wrong, [])


def bands(rows: int, coverage=None):
    """Yields the light field in bands of rows. The arrays of a band are overwritten when the next band is yielded."""
    for y in range(0, HEIGHT, rows):
        views, disparity = [view[y:y + rows].copy() for view in VIEWS], DISPARITY[y:y + rows].copy()
        yield (views, disparity) if coverage is None else (np.stack(views), disparity, coverage[y:y + rows])
        disparity[:] = np.nan
        for view in views:
            view[:] = 255


class Streams(unittest.TestCase):
    """Streams of rows, and frames of a video."""

    def test_streams_have_the_bytes_of_whole_pictures(self):
        engine, taken = refocuser(streaming=1, shapes=1, max_blur=8, superblock=64), []
        for coverage in (None, COVERAGE):
            lens = {"focus": 1, "aperture": 0.75, "shape": Shape.DISC}
            whole = engine.refocus(VIEWS, DISPARITY, coverage=coverage, **lens)
            for rows in (1, 37, HEIGHT):
                made = list(engine.stream(bands(rows, coverage), **lens))
                self.assertGreater(len(made), 2)
                same(np.concatenate(made), whole)
                self.assertEqual(sum(layer["pixels"] for layer in engine.report["layers"]), WIDTH * HEIGHT)
        next(engine.stream((taken.append(1) or band for band in bands(8)), focus=1))
        self.assertLess(len(taken), HEIGHT // 8, "rows are finished before the last band is read")

    def test_wrong_bands_and_frames(self):
        engine, whole, half = refocuser(streaming=1), (VIEWS, DISPARITY), HEIGHT // 2
        for wrong, message in (([], f"bands: expected {HEIGHT} rows in all, found 0"),
                               ([whole, whole], f"expected {HEIGHT} rows in all, found at least {2 * HEIGHT}"),
                               ([(VIEWS[:4], DISPARITY)], "views: expected 5, found 4"),
                               ([(VIEWS, DISPARITY[1:])], "view 0: expected the shape"),
                               ([(*whole, COVERAGE[1:])], "coverage: expected the shape"),
                               ([(VIEWS,)], "expected views, disparity map and optionally coverage")):
            with self.assertRaisesRegex(ValueError, message):
                list(engine.stream(wrong, focus=1))
        mixed = [([view[:half] for view in VIEWS], DISPARITY[:half]),
                 ([view[half:] for view in VIEWS], DISPARITY[half:], COVERAGE[half:])]
        with self.assertRaises(starfocus.StarfocusError):
            list(engine.stream(mixed, focus=1))
        with self.assertRaisesRegex(starfocus.StarfocusError, "features"):
            list(refocuser().stream([whole], focus=1))
        with self.assertRaisesRegex(ValueError, "disparity: expected the shape"):
            list(engine.frames([(VIEWS, DISPARITY[1:])], focus=1))

    def test_other_calls_and_progress_end_a_stream(self):
        engine = refocuser(streaming=1)
        stream = engine.stream(bands(8), focus=1)
        next(stream)
        engine.refocus(VIEWS, DISPARITY, focus=0)
        with self.assertRaises(starfocus.StarfocusError):
            list(stream)
        older, newer = (engine.stream(bands(8), focus=focus) for focus in (1, 2))
        next(older)
        made = [next(newer)]
        with self.assertRaisesRegex(starfocus.StarfocusError, "^stream: .*later stream"):
            next(older)
        made += newer
        same(np.concatenate(made), engine.refocus(VIEWS, DISPARITY, focus=2))
        with self.assertRaises(starfocus.Cancelled):
            list(engine.stream(bands(8), focus=1, progress=lambda done, rows: done > HEIGHT // 2))

    def test_unchanged_parts_of_frames_are_copied(self):
        engine = refocuser(workers=1, superblock=64)
        buffers, disparity = [view.copy() for view in VIEWS], DISPARITY.copy()
        reused, expected = [], []

        def frames():
            for rows, shift in ((slice(0), 0), (slice(0), 0), (slice(40, 60), 0), (slice(0), 1)):
                buffers[0][rows, 40:60] += 50
                disparity[-20:, -20:] -= shift
                expected.append(refocuser(superblock=64).refocus(buffers, disparity, focus=1))
                yield buffers, disparity

        for picture in engine.frames(frames(), focus=1):
            same(picture, expected[-1])
            picture[:] = 0  # the caller may change the picture
            reused.append(engine.report["reused_blocks"])
        self.assertEqual(reused[0], 0)
        self.assertGreater(reused[1], max(reused[2:]))
        self.assertGreater(reused[2], 0)
        made = list(engine.frames([(VIEWS, DISPARITY, COVERAGE), (VIEWS, DISPARITY)], focus=1))
        same(made[0], engine.refocus(VIEWS, DISPARITY, focus=1, coverage=COVERAGE))
        same(made[1], engine.refocus(VIEWS, DISPARITY, focus=1))


class Deep(unittest.TestCase):
    """Pictures of more than 8 bits, light beyond white and alpha. The tests of the C API check their pixels."""

    CODES = [257 * view.astype(np.uint16) for view in VIEWS]
    LIGHT = [((view / 255.0) ** 2.2).astype(np.float16) for view in VIEWS]

    def refocused(self, views, **config):
        engine = starfocus.Refocuser.for_light_field(views, DISPARITY, **config)
        picture = engine.refocus(views, DISPARITY, focus=1)
        self.assertEqual((picture.dtype, picture.shape), (views[0].dtype, views[0].shape))
        return picture

    def test_codes_of_16_bits_give_the_picture_of_8_bits(self):
        flat = refocuser().refocus(VIEWS, DISPARITY, focus=1)
        self.assertLessEqual(np.abs(self.refocused(self.CODES) - 257.0 * flat).max(), 257)

    def test_light_is_linear(self):
        """The features exclude coverage, whose decisions depend on codes. Most light is beyond white in both pictures,
        because lamps are not gathered where their blur varies."""
        dark, bright = ([np.float16(gain) * view for view in self.LIGHT] for gain in (16, 32))
        error = self.refocused(bright, coverage=0) / np.float64(32) - self.refocused(dark, coverage=0) / np.float64(16)
        self.assertLess(np.abs(error).max(), 0.1)
        self.assertLess(np.sqrt((error**2).mean()), 0.003)

    def test_alpha_is_refocused(self):
        opaque = self.refocused([np.dstack([view, np.full_like(view[:, :, 0], 65535)]) for view in self.CODES])
        same(opaque[:, :, :3], self.refocused(self.CODES))
        self.assertTrue((opaque[:, :, 3] == 65535).all())
        # The alpha of white, by which its colours are multiplied, is blurred as its colours are.
        white = self.refocused([np.repeat(view[:, :, 1:2], 4, axis=2) for view in self.LIGHT])
        self.assertGreater(np.ptp(white[:, :, 3]), 0.5)
        self.assertLess(np.abs(white[:, :, 3] - white[:, :, 0].astype(float)).max(), 0.003)

    def test_all_calls_return_the_samples_of_the_views(self):
        opaque = [np.dstack([view, np.ones_like(view[:, :, 0])]) for view in self.LIGHT]
        for views in (self.CODES, self.LIGHT, opaque, [view.astype(np.float32) for view in opaque]):
            kind, channels = views[0].dtype, views[0].shape[2]
            with self.subTest(kind, channels=channels):
                engine = starfocus.Refocuser.for_light_field(views, DISPARITY, streaming=1)
                whole, prepared = engine.refocus(np.stack(views), DISPARITY, focus=1), engine.prepare(views, DISPARITY)
                out = np.zeros((20, 54, channels), kind)
                self.assertIs(prepared.refocus(focus=1, region=(40, 30, 50, 20), out=out[:, 2:-2]).base, out)
                same(out, np.pad(whole[30:50, 40:90], ((0, 0), (2, 2), (0, 0))))
                scenes = [([view[y:y + 50] for view in views], DISPARITY[y:y + 50]) for y in range(0, HEIGHT, 50)]
                same(np.concatenate(list(engine.stream(scenes, focus=1))), whole)
                made = [*engine.frames([(views, DISPARITY)] * 2, focus=1), prepared.refocus(focus=1)]
                for picture in made:
                    same(picture, whole)
                self.assertEqual({(picture.dtype, picture.shape[2]) for picture in made}, {(kind, channels)})

    def test_floats_of_32_bits_give_the_picture_of_16_bits(self):
        wide = [view.astype(np.float32) for view in self.LIGHT]
        same(self.refocused(wide), self.refocused(self.LIGHT).astype(np.float32))
        black = [np.where(view < 0.1, 0, view) for view in wide]
        same(self.refocused([np.where(view < 0.1, np.float32(-1e9), view) for view in wide]), self.refocused(black))

    def test_transfers_have_names(self):
        made = {}
        for name in ("srgb", "none", "pq", "hlg"):
            made[name] = self.refocused(self.CODES, transfer=name)
            same(made[name], self.refocused(self.CODES, transfer=starfocus.Transfer[name.upper()]))
        self.assertEqual(len({picture.tobytes() for picture in made.values()}), 4)

    def test_images_give_the_same_samples(self):
        engine = starfocus.Refocuser.for_light_field(self.CODES, DISPARITY)
        images, out = [Image(Format.RGB16, [view]) for view in self.CODES], Image.empty(Format.RGBA16, WIDTH, HEIGHT)
        engine.refocus(images, DISPARITY, focus=1, out=out)
        same(out.planes[0].reshape(HEIGHT, WIDTH, 4)[:, :, :3], engine.refocus(self.CODES, DISPARITY, focus=1))
        for form, kind in ((Format.RGB_HALF, np.float16), (Format.P010, np.uint16), (Format.NV12, np.uint8)):
            out = Image.empty(form, WIDTH, HEIGHT)
            engine.refocus(self.CODES, DISPARITY, focus=1, out=out)
            self.assertEqual(out.planes[0].dtype, kind)
        self.assertEqual(engine.refocus(images, DISPARITY, focus=1).dtype, np.uint8)

    def test_wrong_samples_name_their_cause(self):
        engine = starfocus.Refocuser.for_light_field(self.CODES, DISPARITY)
        types = "view 0: expected uint8, uint16, float16 or float32, found "
        rows = [([view.astype(kind) for view in VIEWS], TypeError, f"^{types}{np.dtype(kind)}$")
                for kind in (np.float64, np.int16, np.uint32, bool, np.complex64)]
        rows += [([view.astype(">u2") for view in VIEWS], TypeError, f"^{types}>u2$"),
                 ([*self.CODES[:4], VIEWS[4]], TypeError, "^view 4: expected uint16, found uint8$"),
                 ([view[:, :, :2] for view in self.CODES], ValueError, "view 0: expected the shape"),
                 ([np.dstack([view, view]) for view in VIEWS], ValueError, "view 0: expected the shape")]
        for kind in (np.float16, np.float32):
            for value in (np.nan, -np.nan, np.inf, -np.inf, 64.5):
                views = [view.astype(kind) for view in self.LIGHT]
                views[2][5, 7, 1] = value
                rows.append((views, ValueError, rf"^view 2: expected finite values up to 64, found .* at \(7, 5\)$"))
        for views, error, message in rows:
            with self.subTest(message), self.assertRaisesRegex(error, message):
                engine.refocus(views, DISPARITY, focus=1)
        views = [view.astype(np.float32) for view in self.LIGHT]
        views[0][:] = 64
        engine.refocus(views, DISPARITY, focus=1)
        for call, error, message in (
                (lambda: refocuser().refocus(self.CODES, DISPARITY, focus=1), starfocus.ArgumentError,
                 "format of 8 bits without STARFOCUS_FEATURE_DEEP"),
                (lambda: engine.refocus(self.CODES, DISPARITY, focus=1, out=VIEWS[0].copy()), TypeError,
                 "^out: expected an array of uint16$"),
                (lambda: engine.refocus(self.CODES, DISPARITY, focus=1, out=Image(Format.RGB16, VIEWS[:1])), TypeError,
                 "^out, plane 0: expected uint16, found uint8$"),
                (lambda: refocuser(transfer="gamma"), ValueError, "^transfer: expected srgb, none, pq, hlg, found 'gamma'$"),
                (lambda: refocuser(transfer="pq"), starfocus.ArgumentError, "transfer: .*without STARFOCUS_FEATURE_DEEP"),
                (lambda: starfocus.estimate_disparity(self.CODES, -1, 1), TypeError, "^views: expected uint8, found uint16$")):
            with self.subTest(message), self.assertRaisesRegex(error, message):
                call()


class Enumerations(unittest.TestCase):
    """The package declares the same values as the C headers. The library itself lists the fields of structures."""

    def test_enumerations(self):
        text = "\n".join((HEADERS / name).read_text(encoding="utf-8") for name in ("experimental.h", "starfocus.h", "depth.h", "image.h"))
        text = re.sub(r"/\*.*?\*/", "", text, flags=re.S)
        for name, prefix in (("status", "(?:ERROR_)?"), ("mode", "MODE_"), ("renderer", "RENDERER_"), ("shape", "SHAPE_"),
                             ("transfer", "TRANSFER_"), ("format", "FORMAT_"), ("matrix", "MATRIX_"), ("range", "RANGE_"),
                             ("depth_meaning", "DEPTH_")):
            body = re.search(rf"typedef enum starfocus_{name} \{{(.*?)\}}", text, re.S).group(1)
            expected = {re.sub("^STARFOCUS_" + prefix, "", key): int(value) for key, value in re.findall(r"(\w+)\s*=\s*(\d+)", body)}
            enumeration = getattr(constants, name.title().replace("_", ""))
            self.assertEqual({one.name: one.value for one in enumeration}, expected, name)


# structural_similarity of scikit-image 0.19.3 for the luma of RESULT and TRUTH, with gaussian_weights=True, sigma=1.5,
# use_sample_covariance=False, data_range=255.
SSIM = 0.9876324453048113


def psnr(result: np.ndarray, truth: np.ndarray) -> float:
    """Returns the PSNR in decibels."""
    return float(10 * np.log10(255**2 / np.mean((result.astype(float) - truth) ** 2)))


class Quality(unittest.TestCase):
    """The figures of starfocus.evaluate have their published definitions."""

    def setUp(self):
        random = np.random.default_rng(1)
        self.truth = random.integers(0, 256, (30, 40, 3), np.uint8)
        self.result = np.clip(self.truth + random.integers(-20, 21, self.truth.shape), 0, 255).astype(np.uint8)

    def test_psnr_and_ssim(self):
        made, step = starfocus.evaluate(self.result, self.truth), np.zeros(self.truth.shape[:2], np.float32)
        self.assertAlmostEqual(made.psnr, psnr(self.result, self.truth), 9)
        self.assertAlmostEqual(made.ssim, SSIM, 9)
        self.assertIsNone(made.silhouette_psnr)
        self.assertEqual(starfocus.evaluate(self.truth, self.truth, step), (math.inf, 1.0, None))
        step[:, 20:] = 4
        self.assertEqual(starfocus.evaluate(self.truth, self.truth, step), (math.inf, 1.0, math.inf))

    def test_errors_near_silhouettes_alone_count_for_silhouettes(self):
        disparity, truth = np.full((40, 60), 2, np.float32), np.full((40, 60, 3), 100, np.uint8)
        disparity[20:, 30:] = 5
        disparity[5, 5] = np.nan
        result = RANDOM.integers(0, 256, truth.shape, np.uint8)
        near, edge = np.zeros((2, *disparity.shape), bool)
        near[18:, 27:33] = near[17:23, 28:] = True  # two pixels from columns 29 and 30, and from rows 19 and 20
        edge[20:, 29:31] = edge[19:21, 30:] = True
        for options, pixels in (({"distance": 2}, near), ({"distance": 0, "step": 2.9}, edge)):
            made = starfocus.evaluate(result, truth, disparity, **options)
            self.assertAlmostEqual(made.silhouette_psnr, psnr(result[pixels], truth[pixels]), 9)
        self.assertIsNone(starfocus.evaluate(result, truth, disparity, step=3).silhouette_psnr)

    def test_wrong_arguments(self):
        for arguments, options, kind, message in (
                ((self.result[1:], self.truth), {}, ValueError, "result: expected the shape"),
                ((self.result[:10], self.truth[:10]), {}, ValueError, "at least 11 x 11 pixels"),
                ((self.result / 1.0, self.truth), {}, TypeError, "result: expected uint8, found float64"),
                ((self.result, self.truth), {"step": -1}, ValueError, "step: expected at least 0, found -1")):
            with self.assertRaisesRegex(kind, message):
                starfocus.evaluate(*arguments, **options)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
