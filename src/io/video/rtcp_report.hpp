// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gst/gst.h>

#include <optional>

#include "geoloc/io/video/rtp_clock.hpp"

namespace geoloc::io {

/// The sender report in what rtpjitterbuffer's "handle-sync" signal hands out; nullopt where there is none.
std::optional<SenderReport> sender_report(const GstStructure* sync);

}  // namespace geoloc::io
