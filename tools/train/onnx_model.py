# SPDX-License-Identifier: Apache-2.0
"""The exported networks in ONNX Runtime."""

from pathlib import Path

import numpy as np
import onnxruntime

from matching import Network, SecondLook
from patches import in_batches


def open_session(file: Path, threads: int) -> onnxruntime.InferenceSession:
    options = onnxruntime.SessionOptions()
    options.intra_op_num_threads = threads
    return onnxruntime.InferenceSession(str(file), options, providers=["CPUExecutionProvider"])


def load_network(file: Path, threads: int = 2) -> Network:
    session = open_session(file, threads)
    images = session.get_inputs()[0]

    def run(image: np.ndarray) -> np.ndarray:
        pixels = np.ascontiguousarray(image.transpose(2, 0, 1)[None], np.float32) / np.float32(255.0)
        return session.run(None, {images.name: pixels})[0][0]

    return Network(images.shape[3], images.shape[2], run)


def load_second_look(file: Path, threads: int = 2) -> SecondLook:
    session = open_session(file, threads)
    patches = session.get_inputs()[0]

    def run(batch: np.ndarray) -> np.ndarray:
        return session.run(None, {patches.name: batch})[0]

    return lambda pixels: in_batches(pixels, patches.shape[0], run)
