# SPDX-License-Identifier: Apache-2.0
"""Decodes an Ultra HDR JPEG file independently of starfocus, for ultra_hdr_test.cc.

usage: ultra_hdr.py FILE OUT

Finds the gain map through the multi-picture index, reads its XMP and its metadata of ISO 21496-1,
which must agree, and writes the light to OUT: 32-bit floats R, G and B of each pixel in the byte
order of the machine. Prints the size. Needs Pillow and NumPy.
"""
import io
import re
import struct
import sys

import numpy as np
from PIL import Image


def segments(jpeg):
    """Yields the marker, the content and the position of the content of each segment."""
    at = 2
    while jpeg[at] == 0xFF and jpeg[at + 1] != 0xDA:
        size = struct.unpack_from(">H", jpeg, at + 2)[0]
        yield jpeg[at + 1], jpeg[at + 4:at + 2 + size], at + 4
        at += 2 + size


def content(jpeg, marker, name):
    """Returns the content behind `name` of the only such segment, and its position."""
    found = [(text[len(name):], at + len(name)) for its, text, at in segments(jpeg)
             if its == marker and text.startswith(name)]
    assert len(found) == 1, f"{len(found)} segments {name}"
    return found[0]


def second_picture(file):
    index, base = content(file, 0xE2, b"MPF\0")
    order = {b"MM\0*": ">", b"II*\0": "<"}[index[:4]]
    directory = struct.unpack_from(order + "I", index, 4)[0]
    tags = {}
    for k in range(struct.unpack_from(order + "H", index, directory)[0]):
        tag, _, count, value = struct.unpack_from(order + "HHII", index, directory + 2 + 12 * k)
        tags[tag] = count, value
    assert tags[0xB001][1] == 2
    count, entries = tags[0xB002]
    assert count == 32
    _, size, offset = struct.unpack_from(order + "III", index, entries)
    assert offset == 0 and file[size - 2:size] == b"\xff\xd9", "the first picture"
    _, size, offset = struct.unpack_from(order + "III", index, entries + 16)
    picture = file[base + offset:base + offset + size]
    assert picture[:2] == b"\xff\xd8" and picture[-2:] == b"\xff\xd9", "the second picture"
    return picture


XMP = b"http://ns.adobe.com/xap/1.0/\0"
ISO = b"urn:iso:std:iso:ts:21496:-1\0"


def of_xmp(picture):
    xmp = content(picture, 0xE1, XMP)[0].decode()
    values = {"GainMapMin": 0, "Gamma": 1, "OffsetSDR": 1 / 64, "OffsetHDR": 1 / 64,
              "HDRCapacityMin": 0}
    for name in list(values) + ["GainMapMax", "HDRCapacityMax"]:
        single = re.search(f'hdrgm:{name}="([^"]*)"', xmp)
        several = re.search(f"<hdrgm:{name}>(.*?)</hdrgm:{name}>", xmp, re.S)
        if single:
            values[name] = float(single[1])
        elif several:
            values[name] = [float(x) for x in re.findall("<rdf:li>([^<]*)</rdf:li>", several[1])]
    return {name: np.broadcast_to(value, 3) for name, value in values.items()}


def of_iso(picture):
    data = content(picture, 0xE2, ISO)[0]
    version, _, flags = struct.unpack_from(">HHB", data)
    assert version == 0 and flags & 0x40 and not flags & 0x3F
    channels = 3 if flags & 0x80 else 1
    numbers = np.frombuffer(data[5:], ">i4").reshape(-1, 2)
    numbers = numbers[:, 0] / numbers[:, 1]
    assert len(numbers) == 2 + 5 * channels
    names = "GainMapMin", "GainMapMax", "Gamma", "OffsetSDR", "OffsetHDR"
    values = dict(zip(names, np.broadcast_to(numbers[2:].reshape(channels, 5).T, (5, 3))
                      if channels == 1 else numbers[2:].reshape(3, 5).T))
    values["HDRCapacityMin"], values["HDRCapacityMax"] = np.repeat(numbers[:2, None], 3, 1)
    return values


def enlarge(levels, count, axis):
    """Enlarges bilinearly; the centres of the outermost levels and beyond have their values."""
    old = levels.shape[axis]
    at = np.clip((np.arange(count) + 0.5) * old / count - 0.5, 0, old - 1)
    low = np.floor(at).astype(int)
    share = (at - low).reshape([-1 if k == axis else 1 for k in range(3)])
    return (np.take(levels, low, axis) * (1 - share) +
            np.take(levels, np.minimum(low + 1, old - 1), axis) * share)


def main(path, out):
    file = open(path, "rb").read()
    assert content(file, 0xE2, ISO)[0] == bytes(4)
    picture = second_picture(file)
    directory = content(file, 0xE1, XMP)[0].decode()
    assert 'hdrgm:Version="1.0"' in directory
    assert re.findall('Item:Semantic="([^"]*)"', directory) == ["Primary", "GainMap"]
    assert int(re.search('Item:Length="([0-9]*)"', directory)[1]) == len(picture)
    values = of_xmp(picture)
    for name, value in of_iso(picture).items():
        assert np.allclose(value, values[name], atol=1e-6), name
    base = np.asarray(Image.open(io.BytesIO(file)).convert("RGB")) / 255
    light = np.where(base <= 0.04045, base / 12.92, ((base + 0.055) / 1.055) ** 2.4)
    levels = np.asarray(Image.open(io.BytesIO(picture))) / 255
    levels = levels.reshape(*levels.shape[:2], -1)
    for axis in 0, 1:
        levels = enlarge(levels, base.shape[axis], axis)
    stops = (values["GainMapMin"] +
             (values["GainMapMax"] - values["GainMapMin"]) * levels ** (1 / values["Gamma"]))
    light = (light + values["OffsetSDR"]) * 2 ** stops - values["OffsetHDR"]
    np.maximum(light, 0).astype("f4").tofile(out)
    print(f"{base.shape[1]}x{base.shape[0]}")


main(*sys.argv[1:])
