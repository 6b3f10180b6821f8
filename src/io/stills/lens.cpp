// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "geoloc/io/stills/still.hpp"
#include "io/stills/tag_values.hpp"

namespace geoloc::io {
namespace {

/// Shorter and longer ones are misprints.
constexpr double kShortest = 0.2, kLongest = 50.0;  // focal length by the image's longer side

CameraIntrinsics centred(const PictureTags& tags, double focal_px) {
  CameraIntrinsics intrinsics;
  intrinsics.width_px = tags.width_px;
  intrinsics.height_px = tags.height_px;
  intrinsics.fx_px = focal_px;
  intrinsics.fy_px = focal_px;
  intrinsics.cx_px = 0.5 * (tags.width_px - 1);
  intrinsics.cy_px = 0.5 * (tags.height_px - 1);
  return intrinsics;
}

bool is_credible(const PictureTags& tags, const Lens& lens) {
  const double size_px = std::max(tags.width_px, tags.height_px);
  return lens.intrinsics.fx_px > kShortest * size_px && lens.intrinsics.fx_px < kLongest * size_px &&
         CameraConfig{lens.intrinsics, {}}.problems().empty();
}

/// DJI's `DewarpData`: a date; fx, fy, the principal point from the image's centre [px], k1 k2 p1 p2 k3. The
/// distortion is that of the picture where it has not been taken out yet.
std::optional<Lens> dewarp_lens(const PictureTags& tags) {
  const auto text = tags.xmp_text("drone-dji:DewarpData");
  if (!text) return std::nullopt;
  const std::vector<double> values = numbers_in(text->substr(text->find(';') + 1), ',');
  if (values.size() != 9) return std::nullopt;
  Lens lens{centred(tags, values[0]), FocalSource::kCalibration};
  lens.intrinsics.fy_px = values[1];
  lens.intrinsics.cx_px += values[2];
  lens.intrinsics.cy_px += values[3];
  const bool is_taken_out = number_of(tags.xmp_text("drone-dji:DewarpFlag")).value_or(0.0) == 1.0;
  if (!is_taken_out) std::copy(values.begin() + 4, values.end(), lens.intrinsics.distortion.begin());
  return lens;
}

std::optional<Lens> calibrated_lens(const PictureTags& tags) {
  const auto focal_px = number_of(tags.xmp_text("drone-dji:CalibratedFocalLength"));
  if (!focal_px) return std::nullopt;
  return Lens{centred(tags, *focal_px), FocalSource::kCalibration};
}

/// Pictures that were made smaller keep the tags of the larger ones.
double scale_of(const PictureTags& tags) {
  const auto width_px = number_of(tags.exif_text("PixelXDimension"));
  return width_px && *width_px > 0.0 ? tags.width_px / *width_px : 1.0;
}

std::optional<Lens> sensor_lens(const PictureTags& tags) {
  constexpr double kInch_mm = 25.4, kCentimetre_mm = 10.0;
  constexpr double kCentimetreUnit = 3.0;
  const auto focal_mm = number_of(tags.exif_text("FocalLength"));
  const auto per_unit = number_of(tags.exif_text("FocalPlaneXResolution"));
  if (!focal_mm || !per_unit) return std::nullopt;
  const bool is_metric =
      number_of(tags.exif_text("FocalPlaneResolutionUnit")).value_or(0.0) == kCentimetreUnit;
  const double unit_mm = is_metric ? kCentimetre_mm : kInch_mm;
  return Lens{centred(tags, scale_of(tags) * *focal_mm * *per_unit / unit_mm), FocalSource::kSensor};
}

/// The equivalent is for the same diagonal. Pictures of 16:9 are cut from those of 4:3 or 3:2, of which they
/// have the width: the one between is taken.
double film_width_mm(double aspect) {
  constexpr double kWidth3To2_mm = 36.0, kWidth4To3_mm = 34.61;
  if (aspect > 1.6) return 0.5 * (kWidth3To2_mm + kWidth4To3_mm);
  return aspect > 1.42 ? kWidth3To2_mm : kWidth4To3_mm;
}

std::optional<Lens> film_lens(const PictureTags& tags) {
  const auto focal_mm = number_of(tags.exif_text("FocalLengthIn35mmFilm"));
  if (!focal_mm || tags.width_px <= 0 || tags.height_px <= 0) return std::nullopt;
  const double longer_px = std::max(tags.width_px, tags.height_px);
  const double aspect = longer_px / std::min(tags.width_px, tags.height_px);
  return Lens{centred(tags, *focal_mm / film_width_mm(aspect) * longer_px), FocalSource::k35mm};
}

}  // namespace

/// A lens is made to some 2 % of the focal length that its maker states.
double sigma_focal_percent(FocalSource source) {
  switch (source) {
    case FocalSource::kCalibration:
      return 0.3;
    case FocalSource::kSensor:
      return 2.0;
    case FocalSource::k35mm:
      return 3.0;
  }
  return 3.0;
}

std::optional<Lens> lens_of(const PictureTags& tags) {
  for (const auto& told : {&dewarp_lens, &calibrated_lens, &sensor_lens, &film_lens}) {
    const auto lens = told(tags);
    if (lens && is_credible(tags, *lens)) return lens;
  }
  return std::nullopt;
}

}  // namespace geoloc::io
