// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "model_file.hpp"

namespace geoloc::io {

/// Whether this OpenCV runs ultralytics' exports, as it does from 4.8 on. 4.6 fails on them and 4.7 on some.
/// Both take a Split into given sizes for one into equal parts (opencv/opencv#23482), which gives wrong
/// results instead of an error.
bool opencv_runs_exports();

/// The operators of models that tools/onnx_for_opencv.py makes such that OpenCV 4.6 runs them.
inline constexpr std::string_view kConvertibleOperators =
    "Add AveragePool BatchNormalization Cast Clip Concat Constant ConstantOfShape Conv ConvTranspose Cos Div "
    "Exp "
    "Expand Flatten Gather Gemm GlobalAveragePool Identity LeakyRelu MatMul MaxPool Mul Pad Pow Range "
    "ReduceSum "
    "Relu Reshape Resize Shape Sigmoid Sin Slice Softmax Split Sqrt Squeeze Sub Tanh Transpose Unsqueeze";

/// Refuses what this OpenCV would run with wrong results. Throws std::runtime_error naming the file, the
/// fault and the remedy.
void refuse_what_opencv_mistakes(const ModelFile& model);

/// What to do about a model that OpenCV does not run: only what leads to one that runs.
std::string remedy_for_opencv(const ModelFile& model);

/// What to do about a model that OpenVINO does not run.
std::string remedy_for_openvino(const ModelFile& model);

/// What to do about an input whose size is open, with that back end.
std::string remedy_for_open_input(const ModelFile& model, Backend backend);

}  // namespace geoloc::io
