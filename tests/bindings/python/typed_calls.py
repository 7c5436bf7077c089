# SPDX-License-Identifier: Apache-2.0
"""Calls of the package that mypy must accept in its strict mode. The file is not run."""
from pathlib import Path
from typing import Iterator, List, Tuple

import numpy as np
from numpy.typing import NDArray

import starfocus

scene: starfocus.LightField = starfocus.read_light_field(Path("photo.png"), depth="depth.npy", threads=2)
scene = starfocus.read_light_field(b"photo.png", depth=Path("depth.npy"))
scene = starfocus.read_light_field("photo.png", matte=np.zeros((480, 640), np.uint8), floor=True)
starfocus.read_light_field("photo.png", matte=[[0, 255], [0, 255]])
assert scene.disparity is not None
disparity: NDArray[np.float32] = scene.disparity
refocuser = starfocus.Refocuser.for_light_field(scene.views, disparity, positions=scene.positions, streaming=1)
picture: NDArray[np.uint8] = refocuser.refocus(scene.views, disparity, focus=1, blades=5, shape=starfocus.Shape.POLYGON)
image: starfocus.Image = starfocus.Image.empty(starfocus.Format.NV12, 640, 480)
image = refocuser.refocus(scene.views, starfocus.DepthMap(disparity), focus=1, out=image)
refocuser = starfocus.Refocuser.for_light_field(picture, starfocus.DepthMap(disparity))
light: NDArray[np.float32] = refocuser.refocus([np.zeros((480, 640, 4), np.float32)], disparity, focus=1)
refocuser = starfocus.Refocuser(640, 480, 1, disparity_min=0, disparity_max=1, deep=1, transfer="pq")
codes: NDArray[np.uint16] = refocuser.refocus(np.zeros((480, 640, 3), np.uint16), disparity, focus=1)
image = starfocus.Image(starfocus.Format.RGB16, [codes])
prepared = refocuser.prepare(scene.views, disparity)
picture = prepared.refocus(focus=starfocus.focus_at(disparity, 1, 2), out=picture)
picture = prepared.preview(1, focus=1, region=(0, 0, 2, 2))
estimate: starfocus.DisparityMap = starfocus.estimate_disparity(np.stack(scene.views), -1, 1.5)
field: starfocus.MatteField = starfocus.matte_field(picture[..., 0], 640, 480, 30, ground=0.9)
covered: NDArray[np.uint8] = starfocus.matte_coverage(field.coverage, field.disparity, 640, 480)
place: starfocus.MatteStats = starfocus.measure_matte(field.coverage)
quality: starfocus.Quality = starfocus.evaluate(picture, scene.views[0], estimate.disparity)
bands: List[Tuple[List[NDArray[np.uint8]], NDArray[np.float32]]] = [(scene.views, disparity)]
rows: Iterator[NDArray[np.uint8]] = refocuser.stream(bands, focus=1)
frames: Iterator[NDArray[np.uint8]] = refocuser.frames([(scene.views, disparity, scene.coverage)], focus=1)
