# SPDX-License-Identifier: Apache-2.0
"""The images of `geoloc_sim --images` as a detector sees them, after a video link, with everything in view."""

import csv
from collections import defaultdict
from dataclasses import dataclass
from pathlib import Path

import cv2
import numpy as np
from tqdm import tqdm

from codec import Film

INPUT_WIDTH = 1280  # of the network
INPUT_HEIGHT = 736
FILL = 114  # grey of the letterbox' bars
LEAST_VISIBLE = 0.5  # of a target that must be found
STEEPEST_DEG = 60.0  # from the vertical; targets seen at flatter angles are training data, but need not be found
LEAST_LEGIBLE = 0.5  # correlation of a target's appearance with that in an ideal camera
LEGIBLE_IN = 1.2  # boxes around it
LEAST_SIDE_PX = 8.0  # of its box; smaller ones are neither taught nor held against the network


@dataclass
class Example:
    image: np.ndarray  # height x width x 3, RGB, 8 bits
    targets: np.ndarray  # K x 4, float32: centre x, y, width, height [px]
    is_taught: np.ndarray  # K: is training data; the others are neither right nor wrong
    visible: np.ndarray  # K: share of the target that is in the picture and uncovered
    tilt_deg: np.ndarray  # K: of the line of sight from the vertical
    legible: np.ndarray  # K: correlation with its appearance in an ideal camera; 1 if that is not known
    look_alikes: np.ndarray  # M x 4, as the targets
    kinds: list[str]  # M: what they are

    @property
    def is_demanded(self) -> np.ndarray:
        """K: must be found; the others are neither required nor counted."""
        return self.is_taught & (self.tilt_deg <= STEEPEST_DEG) & (self.legible >= LEAST_LEGIBLE)


def letterbox(image: np.ndarray, input_width: int, input_height: int) -> tuple[np.ndarray, float, int, int]:
    """The image in the middle of the network's input; its scale and the position of its corner there."""
    height, width = image.shape[:2]
    scale = min(input_width / width, input_height / height)
    size = (round(width * scale), round(height * scale))
    left, top = (input_width - size[0]) // 2, (input_height - size[1]) // 2
    boxed = np.full((input_height, input_width, 3), FILL, np.uint8)
    boxed[top : top + size[1], left : left + size[0]] = cv2.resize(
        image, size, interpolation=cv2.INTER_LINEAR
    )
    return boxed, scale, left, top


def filmed(folder: Path, names: list[str]) -> np.ndarray:
    """All images [N, H, W, 3], mapped from a file that is made on the first call, so that they need not fit in memory."""
    cache = folder / "pictures.npy"
    if not cache.exists():
        first = cv2.imread(str(folder / "images" / f"{names[0]}.jpg"))
        part = cache.with_suffix(".partial")
        pictures = np.lib.format.open_memmap(part, "w+", np.uint8, (len(names), *first.shape))
        film = Film(0, *first.shape[:2])
        for index, name in enumerate(tqdm(names, desc=f"filming {folder}", unit="picture", mininterval=2.0)):
            picture = cv2.imread(str(folder / "images" / f"{name}.jpg"))
            pictures[index] = film.through(cv2.cvtColor(picture, cv2.COLOR_BGR2RGB))
        pictures.flush()
        part.replace(cache)
    return np.load(cache, mmap_mode="r")


def example_of(image: np.ndarray, crisp: np.ndarray | None, rows: list[dict[str, str]]) -> Example:
    columns = ("centre_x_px", "centre_y_px", "width_px", "height_px", "visible_fraction", "tilt_deg")
    values = np.array([[float(row[name]) for name in columns] for row in rows], np.float32).reshape(-1, 6)
    is_target = np.array([row["kind"] == "target" for row in rows], bool)
    targets = values[is_target]
    return Example(
        image,
        targets[:, :4],
        taught(targets[:, :4], targets[:, 4], image.shape[1], image.shape[0]),
        targets[:, 4],
        targets[:, 5],
        np.ones(len(targets)) if crisp is None else legibility(image, crisp, targets[:, :4]),
        values[~is_target, :4],
        [row["kind"] for row in rows if row["kind"] != "target"],
    )


def legibility(image: np.ndarray, crisp: np.ndarray, targets: np.ndarray) -> np.ndarray:
    """Correlation of brightness with the crisp picture [H, W], around each target [K, 4]: -1 to 1."""
    grey = cv2.cvtColor(np.ascontiguousarray(image), cv2.COLOR_RGB2GRAY)
    reach = 0.5 * LEGIBLE_IN * targets[:, 2:]
    low = np.floor(targets[:, :2] - reach).clip(0, (grey.shape[1] - 1, grey.shape[0] - 1)).astype(int)
    high = np.ceil(targets[:, :2] + reach).clip(low + 1, (grey.shape[1], grey.shape[0])).astype(int)
    values = []
    for (left, top), (right, bottom) in zip(low, high):
        shown, there = (picture[top:bottom, left:right].ravel().astype(float) for picture in (grey, crisp))
        spread = shown.std() * there.std()
        values.append(np.mean((shown - shown.mean()) * (there - there.mean())) / spread if spread > 0 else 0.0)
    return np.array(values)


def taught(targets: np.ndarray, visible: np.ndarray, width: int, height: int) -> np.ndarray:
    inside = ((targets[:, :2] >= 0) & (targets[:, :2] < (width, height))).all(1)
    return inside & (visible >= LEAST_VISIBLE) & (targets[:, 2:].min(1) >= LEAST_SIDE_PX)


def crisp_picture(folder: Path, name: str) -> np.ndarray | None:
    """In grey; None where the folder was made without --crisp."""
    file = folder / "crisp" / f"{name}.png"
    return cv2.imread(str(file), cv2.IMREAD_GRAYSCALE) if file.exists() else None


def load(folder: Path, with_legibility: bool = True) -> list[Example]:
    """with_legibility: determines which targets are legible, which takes as long as reading the crisp images."""
    names = sorted(file.stem for file in (folder / "images").glob("*.jpg"))
    if not names:
        raise SystemExit(f"{folder}: no images/*.jpg; make them with geoloc_sim --images N --out {folder}")
    rows = defaultdict(list)
    with open(folder / "objects.csv", newline="", encoding="utf-8") as file:
        for row in csv.DictReader(file):
            rows[row["picture"]].append(row)
    return [
        example_of(image, crisp_picture(folder, name) if with_legibility else None, rows[name])
        for image, name in zip(filmed(folder, names), names)
    ]
