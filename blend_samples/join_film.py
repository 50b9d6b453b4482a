"""Joins pictures into an animation, with Pillow: python3 blend_samples/join_film.py FOLDER OUTPUT.webp"""
import pathlib
import sys

from PIL import Image

WIDTH = 560         # pixels
MILLISECONDS = 70   # of each picture
QUALITY = 55        # per cent


def main(folder: pathlib.Path, output: pathlib.Path) -> None:
    frames = [Image.open(path).convert("RGB") for path in sorted(folder.glob("*.png"))]
    size = (WIDTH, round(frames[0].height * WIDTH / frames[0].width))
    small = [frame.resize(size, Image.LANCZOS) for frame in frames]
    small[0].save(output, save_all=True, append_images=small[1:], duration=MILLISECONDS, loop=0, quality=QUALITY,
                  method=6)


main(pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]))
