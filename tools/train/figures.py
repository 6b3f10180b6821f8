# SPDX-License-Identifier: Apache-2.0
"""The pictures of docs/model.md."""

from pathlib import Path

import cv2
import numpy as np

from dataset import Example
from matching import Found
from measures import Curve

PLOT = (420, 320)  # width, height of the axes
MARGIN = (60, 20, 20, 45)  # left, top, right, bottom
LOWEST = 0.8  # of both axes
COLOURS = ("#0b6e99", "#c0392b")
TILE_PX, TILES, COLUMNS = 120, 24, 8
AROUND = 2.0  # a failure is shown with its surroundings, this many times its size
RED, GREEN = (230, 40, 40), (40, 200, 40)


def _place(recall: np.ndarray, precision: np.ndarray) -> np.ndarray:
    x = MARGIN[0] + PLOT[0] * (recall - LOWEST) / (1.0 - LOWEST)
    y = MARGIN[1] + PLOT[1] * (1.0 - precision) / (1.0 - LOWEST)
    return np.stack((x, y), 1)


def _axes() -> list[str]:
    left, top, right, bottom = MARGIN[0], MARGIN[1], MARGIN[0] + PLOT[0], MARGIN[1] + PLOT[1]
    parts = [f'<rect x="{left}" y="{top}" width="{PLOT[0]}" height="{PLOT[1]}" class="frame"/>']
    for tick in np.linspace(LOWEST, 1.0, 5):
        (x, y), *_ = _place(np.array([tick]), np.array([tick]))
        parts.append(f'<path d="M{x:.0f} {top}V{bottom}M{left} {y:.0f}H{right}" class="grid"/>')
        parts.append(f'<text x="{x:.0f}" y="{bottom + 16}" text-anchor="middle">{tick:.2f}</text>')
        parts.append(f'<text x="{left - 6}" y="{y + 4:.0f}" text-anchor="end">{tick:.2f}</text>')
    parts.append(f'<text x="{(left + right) / 2}" y="{bottom + 36}" text-anchor="middle">recall</text>')
    middle = (top + bottom) / 2
    parts.append(
        f'<text x="14" y="{middle}" text-anchor="middle" transform="rotate(-90 14 {middle})">precision</text>'
    )
    return parts


def precision_recall(curves: dict[str, Curve], threshold: float) -> str:
    """SVG; the dot is at the threshold."""
    width, height = MARGIN[0] + PLOT[0] + MARGIN[2], MARGIN[1] + PLOT[1] + MARGIN[3]
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" font-family="sans-serif" '
        'font-size="12">',
        "<style>.frame{fill:#fff;stroke:#444}.grid{stroke:#ddd}.line{fill:none;stroke-width:2}</style>",
        f'<rect width="{width}" height="{height}" fill="#fff"/>',
        *_axes(),
    ]
    for row, ((label, curve), colour) in enumerate(zip(curves.items(), COLOURS)):
        seen = (curve.recall >= LOWEST) & (curve.precision >= LOWEST)
        places = _place(curve.recall[seen], curve.precision[seen])
        kept = places[np.unique(places.round().astype(int), axis=0, return_index=True)[1]]
        points = " ".join(f"{x:.1f},{y:.1f}" for x, y in kept[np.argsort(kept[:, 0], kind="stable")])
        parts.append(f'<polyline points="{points}" class="line" stroke="{colour}"/>')
        (x, y), *_ = _place(*(np.array([value]) for value in curve.at(threshold)))
        parts.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="4" fill="{colour}"/>')
        parts.append(
            f'<text x="{MARGIN[0] + 12}" y="{MARGIN[1] + 24 + 18 * row}" fill="{colour}">{label}</text>'
        )
    return "\n".join([*parts, "</svg>\n"])


def _tile(image: np.ndarray, box: np.ndarray, colour: tuple[int, int, int], text: str) -> np.ndarray:
    side = max(int(AROUND * box[2:].max()), 24)
    left, top = (box[:2] - 0.5 * side).round().astype(int)
    padded = cv2.copyMakeBorder(np.ascontiguousarray(image), *[side] * 4, cv2.BORDER_CONSTANT)
    part = padded[top + side : top + 2 * side, left + side : left + 2 * side]
    tile = cv2.resize(part, (TILE_PX, TILE_PX), interpolation=cv2.INTER_CUBIC)
    cv2.rectangle(tile, (0, 0), (TILE_PX - 1, TILE_PX - 1), colour, 2)
    cv2.putText(tile, text, (5, TILE_PX - 7), cv2.FONT_HERSHEY_SIMPLEX, 0.4, (0, 0, 0), 3, cv2.LINE_AA)
    cv2.putText(tile, text, (5, TILE_PX - 7), cv2.FONT_HERSHEY_SIMPLEX, 0.4, (255, 255, 255), 1, cv2.LINE_AA)
    return tile


def failures(found: list[Found], examples: list[Example], threshold: float, least_px: float) -> np.ndarray:
    """The most confident wrong boxes (red, with their confidence), then missed targets (green, with
    their shorter side), as one picture."""
    wrong = [one for one in found if one.target < 0 and one.counts and one.confidence >= threshold]
    wrong = sorted((one for one in wrong if one.side_px >= least_px), key=lambda one: -one.confidence)
    hit = {(one.picture, one.target) for one in found if one.confidence >= threshold}
    missed = [
        (example.image, box)
        for picture, example in enumerate(examples)
        for target, box in enumerate(example.targets)
        if example.is_demanded[target] and box[2:].min() >= least_px and (picture, target) not in hit
    ]
    tiles = [_tile(examples[one.picture].image, one.box, RED, f"{one.confidence:.2f}") for one in wrong][
        : TILES // 2
    ]
    missed_tiles = [_tile(image, box, GREEN, f"{box[2:].min():.0f} px") for image, box in missed]
    tiles += missed_tiles[: TILES - len(tiles)]
    blank = np.full((TILE_PX, TILE_PX, 3), 255, np.uint8)
    tiles += [blank] * (-len(tiles) % COLUMNS)
    rows = [np.hstack(tiles[start : start + COLUMNS]) for start in range(0, len(tiles), COLUMNS)]
    return np.vstack(rows) if rows else blank


def write(folder: Path, name: str, picture: np.ndarray) -> None:
    folder.mkdir(parents=True, exist_ok=True)
    cv2.imwrite(str(folder / name), cv2.cvtColor(picture, cv2.COLOR_RGB2BGR), [cv2.IMWRITE_JPEG_QUALITY, 80])
