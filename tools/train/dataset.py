# SPDX-License-Identifier: Apache-2.0
"""The labelled pictures of `geoloc_sim --images`, as the detector will see them: letterboxed, RGB."""

from dataclasses import dataclass
from pathlib import Path

import cv2
import numpy as np
from tqdm import tqdm

INPUT_WIDTH = 640  # of the network
INPUT_HEIGHT = 384
FILL = 114  # grey of the letterbox' bars
TARGET_SHARE = 0.6  # of the training crops show a target for certain,
CANDIDATES = 4  # and the others are the one of so many with the most contrast
CROP_SCALES = (0.75, 1.25)  # a crop's side before it is resized, over the side wanted
KEPT_FRACTION = 0.4  # a target cut off more than this is no example


@dataclass
class Example:
    image: np.ndarray  # height x width x 3, RGB, 8 bits
    boxes: np.ndarray  # K x 4, float32: left, top, right, bottom [px]


def letterbox(image: np.ndarray) -> tuple[np.ndarray, float, int, int]:
    """The image in the middle of the network's input; its scale and the position of its corner there."""
    height, width = image.shape[:2]
    scale = min(INPUT_WIDTH / width, INPUT_HEIGHT / height)
    size = (round(width * scale), round(height * scale))
    left, top = (INPUT_WIDTH - size[0]) // 2, (INPUT_HEIGHT - size[1]) // 2
    boxed = np.full((INPUT_HEIGHT, INPUT_WIDTH, 3), FILL, np.uint8)
    boxed[top : top + size[1], left : left + size[0]] = cv2.resize(
        image, size, interpolation=cv2.INTER_LINEAR
    )
    return boxed, scale, left, top


def read_labels(file: Path, width: int, height: int) -> np.ndarray:
    rows = [[float(value) for value in line.split()[1:]] for line in file.read_text().splitlines()]
    centre_size = np.array(rows, np.float32).reshape(-1, 4) * [width, height, width, height]
    half = 0.5 * centre_size[:, 2:]
    return np.hstack((centre_size[:, :2] - half, centre_size[:, :2] + half)).astype(np.float32)


def load(folder: Path) -> list[Example]:
    files = sorted((folder / "images").glob("*.jpg"))
    if not files:
        raise SystemExit(f"{folder}: no images/*.jpg; make them with geoloc_sim --images N --out {folder}")
    examples = []
    for file in tqdm(files, desc=f"reading {folder}", unit="picture", mininterval=2.0):
        picture = cv2.cvtColor(cv2.imread(str(file)), cv2.COLOR_BGR2RGB)
        boxes = read_labels(folder / "labels" / f"{file.stem}.txt", picture.shape[1], picture.shape[0])
        image, scale, left, top = letterbox(picture)
        examples.append(Example(image, boxes * scale + np.float32([left, top, left, top])))
    return examples


def random_window(example: Example, side: int, random: np.random.Generator) -> tuple[int, int]:
    """Left and top of a square of the image: around a target, or where something else stands out, for the
    look-alikes teach more than plain ground."""
    height, width = example.image.shape[:2]
    if len(example.boxes) and random.random() < TARGET_SHARE:
        box = example.boxes[random.integers(len(example.boxes))]
        corner = 0.5 * (box[:2] + box[2:]) + random.uniform(-0.5, 0.5, 2) * side - 0.5 * side
        return int(np.clip(corner[0], 0, width - side)), int(np.clip(corner[1], 0, height - side))
    candidates = random.integers((0, 0), (width - side + 1, height - side + 1), (CANDIDATES, 2))
    contrast = [
        example.image[top : top + side : 3, left : left + side : 3, 1].std() for left, top in candidates
    ]
    left, top = candidates[int(np.argmax(contrast))]
    return int(left), int(top)


def random_crop(example: Example, size: int, random: np.random.Generator) -> Example:
    """A square of size px out of the example, at a random scale."""
    side = int(round(size * random.uniform(*CROP_SCALES)))
    left, top = random_window(example, side, random)
    crop = example.image[top : top + side, left : left + side]
    resized = cv2.resize(
        crop, (size, size), interpolation=cv2.INTER_AREA if side > size else cv2.INTER_LINEAR
    )
    boxes = (example.boxes - np.float32([left, top, left, top])) * np.float32(size / side)
    return Example(resized, clipped(boxes, size))


def clipped(boxes: np.ndarray, size: int) -> np.ndarray:
    inside = boxes.clip(0, size)
    area = np.prod(boxes[:, 2:] - boxes[:, :2], axis=1)
    kept = np.prod(inside[:, 2:] - inside[:, :2], axis=1) >= KEPT_FRACTION * area
    return inside[kept]


def flipped(example: Example, random: np.random.Generator) -> Example:
    """One of the eight ways to lay a square."""
    image, boxes, size = example.image, example.boxes, example.image.shape[0]
    if random.random() < 0.5:
        image, boxes = image[:, ::-1], np.stack(
            (size - boxes[:, 2], boxes[:, 1], size - boxes[:, 0], boxes[:, 3]), 1
        )
    if random.random() < 0.5:
        image, boxes = image[::-1], np.stack(
            (boxes[:, 0], size - boxes[:, 3], boxes[:, 2], size - boxes[:, 1]), 1
        )
    if random.random() < 0.5:
        image, boxes = image.transpose(1, 0, 2), boxes[:, [1, 0, 3, 2]]
    return Example(image, boxes)


def relit(image: np.ndarray, random: np.random.Generator) -> np.ndarray:
    gain = random.uniform(0.7, 1.3) * random.uniform(0.93, 1.07, 3)
    return np.clip(image * gain + random.uniform(-20, 20), 0, 255)


def training_batch(
    examples: list[Example], size: int, random: np.random.Generator
) -> tuple[np.ndarray, list[np.ndarray]]:
    """Crops as images [B, 3, size, size] in 0..1 and their boxes."""
    crops = [flipped(random_crop(example, size, random), random) for example in examples]
    images = np.stack([relit(crop.image, random) for crop in crops]).astype(np.float32) / 255.0
    return np.ascontiguousarray(images.transpose(0, 3, 1, 2)), [
        crop.boxes.astype(np.float32) for crop in crops
    ]
