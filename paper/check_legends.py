#!/usr/bin/python3
"""Looks for every sample of a legend in the pictures in PNG:  check_legends.py LEGENDS

gnuplot leaves out, without a word, entries for which a legend has no room, and letters are not as wide in PNG as in SVG.
Each line of LEGENDS has a file, a part of the picture (left, top, right, bottom, in points) that holds a legend, and the
colours of its samples.
"""

import sys

from PIL import Image

# Pixels to a point.
SCALE = 2
# The smallest part of a colour in a pixel at the edge of a line, and how far, of 255, such a pixel may be from the mix.
LEAST_PART, MOST_OFF = 0.5, 16


def holds(pixels, colour):
    """Whether a pixel has the colour, or a mix of it with much less white."""
    dark = [255 - value for value in colour]
    square = sum(value * value for value in dark)
    for pixel in pixels:
        seen = [255 - value for value in pixel]
        part = sum(a * b for a, b in zip(dark, seen)) / square
        if part > LEAST_PART and all(abs(b - part * a) < MOST_OFF for a, b in zip(dark, seen)):
            return True
    return False


opened = {}
for line in open(sys.argv[1], encoding="utf-8"):
    path, *box, colours = line.rstrip("\n").split("\t")
    if path not in opened:
        opened = {path: Image.open(path).convert("RGB")}
    picture = opened[path]
    left, top, right, bottom = (SCALE * int(value) for value in box)
    part = picture.crop((max(left, 0), max(top, 0), min(right, picture.width), min(bottom, picture.height)))
    pixels = {pixel for _, pixel in part.getcolors(part.width * part.height)}
    for colour in colours.split():
        if not holds(pixels, bytes.fromhex(colour)):
            sys.exit(f"paper: the legend of {path} does not name what is drawn in #{colour}.")
