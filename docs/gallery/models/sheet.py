#!/usr/bin/env python3
"""Pictures side by side as one, for pages of the gallery: a scene of cards, rendered with slrender.

Pictures are linear; the sheet is for the screen (gamma 2.2, 8 bits)."""
import argparse
import pathlib
import subprocess
import sys


def card(picture, left, top, right, bottom):
    return (f'Surface "picture" "string texturename" ["{picture}"]\n'
            f'Polygon "P" [ {left} {top} 1  {right} {top} 1  {right} {bottom} 1  {left} {bottom} 1 ] "st" [ 0 0  1 0  1 1  0 1 ]\n')


def sheet(out, pictures, columns, width, height, gap, exposure, quality):
    rows = -(-len(pictures) // columns)
    full = (columns * (width + gap) - gap, rows * (height + gap) - gap)
    text = (f'Display "{out}" "file" "rgb" "string compression" ["jpeg:{quality}"]\nFormat {full[0]} {full[1]} 1\n'
            f'ScreenWindow 0 {full[0]} {-full[1]} 0\nProjection "orthographic"\n'
            'PixelSamples 1 1\nPixelFilter "box" 1 1\nHider "hidden" "int jitter" 0\nShadingRate 0.25\n'
            f'ShadingInterpolation "constant"\nExposure {exposure} 2.2\nImager "background" "color bgcolor" [0.01 0.01 0.012]\nWorldBegin\n')
    for i, picture in enumerate(pictures):
        x, y = i % columns * (width + gap), -(i // columns) * (height + gap)
        text += card(picture, x, y, x + width, y - height)
    return text + "WorldEnd\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("pictures", nargs="+")
    parser.add_argument("--out", required=True)
    parser.add_argument("--columns", type=int, default=2)
    parser.add_argument("--size", type=int, nargs=2, required=True, metavar=("WIDTH", "HEIGHT"), help="of each picture")
    parser.add_argument("--gap", type=int, default=4, help="pixels between pictures")
    parser.add_argument("--exposure", type=float, default=1)
    parser.add_argument("--quality", type=int, default=86, help="of the JPEG file, 1 to 100")
    given = parser.parse_args()
    text = sheet(given.out, given.pictures, given.columns, *given.size, given.gap, given.exposure, given.quality)
    here = pathlib.Path(__file__).resolve().parent
    return subprocess.run(["slrender", "--shaders", f"{here}:@", "-"], input=text, text=True, check=False).returncode


if __name__ == "__main__":
    sys.exit(main())
