# SPDX-License-Identifier: Apache-2.0
"""Tests functions for maps that are smaller than the picture and contain distances or 16-bit values."""
import math
import unittest

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
            with self.assertRaisesRegex(starfocus.ArgumentError, "lens.aperture"):
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


if __name__ == "__main__":
    unittest.main()
