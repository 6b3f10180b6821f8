# SPDX-License-Identifier: Apache-2.0
"""The figures of docs/model.md, for the validation set and the held-back ones. Prints tables in Markdown, and writes
precision_recall.svg and failures.jpg."""

import argparse
from dataclasses import replace
from pathlib import Path

import numpy as np
import onnx
from tqdm import tqdm

import figures
from dataset import Example, load
from matching import Boxes, Detector, Found, detect, detect_twice, match
from measures import SIZES_PX, WHOLE, CentreErrors, centre_errors, curve, demanded, fit_sigma
from onnx_model import load_network, load_second_look

TABLE_THRESHOLDS = (0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9)
SIDE_CLASSES = ((10, 16), (16, 20), (20, 40), (40, 60), (60, 100), (100, 200))
TILT_CLASSES = ((0, 20), (20, 40), (40, 60))
LEAST_COUNT = 20  # a cell of a table with fewer boxes stays empty


def name_of(size: tuple[float, float]) -> str:
    return f"{size[0]:.0f} px and up" if np.isinf(size[1]) else f"{size[0]:.0f} to {size[1]:.0f} px"


def quality_table(found: list[Found], examples: list[Example], thresholds: list[float]) -> list[str]:
    names = [f"{name_of(size)} ({demanded(examples, size)})" for size in SIZES_PX]
    lines = ["| confidence | " + " | ".join(f"{name}: recall | precision" for name in names) + " |"]
    lines.append("|---" * (1 + 2 * len(names)) + "|")
    curves = [curve(found, examples, size) for size in SIZES_PX]
    for threshold in thresholds:
        values = [
            f"{recall:.3f} | {precision:.3f}" for recall, precision in (one.at(threshold) for one in curves)
        ]
        lines.append(f"| {threshold:.2f} | " + " | ".join(values) + " |")
    return lines


def sets_table(found: list[Found], sets: dict[str, list[Example]], threshold: float) -> list[str]:
    """Each set on its own, at one threshold; `found` has the images of all sets in sequence."""
    lines = [
        "| set | " + " | ".join(f"{name_of(size)}: targets | recall | precision" for size in SIZES_PX) + " |",
        "|---" * (1 + 3 * len(SIZES_PX)) + "|",
    ]
    begin = 0
    for name, examples in sets.items():
        own = [replace(one, picture=one.picture - begin) for one in found if 0 <= one.picture - begin < len(examples)]
        cells = []
        for size in SIZES_PX:
            recall, precision = curve(own, examples, size).at(threshold)
            cells.append(f"{demanded(examples, size)} | {recall:.3f} | {precision:.3f}")
        lines.append(f"| {name} | " + " | ".join(cells) + " |")
        begin += len(examples)
    return lines


def cell(errors: CentreErrors) -> str:
    if len(errors.side) < LEAST_COUNT:
        return ""
    sigma, bias = errors.sigma(), errors.bias()
    return f"{sigma[0]:.2f}, {sigma[1]:.2f} ({bias[0]:+.2f}, {bias[1]:+.2f})"


def centre_table(errors: CentreErrors) -> list[str]:
    whole = errors.where((errors.visible >= WHOLE) & ~errors.is_cut)
    lines = [
        "| shorter side | " + " | ".join(f"tilt {low}-{high}°" for low, high in TILT_CLASSES) + " | all |"
    ]
    lines.append("|---" * (len(TILT_CLASSES) + 2) + "|")
    for low, high in (*SIDE_CLASSES, (20, 60)):
        row = whole.where((whole.side >= low) & (whole.side < high))
        cells = [cell(row.where((row.tilt_deg >= a) & (row.tilt_deg < b))) for a, b in TILT_CLASSES]
        lines.append(f"| {low}-{high} px | " + " | ".join([*cells, cell(row)]) + " |")
    covered = (errors.visible < WHOLE) & ~errors.is_cut
    for name, chosen in (("partly covered", covered), ("cut by the picture's edge", errors.is_cut)):
        lines.append(f"| {name}" + " | " * (1 + len(TILT_CLASSES)) + f"{cell(errors.where(chosen))} |")
    return lines


def wrong_kinds(found: list[Found], examples: list[Example], threshold: float) -> str:
    """The kinds of things that wrong boxes are on, most frequent first."""
    counts: dict[str, int] = {}
    for one in found:
        if one.target >= 0 or not one.counts or one.confidence < threshold:
            continue
        example = examples[one.picture]
        off = np.abs(example.look_alikes[:, :2] - one.box[:2]) if len(example.kinds) else np.empty((0, 2))
        near = np.flatnonzero((off < 0.5 * example.look_alikes[:, 2:] + 2.0).all(1)) if len(off) else []
        kind = example.kinds[int(near[0])] if len(near) else "ground"
        counts[kind] = counts.get(kind, 0) + 1
    return ", ".join(f"{count} {kind}" for kind, count in sorted(counts.items(), key=lambda item: -item[1]))


def open_detector(model: Path, alone: bool) -> Detector:
    """The model, and the second-look model that it names, which is beside it."""
    network = load_network(model)
    name = metadata(model).get("geoloc_second_look")
    if alone or not name:
        return lambda image: detect(network, image)
    second_look = load_second_look(model.with_name(name))
    return lambda image: detect_twice(network, second_look, image)


def metadata(model: Path) -> dict[str, str]:
    return {entry.key: entry.value for entry in onnx.load(str(model)).metadata_props}


def answers_to(detector: Detector, examples: list[Example], name: str) -> list[Boxes]:
    return [
        detector(example.image) for example in tqdm(examples, desc=name, unit="picture", mininterval=2.0)
    ]


def sigma_line(found: list[Found], examples: list[Example], threshold: float) -> str:
    """Whether errors are as large as stated."""
    errors = centre_errors(found, examples, threshold)
    whole = errors.where((errors.visible >= WHOLE) & np.isfinite(errors.stated))
    if not len(whole.side):
        return "no sigma is stated"
    ratio = np.abs(whole.error) / whole.stated[:, None]
    return (
        f"errors of centres over stated sigma: median {np.median(ratio):.2f} (0.67 if normal), "
        f"within 1 sigma {np.mean(ratio < 1):.2f} (0.68), within 3 {np.mean(ratio < 3):.3f} (0.997)"
    )


def main() -> None:
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("model", type=Path)
    arguments.add_argument("--validation", type=Path, required=True)
    arguments.add_argument("--held-back", type=Path, nargs="+", required=True)
    arguments.add_argument("--figures", type=Path, help="folder for the pictures")
    arguments.add_argument(
        "--confidence", type=float, default=0.8, help="of the pictures and centres; detection.confidence [0.8]"
    )
    arguments.add_argument("--alone", action="store_true", help="without the second look")
    options = arguments.parse_args()
    detector = open_detector(options.model, options.alone)
    validation = load(options.validation)
    sets = {folder.name: load(folder) for folder in options.held_back}
    held_back = [example for examples in sets.values() for example in examples]
    found = match(answers_to(detector, validation, "validation"), validation)
    threshold = options.confidence
    thresholds = sorted({*TABLE_THRESHOLDS, threshold})
    print(
        "centre sigma fitted to the validation set: hypot({:.4f}, {:.4f} * size)".format(
            *(fit_sigma(centre_errors(found, validation, threshold)) or (np.nan, np.nan))
        )
    )
    print(f"stored in the model: {metadata(options.model).get('geoloc_centre_sigma_px', 'nothing')}\n")
    print("\n".join(quality_table(found, validation, thresholds)), "\n")

    answers = answers_to(detector, held_back, "held back")
    found = match(answers, held_back)
    print("\n".join(quality_table(found, held_back, thresholds)), "\n")
    print("\n".join(sets_table(found, sets, threshold)), "\n")
    everything = [replace(example, legible=np.ones(len(example.targets))) for example in held_back]
    print("With those that are not legible any more:\n")
    print("\n".join(quality_table(match(answers, everything), everything, thresholds)), "\n")
    print("\n".join(centre_table(centre_errors(found, held_back, threshold))), "\n")
    print(sigma_line(found, held_back, threshold), "\n")
    print("wrong boxes:", wrong_kinds(found, held_back, threshold))
    if options.figures:
        curves = {name_of(size): curve(found, held_back, size) for size in SIZES_PX}
        options.figures.mkdir(parents=True, exist_ok=True)
        (options.figures / "precision_recall.svg").write_text(figures.precision_recall(curves, threshold))
        sheet = figures.failures(found, held_back, threshold, SIZES_PX[0][0])
        figures.write(options.figures, "failures.jpg", sheet)


if __name__ == "__main__":
    main()
