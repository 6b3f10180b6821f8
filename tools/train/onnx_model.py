# SPDX-License-Identifier: Apache-2.0
"""An exported detector in ONNX Runtime."""

from pathlib import Path

import numpy as np
import onnxruntime

from matching import Network


def load_network(file: Path, threads: int = 2) -> Network:
    options = onnxruntime.SessionOptions()
    options.intra_op_num_threads = threads
    session = onnxruntime.InferenceSession(str(file), options, providers=["CPUExecutionProvider"])
    images = session.get_inputs()[0]

    def run(image: np.ndarray) -> np.ndarray:
        pixels = np.ascontiguousarray(image.transpose(2, 0, 1)[None], np.float32) / np.float32(255.0)
        return session.run(None, {images.name: pixels})[0][0]

    return Network(images.shape[3], images.shape[2], run)
