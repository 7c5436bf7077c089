# SPDX-License-Identifier: Apache-2.0
"""Runs the commands of the gallery, and writes the gallery's pictures.

usage: gallery.py GALLERY.md FOLDER

Each code block of the document is run by bash in FOLDER, and writes one page with `--compare NAME.html`. The pictures
of this page are written to NAME-before.jpg and NAME-after.jpg. The slider of the page without its pictures is written
to NAME.slider, and the style and the script of all sliders to slider.css and slider.js.
"""

import base64
import pathlib
import re
import subprocess
import sys


def split(page, folder, name):
    """Writes the pictures, the slider, the style and the script of one page of `--compare`."""
    slider = re.search(r'<div class="slider".*?<div class="divider"></div>\n</div>\n', page, re.S).group()
    for part in ('before', 'after'):
        data = re.search(r'src="data:image/jpeg;base64,([^"]*)"', slider)
        (folder / f'{name}-{part}.jpg').write_bytes(base64.b64decode(data.group(1)))
        slider = slider.replace(data.group(), f'loading="lazy" src="gallery/{name}-{part}.jpg"')
    (folder / f'{name}.slider').write_text(slider)
    style = re.search(r'<style>(.*?)</style>', page, re.S).group(1)
    rules = re.findall(r'^\.(?:slider|tag|divider).*\n', style, re.M)
    (folder / 'slider.css').write_text(''.join(rules))
    (folder / 'slider.js').write_text(re.search(r'<script>(.*?)</script>', page, re.S).group(1))


def main():
    document, folder = map(pathlib.Path, sys.argv[1:])
    for block in re.findall(r'^```\n(.*?)^```$', document.read_text(), re.M | re.S):
        subprocess.run(['bash', '-euc', block], cwd=folder, check=True)
        names = re.findall(r'--compare (\w+)\.html', block)
        if len(names) != 1:
            sys.exit(f'{document}: expected one --compare NAME.html in a block, found {len(names)}:\n{block}')
        split((folder / f'{names[0]}.html').read_text(), folder, names[0])


main()
