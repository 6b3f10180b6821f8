# SPDX-License-Identifier: Apache-2.0
"""The second look's input, the surroundings of a box at one size and one exposure, and the interpretation of its output.
src/io/detection/patch.cpp does the same."""

from collections.abc import Callable

import cv2
import numpy as np

PATCH_PX = 48
SURROUNDINGS = 2.0  # a patch shows this many times the longer side of a box
LEAST_SIDE_PX = 16  # of the square that a patch shows
LUMA = np.float32([0.299, 0.587, 0.114])  # shares of red, green, blue
IN_DOUBT = (0.05, 0.98)  # for scores in between, the mirrored patches are evaluated too
LEAST_CONTRAST = 2.0  # grey levels: a patch with less is not stretched further, as it would show only noise


def squares_around(boxes: np.ndarray, image: np.ndarray) -> np.ndarray:
    """Left, top and side [K, 3] in whole pixels, of boxes [K, 4] (centre x, y, width, height)."""
    side = np.floor(SURROUNDINGS * boxes[:, 2:].max(1) + 0.5).clip(LEAST_SIDE_PX, min(image.shape[:2]))
    corner = np.floor(boxes[:, :2] - 0.5 * side[:, None] + 0.5)
    return np.column_stack((corner, side)).astype(int)


def cut(image: np.ndarray, square: np.ndarray) -> np.ndarray:
    """The square of the image; outside of the image, its edge pixels are repeated."""
    left, top, side = square
    height, width = image.shape[:2]
    inside = image[max(top, 0) : top + side, max(left, 0) : left + side]
    if inside.shape[:2] == (side, side):
        return inside
    return cv2.copyMakeBorder(
        inside,
        max(-top, 0),
        max(top + side - height, 0),
        max(-left, 0),
        max(left + side - width, 0),
        cv2.BORDER_REPLICATE,
    )


def resized(square: np.ndarray, size: int = PATCH_PX) -> np.ndarray:
    shrinks = square.shape[0] > size
    return cv2.resize(square, (size, size), interpolation=cv2.INTER_AREA if shrinks else cv2.INTER_LINEAR)


def normalised(patch: np.ndarray) -> np.ndarray:
    """[H, W, 3] of any type to [3, H, W]: each channel with mean 0, and the brightness with standard deviation 1."""
    pixels = patch.astype(np.float32)
    contrast = max(float((pixels @ LUMA).std()), LEAST_CONTRAST)
    return ((pixels - pixels.mean((0, 1))) / contrast).transpose(2, 0, 1)


def boxes_of(answers: np.ndarray, squares: np.ndarray) -> np.ndarray:
    """Answers [K, 4] (off-centre x, y and width, height in sides of the square) to boxes [K, 4] in pixels."""
    side = squares[:, 2:].astype(np.float64)
    return np.column_stack((squares[:, :2] + (0.5 + answers[:, :2]) * side, answers[:, 2:4] * side))


def answers_for(boxes: np.ndarray, squares: np.ndarray) -> np.ndarray:
    """The inverse of boxes_of()."""
    side = squares[:, 2:].astype(np.float64)
    return np.column_stack(((boxes[:, :2] - squares[:, :2]) / side - 0.5, boxes[:, 2:] / side))


def judged(patches: np.ndarray, second_look: Callable[[np.ndarray], np.ndarray]) -> np.ndarray:
    """Answers [K, 6] to patches [K, 3, 48, 48]. If the score is doubtful, the mean over the patch and its two mirror
    images: of the scores' logits and of the centres, with size and sigma of the plain patch."""
    answers = second_look(patches)
    doubtful = np.flatnonzero((answers[:, 0] > IN_DOUBT[0]) & (answers[:, 0] < IN_DOUBT[1]))
    if len(doubtful):
        plain = answers[doubtful]
        reversed_ = second_look(patches[doubtful, :, :, ::-1].copy())
        inverted = second_look(patches[doubtful, :, ::-1].copy())
        mean_logit = np.mean([logit(one[:, 0]) for one in (plain, reversed_, inverted)], 0)
        answers[doubtful, 0] = 1.0 / (1.0 + np.exp(-mean_logit))
        answers[doubtful, 1] = (plain[:, 1] - reversed_[:, 1] + inverted[:, 1]) / 3.0
        answers[doubtful, 2] = (plain[:, 2] + reversed_[:, 2] - inverted[:, 2]) / 3.0
    return answers


def in_batches(patches: np.ndarray, at_once: int, run: Callable[[np.ndarray], np.ndarray]) -> np.ndarray:
    """run() for all patches, with a network that takes exactly `at_once` of them."""
    padded = np.concatenate((patches, np.zeros((-len(patches) % at_once, *patches.shape[1:]), np.float32)))
    return np.concatenate([run(part) for part in np.split(padded, len(padded) // at_once)])[: len(patches)]


def logit(score: np.ndarray) -> np.ndarray:
    clamped = np.clip(score, 1e-6, 1.0 - 1e-6)
    return np.log(clamped / (1.0 - clamped))
