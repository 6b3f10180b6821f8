# SPDX-License-Identifier: Apache-2.0
"""Which predictor answers for which target, and what its answer costs."""

import torch
from torch.nn import functional

LARGE_PX = 36.0  # input pixels: targets from here on belong to the stride-16 grid,
OVERLAP = 1.3  # those within this factor of it to both
SCORE_WEIGHT = 4.0  # telling targets from look-alikes is harder than boxing them
REACH = 0.8  # predictors whose centre is this near the target's (in strides, either axis) answer for it


def assign(
    boxes: torch.Tensor, centres: torch.Tensor, strides: torch.Tensor
) -> tuple[torch.Tensor, torch.Tensor]:
    """boxes [K, 4] (left, top, right, bottom); returns the responsible cells and the box of each of them."""
    middle = 0.5 * (boxes[:, :2] + boxes[:, 2:])
    size = (boxes[:, 2:] - boxes[:, :2]).amax(1)
    distance = (centres.T[None] - middle[:, None]).abs().amax(2) / strides  # [K, N]
    fine = strides < 12.0
    fits = torch.where(fine[None], size[:, None] < LARGE_PX * OVERLAP, size[:, None] > LARGE_PX / OVERLAP)
    distance = torch.where(fits & (distance < REACH), distance, torch.inf)
    nearest, owner = distance.min(0)
    responsible = torch.nonzero(torch.isfinite(nearest)).flatten()
    return responsible, owner[responsible]


def intersection_over_union(a: torch.Tensor, b: torch.Tensor) -> torch.Tensor:
    """Of boxes [..., 4] as left, top, right, bottom, pair by pair."""
    overlap = (
        (torch.minimum(a[..., 2:], b[..., 2:]) - torch.maximum(a[..., :2], b[..., :2])).clamp(min=0).prod(-1)
    )
    area = (a[..., 2:] - a[..., :2]).prod(-1) + (b[..., 2:] - b[..., :2]).prod(-1)
    return overlap / (area - overlap + 1e-6)


def corners(centre_size: torch.Tensor) -> torch.Tensor:
    """Centre and size [..., 4] to left, top, right, bottom."""
    half = 0.5 * centre_size[..., 2:]
    return torch.cat((centre_size[..., :2] - half, centre_size[..., :2] + half), -1)


def detection_loss(
    decoded: torch.Tensor,  # [B, 4, N] centre and size [px]
    scores: torch.Tensor,  # [B, 1, N] logits
    targets: list[torch.Tensor],  # B times [K, 4]
    centres: torch.Tensor,
    strides: torch.Tensor,
) -> torch.Tensor:
    wanted = torch.zeros_like(scores)
    box_loss = decoded.new_zeros(())
    answers = 0
    for index, boxes in enumerate(targets):
        if len(boxes) == 0:
            continue
        responsible, owner = assign(boxes, centres, strides)
        if len(responsible) == 0:
            continue
        predicted, truth = decoded[index, :, responsible].T, boxes[owner]
        overlap = intersection_over_union(corners(predicted), truth)
        wanted[index, 0, responsible] = overlap.detach().sqrt()  # a good box scores near 1
        true_centre, true_size = 0.5 * (truth[:, :2] + truth[:, 2:]), truth[:, 2:] - truth[:, :2]
        # Geo-location uses the centre alone, so the centre is paid for once more, beside the overlap.
        off_centre = (predicted[:, :2] - true_centre).abs() / true_size
        off_size = (torch.log(predicted[:, 2:]) - torch.log(true_size)).abs()
        box_loss = (
            box_loss + (1.0 - overlap).sum() + 4.0 * off_centre.mean(1).sum() + 0.5 * off_size.mean(1).sum()
        )
        answers += len(responsible)
    score_loss = functional.binary_cross_entropy_with_logits(scores, wanted, reduction="sum")
    return (SCORE_WEIGHT * score_loss + box_loss) / max(answers, 1)
