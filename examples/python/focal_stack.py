# SPDX-License-Identifier: Apache-2.0
"""A tour of starfocus for researchers: focal_stack.py [FOLDER] [OUTPUT].

FOLDER is a light field, for example a folder that `./do demo` has written. Plots are written to OUTPUT. Editors that
support cells (# %%) can run the script cell by cell.
"""
# %% Read a light field: views as uint8 of shape (height, width, 3), and the disparity map of the first view as float32.
import sys
import time
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

import starfocus

folder = Path(sys.argv[1] if len(sys.argv) > 1 else "demo/portrait")
output = Path(sys.argv[2] if len(sys.argv) > 2 else "plots")
output.mkdir(parents=True, exist_ok=True)
scene = starfocus.read_light_field(folder)
views, disparity = scene.views, scene.disparity
height, width = disparity.shape
print(f"{len(views)} views of {width} x {height}, disparities {disparity.min():.2f} to {disparity.max():.2f}, "
      f"starfocus {starfocus.__version__} on {starfocus.simd_target()}")

# %% Create one engine for all pictures. `prepare` computes the data that do not depend on the focus once for all
# pictures.
refocuser = starfocus.Refocuser.for_light_field(views, disparity)
prepared = refocuser.prepare(views, disparity)
foci = np.linspace(disparity.max(), disparity.min(), 3)
stack = [prepared.refocus(focus=focus) for focus in foci]

figure, axes = plt.subplots(1, 4, figsize=(16, 3.6), constrained_layout=True)
shown = axes[0].imshow(disparity, cmap="viridis")
axes[0].set_title("disparity, pixels per unit of u")
figure.colorbar(shown, ax=axes[0], shrink=0.7)
for axis, picture, focus in zip(axes[1:], stack, foci):
    axis.imshow(picture)
    axis.set_title(f"focus {focus:.2f}")
for axis in axes:
    axis.set_axis_off()
figure.savefig(output / "focal_stack.png", dpi=100)


# %% Plot time against error. Errors are relative to the mode `benchmark`, which renders about two views along the
# radius for each pixel of blur radius.
def psnr(picture: np.ndarray, truth: np.ndarray) -> float:
    """Returns the PSNR in decibels over all samples."""
    return 10 * np.log10(255**2 / max(np.mean((picture.astype(float) - truth) ** 2), 1e-9))


apertures = [0.125, 0.25, 0.5, 1.0]
figure, (left, right) = plt.subplots(1, 2, figsize=(11, 4), constrained_layout=True)
for mode in (starfocus.Mode.BLOCK, starfocus.Mode.BLUR, starfocus.Mode.BENCHMARK):
    seconds, errors = [], []
    for aperture in apertures:
        truth = prepared.refocus(focus=foci[0], aperture=aperture, mode=starfocus.Mode.BENCHMARK)
        start = time.perf_counter()
        picture = prepared.refocus(focus=foci[0], aperture=aperture, mode=mode)
        seconds.append(time.perf_counter() - start)
        errors.append(psnr(picture, truth))
    left.plot(apertures, seconds, "o-", label=mode.name.lower())
    if mode is not starfocus.Mode.BENCHMARK:
        right.plot(apertures, errors, "o-", label=mode.name.lower())
left.set(xlabel="aperture", ylabel="seconds", yscale="log", title=f"{refocuser.workers} workers")
right.set(xlabel="aperture", ylabel="PSNR against the benchmark, dB")
left.legend()
right.legend()
figure.savefig(output / "time_and_error.png", dpi=100)

# %% Print statistics of the last refocusing from the engine's report.
report = refocuser.report
print(f"N = {report['n']}, {report['rendered_samples'] / (3 * width * height):.1f} samples per pixel")
