# SPDX-License-Identifier: Apache-2.0
"""Trains the target detector on pictures of `geoloc_sim --images`, from scratch, on a CPU."""

import argparse
import copy
import math
from pathlib import Path

import numpy as np
import torch
from tqdm import tqdm

from crops import Diet, confusable, training_batch
from dataset import INPUT_HEIGHT, INPUT_WIDTH, Example, load
from export import export
from loss import detection_loss
from matching import Found, Network, match
from measures import SIZES_PX, centre_errors, curve, fit_sigma
from model import TargetDetector, cells, decode

CROP_PX = 320
BATCH = 32
PEAK_RATE = 3e-3
WARM_UP_STEPS = 100
BROAD = Diet(targets=0.5, look_alikes=0.35, mosaics=0.6, confusable=1.0)  # to begin with,
HARD = Diet(targets=0.4, look_alikes=0.5, mosaics=0.75, confusable=5.0)  # and what it is
HARD_FROM = 0.58  # of the run on
AVERAGE_DECAY = 0.998  # the exported weights are a running mean over the last few hundred steps


THRESHOLDS = (0.3, 0.4, 0.5, 0.6, 0.7, 0.8)  # at which the progress is reported


def rate_at(step: int, steps: int) -> float:
    """Cosine decay after a linear start."""
    return (
        PEAK_RATE * min(1.0, (step + 1) / WARM_UP_STEPS) * 0.5 * (1.0 + math.cos(math.pi * step / steps))
        + 1e-5
    )


def update_average(average: TargetDetector, model: TargetDetector, step: int) -> None:
    decay = min(AVERAGE_DECAY, (step + 1) / (step + 10))
    with torch.no_grad():
        for mean, value in zip(average.state_dict().values(), model.state_dict().values()):
            if mean.is_floating_point():
                mean.mul_(decay).add_(value, alpha=1.0 - decay)
            else:
                mean.copy_(value)


class Training:
    """The state of a run: everything that a checkpoint holds."""

    def __init__(self, epochs: int, seed: int, bfloat16: bool):
        torch.manual_seed(seed)
        self.epochs, self.seed, self.epoch, self.bfloat16 = epochs, seed, 0, bfloat16
        self.model = TargetDetector()
        self.average = copy.deepcopy(self.model)
        self.optimizer = torch.optim.AdamW(self.model.parameters(), PEAK_RATE, weight_decay=5e-4)

    def save(self, file: Path) -> None:
        state = {name: getattr(self, name).state_dict() for name in ("model", "average", "optimizer")}
        part = file.with_suffix(".partial")
        torch.save(state | {"epoch": self.epoch, "epochs": self.epochs, "seed": self.seed}, part)
        part.replace(file)

    def restore(self, file: Path) -> None:
        state = torch.load(file, weights_only=False)
        if (state["epochs"], state["seed"]) != (self.epochs, self.seed):
            raise SystemExit(
                f"{file} belongs to a run with other --epochs or --seed; remove it to start anew"
            )
        for name in ("model", "average", "optimizer"):
            getattr(self, name).load_state_dict(state[name])
        self.epoch = state["epoch"]

    def run_epoch(self, examples: list[Example]) -> None:
        random = np.random.default_rng((self.seed, self.epoch))
        order = random.permutation(len(examples))
        batches = len(order) // BATCH
        is_hard = self.epoch >= HARD_FROM * self.epochs
        diet, partners = (HARD, confusable(examples)) if is_hard else (BROAD, examples)
        centres, strides = cells(CROP_PX, CROP_PX)
        self.model.train()
        progress = tqdm(range(batches), desc=f"epoch {self.epoch + 1}/{self.epochs}", mininterval=2.0)
        for batch in progress:
            step = self.epoch * batches + batch
            for group in self.optimizer.param_groups:
                group["lr"] = rate_at(step, self.epochs * batches)
            chosen = [examples[i] for i in order[batch * BATCH : (batch + 1) * BATCH]]
            pixels, targets, is_taught = training_batch(chosen, partners, CROP_PX, diet, random)
            images = torch.from_numpy(pixels).permute(0, 3, 1, 2).contiguous().float() / 255.0
            with torch.autocast("cpu", torch.bfloat16, enabled=self.bfloat16):
                boxes, scores = self.model(images)
            loss = detection_loss(
                decode(boxes.float(), centres, strides),
                scores.float(),
                [torch.from_numpy(values) for values in targets],
                [torch.from_numpy(values) for values in is_taught],
                centres,
                strides,
            )
            self.optimizer.zero_grad()
            loss.backward()
            torch.nn.utils.clip_grad_norm_(self.model.parameters(), 10.0)
            self.optimizer.step()
            update_average(self.average, self.model, step)
            progress.set_postfix(loss=f"{loss.item():.3f}", refresh=False)
        self.epoch += 1


def found_by(model: TargetDetector, examples: list[Example]) -> list[Found]:
    model.eval()

    def run(image: np.ndarray) -> np.ndarray:
        pixels = torch.tensor(image.transpose(2, 0, 1)[None].copy()).float() / 255.0
        with torch.no_grad():
            boxes, scores = model(pixels)
            return torch.cat((decode(boxes, *cells(*image.shape[:2])), scores.sigmoid()), 1)[0].numpy()

    return match(Network(INPUT_WIDTH, INPUT_HEIGHT, run), examples)


def report(found: list[Found], examples: list[Example]) -> str:
    lines = []
    curves = [curve(found, examples, size) for size in SIZES_PX]
    for threshold in THRESHOLDS:
        points = [one.at(threshold) for one in curves]
        text = ", ".join(
            f"{low:.0f}-{high:.0f} px: {recall:.4f} / {precision:.4f}"
            for (low, high), (recall, precision) in zip(SIZES_PX, points)
        )
        lines.append(f"  at {threshold}: recall / precision of {text}")
    errors = centre_errors(found, examples, THRESHOLDS[0])
    usual = errors.where((errors.side >= 20) & (errors.side < 60))
    if len(usual.side):
        lines.append(
            f"  centre of 20-60 px: bias {usual.bias().round(2)} px, sigma {usual.sigma().round(2)} px"
        )
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
    arguments.add_argument("--epochs", type=int, default=32)
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
    training = Training(options.epochs, options.seed, options.bfloat16)
    checkpoint = options.out.with_suffix(".checkpoint")
    if checkpoint.exists():
        training.restore(checkpoint)
    examples = [example for folder in options.train for example in load(folder)]
    validation = load(options.validation)
    while training.epoch < options.epochs:
        training.run_epoch(examples)
        training.save(checkpoint)
        if training.epoch % options.judge_every == 0 or training.epoch == options.epochs:
            print(report(found_by(training.average, validation), validation), flush=True)
    errors = centre_errors(found_by(training.average, validation), validation, THRESHOLDS[0])
    export(training.average.eval(), options.out, fit_sigma(errors))
    print(f"{options.out}: {options.out.stat().st_size / 1e6:.2f} MB")


if __name__ == "__main__":
    main()
