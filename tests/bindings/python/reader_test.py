# SPDX-License-Identifier: Apache-2.0
"""Tests starfocus.read_light_field: reader_test.py PROGRAM FOLDER [no-tiff]. FOLDER is a light field of five views. With
`no-tiff`, the package must reject depth maps in TIFF."""
import os
import subprocess
import sys
import tempfile
import unittest
import warnings
from pathlib import Path
from unittest import mock

import numpy as np
from PIL import Image

import starfocus
from starfocus import reader

PROGRAM, FOLDER = (Path(argument).resolve() for argument in sys.argv[1:3])
NAMES = ("view_+0.0_+0.0", "view_+1.0_+0.0", "view_-1.0_+0.0", "view_+0.0_+1.0", "view_+0.0_-1.0")
VIEWS = [starfocus.read_picture(FOLDER / f"{name}.png") for name in NAMES]
DISPARITY = starfocus.read_pfm(FOLDER / "disparity.pfm")


class Tensor:
    """Converts itself to an array, as tensors of networks do."""

    def __init__(self, values):
        self.values = values

    def __array__(self, *_, **__):
        return self.values


class Reader(unittest.TestCase):
    """Each test starts in an empty folder, which is also the folder of temporary files."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(folder.name)
        os.mkdir("temporary")
        for patch in (mock.patch.object(tempfile, "tempdir", os.path.abspath("temporary")),
                      mock.patch.dict(os.environ, TMPDIR=os.path.abspath("temporary")), warnings.catch_warnings()):
            patch.__enter__()
            self.addCleanup(patch.__exit__, None, None, None)
        warnings.simplefilter("error")

    def tearDown(self):
        self.assertEqual(os.listdir("temporary"), [])

    def test_a_folder_of_views(self):
        scene = starfocus.read_light_field(FOLDER)
        np.testing.assert_array_equal(scene.views, VIEWS)
        np.testing.assert_array_equal(scene.disparity, DISPARITY)
        self.assertEqual(scene.positions, starfocus.view_positions(5))
        self.assertEqual((scene.format, scene.coverage, scene.widest_f_stop), ("light-field folder", None, None))
        self.assertEqual((scene.views[0].dtype, scene.disparity.dtype), (np.uint8, np.float32))
        some = starfocus.read_light_field(str(FOLDER), views=np.array([(0, 0), (0, 1)]))
        np.testing.assert_array_equal(some.views, [VIEWS[0], VIEWS[3]])
        self.assertEqual(some.positions, [(0, 0), (0, 1)])
        self.assertEqual(len(starfocus.read_light_field(FOLDER, views=1, threads=2).views), 1)

    def test_a_photo_with_depth(self):
        subprocess.run([PROGRAM, "refocus", FOLDER, "-o", "-photo.jpg", "--aperture", "0.01", "--focus", "1",
                        "--depth-photo"], check=True, stdout=subprocess.DEVNULL)
        given = starfocus.read_light_field(Path("-photo.jpg"))
        self.assertEqual((given.positions, given.widest_f_stop), ([(0, 0)], 1))
        self.assertIn("map", given.facts)
        self.assertEqual(given.disparity.shape, DISPARITY.shape)

    def test_a_picture_with_depth_and_coverage(self):
        Image.fromarray(VIEWS[0]).save("photo.png")
        noisy = (DISPARITY + np.random.default_rng(1).normal(0, 1, DISPARITY.shape)).astype(np.float32)
        np.save("noisy.npy", noisy)
        repaired = starfocus.read_light_field("photo.png", depth="noisy.npy", depth_unit="disparity", repair=True)
        self.assertLess(np.abs(repaired.disparity - DISPARITY).mean(), np.abs(noisy - DISPARITY).mean() / 2)
        np.save("depth.npy", DISPARITY)
        coverage = np.arange(DISPARITY.size, dtype=np.uint8).reshape(DISPARITY.shape)
        Image.fromarray(coverage).save("coverage.png")
        scene = starfocus.read_light_field("photo.png", depth="depth.npy", coverage="coverage.png", depth_unit="disparity",
                                           no_repair=True)
        np.testing.assert_array_equal(scene.views, VIEWS[:1])
        np.testing.assert_array_equal(scene.disparity, DISPARITY)
        np.testing.assert_array_equal(scene.coverage, coverage)

    def test_a_picture_and_its_matte(self):
        Image.fromarray(VIEWS[0]).save("photo.png")
        matte = np.zeros(DISPARITY.shape, np.uint8)
        matte[40:, 80:200] = 255
        matte[40:, 200:204] = 100
        Image.fromarray(matte).save("matte.png")
        given = starfocus.read_light_field("photo.png", matte="matte.png")
        np.testing.assert_array_equal(given.coverage, matte)
        self.assertEqual(given.disparity.min(), 0)
        np.testing.assert_array_equal(given.disparity > 0, matte >= 128)
        cutout = np.dstack([VIEWS[0], matte])
        for name, array in (("bytes", matte), ("words", np.uint16(matte) * 257), ("floats", np.float32(matte) / 255),
                            ("doubles", matte / 255), ("cutout", cutout), ("flipped", matte[::-1].copy()[::-1]),
                            ("list", (matte / 255).tolist()), ("picture", Image.fromarray(matte)), ("axis", matte[..., None]),
                            ("batch", matte[None]), ("tensor", Tensor(matte)), ("masked", np.ma.masked_equal(np.where(matte, matte, 7), 7))):
            with self.subTest(name):
                same = starfocus.read_light_field("photo.png", matte=array)
                np.testing.assert_array_equal(same.coverage, matte)
                np.testing.assert_array_equal(same.disparity, given.disparity)
        hard = starfocus.read_light_field("photo.png", matte=matte == 255)
        np.testing.assert_array_equal(hard.coverage, np.where(matte == 255, 255, 0))
        floor = starfocus.read_light_field("photo.png", matte=matte, floor=True).disparity
        self.assertGreater(floor[-1].min(), 0.97 * given.disparity.max())
        self.assertEqual(floor[0].max(), 0)
        command = starfocus.read_light_field("photo.png", matte_command="cp matte.png {output} && test -s {input}")
        np.testing.assert_array_equal(command.coverage, matte)
        for wrong, message in ((VIEWS[0], "^matte: expected an array of shape .* found shape .240, 320, 3.$"),
                               (np.zeros_like(matte), "^matte.npy: expected a matte with a subject, .* empty matte"),
                               (matte[:, :99], "expected a matte with the proportions of the picture")):
            with self.assertRaisesRegex(ValueError, message):
                starfocus.read_light_field("photo.png", matte=wrong)

    def test_a_matte_beside_depth(self):
        Image.fromarray(VIEWS[0]).save("photo.png")
        matte = np.where(DISPARITY > np.median(DISPARITY), 200, 0).astype(np.uint8)
        depth = np.ma.array(DISPARITY, mask=np.indices(DISPARITY.shape)[0] < 2)
        with self.assertWarnsRegex(UserWarning, "pixels of the depth map are unknown"):
            scene = starfocus.read_light_field("photo.png", depth=depth, depth_unit="disparity", matte=matte,
                                               no_repair=True)
        np.testing.assert_array_equal(scene.disparity[2:], DISPARITY[2:])
        self.assertEqual((scene.coverage.dtype, scene.coverage.shape), (np.uint8, matte.shape))

    def test_a_depth_map_in_tiff(self):
        Image.fromarray(VIEWS[0]).save("photo.png")
        Image.fromarray(DISPARITY).save("depth.tiff")
        options = {"depth": Path("depth.tiff"), "depth_unit": "disparity", "no_repair": True}
        if sys.argv[3:] == ["no-tiff"]:
            with self.assertRaisesRegex(reader.InputError, "TIFF is not supported"):
                starfocus.read_light_field("photo.png", **options)
        else:
            np.testing.assert_array_equal(starfocus.read_light_field("photo.png", **options).disparity, DISPARITY)

    def test_a_stereo_photo_without_a_map(self):
        Image.fromarray(VIEWS[0]).save("pair.mpo", save_all=True, append_images=[Image.fromarray(VIEWS[1])])
        scene = starfocus.read_light_field("pair.mpo")
        self.assertEqual((len(scene.views), scene.disparity), (2, None))
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            estimated = starfocus.read_light_field("pair.mpo", estimate=True)
        self.assertLess(np.median(np.abs(estimated.disparity - DISPARITY)), 1)

    def test_notes_are_warnings(self):
        with self.assertWarnsRegex(UserWarning, "not run, because the input has depth"):
            with self.assertRaisesRegex(starfocus.InputError, "^[^\n]*: expected 17 views, found no [^\n]*$"):
                starfocus.read_light_field(FOLDER, depth_command="false {input} {output}", views=17)

    def test_wrong_inputs_and_options(self):
        os.mkdir("one")
        Image.fromarray(VIEWS[0]).save("one/view_+0.0_+0.0.png")
        for path, options, message in (("missing.jpg", {}, "^cannot read missing.jpg: no such file"),
                                       (FOLDER, {"views": 3}, "--views: expected "),
                                       (FOLDER, {"near": "grey"}, "--near: expected "),
                                       (FOLDER, {"no_such": 1}, "--no-such: expected an option"),
                                       ("one", {"estimate": True}, "single view")):
            with self.assertRaisesRegex(starfocus.InputError, message):
                starfocus.read_light_field(path, **options)
        with mock.patch.object(reader, "_PROGRAM", Path("absent")), self.assertRaisesRegex(RuntimeError, "built without it"):
            starfocus.read_light_field(FOLDER)

    def test_maps_of_either_byte_order(self):
        values = np.arange(6, dtype=np.float32).reshape(2, 3)
        for kind, scale in (("<f4", "-1.0"), (">f4", "1.0")):
            Path("map.pfm").write_bytes(f"Pf # a comment\n#\n3\t2\n{scale}\n".encode() + values[::-1].astype(kind).tobytes())
            np.testing.assert_array_equal(starfocus.read_pfm("map.pfm"), values)
        header = "^map.pfm: expected the header of a PFM with one channel, found b"
        for content, message in (
                (b"", header), (b"PF\n3 2\n-1.0\n", header), (b"Pf\n3 2\n-1.0", header), (b"Pf\n0 2\n-1.0\n", header),
                (b"Pf\n3 2\nnan\n", header), (b"Pf\n3 1234567890\n-1.0\n", header), (b"Pf # a comment", header),
                (b"Pf\n3 2\n-1.0\n" + bytes(23), "expected 24 bytes of values, found 23"),
                (b"Pf 123456789 123456789 -1.0\n", "expected 60966315000762084 bytes of values, found 0")):
            Path("map.pfm").write_bytes(content)
            with self.subTest(content), self.assertRaisesRegex(ValueError, message):
                starfocus.read_pfm("map.pfm")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
