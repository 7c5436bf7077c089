# SPDX-License-Identifier: Apache-2.0
"""Tests starfocus.evaluate."""
import math
import unittest

import numpy as np

import starfocus

RANDOM = np.random.default_rng(1)
TRUTH = RANDOM.integers(0, 256, (30, 40, 3), np.uint8)
RESULT = np.clip(TRUTH + RANDOM.integers(-20, 21, TRUTH.shape), 0, 255).astype(np.uint8)
# structural_similarity of scikit-image 0.19.3 for the luma of RESULT and TRUTH, with gaussian_weights=True, sigma=1.5,
# use_sample_covariance=False, data_range=255.
SSIM = 0.9876324453048113


def psnr(result: np.ndarray, truth: np.ndarray) -> float:
    """Returns the PSNR in decibels."""
    return float(10 * np.log10(255**2 / np.mean((result.astype(float) - truth) ** 2)))


class Quality(unittest.TestCase):
    """The figures have their published definitions."""

    def test_psnr_and_ssim(self):
        made = starfocus.evaluate(RESULT, TRUTH)
        self.assertAlmostEqual(made.psnr, psnr(RESULT, TRUTH), 9)
        self.assertAlmostEqual(made.ssim, SSIM, 9)
        self.assertIsNone(made.silhouette_psnr)

    def test_equal_pictures(self):
        disparity = np.zeros(TRUTH.shape[:2], np.float32)
        self.assertEqual(starfocus.evaluate(TRUTH, TRUTH, disparity), (math.inf, 1.0, None))
        disparity[:, 20:] = 4
        self.assertEqual(starfocus.evaluate(TRUTH, TRUTH, disparity), (math.inf, 1.0, math.inf))

    def test_errors_near_silhouettes_alone_count_for_silhouettes(self):
        disparity = np.full((40, 60), 2, np.float32)
        disparity[20:, 30:] = 5
        disparity[5, 5] = np.nan
        truth = np.full((40, 60, 3), 100, np.uint8)
        near = np.zeros(disparity.shape, bool)
        near[18:, 27:33] = near[17:23, 28:] = True  # two pixels from columns 29 and 30, and from rows 19 and 20
        result = truth.copy()
        result[near] = RANDOM.integers(0, 256, (near.sum(), 3))
        expected = psnr(result[near], truth[near])
        made = starfocus.evaluate(result, truth, disparity, distance=2)
        self.assertAlmostEqual(made.silhouette_psnr, expected, 9)
        self.assertEqual(starfocus.evaluate(np.where(near[..., None], truth, 0).astype(np.uint8), truth, disparity,
                                            distance=2).silhouette_psnr, math.inf)
        self.assertIsNone(starfocus.evaluate(result, truth, disparity, step=3).silhouette_psnr)
        near[:] = False
        near[20:, 29:31] = near[19:21, 30:] = True
        narrow = starfocus.evaluate(result, truth, disparity, distance=0, step=2.9)
        self.assertAlmostEqual(narrow.silhouette_psnr, psnr(result[near], truth[near]), 9)

    def test_wrong_arguments(self):
        for arguments, message in (((RESULT[1:], TRUTH), "result: expected the shape"),
                                   ((RESULT[:10], TRUTH[:10]), "at least 11 x 11 pixels"),
                                   ((RESULT, TRUTH, np.zeros((3, 3))), "disparity: expected the shape")):
            with self.assertRaisesRegex(ValueError, message):
                starfocus.evaluate(*arguments)
        with self.assertRaisesRegex(TypeError, "result: expected uint8, found float64"):
            starfocus.evaluate(RESULT / 1.0, TRUTH)
        with self.assertRaisesRegex(TypeError, "distance: expected a whole number, found 2.5"):
            starfocus.evaluate(RESULT, TRUTH, np.zeros(TRUTH.shape[:2]), distance=2.5)
        for name in ("distance", "step"):
            with self.assertRaisesRegex(ValueError, f"{name}: expected at least 0, found -1"):
                starfocus.evaluate(RESULT, TRUTH, **{name: -1})


if __name__ == "__main__":
    unittest.main()
