#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Rewrites an ONNX export of a YOLO detector (v8, 11, 12 …) so that OpenCV 4.6 (Debian 12) runs it.

OpenCV 4.6 neither folds constants, nor broadcasts them, nor supports the form that operators have from opset 13 on:
    python3 tools/onnx_for_opencv.py yolo11n.onnx yolo11n_opencv.onnx
An export with dynamic=True leaves its input size open; set it with --input-size. Needs the packages onnx and onnxruntime:
both models are run on the same pictures, and the result is written only if they agree (boxes to 0.01 px, scores to 0.0001).
"""

import argparse
import os
from pathlib import Path

import numpy as np
import onnx
from onnx import helper, numpy_helper
from onnx.reference import ReferenceEvaluator

TARGET_OPSET = 12
BOX_TOLERANCE_PX, SCORE_TOLERANCE = 0.01, 1e-4
BROADCASTING = {"Add", "Sub", "Mul", "Div"}
# Operators whose form is the same in opset 12 and opset 21, as far as detectors use them.
UNCHANGED = BROADCASTING | {
    "AveragePool", "BatchNormalization", "Clip", "Concat", "Conv", "ConvTranspose", "Cos", "Exp", "Flatten", "Gemm",
    "GlobalAveragePool", "LeakyRelu", "MatMul", "MaxPool", "Pad", "Pow", "Relu", "Sigmoid", "Sin", "Slice", "Sqrt",
    "Tanh", "Transpose",
}  # fmt: skip
REWRITTEN = {"Reshape", "ReduceSum", "Resize", "Softmax", "Split", "Squeeze", "Unsqueeze"}
# Operators on shapes, which are constants once the input's size is.
FOLDED = {"Cast", "Constant", "ConstantOfShape", "Expand", "Gather", "Identity", "Range", "Shape"}
OPENVINO = "run the export as it is with --backend openvino"


class Graph:
    """A graph with its constants and the shapes of its values at hand."""

    def __init__(self, model: onnx.ModelProto):
        self.model = model
        self.proto = model.graph
        self.opset = next(entry.version for entry in model.opset_import if entry.domain in ("", "ai.onnx"))
        self.constants = {tensor.name: numpy_helper.to_array(tensor) for tensor in self.proto.initializer}
        inferred = onnx.shape_inference.infer_shapes(model).graph
        self.shapes = {
            value.name: [dimension.dim_value for dimension in value.type.tensor_type.shape.dim]
            for value in (*inferred.value_info, *inferred.input, *inferred.output)
        }

    def is_constant(self, name: str) -> bool:
        return name == "" or name in self.constants

    def shape(self, name: str) -> list[int]:
        shape = self.shapes.get(name, [])
        if not shape or min(shape) < 1:
            raise SystemExit(f"the shape of {name} is not known: export with a fixed input size (dynamic=False)")
        return shape

    def store_constants(self) -> None:
        used = {name for node in self.proto.node for name in node.input}
        del self.proto.initializer[:]
        self.proto.initializer.extend(
            numpy_helper.from_array(np.asarray(value, order="C"), name)  # ascontiguousarray would make lists of scalars
            for name, value in self.constants.items()
            if name in used
        )
        del self.proto.value_info[:]


def attribute(node: onnx.NodeProto, name: str, default=None):
    return next((helper.get_attribute_value(found) for found in node.attribute if found.name == name), default)


def set_attribute(node: onnx.NodeProto, name: str, value) -> None:
    remove_attribute(node, name)
    if value is not None:
        node.attribute.append(helper.make_attribute(name, value))


def remove_attribute(node: onnx.NodeProto, name: str) -> None:
    for found in [found for found in node.attribute if found.name == name]:
        node.attribute.remove(found)


def fold_constants(graph: Graph) -> None:
    kept = []
    for node in graph.proto.node:
        if node.op_type == "Shape" and min(graph.shapes.get(node.input[0], [0])) > 0:
            values = [np.array(graph.shapes[node.input[0]], np.int64)[attribute(node, "start", 0) : attribute(node, "end")]]
        elif all(graph.is_constant(name) for name in node.input):
            evaluator = ReferenceEvaluator(node, opsets={"": graph.opset})
            values = evaluator.run(None, {name: graph.constants[name] for name in node.input if name})
        else:
            kept.append(node)
            continue
        graph.constants.update(zip(node.output, (np.asarray(value) for value in values)))
    del graph.proto.node[:]
    graph.proto.node.extend(kept)


def input_to_attribute(graph: Graph, node: onnx.NodeProto, index: int, name: str) -> None:
    """Sizes and axes became inputs in opset 13."""
    if len(node.input) <= index:
        return
    if not graph.is_constant(node.input[index]):
        raise SystemExit(f"{node.op_type} {node.name}: its {name} are computed at run time")
    if node.input[index]:
        set_attribute(node, name, graph.constants[node.input[index]].ravel().tolist())
    del node.input[index:]


def equal_split(graph: Graph, node: onnx.NodeProto) -> None:
    remove_attribute(node, "num_outputs")
    input_to_attribute(graph, node, 1, "split")
    if attribute(node, "split") is None:
        axis = attribute(node, "axis", 0)
        set_attribute(node, "split", [graph.shape(output)[axis] for output in node.output])


def softmax_over_last_axis(graph: Graph, node: onnx.NodeProto) -> list[onnx.NodeProto]:
    """Before opset 13, Softmax ran over all axes from the given one on, which is the same only for the last axis."""
    rank = len(graph.shape(node.input[0]))
    axis = attribute(node, "axis", -1) % rank
    set_attribute(node, "axis", rank - 1)
    if axis == rank - 1:
        return [node]
    order = list(range(rank))
    order[axis], order[-1] = order[-1], order[axis]
    before = helper.make_node("Transpose", [node.input[0]], [f"{node.name}_in"], perm=order)
    after = helper.make_node("Transpose", [f"{node.name}_out"], [node.output[0]], perm=order)
    node.input[0], node.output[0] = before.output[0], after.input[0]
    return [before, node, after]


def at_opset_12(graph: Graph, node: onnx.NodeProto) -> list[onnx.NodeProto]:
    if node.op_type == "Split":
        equal_split(graph, node)
    elif node.op_type in ("ReduceSum", "Squeeze", "Unsqueeze"):
        input_to_attribute(graph, node, 1, "axes")
    elif node.op_type == "Softmax":
        return softmax_over_last_axis(graph, node)
    elif node.op_type == "Reshape":
        remove_attribute(node, "allowzero")
    elif node.op_type == "Resize":
        if len(node.input) > 1 and node.input[1] == "":
            node.input[1] = "no_region_of_interest"
            graph.constants[node.input[1]] = np.zeros(0, np.float32)
    return [node]


def refuse_unknown(graph: Graph) -> None:
    if any(tensor.data_type == onnx.TensorProto.FLOAT16 for tensor in graph.proto.initializer):
        raise SystemExit(f"OpenCV 4.6 does not run numbers of 16 bits: {OPENVINO}, or export it with half=False")
    unknown = sorted({node.op_type for node in graph.proto.node} - UNCHANGED - REWRITTEN)
    if not unknown:
        return
    properties = {entry.key: entry.value for entry in graph.model.metadata_props}
    chooses = properties.get("end2end") == "True" or "'nms': True" in properties.get("args", "")
    export = ", or export it so that it does not choose boxes itself (without nms=, or with end2end=False)"
    raise SystemExit(f"OpenCV 4.6 does not run {', '.join(unknown)}: {OPENVINO}{export if chooses else ''}")


def lower_opset(graph: Graph) -> None:
    if graph.opset > TARGET_OPSET:
        lowered = [new for node in graph.proto.node for new in at_opset_12(graph, node)]
        del graph.proto.node[:]
        graph.proto.node.extend(lowered)


def expand_constants(graph: Graph) -> None:
    for number, node in enumerate(graph.proto.node):
        if node.op_type not in BROADCASTING:
            continue
        for index, name in enumerate(node.input):
            value = graph.constants.get(name)
            if value is None or value.size == 1 or list(value.shape) == graph.shape(node.output[0]):
                continue
            node.input[index] = f"{name}_for_{number}"
            graph.constants[node.input[index]] = np.broadcast_to(value, graph.shape(node.output[0]))


def set_opset(model: onnx.ModelProto, opset: int) -> None:
    for entry in model.opset_import:
        if entry.domain in ("", "ai.onnx"):
            entry.version = opset
    model.ir_version = min(model.ir_version, 7)


def fix_input_size(model: onnx.ModelProto, size: tuple[int, int] | None) -> None:
    """Batch 1, and [width, height] where the model leaves them open."""
    shape = model.graph.input[0].type.tensor_type.shape.dim
    if len(shape) != 4:
        raise SystemExit(f"its input has {len(shape)} dimensions, not [1, 3, height, width]")
    wanted = [1, 3, size[1], size[0]] if size else [1, 3, 0, 0]
    for dimension, length in zip(shape, wanted):
        if dimension.dim_value < 1:
            if length < 1:
                raise SystemExit("it leaves its input's size open: give --input-size WIDTH HEIGHT")
            dimension.dim_value = length
        elif length not in (0, dimension.dim_value):
            raise SystemExit(f"its input is {dimension.dim_value} where {length} is wanted: export it so")
    for value in (*model.graph.output, *model.graph.value_info):  # they may refer to the open sizes
        value.type.tensor_type.ClearField("shape")


def is_open(model: onnx.ModelProto) -> bool:
    return any(dimension.dim_value < 1 for dimension in model.graph.input[0].type.tensor_type.shape.dim)


def convert(model: onnx.ModelProto, size: tuple[int, int] | None = None) -> onnx.ModelProto:
    if size or is_open(model):
        fix_input_size(model, size)
    nodes = None
    while nodes != len(model.graph.node):  # constants determine more shapes, which are constants again
        nodes = len(model.graph.node)
        graph = Graph(model)
        fold_constants(graph)
        graph.store_constants()
    graph = Graph(model)
    refuse_unknown(graph)
    graph.shape(model.graph.input[0].name)
    lower_opset(graph)
    expand_constants(graph)
    graph.store_constants()
    set_opset(model, min(graph.opset, TARGET_OPSET))
    model.graph.CopyFrom(onnx.shape_inference.infer_shapes(model).graph)  # the output's too
    del model.graph.value_info[:]
    onnx.checker.check_model(model)
    return model


def pictures(shape: list[int]) -> list[np.ndarray]:
    """Noise, and a smooth image with a bright square, for which a network's outputs differ widely."""
    generator = np.random.default_rng(0)
    ramp = np.linspace(0, 0.6, shape[3], dtype=np.float32) * np.linspace(0.3, 1, shape[2], dtype=np.float32)[:, None]
    smooth = np.broadcast_to(ramp, shape).copy()
    smooth[:, :, shape[2] // 3 : shape[2] // 2, shape[3] // 3 : shape[3] // 2] = 1
    return [generator.random(shape, np.float32), smooth]


def differences(before: Path, after: onnx.ModelProto) -> tuple[float, float]:
    """The largest of the boxes [px] and of the scores, by ONNX Runtime; NaN where either gives one."""
    import onnxruntime

    options = {"providers": ["CPUExecutionProvider"]}
    sessions = [onnxruntime.InferenceSession(str(before), **options)]
    sessions.append(onnxruntime.InferenceSession(after.SerializeToString(), **options))
    value = sessions[1].get_inputs()[0]
    boxes = scores = 0.0
    for picture in pictures(value.shape):
        outputs = [session.run(None, {session.get_inputs()[0].name: picture})[0] for session in sessions]
        difference = np.abs(outputs[0] - outputs[1])
        boxes = np.maximum(boxes, difference[:, :4].max())  # NaN stays
        scores = np.maximum(scores, difference[:, 4:].max())
    return float(boxes), float(scores)


def write(model: onnx.ModelProto, file: Path) -> None:
    beside = file.with_name(f"{file.name}.partial-{os.getpid()}")
    onnx.save(model, str(beside))
    beside.replace(file)


def main() -> None:
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("source", type=Path, help="the export")
    arguments.add_argument("result", type=Path, help="the file to write")
    arguments.add_argument("--input-size", type=int, nargs=2, metavar=("WIDTH", "HEIGHT"), help="px, where it is open")
    arguments.add_argument("--unchecked", action="store_true", help="do not compare the two (no onnxruntime)")
    options = arguments.parse_args()
    model = convert(onnx.load(str(options.source)), options.input_size)
    checked = "not compared"
    if not options.unchecked:
        try:
            boxes, scores = differences(options.source, model)
        except ImportError:
            raise SystemExit("onnxruntime is not installed (pip install onnxruntime): --unchecked does without") from None
        checked = f"boxes differ by {boxes:.1e} px, scores by {scores:.1e}"
        if not (boxes <= BOX_TOLERANCE_PX and scores <= SCORE_TOLERANCE):
            raise SystemExit(f"{options.source}: {checked} after conversion; {options.result} is not written")
    write(model, options.result)
    print(f"{options.result}: {checked}")


if __name__ == "__main__":
    main()
