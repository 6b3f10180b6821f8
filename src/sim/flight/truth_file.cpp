// SPDX-License-Identifier: Apache-2.0
#include "truth_file.hpp"

#include <zlib.h>

#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace geoloc::sim {
namespace {

constexpr std::string_view kColumns = "time_boot_s,lat,lon,alt_amsl,roll,pitch,yaw";
constexpr std::size_t kColumnCount = 7;
constexpr double kLongestFlight_s = 1e7;

[[noreturn]] void fail(const std::string& name, std::size_t line, const std::string& reason) {
  throw std::runtime_error(name + ": line " + std::to_string(line) + ": " + reason);
}

/// Takes the text up to the next newline, without it and without a carriage return.
std::string_view take_line(std::string_view& rest) {
  const std::size_t end = std::min(rest.find('\n'), rest.size());
  std::string_view line = rest.substr(0, end);
  rest.remove_prefix(std::min(end + 1, rest.size()));
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  return line;
}

std::array<double, kColumnCount> parse_numbers(std::string_view line, const std::string& name,
                                               std::size_t number) {
  std::array<double, kColumnCount> values{};
  const char* at = line.data();
  const char* const end = line.data() + line.size();
  for (std::size_t column = 0; column < kColumnCount; ++column) {
    if (column > 0 && (at == end || *at++ != ',')) fail(name, number, "too few columns");
    const auto [stopped_at, error] = std::from_chars(at, end, values[column]);
    if (error != std::errc{} || !std::isfinite(values[column])) {
      fail(name, number, "column " + std::to_string(column + 1) + " is not a finite number");
    }
    at = stopped_at;
  }
  if (at != end && *at != ',') fail(name, number, "column 7 is not a finite number");
  return values;
}

TrueState parse_state(std::string_view line, const std::string& name, std::size_t number) {
  const auto [time_s, latitude_deg, longitude_deg, height_msl_m, roll_rad, pitch_rad, yaw_rad] =
      parse_numbers(line, name, number);
  if (!(std::abs(time_s) < kLongestFlight_s)) fail(name, number, "the time is out of range");
  TrueState state;
  state.time = VehicleTime{from_seconds(time_s)};
  state.position = {latitude_deg, longitude_deg};
  state.height_msl_m = height_msl_m;
  state.attitude = {roll_rad, pitch_rad, yaw_rad};
  if (!is_valid(state.position)) fail(name, number, "latitude or longitude is out of range");
  return state;
}

/// Ends the zlib stream on every way out.
struct Inflater {
  z_stream stream{};
  Inflater() {
    constexpr int kGzipOnly = 16;
    if (inflateInit2(&stream, MAX_WBITS + kGzipOnly) != Z_OK) throw std::runtime_error("zlib cannot start");
  }
  ~Inflater() { inflateEnd(&stream); }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;
};

}  // namespace

std::vector<TrueState> parse_truth_csv(std::string_view csv, const std::string& name) {
  const std::string_view header = take_line(csv);
  const bool known = header.substr(0, kColumns.size()) == kColumns &&
                     (header.size() == kColumns.size() || header[kColumns.size()] == ',');
  if (!known) fail(name, 1, "the columns must begin with " + std::string(kColumns));
  std::vector<TrueState> states;
  for (std::size_t number = 2; !csv.empty(); ++number) {
    const TrueState state = parse_state(take_line(csv), name, number);
    if (!states.empty() && !(state.time > states.back().time)) fail(name, number, "the time does not rise");
    states.push_back(state);
  }
  if (states.size() < 2) throw std::runtime_error(name + ": two samples at least are needed");
  return states;
}

std::string gunzip(std::string_view compressed, const std::string& name, std::size_t max_size) {
  Inflater inflater;
  z_stream& stream = inflater.stream;
  if (compressed.size() > std::numeric_limits<uInt>::max()) throw std::runtime_error(name + ": too large");
  stream.next_in =
      reinterpret_cast<Bytef*>(const_cast<char*>(compressed.data()));  // zlib does not write there
  stream.avail_in = static_cast<uInt>(compressed.size());
  std::string content;
  std::array<char, 1U << 16U> block;
  int status = Z_OK;
  while (status != Z_STREAM_END) {
    stream.next_out = reinterpret_cast<Bytef*>(block.data());
    stream.avail_out = static_cast<uInt>(block.size());
    status = inflate(&stream, Z_NO_FLUSH);
    if (status != Z_OK && status != Z_STREAM_END)
      throw std::runtime_error(name + ": damaged or cut gzip data");
    content.append(block.data(), block.size() - stream.avail_out);
    if (content.size() > max_size) throw std::runtime_error(name + ": unpacks to more than is believable");
  }
  return content;
}

std::vector<TrueState> read_truth_file(const std::filesystem::path& file) {
  std::ifstream input(file, std::ios::binary);
  if (!input) throw std::runtime_error(file.string() + ": cannot be read");
  const std::string compressed{std::istreambuf_iterator<char>(input), {}};
  return parse_truth_csv(gunzip(compressed, file.string()), file.string());
}

}  // namespace geoloc::sim
