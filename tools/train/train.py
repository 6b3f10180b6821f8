# SPDX-License-Identifier: Apache-2.0
"""Trains the target detector on images of `geoloc_sim --images`, from scratch, on a CPU."""

import argparse
from pathlib import Path

import numpy as np
import torch

from crops import training_batch
from dataset import INPUT_HEIGHT, INPUT_WIDTH, Example, load
from export import export
from loss import detection_loss
from matching import Found, Network, detect, match
from measures import SIZES_PX, centre_errors, curve, fit_sigma
from model import TargetDetector, cells, decode
from optimisation import Run

CROP_PX = 320
BATCH = 32
PEAK_RATE = 3e-3

THRESHOLDS = (0.05, 0.1, 0.2, 0.4)  # at which progress is reported


def train_epoch(run: Run, examples: list[Example]) -> None:
    random = np.random.default_rng((run.seed, run.epoch))
    order = random.permutation(len(examples))
    centres, strides = cells(CROP_PX, CROP_PX)

    def batch_of(index: int) -> tuple[np.ndarray, list[np.ndarray], list[np.ndarray]]:
        chosen = [examples[i] for i in order[index * BATCH : (index + 1) * BATCH]]
        return training_batch(chosen, examples, CROP_PX, random)

    def loss_of(batch: tuple[np.ndarray, list[np.ndarray], list[np.ndarray]]) -> torch.Tensor:
        pixels, boxes_there, roles = batch
        images = torch.from_numpy(pixels).permute(0, 3, 1, 2).contiguous().float() / 255.0
        with torch.autocast("cpu", torch.bfloat16, enabled=run.bfloat16):
            boxes, scores = run.model(images)
        return detection_loss(
            decode(boxes.float(), centres, strides),
            scores.float(),
            [torch.from_numpy(values) for values in boxes_there],
            [torch.from_numpy(values) for values in roles],
            centres,
            strides,
        )

    run.run_epoch(batch_of, loss_of)


def found_by(model: TargetDetector, examples: list[Example]) -> list[Found]:
    model.eval()

    def run(image: np.ndarray) -> np.ndarray:
        pixels = torch.tensor(image.transpose(2, 0, 1)[None].copy()).float() / 255.0
        with torch.no_grad():
            boxes, scores = model(pixels)
            return torch.cat((decode(boxes, *cells(*image.shape[:2])), scores.sigmoid()), 1)[0].numpy()

    network = Network(INPUT_WIDTH, INPUT_HEIGHT, run)
    return match([detect(network, example.image) for example in examples], examples)


def report(found: list[Found], examples: list[Example]) -> str:
    lines = []
    curves = [curve(found, examples, size) for size in SIZES_PX]
    for threshold in THRESHOLDS:
        text = ", ".join(
            f"{low:.0f}-{high:.0f} px: {one.at(threshold)[0]:.4f}"
            for (low, high), one in zip(SIZES_PX, curves)
        )
        boxes = sum(one.confidence >= threshold for one in found) / len(examples)
        lines.append(f"  at {threshold}: {boxes:.1f} boxes a picture, recall of {text}")
    return "\n".join(lines)


def parse_arguments() -> argparse.Namespace:
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument(
        "--train", type=Path, nargs="+", required=True, help="folders of geoloc_sim --images"
    )
    arguments.add_argument(
        "--validation", type=Path, required=True, help="the same with another seed, for judging"
    )
    arguments.add_argument(
        "--out", type=Path, required=True, help="the .onnx to write; the checkpoint stands beside it"
    )
    arguments.add_argument("--epochs", type=int, default=36)
    arguments.add_argument("--seed", type=int, default=0)
    arguments.add_argument("--threads", type=int, default=2)
    arguments.add_argument(
        "--bfloat16", action="store_true", help="faster on processors that have it (avx512_bf16)"
    )
    arguments.add_argument("--judge-every", type=int, default=8, help="epochs between two judgements")
    return arguments.parse_args()


def main() -> None:
    options = parse_arguments()
    torch.set_num_threads(options.threads)
    torch.manual_seed(options.seed)
    examples = [example for folder in options.train for example in load(folder, with_legibility=False)]
    validation = load(options.validation)
    run = Run(
        TargetDetector(), PEAK_RATE, options.epochs, len(examples) // BATCH, options.seed, options.bfloat16
    )
    checkpoint = options.out.with_suffix(".checkpoint")
    if checkpoint.exists():
        run.restore(checkpoint)
    while run.epoch < options.epochs:
        train_epoch(run, examples)
        run.save(checkpoint)
        if run.epoch % options.judge_every == 0 or run.epoch == options.epochs:
            print(report(found_by(run.average, validation), validation), flush=True)
    errors = centre_errors(found_by(run.average, validation), validation, THRESHOLDS[0])
    export(run.average.eval(), options.out, fit_sigma(errors))
    print(f"{options.out}: {options.out.stat().st_size / 1e6:.2f} MB")


if __name__ == "__main__":
    main()
