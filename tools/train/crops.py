# SPDX-License-Identifier: Apache-2.0
"""Training crops: squares around targets and look-alikes, at random scales, in any orientation and any colours."""

from dataclasses import dataclass
from enum import IntEnum

import cv2
import numpy as np

from dataset import LEAST_SIDE_PX, Example

SCALES = (0.5, 1.33)
SHOWN_TARGET = 0.6  # share of the crops that are certain to show a target,
SHOWN_LOOK_ALIKE = 0.2  # and a look-alike; the others anything
MOSAICS = 0.7  # share of mosaics of four crops, which show four times as many objects at no cost
GAINS = (0.3, 1.8)  # of the exposure: a camera's range is wider than that of the images
CROP_VISIBLE = 0.5  # a target with a smaller part in the crop is neither right nor wrong


class Role(IntEnum):
    """The meaning of a box for the cells under it."""

    UNDECIDED = 0  # a target too small or too much covered to be taught: neither right nor wrong
    TARGET = 1
    LOOK_ALIKE = 2


@dataclass
class Crop:
    image: np.ndarray  # size x size x 3, RGB, 8 bits
    boxes: np.ndarray  # K x 4: centre x, y, width, height [px]
    roles: np.ndarray  # K


def random_corner(example: Example, side: int, random: np.random.Generator) -> np.ndarray:
    """Left and top of a square of the image."""
    height, width = example.image.shape[:2]
    most = np.array([width - side, height - side])
    choice = random.random()
    if choice < SHOWN_TARGET and len(example.targets):
        boxes = example.targets
    elif choice < SHOWN_TARGET + SHOWN_LOOK_ALIKE and len(example.look_alikes):
        boxes = example.look_alikes
    else:
        return random.integers(0, most + 1)
    centre = boxes[random.integers(len(boxes)), :2]
    return np.clip(centre - side * random.uniform(0.1, 0.9, 2), 0, most).astype(int)


def part_inside(targets: np.ndarray, size: int) -> np.ndarray:
    """Share of each box that is inside the square."""
    low, high = targets[:, :2] - 0.5 * targets[:, 2:], targets[:, :2] + 0.5 * targets[:, 2:]
    inside = (np.minimum(high, size) - np.maximum(low, 0)).clip(0)
    return inside.prod(1) / targets[:, 2:].prod(1)


def random_crop(example: Example, size: int, random: np.random.Generator) -> Crop:
    """A square of `size` px from the example, at a random scale."""
    scale = np.exp(random.uniform(*np.log(SCALES)))
    side = min(int(round(size / scale)), *example.image.shape[:2])
    left, top = random_corner(example, side, random)
    part = example.image[top : top + side, left : left + side]
    image = cv2.resize(part, (size, size), interpolation=cv2.INTER_AREA if side > size else cv2.INTER_LINEAR)
    boxes = np.concatenate((example.targets, example.look_alikes))
    boxes[:, :2] -= (left, top)
    boxes *= np.float32(size / side)
    share = part_inside(boxes, size)
    targets, share_of_targets = boxes[: len(example.targets)], share[: len(example.targets)]
    is_taught = (
        example.is_taught
        & (share_of_targets * example.visible >= CROP_VISIBLE)
        & ((targets[:, :2] >= 0) & (targets[:, :2] < size)).all(1)
        & (targets[:, 2:].min(1) >= LEAST_SIDE_PX)
    )
    roles = np.full(len(boxes), Role.LOOK_ALIKE)
    roles[: len(targets)] = np.where(is_taught, Role.TARGET, Role.UNDECIDED)
    return Crop(image, boxes[share > 0], roles[share > 0])


def mosaic(examples: list[Example], size: int, random: np.random.Generator) -> Crop:
    """Four crops of half the size side by side."""
    half = size // 2
    parts = [random_crop(example, half, random) for example in examples]
    corners = np.float32([[0, 0, 0, 0], [half, 0, 0, 0], [0, half, 0, 0], [half, half, 0, 0]])
    rows = [np.hstack([part.image for part in parts[:2]]), np.hstack([part.image for part in parts[2:]])]
    return Crop(
        np.vstack(rows),
        np.concatenate([part.boxes + corner for part, corner in zip(parts, corners)]),
        np.concatenate([part.roles for part in parts]),
    )


def varied(example: Example, others: list[Example], size: int, random: np.random.Generator) -> Crop:
    """A crop of the example, alone or in a mosaic with three of other examples."""
    if random.random() >= MOSAICS:
        return flipped(random_crop(example, size, random), random)
    beside = [others[i] for i in random.integers(len(others), size=3)]
    return flipped(mosaic([example, *beside], size, random), random)


def flipped(crop: Crop, random: np.random.Generator) -> Crop:
    """One of the eight orientations of a square."""
    image, boxes, size = crop.image, crop.boxes, crop.image.shape[0]
    if random.random() < 0.5:
        image, boxes = image[:, ::-1], boxes * (-1, 1, 1, 1) + (size, 0, 0, 0)
    if random.random() < 0.5:
        image, boxes = image[::-1], boxes * (1, -1, 1, 1) + (0, size, 0, 0)
    if random.random() < 0.5:
        image, boxes = image.transpose(1, 0, 2), boxes[:, [1, 0, 3, 2]]
    return Crop(image, boxes, crop.roles)


def recoloured(image: np.ndarray, random: np.random.Generator) -> np.ndarray:
    """Another exposure, contrast and white balance."""
    level = np.linspace(0.0, 1.0, 256)[:, None]
    gain = np.exp(random.uniform(*np.log(GAINS))) * random.uniform(0.85, 1.15, 3)
    table = gain * level ** random.uniform(0.75, 1.35) + random.uniform(-0.08, 0.08)
    return cv2.LUT(
        np.ascontiguousarray(image), np.clip(255.0 * table, 0, 255).astype(np.uint8).reshape(1, 256, 3)
    )


def training_batch(
    examples: list[Example], others: list[Example], size: int, random: np.random.Generator
) -> tuple[np.ndarray, list[np.ndarray], list[np.ndarray]]:
    """A crop of each example: images [B, size, size, 3] (8 bits), their boxes [K, 4] and the roles of these [K]."""
    crops = [varied(example, others, size, random) for example in examples]
    return (
        np.stack([recoloured(crop.image, random) for crop in crops]),
        [crop.boxes.astype(np.float32) for crop in crops],
        [crop.roles for crop in crops],
    )
