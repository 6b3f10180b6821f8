// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gst/gst.h>

#include <optional>
#include <string_view>

#include "geoloc/io/sei/video_telemetry.hpp"

// user_data_unregistered messages on GStreamer's buffers: parsers put them there, decoders, encoders and
// converters hand them on.
namespace geoloc::io {

/// The telemetry of a picture. Of several records the last one counts, whatever it holds.
std::optional<VideoTelemetry> telemetry_of(GstBuffer* picture);

/// The picture, of which the caller has the only reference, gets the record.
void attach_telemetry(GstBuffer* picture, std::string_view record);

/// Attaches what H.265's pictures carry to those that leave a parser: that of GStreamer 1.22 does it for
/// H.264 alone.
void read_telemetry_at(GstPad* parsed);

/// Writes what is attached to an encoder's pictures into its stream, which must be H.264's byte stream in
/// whole access units: no encoder of GStreamer 1.22 does.
void write_telemetry_at(GstPad* encoded);

}  // namespace geoloc::io
