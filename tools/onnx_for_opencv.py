#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Rewrites an ONNX export of a YOLO detector (v8, 11, 12 …) so that OpenCV 4.6, Debian 12's, runs it.

OpenCV 4.6 neither folds constants, nor broadcasts them, nor knows the operators in their form of opset 13 and later:
    python3 tools/onnx_for_opencv.py yolo11n.onnx yolo11n_opencv.onnx
The input's size must be fixed. Needs the package onnx; where onnxruntime is installed too, both models are run on the
same input and compared.
"""

import argparse
from pathlib import Path

import numpy as np
import onnx
from onnx import helper, numpy_helper
from onnx.reference import ReferenceEvaluator

TARGET_OPSET = 12
BROADCASTING = {"Add", "Sub", "Mul", "Div"}
# Operators whose form in opset 12 is that of opset 21, as far as detectors use them.
UNCHANGED = BROADCASTING | {
    "AveragePool", "BatchNormalization", "Clip", "Concat", "Conv", "ConvTranspose", "Exp", "Flatten", "Gemm",
    "GlobalAveragePool", "LeakyRelu", "MatMul", "MaxPool", "Pad", "Pow", "Relu", "Sigmoid", "Slice", "Sqrt", "Tanh",
    "Transpose",
}  # fmt: skip


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
            numpy_helper.from_array(np.ascontiguousarray(value), name)
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
    """Before opset 13, Softmax ran over all axes from the given one on: the same only for the last."""
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
    elif node.op_type not in UNCHANGED:
        raise SystemExit(f"{node.op_type} of opset {graph.opset} is not known here: export with opset=12")
    return [node]


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


def convert(model: onnx.ModelProto) -> onnx.ModelProto:
    for _ in range(2):  # constants tell further shapes, and those are constants again
        graph = Graph(model)
        fold_constants(graph)
        graph.store_constants()
    graph = Graph(model)
    graph.shape(model.graph.input[0].name)
    lower_opset(graph)
    expand_constants(graph)
    graph.store_constants()
    set_opset(model, min(graph.opset, TARGET_OPSET))
    onnx.checker.check_model(model)
    return model


def largest_difference(before: Path, after: Path) -> float | None:
    """Of the two models' outputs for the same noise, by ONNX Runtime; None where that is not installed."""
    try:
        import onnxruntime
    except ImportError:
        return None
    sessions = [onnxruntime.InferenceSession(str(file), providers=["CPUExecutionProvider"]) for file in (before, after)]
    value = sessions[0].get_inputs()[0]
    noise = np.random.default_rng(0).random(value.shape, np.float32)
    outputs = [session.run(None, {value.name: noise})[0] for session in sessions]
    return float(np.abs(outputs[0] - outputs[1]).max())


def main() -> None:
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("source", type=Path, help="the export")
    arguments.add_argument("result", type=Path, help="the file to write")
    options = arguments.parse_args()
    onnx.save(convert(onnx.load(str(options.source))), str(options.result))
    difference = largest_difference(options.source, options.result)
    checked = "not compared: onnxruntime is not installed" if difference is None else f"outputs differ by {difference:.1e}"
    print(f"{options.result}: {checked}")


if __name__ == "__main__":
    main()
