# SPDX-License-Identifier: Apache-2.0
"""What a detector found, set against what is there, for every confidence threshold at once."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from dataset import Example, letterbox

LOWEST_CONFIDENCE = 0.05  # nothing below is looked at
SUPPRESS_OVERLAP = 0.5  # as detection.nms_iou is by default
MATCH_OVERLAP = 0.5


@dataclass
class Network:
    """Something that detects."""

    width: int  # of its input
    height: int
    run: Callable[[np.ndarray], np.ndarray]  # [height, width, 3] (RGB, 8 bits) to [5, N] in YOLO's layout


@dataclass
class Found:
    """One box."""

    picture: int
    confidence: float
    box: np.ndarray  # centre x, y, width, height [px of the picture]
    target: int  # of the picture, or -1
    counts: bool  # False: it matches a target that is neither demanded nor counted

    @property
    def side_px(self) -> float:
        return float(self.box[2:].min())


def overlap(box: np.ndarray, others: np.ndarray) -> np.ndarray:
    """IoU of one box with K others, all as centre x, y, width, height."""
    low = np.maximum(box[:2] - box[2:] / 2, others[:, :2] - others[:, 2:] / 2)
    high = np.minimum(box[:2] + box[2:] / 2, others[:, :2] + others[:, 2:] / 2)
    common = (high - low).clip(0).prod(1)
    return common / (box[2:].prod() + others[:, 2:].prod(1) - common + 1e-9)


def candidates(output: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Boxes [K, 4] that greedy non-maximum suppression keeps, best first, and their confidences [K]."""
    sure = output[4] > LOWEST_CONFIDENCE
    order = np.argsort(-output[4, sure], kind="stable")
    boxes, scores = output[:4, sure].T[order], output[4, sure][order]
    kept: list[int] = []
    for index, box in enumerate(boxes):
        if not kept or overlap(box, boxes[kept]).max() <= SUPPRESS_OVERLAP:
            kept.append(index)
    return boxes[kept], scores[kept]


def detect(network: Network, image: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The same in pixels of the picture; boxes may reach out of it."""
    boxed, scale, left, top = letterbox(image, network.width, network.height)
    boxes, scores = candidates(network.run(boxed))
    return (boxes - np.float32([left, top, 0, 0])) / scale, scores


def match(network: Network, examples: list[Example]) -> list[Found]:
    found = []
    for picture, example in enumerate(examples):
        free = np.ones(len(example.targets), bool)
        for box, confidence in zip(*detect(network, example.image)):
            target, counts = -1, True
            overlaps = np.where(free, overlap(box, example.targets), 0.0)
            if len(overlaps) and overlaps.max() >= MATCH_OVERLAP:
                target = int(overlaps.argmax())
                free[target] = False
                counts = bool(example.is_demanded[target])
            elif hidden(box, example):
                counts = False
            found.append(Found(picture, float(confidence), box, target, counts))
    return found


def hidden(box: np.ndarray, example: Example) -> bool:
    """The box lies on a target that is too small or too much covered to be demanded."""
    off = np.abs(example.targets[~example.is_demanded, :2] - box[:2])
    reach = 0.5 * np.maximum(example.targets[~example.is_demanded, 2:], box[2:])
    return bool((off < reach).all(1).any())
