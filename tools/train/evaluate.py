# SPDX-License-Identifier: Apache-2.0
"""Precision, recall and centre error on whole pictures, counted as the application would use the model."""

from dataclasses import dataclass

import numpy as np
import torch

from dataset import Example
from loss import corners, intersection_over_union
from model import TargetDetector, cells, decode

SMALLEST_PX = 14.0  # of the full picture: smaller targets are neither demanded nor held against the model
FULL_PER_INPUT = 2.0  # a 1280 x 720 picture in a 640 x 384 input
MATCH_OVERLAP = 0.5
SUPPRESS_OVERLAP = 0.45


@dataclass
class Quality:
    recall: float
    precision: float
    centre_sigma_px: float  # per axis, of the full picture
    centre_bias_px: tuple[float, float]

    def __str__(self) -> str:
        bias = ", ".join(f"{value:+.2f}" for value in self.centre_bias_px)
        return (
            f"recall {self.recall:.4f}  precision {self.precision:.4f}  "
            f"centre sigma {self.centre_sigma_px:.2f} px  bias ({bias}) px"
        )


def suppressed(boxes: np.ndarray, scores: np.ndarray) -> np.ndarray:
    """Greedy non-maximum suppression; returns the kept boxes [K, 4], best first."""
    kept: list[np.ndarray] = []
    for index in np.argsort(-scores):
        overlaps = intersection_over_union(
            torch.tensor(boxes[index]), torch.tensor(np.array(kept).reshape(-1, 4))
        )
        if not (overlaps > SUPPRESS_OVERLAP).any():
            kept.append(boxes[index])
    return np.array(kept, np.float32).reshape(-1, 4)


def detect(output: np.ndarray, threshold: float) -> np.ndarray:
    """output [5, N] in YOLO's layout; returns boxes [K, 4] (left, top, right, bottom), best first."""
    sure = output[4] > threshold
    return suppressed(corners(torch.tensor(output[:4, sure].T)).numpy(), output[4, sure])


class Counter:
    def __init__(self) -> None:
        self.demanded = self.found = self.right = self.wrong = 0
        self.errors: list[np.ndarray] = []

    def add(self, detected: np.ndarray, truth: np.ndarray) -> None:
        free = list(range(len(truth)))
        demanded = [self._is_demanded(box) for box in truth]
        self.demanded += sum(demanded)
        for box in detected:
            overlaps = [
                float(intersection_over_union(torch.tensor(box), torch.tensor(truth[i]))) for i in free
            ]
            if not overlaps or max(overlaps) < MATCH_OVERLAP:
                self.wrong += 1
                continue
            match = free.pop(int(np.argmax(overlaps)))
            if demanded[match]:
                self.found += 1
                self.right += 1
                self.errors.append(
                    FULL_PER_INPUT * 0.5 * (box[:2] + box[2:] - truth[match][:2] - truth[match][2:])
                )

    @staticmethod
    def _is_demanded(box: np.ndarray) -> bool:
        return bool((box[2:] - box[:2]).min() * FULL_PER_INPUT >= SMALLEST_PX)

    def quality(self) -> Quality:
        errors = np.array(self.errors).reshape(-1, 2)
        bias = errors.mean(0) if len(errors) else np.zeros(2)
        return Quality(
            self.found / max(self.demanded, 1),
            self.right / max(self.right + self.wrong, 1),
            float(np.sqrt((errors**2).mean())) if len(errors) else float("nan"),
            (float(bias[0]), float(bias[1])),
        )


def predict(model: TargetDetector, example: Example) -> np.ndarray:
    """Output [5, N] in YOLO's layout."""
    height, width = example.image.shape[:2]
    image = torch.tensor(example.image.transpose(2, 0, 1)[None].copy()).float() / 255.0
    with torch.no_grad():
        boxes, scores = model(image)
        return torch.cat((decode(boxes, *cells(height, width)), scores.sigmoid()), 1)[0].numpy()


def evaluate(model: TargetDetector, examples: list[Example], thresholds: tuple[float, ...]) -> list[Quality]:
    """At each confidence threshold."""
    model.eval()
    counters = [Counter() for _ in thresholds]
    for example in examples:
        output = predict(model, example)
        for counter, threshold in zip(counters, thresholds):
            counter.add(detect(output, threshold), example.boxes)
    return [counter.quality() for counter in counters]
