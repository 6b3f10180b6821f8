// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

#include "geoloc/io/object_note.hpp"

// notes.jsonl of a recording: what people said of the objects, one note a line, in the order they came.
namespace geoloc::io {

/// One line, with its end.
std::string note_to_line(const NotedObject& noted);

/// Reads notes.jsonl; lines that are no notes are left out and counted, because no note is worth a replay.
std::vector<NotedObject> read_notes(std::istream& input, std::size_t& skipped_lines);

/// Appends to the notes of a recording that is complete. Throws std::runtime_error naming the file and the
/// reason.
void append_notes(const std::filesystem::path& folder, const std::vector<NotedObject>& notes);

}  // namespace geoloc::io
