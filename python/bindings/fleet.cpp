// SPDX-License-Identifier: Apache-2.0
// Summaries of flights, and the map that is made of many.
#include <nanobind/nanobind.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "geoloc/fleet/flight_summary.hpp"
#include "geoloc/fleet/fusion.hpp"
#include "geoloc/io/fleet/fused_report.hpp"
#include "geoloc/io/fleet/summary_file.hpp"
#include "geoloc/io/output/geoid.hpp"
#include "rows.hpp"
#include "values.hpp"

namespace geoloc::python {
namespace {

nb::bytes to_bytes(const std::string& text) {
  return nb::bytes(text.data(), text.size());
}

FlightSummary parse(const nb::bytes& content, const std::string& name) {
  return or_value_error([&] {
    const std::string_view bytes(content.c_str(), content.size());
    const nb::gil_scoped_release unlocked;
    return io::parse_summary(bytes, name);
  });
}

nb::bytes objects_of(const FlightSummary& summary) {
  std::vector<SummaryObjectRow> rows;
  for (const FlightSummary::Object& object : summary.objects) rows.push_back(row_of(object));
  return bytes_of(rows);
}

/// Row by row.
nb::bytes shared_error_of(const FlightSummary& summary) {
  const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> rows = summary.shared_error;
  return nb::bytes(rows.data(), static_cast<std::size_t>(rows.size()) * sizeof(double));
}

nb::bytes apart_of(const FlightSummary& summary) {
  std::vector<std::array<std::int64_t, 2>> pairs;
  for (const auto& [first, second] : summary.apart) pairs.push_back({first, second});
  return bytes_of(pairs);
}

/// Those that are not told stay as they are.
struct FusionSettings {
  std::optional<double> quarantine_gate, most_shift_m, sigma_home_m;

  FusionConfig config() const {
    FusionConfig config;
    config.quarantine_gate = quarantine_gate.value_or(config.quarantine_gate);
    config.most_shift_m = most_shift_m.value_or(config.most_shift_m);
    config.sigma_home_m = sigma_home_m.value_or(config.sigma_home_m);
    return config;
  }
};

nb::tuple three(const Eigen::Vector3d& vector) {
  return nb::make_tuple(vector.x(), vector.y(), vector.z());
}

nb::tuple names_of_parts(const FusedMap& map, const FusedFlight& flight) {
  nb::list names;
  for (const std::size_t part : flight.parts) names.append(map.flights[part].identity.flight);
  return nb::tuple(names);
}

Fields to_dict(const FusedMap& map, const FusedFlight& flight) {
  Fields fields;
  fields["flight"] = flight.identity.flight;
  fields["vehicle"] = flight.identity.vehicle;
  fields["sequence"] = flight.identity.sequence;
  fields["verdict"] = io::word_of(flight.verdict);
  fields["reason"] = flight.reason;
  fields["objects"] = flight.objects;
  fields["shared_objects"] = flight.shared_objects;
  fields["common_error_m"] = three(flight.common_error_m);
  fields["sigma_m"] = three(flight.sigma_m);
  fields["chi2"] = flight.chi2;
  fields["parts"] = names_of_parts(map, flight);
  return fields;
}

/// The map of many flights, ready to be told.
class Fused {
 public:
  Fused(const std::vector<const FlightSummary*>& summaries, const FusionSettings& settings,
        const std::vector<std::string>& class_names) {
    const nb::gil_scoped_release unlocked;
    Fleet fleet;
    for (const FlightSummary* const summary : summaries) take(*summary, fleet);
    map_ = fuse(fleet, settings.config());
    reports_ = io::report_objects(map_, class_names);
    io::Geoid().complete(reports_);
  }

  nb::bytes objects() const {
    return bytes_of(
        rows_of<FusedObjectRow>(map_.objects, map_.frame, [](const FusedObject&) { return true; }));
  }

  /// Rows of places: among the objects, among the flights, among that flight's objects.
  nb::bytes contributions() const {
    std::vector<std::array<std::int64_t, 3>> rows;
    for (std::size_t i = 0; i < map_.objects.size(); ++i) {
      for (const Contribution& one : map_.objects[i].contributions)
        rows.push_back({static_cast<std::int64_t>(i), static_cast<std::int64_t>(one.flight),
                        static_cast<std::int64_t>(one.object)});
    }
    return bytes_of(rows);
  }

  std::vector<Fields> flights() const {
    std::vector<Fields> flights;
    for (const FusedFlight& flight : map_.flights) flights.push_back(to_dict(map_, flight));
    return flights;
  }

  std::optional<std::pair<double, double>> origin() const {
    if (!map_.frame) return std::nullopt;
    return std::make_pair(map_.frame->origin().latitude_deg, map_.frame->origin().longitude_deg);
  }

  std::string geojson() const { return io::fused_to_geojson(map_, reports_); }
  std::string table() const { return io::flights_to_table(map_); }

 private:
  FusedMap map_;
  std::vector<io::ObjectReport> reports_;
};

}  // namespace

void bind_fleet(nb::module_& module) {
  nb::class_<FlightSummary>(module, "Summary")
      .def_prop_ro("flight", [](const FlightSummary& summary) { return summary.identity.flight; })
      .def_prop_ro("vehicle", [](const FlightSummary& summary) { return summary.identity.vehicle; })
      .def_prop_ro("sequence", [](const FlightSummary& summary) { return summary.identity.sequence; })
      .def_prop_ro("origin",
                   [](const FlightSummary& summary) {
                     return std::make_pair(summary.origin.latitude_deg, summary.origin.longitude_deg);
                   })
      .def_ro("home_height_msl_m", &FlightSummary::home_height_msl_m)
      .def("objects", &objects_of)
      .def("shared_count", [](const FlightSummary& summary) { return summary.shared_count(); })
      .def("shared_error", &shared_error_of)
      .def("apart", &apart_of)
      .def("to_bytes", [](const FlightSummary& summary) { return to_bytes(io::summary_to_bytes(summary)); })
      .def("to_json", [](const FlightSummary& summary) { return io::summary_to_json(summary); });
  module.def("parse_summary", &parse, nb::arg("content"), nb::arg("name"));
  nb::class_<Fused>(module, "Fused")
      .def("objects", &Fused::objects)
      .def("contributions", &Fused::contributions)
      .def("flights", &Fused::flights)
      .def("origin", &Fused::origin)
      .def("geojson", &Fused::geojson)
      .def("table", &Fused::table);
  module.def(
      "fuse",
      [](const std::vector<const FlightSummary*>& summaries, const std::vector<std::string>& class_names,
         std::optional<double> quarantine_gate, std::optional<double> most_shift_m,
         std::optional<double> sigma_home_m) {
        return Fused(summaries, {quarantine_gate, most_shift_m, sigma_home_m}, class_names);
      },
      nb::arg("summaries"), nb::arg("class_names"), nb::arg("quarantine_gate").none(),
      nb::arg("most_shift_m").none(), nb::arg("sigma_home_m").none());
}

}  // namespace geoloc::python
