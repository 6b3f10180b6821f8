// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "geoloc/io/detection/output_layout.hpp"
#include "model_file.hpp"

namespace geoloc::io {

/// What the file tells of its output, whose `shape` a first run gave. `named_classes`: how many names are
/// given besides those in the file, which count for more.
OutputFacts facts_of(const ModelFile& model, std::vector<std::int64_t> shape,
                     std::optional<int> named_classes);

/// Whether the network itself chooses the best boxes, by an export with nms=True or end2end=True; nullopt:
/// its metadata do not tell.
std::optional<bool> has_selected(const OnnxMetadata& metadata);

/// Refuses a model for a task that gives no boxes, by its metadata.
void refuse_other_tasks(const ModelFile& model);

/// The one form that the output has. Throws std::runtime_error naming the file, the fault and the remedy,
/// where it has none, or may have several.
OutputForm settled_form(const ModelFile& model, const OutputFacts& facts, OutputLayout wanted);

}  // namespace geoloc::io
