// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/stills/picture_tags.hpp"

#include <cpl_conv.h>
#include <cpl_string.h>
#include <cpl_vsi.h>
#include <gdal.h>
#include <gdal_frmts.h>

#include <array>
#include <cstdint>
#include <memory>
#include <stdexcept>

#include "io/gdal_dataset.hpp"

namespace geoloc::io {
namespace {

/// Bytes as a file of GDAL's that lies in memory: no other file lies beside it, so that none is read.
class MemoryFile {
 public:
  explicit MemoryFile(std::string_view bytes) {
    // It is opened for reading alone.
    auto* const data = reinterpret_cast<GByte*>(const_cast<char*>(bytes.data()));
    VSILFILE* const file = VSIFileFromMemBuffer(name(), data, bytes.size(), FALSE);
    if (file != nullptr) VSIFCloseL(file);
  }
  ~MemoryFile() { VSIUnlink(name()); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  const char* name() const { return name_.c_str(); }

 private:
  std::string name_ = "/vsimem/geoloc_still_" + std::to_string(reinterpret_cast<std::uintptr_t>(this));
};

GdalDataset open(const MemoryFile& file) {
  constexpr std::array<const char*, 2> kFormats{"JPEG", nullptr};
  GDALRegister_JPEG();  // registered twice it is registered once
  return GdalDataset(
      GDALOpenEx(file.name(), GDAL_OF_RASTER | GDAL_OF_READONLY, kFormats.data(), nullptr, nullptr));
}

/// GDAL's names are the standard's but for a prefix and one misspelling.
std::string standard_name(const std::string& gdal_name) {
  constexpr std::string_view kPrefix = "EXIF_";
  const std::string name = gdal_name.substr(kPrefix.size());
  return name == "SubSecTime_Original" ? "SubSecTimeOriginal" : name;
}

std::map<std::string, std::string> exif_of(GDALDatasetH dataset) {
  std::map<std::string, std::string> tags;
  for (CSLConstList entry = GDALGetMetadata(dataset, nullptr); entry != nullptr && *entry != nullptr;
       ++entry) {
    const std::string text = *entry;
    const std::size_t equals = text.find('=');
    if (text.rfind("EXIF_", 0) == 0 && equals != std::string::npos)
      tags.emplace(standard_name(text.substr(0, equals)), text.substr(equals + 1));
  }
  return tags;
}

std::map<std::string, std::string> xmp_of(GDALDatasetH dataset) {
  const CSLConstList packet = GDALGetMetadata(dataset, "xml:XMP");
  if (packet == nullptr || *packet == nullptr) return {};
  return parse_xmp(*packet);
}

std::optional<std::string> found_in(const std::map<std::string, std::string>& tags, const std::string& name) {
  const auto found = tags.find(name);
  if (found == tags.end()) return std::nullopt;
  return found->second;
}

}  // namespace

std::optional<std::string> PictureTags::exif_text(const std::string& name) const {
  return found_in(exif, name);
}

std::optional<std::string> PictureTags::xmp_text(const std::string& name) const {
  return found_in(xmp, name);
}

PictureTags parse_picture_tags(std::string_view jpeg) {
  constexpr std::string_view kStart{"\xFF\xD8\xFF"};
  if (jpeg.substr(0, kStart.size()) != kStart) throw std::runtime_error("is no JPEG");
  const GdalErrors quiet;
  const MemoryFile file(jpeg);
  const GdalDataset dataset = open(file);
  if (!dataset) throw std::runtime_error("is no JPEG that can be read");
  PictureTags tags;
  tags.width_px = GDALGetRasterXSize(dataset.get());
  tags.height_px = GDALGetRasterYSize(dataset.get());
  tags.exif = exif_of(dataset.get());
  tags.xmp = xmp_of(dataset.get());
  return tags;
}

}  // namespace geoloc::io
