// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "geoloc/io/live_page/live_document.hpp"
#include "geoloc/io/live_page/live_page_config.hpp"
#include "geoloc/io/live_page/picture_board.hpp"

// The parts of what the page is sent, as JSON texts. Values that are not finite become null; bytes that are
// not UTF-8 are replaced.
namespace geoloc::io::page_json {

std::string title(const LivePageTitle& title);
std::string status(const LiveStatus& status);
std::string view(const OutputFrame& frame);
std::string estimator(const EstimatorReport& report);
/// `picture`: number of its picture; 0: there is none.
std::string object(const ObjectReport& object, bool is_confirmed, std::uint64_t picture);

std::string targets(const std::vector<Eigen::Vector2d>& positions_in_enu);

/// The boxes of a picture, in the frame's pixels.
std::string picture(const LivePicture& picture, std::uint64_t number,
                    const std::vector<std::string>& class_names);

/// The settings that the page needs. `may_change`: whether it may write notes.
std::string settings(const LivePageConfig& config, bool may_change);

/// A position known in both frames, with which the page converts east and north to degrees.
std::string anchor(const ViewReport& view);
std::string anchor(const Geodetic& origin);

/// Of a fleet.
std::string flights(const std::vector<FlightReport>& reports);

/// Appends `"name":value` to an object that is written piece by piece.
void append(std::string& object, const std::string& name, const std::string& json);

/// `object` without its closing brace, and the details that a click on it shows.
std::string details(const ObjectReport& report, const std::string& object_json,
                    const std::string& history_json);

/// Milliseconds since 1970, UTC.
std::int64_t milliseconds(HostTime time);

}  // namespace geoloc::io::page_json
