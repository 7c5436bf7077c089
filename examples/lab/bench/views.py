# SPDX-License-Identifier: Apache-2.0
"""Compares sets of views with the star of five views: PSNR in dB, as rows of docs/constants.md.

usage: views.py PROGRAM FOLDER...

The folders have 17 views and truths; `starfocus-lab scene DIR --truth=D,1 --transfer none` creates them. For each
truth the script prints a row for whole pictures, and a row for each pair of views. The row of a pair covers the pixels
that change if the star lacks the side view of the pair. In these pixels that view looks behind an edge.
"""
import math
import re
import subprocess
import sys
import tempfile
from pathlib import Path

SIDES = ("1,0", "-1,0", "0,1", "0,-1")
SETS = {"one": "1", "pair": "0,0:1,0", "other pair": "0,0:-1,0", "three in a row": "0,0:1,0:-1,0",
        "an L": "0,0:1,0:0,1", "five in a row": "0,0:-1,0:-0.5,0:0.5,0:1,0", "star of 5": "5", "star of 17": "17"}


def read(path):
    """Reads a binary PPM without comments. Returns its width and its samples."""
    data = path.read_bytes()
    width, height = (int(word) for word in data.split(None, 3)[1:3])
    return width, data[len(data) - 3 * width * height:]


def decibels(picture, truth, pixels):
    """Returns the PSNR in dB over the given pixels."""
    error = sum((picture[i] - truth[i]) ** 2 for pixel in pixels for i in range(3 * pixel, 3 * pixel + 3))
    return 10 * math.log10(255 ** 2 * 3 * len(pixels) / error)


class Scene:
    """A light-field folder and one of its truths."""

    def __init__(self, program, truth, work):
        self.program, self.folder, self.out = program, truth.parent, work / "out.ppm"
        self.focus = re.fullmatch(r"truth_dt(.*)_ut1", truth.stem).group(1)
        self.width, _ = read(self.refocused("1"))
        self.call("-lab", "sheet", truth, "-o", self.out)
        wide, samples = read(self.out)
        margin = (wide - self.width) // 2  # margin of the sheet on all sides of the picture
        rows = len(samples) // (3 * wide)
        self.truth = b"".join(samples[3 * (wide * y + margin):3 * (wide * y + margin + self.width)]
                              for y in range(margin, rows - margin))

    def call(self, suffix, *arguments):
        """Runs the program whose name has this suffix: "" for starfocus, or "-lab" for starfocus-lab."""
        subprocess.run([self.program + suffix, *arguments], check=True, stdout=subprocess.DEVNULL)

    def refocused(self, views):
        """Refocuses with these views. Returns the path of the picture, which the next call overwrites."""
        self.call("", "refocus", self.folder, "-o", self.out, f"--focus={self.focus}", "--transfer", "none",
                  "--views", views)
        return self.out

    def print_rows(self):
        """Prints the row for whole pictures, and the row for each pair."""
        pictures = {name: read(self.refocused(views))[1] for name, views in SETS.items()}
        every = range(len(self.truth) // 3)
        whole = [f"{decibels(picture, self.truth, every):.2f}" for picture in pictures.values()]
        print(f"| {self.folder.name}, {self.focus} |", " | ".join(whole), "|", flush=True)
        for name, side in (("pair", "1,0"), ("other pair", "-1,0")):
            others = ":".join(["0,0"] + [other for other in SIDES if other != side])
            without, five = read(self.refocused(others))[1], pictures["star of 5"]
            pixels = [k for k in every if five[3 * k:3 * k + 3] != without[3 * k:3 * k + 3]]
            one, pair, star = (decibels(pictures[which], self.truth, pixels) for which in ("one", name, "star of 5"))
            share, gain = 100 * len(pixels) / len(every), (pair - one) / (star - one)
            print(f"|   {name}, {share:.1f} % of the pixels | {one:.2f} | {pair:.2f} | {star:.2f} | {gain:.2f} |",
                  flush=True)


def main():
    """Prints the rows of all folders."""
    print("| |", " | ".join(SETS), "|")
    with tempfile.TemporaryDirectory() as work:
        for folder in sys.argv[2:]:
            for truth in sorted(Path(folder).glob("truth_dt*_ut1.png")):
                Scene(sys.argv[1], truth, Path(work)).print_rows()


if __name__ == "__main__":
    main()
