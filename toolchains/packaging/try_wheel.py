# SPDX-License-Identifier: Apache-2.0
"""usage: try_wheel.py FIELD PICTURE

Refocuses the light field FIELD at the disparity 2 and the aperture 0.5 with the installed package and with the program
in the package. The package must produce the pixels of the PNG file PICTURE, and the program the bytes of this file.
"""
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy
from PIL import Image

import starfocus

field, expected = sys.argv[1:]
scene = starfocus.read_light_field(field)
refocuser = starfocus.Refocuser.for_light_field(scene.views, scene.disparity)
picture = refocuser.refocus(scene.views, scene.disparity, focus=2, aperture=0.5)
if not numpy.array_equal(picture, numpy.asarray(Image.open(expected))):
    sys.exit(f"try_wheel: the package produced other pixels than {expected}")
with tempfile.TemporaryDirectory() as work:
    own = Path(work) / "own.png"
    program = Path(starfocus.__file__).parent / "bin/starfocus"
    subprocess.run([program, "refocus", field, "-o", own, "--focus", "2", "--aperture", "0.5"], check=True)
    if own.read_bytes() != Path(expected).read_bytes():
        sys.exit(f"try_wheel: the program wrote other bytes than {expected}")
print(f"starfocus {starfocus.__version__}, numpy {numpy.__version__}, Python {sys.version.split()[0]}")
