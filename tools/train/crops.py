# SPDX-License-Identifier: Apache-2.0
"""Training crops: squares around targets and look-alikes, at random scales, laid any way, in any colours."""

from dataclasses import dataclass

import cv2
import numpy as np

from dataset import LEAST_SIDE_PX, Example

SCALES = (0.75, 1.33)
CROP_VISIBLE = 0.5  # a target of which less is left in the crop is neither right nor wrong
CONFUSABLE = {
    "bullseye",
    "checker",
    "quartered_disc",
    "wheel",
    "tyre",
    "ring",
    "manhole",
    "cross",
    "black_panel",
}


@dataclass
class Diet:
    """What the crops show."""

    targets: float  # share of the crops that show a target for certain,
    look_alikes: float  # and a look-alike; the others anything
    mosaics: float  # share put together from four crops, which shows four times as many objects at no cost
    confusable: float  # how much rather a confusable look-alike than another is shown


@dataclass
class Crop:
    image: np.ndarray  # size x size x 3, RGB, 8 bits
    targets: np.ndarray  # K x 4: centre x, y, width, height [px]
    is_taught: np.ndarray  # K


def random_look_alike(example: Example, diet: Diet, random: np.random.Generator) -> np.ndarray:
    weights = np.array([diet.confusable if kind in CONFUSABLE else 1.0 for kind in example.kinds])
    return example.look_alikes[random.choice(len(weights), p=weights / weights.sum())]


def random_corner(example: Example, side: int, diet: Diet, random: np.random.Generator) -> np.ndarray:
    """Left and top of a square of the image."""
    height, width = example.image.shape[:2]
    most = np.array([width - side, height - side])
    choice = random.random()
    if choice < diet.targets and len(example.targets):
        box = example.targets[random.integers(len(example.targets))]
    elif choice < diet.targets + diet.look_alikes and len(example.look_alikes):
        box = random_look_alike(example, diet, random)
    else:
        return random.integers(0, most + 1)
    return np.clip(box[:2] - side * random.uniform(0.1, 0.9, 2), 0, most).astype(int)


def part_inside(targets: np.ndarray, size: int) -> np.ndarray:
    """Share of each box that is inside the square."""
    low, high = targets[:, :2] - 0.5 * targets[:, 2:], targets[:, :2] + 0.5 * targets[:, 2:]
    inside = (np.minimum(high, size) - np.maximum(low, 0)).clip(0)
    return inside.prod(1) / targets[:, 2:].prod(1)


def random_crop(example: Example, size: int, diet: Diet, random: np.random.Generator) -> Crop:
    """A square of size px out of the example, at a random scale."""
    scale = np.exp(random.uniform(*np.log(SCALES)))
    side = int(round(size / scale))
    left, top = random_corner(example, side, diet, random)
    part = example.image[top : top + side, left : left + side]
    image = cv2.resize(part, (size, size), interpolation=cv2.INTER_AREA if side > size else cv2.INTER_LINEAR)
    targets = example.targets.copy()
    targets[:, :2] -= (left, top)
    targets *= np.float32(size / side)
    share = part_inside(targets, size)
    is_taught = (
        example.is_taught
        & (share * example.visible >= CROP_VISIBLE)
        & ((targets[:, :2] >= 0) & (targets[:, :2] < size)).all(1)
        & (targets[:, 2:].min(1) >= LEAST_SIDE_PX)
    )
    return Crop(image, targets[share > 0], is_taught[share > 0])


def confusable(examples: list[Example]) -> list[Example]:
    return [example for example in examples if CONFUSABLE.intersection(example.kinds)]


def mosaic(examples: list[Example], size: int, diet: Diet, random: np.random.Generator) -> Crop:
    """Four crops of half the size side by side."""
    half = size // 2
    parts = [random_crop(example, half, diet, random) for example in examples]
    corners = np.float32([[0, 0, 0, 0], [half, 0, 0, 0], [0, half, 0, 0], [half, half, 0, 0]])
    rows = [np.hstack([part.image for part in parts[:2]]), np.hstack([part.image for part in parts[2:]])]
    return Crop(
        np.vstack(rows),
        np.concatenate([part.targets + corner for part, corner in zip(parts, corners)]),
        np.concatenate([part.is_taught for part in parts]),
    )


def varied(
    example: Example, partners: list[Example], size: int, diet: Diet, random: np.random.Generator
) -> Crop:
    if random.random() >= diet.mosaics:
        return flipped(random_crop(example, size, diet, random), random)
    others = [partners[i] for i in random.integers(len(partners), size=3)]
    return flipped(mosaic([example, *others], size, diet, random), random)


def flipped(crop: Crop, random: np.random.Generator) -> Crop:
    """One of the eight ways to lay a square."""
    image, targets, size = crop.image, crop.targets, crop.image.shape[0]
    if random.random() < 0.5:
        image, targets = image[:, ::-1], targets * (-1, 1, 1, 1) + (size, 0, 0, 0)
    if random.random() < 0.5:
        image, targets = image[::-1], targets * (1, -1, 1, 1) + (0, size, 0, 0)
    if random.random() < 0.5:
        image, targets = image.transpose(1, 0, 2), targets[:, [1, 0, 3, 2]]
    return Crop(image, targets, crop.is_taught)


def recoloured(image: np.ndarray, random: np.random.Generator) -> np.ndarray:
    """Another exposure, contrast and white balance."""
    level = np.linspace(0.0, 1.0, 256)[:, None]
    gain = random.uniform(0.65, 1.35) * random.uniform(0.85, 1.15, 3)
    table = gain * level ** random.uniform(0.75, 1.35) + random.uniform(-0.08, 0.08)
    return cv2.LUT(
        np.ascontiguousarray(image), np.clip(255.0 * table, 0, 255).astype(np.uint8).reshape(1, 256, 3)
    )


def training_batch(
    examples: list[Example], partners: list[Example], size: int, diet: Diet, random: np.random.Generator
) -> tuple[np.ndarray, list[np.ndarray], list[np.ndarray]]:
    """A crop of each example, many with three of the partners beside it: images [B, size, size, 3] (8 bits), their
    targets [K, 4] and which of these are taught [K]."""
    crops = [varied(example, partners, size, diet, random) for example in examples]
    return (
        np.stack([recoloured(crop.image, random) for crop in crops]),
        [crop.targets.astype(np.float32) for crop in crops],
        [crop.is_taught for crop in crops],
    )
