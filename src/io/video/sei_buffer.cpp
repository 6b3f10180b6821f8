// SPDX-License-Identifier: Apache-2.0
#include "sei_buffer.hpp"

#include <gst/video/video-sei.h>
#include <gst/video/video.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "geoloc/io/sei/sei_reader.hpp"
#include "geoloc/io/sei/sei_unit.hpp"
#include "io/gst/gst_handles.hpp"

namespace geoloc::io {
namespace {

/// The data of each message with our UUID, in order.
template <typename Take>
void for_each_record(GstBuffer* buffer, const Take& take) {
  gpointer state = nullptr;
  while (GstMeta* meta = gst_buffer_iterate_meta_filtered(
             buffer, &state, GST_VIDEO_SEI_USER_DATA_UNREGISTERED_META_API_TYPE)) {
    const auto& message = *reinterpret_cast<const GstVideoSEIUserDataUnregisteredMeta*>(meta);
    if (!std::equal(kTelemetryUuid.begin(), kTelemetryUuid.end(), message.uuid)) continue;
    take(std::string_view(reinterpret_cast<const char*>(message.data), message.size));
  }
}

/// The same picture with the messages before its first slice.
GstBuffer* with_units(GstBuffer* picture, const std::vector<std::uint8_t>& units) {
  GstMapInfo map;
  if (units.empty() || gst_buffer_map(picture, &map, GST_MAP_READ) == FALSE) return picture;
  const std::size_t at = first_slice(map.data, map.size);
  std::vector<std::uint8_t> bytes(map.data, map.data + at);
  bytes.insert(bytes.end(), units.begin(), units.end());
  bytes.insert(bytes.end(), map.data + at, map.data + map.size);
  gst_buffer_unmap(picture, &map);
  GstBuffer* const written = gst_buffer_new_memdup(bytes.data(), bytes.size());
  gst_buffer_copy_into(written, picture,
                       static_cast<GstBufferCopyFlags>(GST_BUFFER_COPY_FLAGS | GST_BUFFER_COPY_TIMESTAMPS), 0,
                       static_cast<gsize>(-1));
  gst_buffer_unref(picture);
  return written;
}

GstPadProbeReturn on_encoded(GstPad*, GstPadProbeInfo* info, gpointer) {
  GstBuffer* const picture = GST_PAD_PROBE_INFO_BUFFER(info);
  std::vector<std::uint8_t> units;
  for_each_record(picture, [&units](std::string_view record) {
    const auto unit = sei_unit(kTelemetryUuid, record);
    units.insert(units.end(), unit.begin(), unit.end());
  });
  GST_PAD_PROBE_INFO_DATA(info) = with_units(picture, units);
  return GST_PAD_PROBE_OK;
}

UnitPrefix unit_prefix(GstPad* pad) {
  const GstCapsPtr caps{gst_pad_get_current_caps(pad)};
  const bool has_format = caps && gst_caps_get_size(caps.get()) > 0;
  const char* const format =
      has_format ? gst_structure_get_string(gst_caps_get_structure(caps.get(), 0), "stream-format") : nullptr;
  const bool is_stream = format != nullptr && std::string_view(format) == "byte-stream";
  return is_stream ? UnitPrefix::kStartCode : UnitPrefix::kLength;
}

GstPadProbeReturn on_parsed_h265(GstPad* parsed, GstPadProbeInfo* info, gpointer) {
  GstBuffer* picture = GST_PAD_PROBE_INFO_BUFFER(info);
  GstMapInfo map;
  bool is_attached = false;  // by a newer GStreamer
  for_each_record(picture, [&is_attached](std::string_view) { is_attached = true; });
  if (is_attached || gst_buffer_map(picture, &map, GST_MAP_READ) == FALSE) return GST_PAD_PROBE_OK;
  const auto record = unregistered_data_h265(kTelemetryUuid, unit_prefix(parsed), map.data, map.size);
  gst_buffer_unmap(picture, &map);
  if (!record) return GST_PAD_PROBE_OK;
  picture = gst_buffer_make_writable(picture);
  attach_telemetry(picture, *record);
  GST_PAD_PROBE_INFO_DATA(info) = picture;
  return GST_PAD_PROBE_OK;
}

}  // namespace

std::optional<VideoTelemetry> telemetry_of(GstBuffer* picture) {
  std::optional<std::string_view> last;
  for_each_record(picture, [&last](std::string_view record) { last = record; });
  return last ? parse_video_telemetry(*last) : std::nullopt;
}

void attach_telemetry(GstBuffer* picture, std::string_view record) {
  auto uuid = kTelemetryUuid;
  std::vector<std::uint8_t> data(record.begin(), record.end());
  gst_buffer_add_video_sei_user_data_unregistered_meta(picture, uuid.data(), data.data(), data.size());
}

void read_telemetry_at(GstPad* parsed) {
  gst_pad_add_probe(parsed, GST_PAD_PROBE_TYPE_BUFFER, on_parsed_h265, nullptr, nullptr);
}

void write_telemetry_at(GstPad* encoded) {
  gst_pad_add_probe(encoded, GST_PAD_PROBE_TYPE_BUFFER, on_encoded, nullptr, nullptr);
}

}  // namespace geoloc::io
