# SPDX-License-Identifier: Apache-2.0
"""Precision, recall and centre errors from the results of matching.py."""

from dataclasses import dataclass

import numpy as np

from dataset import Example
from matching import Found

SIZES_PX = ((10.0, 16.0), (16.0, np.inf))  # of the shorter side of a box: the two classes that are judged
LEAST_FOR_FIT = 200  # boxes
WHOLE = 0.98  # of a target that counts as fully visible


def demanded(examples: list[Example], size: tuple[float, float]) -> int:
    """Number of targets whose shorter side is of this size [px] and that must be found."""
    sides = [example.targets[example.is_demanded, 2:].min(1) for example in examples if len(example.targets)]
    return int(sum(((side >= size[0]) & (side < size[1])).sum() for side in sides))


@dataclass
class Curve:
    """Thresholds, descending, with recall and precision at each."""

    threshold: np.ndarray
    recall: np.ndarray
    precision: np.ndarray

    def at(self, threshold: float) -> tuple[float, float]:
        count = int((self.threshold >= threshold).sum())
        return (float(self.recall[count - 1]), float(self.precision[count - 1])) if count else (0.0, 1.0)


def curve(found: list[Found], examples: list[Example], size: tuple[float, float]) -> Curve:
    """Recall of targets of this size, precision of boxes of this size, by their shorter sides."""

    def is_of_size(side: float) -> bool:
        return size[0] <= side < size[1]

    counted = sorted((one for one in found if one.counts), key=lambda one: -one.confidence)
    hits = [
        one.target >= 0 and is_of_size(examples[one.picture].targets[one.target, 2:].min()) for one in counted
    ]
    boxes = np.array([is_of_size(one.side_px) for one in counted], bool)
    right = np.array([one.target >= 0 for one in counted], bool) & boxes
    return Curve(
        np.array([one.confidence for one in counted]),
        np.cumsum(hits) / max(demanded(examples, size), 1),
        np.cumsum(right) / np.maximum(np.cumsum(boxes), 1),
    )


@dataclass
class CentreErrors:
    """Centre errors of every correct box, in pixels of the image."""

    error: np.ndarray  # M x 2
    side: np.ndarray  # M: shorter side of the target's box
    box_size: np.ndarray  # M: root of the area of the box that was found
    tilt_deg: np.ndarray  # M
    visible: np.ndarray  # M
    is_cut: np.ndarray  # M: by the image's edge; such a box and its centre are of the part inside
    stated: np.ndarray  # M: sigma as stated by the detector [px]; NaN if not stated

    def where(self, chosen: np.ndarray) -> "CentreErrors":
        return CentreErrors(*(values[chosen] for values in vars(self).values()))

    def bias(self) -> np.ndarray:
        return self.error.mean(0)

    def sigma(self) -> np.ndarray:
        """Per-axis standard deviation without the worst 1 %."""
        off = np.abs(self.error - np.median(self.error, 0))
        kept = self.error[(off <= np.quantile(off, 0.99, axis=0)).all(1)]
        return kept.std(0)

    def robust_sigma(self) -> float:
        """Sigma of both axes together, from the median deviation."""
        return float(1.4826 * np.median(np.abs(self.error - np.median(self.error, 0))))


def reaches_out(example: Example, target: int) -> bool:
    height, width = example.image.shape[:2]
    centre, size = example.targets[target, :2], example.targets[target, 2:]
    return bool((centre < 0.5 * size).any() or (centre + 0.5 * size > (width, height)).any())


def centre_errors(found: list[Found], examples: list[Example], threshold: float) -> CentreErrors:
    right = [one for one in found if one.target >= 0 and one.counts and one.confidence >= threshold]
    truth = np.array([examples[one.picture].targets[one.target] for one in right]).reshape(-1, 4)
    boxes = np.array([one.box for one in right]).reshape(-1, 4)
    return CentreErrors(
        boxes[:, :2] - truth[:, :2],
        truth[:, 2:].min(1),
        np.sqrt(boxes[:, 2:].prod(1)),
        np.array([examples[one.picture].tilt_deg[one.target] for one in right]),
        np.array([examples[one.picture].visible[one.target] for one in right]),
        np.array([reaches_out(examples[one.picture], one.target) for one in right], bool),
        np.array([one.sigma_px for one in right]),
    )


def fit_sigma(errors: CentreErrors) -> tuple[float, float] | None:
    """a, b of the per-axis sigma hypot(a, b * box size) in pixels, fitted to the robust sigma of size
    classes; None if there are too few."""
    if len(errors.side) < LEAST_FOR_FIT:
        return None
    classes = np.quantile(errors.box_size, np.linspace(0.0, 1.0, 11))
    rows, squares = [], []
    for low, high in zip(classes[:-1], classes[1:]):
        members = errors.where((errors.box_size >= low) & (errors.box_size <= high))
        square = members.robust_sigma() ** 2
        rows.append(np.array([1.0, np.median(members.box_size) ** 2]) / square)  # equal relative errors
        squares.append(1.0)
    squared, *_ = np.linalg.lstsq(np.array(rows), np.array(squares), rcond=None)
    a, b = np.sqrt(np.maximum(squared, (0.01, 0.0)))  # no detector is assumed better than a tenth of a pixel
    return float(a), float(b)
