# SPDX-License-Identifier: Apache-2.0
"""Detections compared with the labels, for all confidence thresholds at once."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from dataset import Example, letterbox
from patches import boxes_of, cut, judged, normalised, resized, squares_around

LOWEST_CONFIDENCE = 0.05  # lower confidences are ignored
PROPOSED = 0.1  # confidence from which on boxes get a second look, the default of detection.second_look.confidence
MOST_PROPOSED = 40  # as detection.second_look.max_boxes
SUPPRESS_OVERLAP = 0.5  # the default of detection.nms_iou
MATCH_OVERLAP = 0.5


@dataclass
class Network:
    """A detector."""

    width: int  # of its input
    height: int
    run: Callable[[np.ndarray], np.ndarray]  # [height, width, 3] (RGB, 8 bits) to [5, N] in YOLO's layout


SecondLook = Callable[[np.ndarray], np.ndarray]  # patches [K, 3, 48, 48] to answers [K, 6]
Boxes = tuple[np.ndarray, np.ndarray, np.ndarray]  # [K, 4], confidences [K], sigma of the centre [K], NaN: not stated
Detector = Callable[[np.ndarray], Boxes]


@dataclass
class Found:
    """One box."""

    picture: int
    confidence: float
    box: np.ndarray  # centre x, y, width, height [px of the picture]
    target: int  # index in the image, or -1
    counts: bool  # False: it matches a target that is neither required nor counted
    sigma_px: float  # per-axis sigma of the centre as stated by the detector; NaN if it states none

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
    kept = suppressed(boxes)
    return boxes[kept], scores[kept]


def suppressed(boxes: np.ndarray) -> list[int]:
    """Indices of the boxes, best first, that greedy non-maximum suppression keeps."""
    kept: list[int] = []
    for index, box in enumerate(boxes):
        if not kept or overlap(box, boxes[kept]).max() <= SUPPRESS_OVERLAP:
            kept.append(index)
    return kept


def detect(network: Network, image: np.ndarray) -> Boxes:
    """The same in pixels of the image; boxes may extend beyond it."""
    boxed, scale, left, top = letterbox(image, network.width, network.height)
    boxes, scores = candidates(network.run(boxed))
    return (boxes - np.float32([left, top, 0, 0])) / scale, scores, np.full(len(scores), np.nan)


def clipped(boxes: np.ndarray, width: int, height: int) -> np.ndarray:
    """The part of boxes [K, 4] inside the image, as the program reports it."""
    low = np.clip(boxes[:, :2] - 0.5 * boxes[:, 2:], 0, (width, height))
    high = np.clip(boxes[:, :2] + 0.5 * boxes[:, 2:], 0, (width, height))
    return np.concatenate((0.5 * (low + high), high - low), 1)


def detect_twice(network: Network, second_look: SecondLook, image: np.ndarray) -> Boxes:
    """Boxes that the second look has moved, sized and judged, best first, and their confidences."""
    height, width = image.shape[:2]
    boxes, scores, _ = detect(network, image)
    proposed = clipped(boxes[scores >= PROPOSED][:MOST_PROPOSED], width, height)
    proposed = proposed[(proposed[:, 2:] > 0).all(1)]
    squares = squares_around(proposed, image)
    if not len(squares):
        return proposed, np.empty(0), np.empty(0)
    patches = np.stack([normalised(resized(cut(image, square))) for square in squares])
    answers = judged(patches, second_look)
    order = np.argsort(-answers[:, 0], kind="stable")
    boxes, scores = clipped(boxes_of(answers[:, 1:5], squares), width, height)[order], answers[order, 0]
    kept = suppressed(boxes)
    return boxes[kept], scores[kept], (answers[order, 5] * squares[order, 2])[kept]


def match(answers: list[Boxes], examples: list[Example]) -> list[Found]:
    """A detector's output for each image, compared with the labels."""
    found = []
    for picture, (answer, example) in enumerate(zip(answers, examples)):
        free = np.ones(len(example.targets), bool)
        targets = clipped(example.targets, *example.image.shape[1::-1])
        for box, confidence, sigma in zip(*answer):
            target, counts = -1, True
            overlaps = np.where(free, overlap(box, targets), 0.0)
            if len(overlaps) and overlaps.max() >= MATCH_OVERLAP:
                target = int(overlaps.argmax())
                free[target] = False
                counts = bool(example.is_demanded[target])
            elif hidden(box, example):
                counts = False
            found.append(Found(picture, float(confidence), box, target, counts, float(sigma)))
    return found


def hidden(box: np.ndarray, example: Example) -> bool:
    """The box is on a target that is too small or too much covered to be required."""
    off = np.abs(example.targets[~example.is_demanded, :2] - box[:2])
    reach = 0.5 * np.maximum(example.targets[~example.is_demanded, 2:], box[2:])
    return bool((off < reach).all(1).any())
