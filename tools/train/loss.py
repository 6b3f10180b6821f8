# SPDX-License-Identifier: Apache-2.0
"""Which predictor is responsible for which target, and the cost of its output."""

import torch
from torch.nn import functional

from crops import Role

LARGE_PX = 32.0  # targets from this size on belong to the stride-16 grid,
OVERLAP = 1.3  # those within this factor of it belong to both
REACH = 0.8  # predictors whose centre is this near the target's (in strides, either axis) answer for it
SCORE_WEIGHT = 6.0
LOOK_ALIKE_WEIGHT = 0.2  # of a cell on one: the second look tells them from targets, this one must miss none
CENTRE_WEIGHT = 2.0  # geolocation uses the centre alone, so it has a cost of its own besides that of the overlap
SIZE_WEIGHT = 0.5
FOCUS = 1.5  # exponent: cells that are already right cost almost nothing, which leaves the look-alikes


def assign(
    targets: torch.Tensor, centres: torch.Tensor, strides: torch.Tensor
) -> tuple[torch.Tensor, torch.Tensor]:
    """targets [K, 4] (centre, size); returns the responsible cells and the target of each of them."""
    distance = (centres.T[None] - targets[:, None, :2]).abs().amax(2) / strides  # [K, N]
    size = targets[:, 2:].amax(1)[:, None]
    fine = strides[None] < 12.0
    fits = torch.where(fine, size < LARGE_PX * OVERLAP, size > LARGE_PX / OVERLAP)
    distance = torch.where(fits & (distance < REACH), distance, torch.inf)
    nearest, owner = distance.min(0)
    responsible = torch.nonzero(torch.isfinite(nearest)).flatten()
    return responsible, owner[responsible]


def covered(targets: torch.Tensor, centres: torch.Tensor, strides: torch.Tensor) -> torch.Tensor:
    """Which cells [N] are on any of the targets [K, 4]."""
    if not len(targets):
        return torch.zeros(len(strides), dtype=torch.bool)
    off = (centres.T[None] - targets[:, None, :2]).abs()  # [K, N, 2]
    return (off < 0.5 * targets[:, None, 2:] + 0.5 * strides[None, :, None]).all(2).any(0)


def intersection_over_union(a: torch.Tensor, b: torch.Tensor) -> torch.Tensor:
    """IoU of boxes [..., 4] as left, top, right, bottom, pair by pair."""
    overlap = (
        (torch.minimum(a[..., 2:], b[..., 2:]) - torch.maximum(a[..., :2], b[..., :2])).clamp(min=0).prod(-1)
    )
    area = (a[..., 2:] - a[..., :2]).prod(-1) + (b[..., 2:] - b[..., :2]).prod(-1)
    return overlap / (area - overlap + 1e-6)


def corners(centre_size: torch.Tensor) -> torch.Tensor:
    """Centre and size [..., 4] to left, top, right, bottom."""
    half = 0.5 * centre_size[..., 2:]
    return torch.cat((centre_size[..., :2] - half, centre_size[..., :2] + half), -1)


def box_loss(predicted: torch.Tensor, truth: torch.Tensor, overlap: torch.Tensor) -> torch.Tensor:
    """Sum over boxes [M, 4] (centre, size) with these overlaps [M]."""
    # Relative to the square root of the size: a compromise between pixels, which would hardly affect small targets,
    # and sizes, which would hardly affect large ones.
    off_centre = (predicted[:, :2] - truth[:, :2]).abs() / truth[:, 2:].sqrt()
    off_size = (predicted[:, 2:].log() - truth[:, 2:].log()).abs()
    each = 1.0 - overlap + CENTRE_WEIGHT * off_centre.mean(1) + SIZE_WEIGHT * off_size.mean(1)
    return each.sum()


def detection_loss(
    decoded: torch.Tensor,  # [B, 4, N] centre and size [px]
    scores: torch.Tensor,  # [B, 1, N] logits
    boxes: list[torch.Tensor],  # B times [K, 4]
    roles: list[torch.Tensor],  # B times [K]: Role of each box
    centres: torch.Tensor,
    strides: torch.Tensor,
) -> torch.Tensor:
    wanted, counts = torch.zeros_like(scores), torch.ones_like(scores)
    boxes_cost = decoded.new_zeros(())
    answers = 0
    for index, (box, role) in enumerate(zip(boxes, roles)):
        counts[index, 0, covered(box[role == Role.LOOK_ALIKE], centres, strides)] = LOOK_ALIKE_WEIGHT
        counts[index, 0, covered(box[role == Role.UNDECIDED], centres, strides)] = 0.0
        targets = box[role == Role.TARGET]
        if not len(targets):
            continue
        responsible, owner = assign(targets, centres, strides)
        predicted, truth = decoded[index, :, responsible].T, targets[owner]
        overlap = intersection_over_union(corners(predicted), corners(truth))
        wanted[index, 0, responsible] = overlap.detach().sqrt()  # a good box scores near 1
        counts[index, 0, responsible] = 1.0
        boxes_cost = boxes_cost + box_loss(predicted, truth, overlap)
        answers += len(responsible)
    surprise = (scores.detach().sigmoid() - wanted).abs() ** FOCUS
    score_cost = functional.binary_cross_entropy_with_logits(scores, wanted, reduction="none")
    score_loss = (counts * surprise * score_cost).sum()
    return (SCORE_WEIGHT * score_loss + boxes_cost) / max(answers, 1)
