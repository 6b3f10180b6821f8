# SPDX-License-Identifier: Apache-2.0
"""Training patches for the second look: targets and other things that the detector proposes, off-centre as proposed."""

from dataclasses import dataclass

import cv2
import numpy as np
from tqdm import tqdm

from crops import recoloured
from dataset import LEAST_LEGIBLE, Example
from matching import PROPOSED, Network, clipped, detect, hidden, overlap
from patches import PATCH_PX, answers_for, cut, normalised, resized, squares_around

POSITIVES = 0.4  # share of the patches that shows a target,
MINED = 0.25  # a look-alike or bare ground that the detector proposed,
LOOK_ALIKES = 0.3  # any look-alike; the others: any ground
MATCHES = 0.4  # overlap from which on a proposal belongs to a target,
MISSES = 0.15  # and below which it does not; in between it is neither right nor wrong
CENTRE_JITTER = 0.08  # 1-sigma, of the box's size,
CENTRE_JITTER_PX = 0.7  # and besides
SIZE_JITTER = 0.15  # 1-sigma of the logarithms of width and height
SMALLEST_PX = 4.0
GROUND_SIDES_PX = (8.0, 100.0)
MOST_PIXELS = 128  # sides of squares that are shrunk before they are degraded
NOISE = 5.0  # grey levels, at most
SHARE_COARSE = 0.3  # of the patches, shown as if from further away,
COARSEST_PX = 20  # down to this side
SHARE_COMPRESSED = 0.15
JPEG_QUALITY = (25, 70)


@dataclass
class Look:
    """One place to look at."""

    picture: int
    box: np.ndarray  # centre x, y, width, height [px]: as proposed, or the true one
    truth: np.ndarray | None  # the target's box; None where there is no target


@dataclass
class Looks:
    targets: list[Look]
    mined: list[Look]
    look_alikes: list[Look]


def proposed(network: Network, examples: list[Example]) -> list[np.ndarray]:
    """Per image, the boxes [K, 4] that the detector proposes, most confident first."""
    proposals = []
    for example in tqdm(examples, desc="proposals", unit="picture", mininterval=2.0):
        boxes, confidences, _ = detect(network, example.image)
        proposals.append(boxes[confidences >= PROPOSED].astype(np.float32))
    return proposals


def collect(examples: list[Example], proposals: list[np.ndarray]) -> Looks:
    looks = Looks([], [], [])
    for picture, (example, boxes) in enumerate(zip(examples, proposals)):
        taught = example.targets[example.is_taught & (example.legible >= LEAST_LEGIBLE)]
        looks.targets += [Look(picture, box, box) for box in taught]
        for box in boxes:
            overlaps = overlap(box, taught)
            if overlaps.max(initial=0.0) >= MATCHES:
                looks.targets.append(Look(picture, box, taught[overlaps.argmax()]))
        for group, others in ((looks.mined, boxes), (looks.look_alikes, example.look_alikes)):
            group += [Look(picture, box, None) for box in others if shows_no_target(box, example)]
    return looks


def shows_no_target(box: np.ndarray, example: Example) -> bool:
    overlaps = overlap(box, example.targets)
    return overlaps.max(initial=0.0) < MISSES and not hidden(box, example) and box[2:].min() > SMALLEST_PX


def jittered(box: np.ndarray, random: np.random.Generator) -> np.ndarray:
    size = np.sqrt(box[2:].prod())
    centre = box[:2] + random.normal(0.0, CENTRE_JITTER * size + CENTRE_JITTER_PX, 2)
    return np.concatenate((centre, box[2:] * np.exp(random.normal(0.0, SIZE_JITTER, 2))))


def random_look(
    looks: Looks, examples: list[Example], random: np.random.Generator
) -> tuple[Look, np.ndarray]:
    """A look and the box that is proposed for it."""
    choice = random.random()
    for share, group in (
        (POSITIVES, looks.targets),
        (MINED, looks.mined),
        (LOOK_ALIKES, looks.look_alikes),
    ):
        if choice < share and group:
            look = group[random.integers(len(group))]
            return look, jittered(look.box, random)
        choice -= share
    picture = int(random.integers(len(examples)))
    height, width = examples[picture].image.shape[:2]
    side = np.exp(random.uniform(*np.log(GROUND_SIDES_PX)))
    box = np.array([random.uniform(0, width), random.uniform(0, height), side, side])
    if overlap(box * (1, 1, 2, 2), examples[picture].targets).max(initial=0.0) > 0.0:
        return random_look(looks, examples, random)
    return Look(picture, box, None), box


def degraded(square: np.ndarray, random: np.random.Generator) -> np.ndarray:
    """Another exposure, noise, fewer pixels, blocks."""
    if square.shape[0] > MOST_PIXELS:
        square = resized(square, MOST_PIXELS)
    square = recoloured(square, random)
    if random.random() < SHARE_COARSE and square.shape[0] > COARSEST_PX:
        square = resized(square, int(random.integers(COARSEST_PX, square.shape[0])))
    noise = random.uniform(0.0, NOISE) * random.standard_normal(square.shape, np.float32)
    square = np.clip(square + noise, 0, 255).astype(np.uint8)
    if random.random() < SHARE_COMPRESSED:
        quality = int(random.integers(*JPEG_QUALITY))
        square = cv2.imdecode(cv2.imencode(".jpg", square, [cv2.IMWRITE_JPEG_QUALITY, quality])[1], 1)
    return square


def turned(
    patch: np.ndarray, answer: np.ndarray, random: np.random.Generator
) -> tuple[np.ndarray, np.ndarray]:
    """One of the eight orientations of a patch [H, W, 3] and its answer (off-centre x, y; width, height)."""
    for axis in (0, 1):
        if random.random() < 0.5:
            patch = patch[:, ::-1] if axis == 0 else patch[::-1]
            answer = answer * np.where(np.arange(4) == axis, -1.0, 1.0)
    if random.random() < 0.5:
        patch, answer = patch.transpose(1, 0, 2), answer[[1, 0, 3, 2]]
    return patch, answer


def training_looks(
    looks: Looks, examples: list[Example], count: int, random: np.random.Generator
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Patches [count, 3, 48, 48], whether each shows a target [count], and where it is [count, 4]."""
    patches = np.empty((count, 3, PATCH_PX, PATCH_PX), np.float32)
    is_target, answers = np.zeros(count, np.float32), np.zeros((count, 4), np.float32)
    for index in range(count):
        look, box = random_look(looks, examples, random)
        image = examples[look.picture].image
        square = squares_around(clipped(box[None], image.shape[1], image.shape[0]), image)
        truth = look.box if look.truth is None else look.truth
        patch, answer = turned(cut(image, square[0]), answers_for(truth[None], square)[0], random)
        patches[index] = normalised(resized(degraded(np.ascontiguousarray(patch), random)))
        is_target[index], answers[index] = look.truth is not None, answer
    return patches, is_target, answers
