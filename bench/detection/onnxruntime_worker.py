# SPDX-License-Identifier: Apache-2.0
"""onnxruntime_worker.py MODEL THREADS PICTURE: the same question as detection_worker's, answered with ONNX Runtime's Python
package and what a Python programmer puts around it: OpenCV's resize, blobFromImage and NMSBoxes, and numpy."""

import sys
import time

import cv2
import numpy as np
import onnxruntime

CONFIDENCE, OVERLAP = 0.55, 0.5  # geoloc's defaults


class Detector:
    def __init__(self, model: str, threads: int):
        options = onnxruntime.SessionOptions()
        options.intra_op_num_threads = threads
        self.session = onnxruntime.InferenceSession(model, options, providers=["CPUExecutionProvider"])
        self.input = self.session.get_inputs()[0]
        self.canvas = np.full((*self.input.shape[2:], 3), 114, np.uint8)

    def detect(self, picture: np.ndarray) -> np.ndarray:
        """Rows of left, top, width, height [px of the picture]."""
        scale = min(self.canvas.shape[0] / picture.shape[0], self.canvas.shape[1] / picture.shape[1])
        height, width = (round(length * scale) for length in picture.shape[:2])
        top, left = (self.canvas.shape[0] - height) // 2, (self.canvas.shape[1] - width) // 2
        cv2.resize(picture, (width, height), self.canvas[top : top + height, left : left + width])
        blob = cv2.dnn.blobFromImage(self.canvas, 1 / 255, swapRB=True)
        output = self.session.run(None, {self.input.name: blob})[0][0]
        scores = output[4:].max(0)
        kept = np.flatnonzero(scores >= CONFIDENCE)
        boxes, scores, classes = output[:4, kept].T, scores[kept], output[4:, kept].argmax(0)
        boxes[:, :2] -= boxes[:, 2:] / 2
        kept = np.array(cv2.dnn.NMSBoxesBatched(boxes, scores, classes, CONFIDENCE, OVERLAP), int)
        return (boxes[kept] - [left, top, 0, 0]) / scale


def main() -> None:
    detector, picture = Detector(sys.argv[1], int(sys.argv[2])), cv2.imread(sys.argv[3])
    cv2.setNumThreads(int(sys.argv[2]))
    for line in sys.stdin:
        looks = int(line)
        begun = time.perf_counter()
        for _ in range(looks):
            found = detector.detect(picture)
        print(1e3 * (time.perf_counter() - begun) / looks, len(found), flush=True)


if __name__ == "__main__":
    main()
