# SPDX-License-Identifier: Apache-2.0
"""Tests Refocuser.stream and Refocuser.frames: frames_test.py FOLDER. FOLDER is a light field of five views."""
import sys
import unittest

import numpy as np

import starfocus

SCENE = starfocus.read_light_field(sys.argv[1])
VIEWS, DISPARITY = SCENE.views, SCENE.disparity
HEIGHT, WIDTH = DISPARITY.shape
COVERAGE = np.add.outer(3 * np.arange(HEIGHT), np.arange(WIDTH)).astype(np.uint8)


def refocuser(**config) -> starfocus.Refocuser:
    return starfocus.Refocuser.for_light_field(VIEWS, DISPARITY, **config)


def bands(rows: int, coverage=None):
    """Yields the light field in bands of rows. The arrays of a band are overwritten when the next band is yielded."""
    for y in range(0, HEIGHT, rows):
        views, disparity = [view[y:y + rows].copy() for view in VIEWS], DISPARITY[y:y + rows].copy()
        yield (views, disparity) if coverage is None else (np.stack(views), disparity, coverage[y:y + rows])
        disparity[:] = np.nan
        for view in views:
            view[:] = 255


class Stream(unittest.TestCase):
    """Streams of rows."""

    def test_streams_have_the_bytes_of_whole_pictures(self):
        engine = refocuser(streaming=1, shapes=1)
        for coverage in (None, COVERAGE):
            lens = {"focus": 1, "aperture": 0.75, "shape": starfocus.Shape.DISC}
            whole = engine.refocus(VIEWS, DISPARITY, coverage=coverage, **lens)
            for rows in (1, 37, HEIGHT):
                made = list(engine.stream(bands(rows, coverage), **lens))
                self.assertGreater(len(made), 2)
                np.testing.assert_array_equal(np.concatenate(made), whole)
                self.assertEqual(sum(layer["pixels"] for layer in engine.report["layers"]), WIDTH * HEIGHT)

    def test_rows_are_finished_before_the_last_band_is_read(self):
        taken = []
        stream = refocuser(streaming=1, max_blur=8).stream((taken.append(1) or band for band in bands(8)), focus=1)
        next(stream)
        self.assertLess(len(taken), HEIGHT // 8)

    def test_wrong_bands(self):
        engine = refocuser(streaming=1)
        whole = VIEWS, DISPARITY
        for wrong, message in (([], f"bands: expected {HEIGHT} rows in all, found 0"),
                               ([whole, whole], f"expected {HEIGHT} rows in all, found at least {2 * HEIGHT}"),
                               ([(VIEWS[:4], DISPARITY)], "views: expected 5, found 4"),
                               ([(VIEWS, DISPARITY[1:])], "view 0: expected the shape"),
                               ([(*whole, COVERAGE[1:])], "coverage: expected the shape"),
                               ([(VIEWS,)], "expected views, disparity map and optionally coverage")):
            with self.assertRaisesRegex(ValueError, message):
                list(engine.stream(wrong, focus=1))
        half = HEIGHT // 2
        mixed = [([view[:half] for view in VIEWS], DISPARITY[:half]),
                 ([view[half:] for view in VIEWS], DISPARITY[half:], COVERAGE[half:])]
        with self.assertRaises(starfocus.StarfocusError):
            list(engine.stream(mixed, focus=1))
        with self.assertRaisesRegex(starfocus.StarfocusError, "features"):
            list(refocuser().stream([whole], focus=1))

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
        np.testing.assert_array_equal(np.concatenate(made), engine.refocus(VIEWS, DISPARITY, focus=2))
        with self.assertRaises(starfocus.Cancelled):
            list(engine.stream(bands(8), focus=1, progress=lambda done, rows: done > HEIGHT // 2))


class Frames(unittest.TestCase):
    """Frames of a video."""

    def test_unchanged_parts_are_copied(self):
        engine = refocuser(workers=1)
        buffers, disparity = [view.copy() for view in VIEWS], DISPARITY.copy()
        changed = [(slice(0), 0), (slice(0), 0), (slice(40, 60), 0), (slice(0), 1)]
        reused, expected = [], []

        def frames():
            for rows, shift in changed:
                buffers[0][rows, 40:60] += 50
                disparity[-20:, -20:] -= shift
                expected.append(refocuser().refocus(buffers, disparity, focus=1))
                yield buffers, disparity

        for picture in engine.frames(frames(), focus=1):
            np.testing.assert_array_equal(picture, expected[-1])
            picture[:] = 0  # the caller may change the picture
            reused.append(engine.report["reused_blocks"])
        self.assertEqual(reused[0], 0)
        self.assertGreater(reused[1], reused[2])
        self.assertGreater(reused[2], 0)
        self.assertGreater(reused[1], reused[3])

    def test_coverage_and_wrong_frames(self):
        engine = refocuser()
        made = list(engine.frames([(VIEWS, DISPARITY, COVERAGE), (VIEWS, DISPARITY)], focus=1))
        np.testing.assert_array_equal(made[0], engine.refocus(VIEWS, DISPARITY, focus=1, coverage=COVERAGE))
        np.testing.assert_array_equal(made[1], engine.refocus(VIEWS, DISPARITY, focus=1))
        with self.assertRaisesRegex(ValueError, "disparity: expected the shape"):
            list(engine.frames([(VIEWS, DISPARITY[1:])], focus=1))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
