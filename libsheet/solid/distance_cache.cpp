// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/solid/distance_cache.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <fcntl.h>
#include <unistd.h>
#include <xxhash.h>

#include "libsheet/base/error.h"
#include "libsheet/base/files.h"
#include "libsheet/base/log.h"

namespace sheet::solid {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t cache_format = 1; // one more whenever what the fields hold changes

// Checksum of the rest, then the field.
constexpr std::size_t head_bytes = sizeof(std::uint64_t);

std::optional<fs::path> folder() {
  if (const char* own = std::getenv("SHEET_CACHE_DIR"))
    return *own == '\0' ? std::nullopt : std::optional<fs::path>(own);
  if (const char* cache = std::getenv("XDG_CACHE_HOME"); cache != nullptr && *cache == '/')
    return fs::path(cache) / "sheet";
  if (const char* home = std::getenv("HOME"); home != nullptr && *home == '/')
    return fs::path(home) / ".cache" / "sheet";
  return std::nullopt;
}

fs::path file_of(const fs::path& folder, const std::string& key) { return folder / ("field-" + key); }

} // namespace

std::string cache_key(const SolidSurface& surface, double voxel_size, double band) {
  const std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state(XXH3_createState(), &XXH3_freeState);
  XXH3_128bits_reset(state.get());
  const auto add = [&](const void* data, std::size_t size) { XXH3_128bits_update(state.get(), data, size); };
  const std::array<std::uint64_t, 4> counts{cache_format, level_set_version(), surface.points.size(),
                                            surface.triangles.size()};
  const std::array<double, 2> sizes{voxel_size, band};
  add(counts.data(), sizeof counts);
  add(sizes.data(), sizeof sizes);
  add(surface.points.data(), surface.points.size() * sizeof(Vector3));
  add(surface.triangles.data(), surface.triangles.size() * sizeof(Corners));
  const XXH128_hash_t hash = XXH3_128bits_digest(state.get());
  return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

std::optional<DistanceField> load_field(const std::string& key) {
  const auto place = folder();
  std::error_code error;
  if (!place || !fs::exists(file_of(*place, key), error))
    return std::nullopt;
  const std::string path = file_of(*place, key).string();
  try {
    const std::string bytes = read_text_file(path);
    std::uint64_t checksum = 0;
    if (bytes.size() > head_bytes) {
      std::memcpy(&checksum, bytes.data(), head_bytes);
      if (checksum == XXH3_64bits(bytes.data() + head_bytes, bytes.size() - head_bytes))
        return DistanceField::parse(bytes.substr(head_bytes));
    }
    log::detail("{}: damaged, made anew", path);
  } catch (const std::exception& problem) {
    log::detail("{}: {}; made anew", path, problem.what());
  }
  return std::nullopt;
}

void store_field(const std::string& key, const DistanceField& field) {
  const auto place = folder();
  if (!place)
    return;
  std::error_code error;
  fs::create_directories(*place, error);
  const std::string path = file_of(*place, key).string();
  std::string temporary = path + ".XXXXXX";
  const int descriptor = mkstemp(temporary.data());
  if (descriptor < 0) {
    log::detail("{}: cannot be written, so the next run makes the field again", temporary);
    return;
  }
  close(descriptor);
  const std::string bytes = field.print();
  const std::uint64_t checksum = XXH3_64bits(bytes.data(), bytes.size());
  std::ofstream out(temporary, std::ios::binary);
  out.write(reinterpret_cast<const char*>(&checksum), head_bytes);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  out.close();
  if (out)
    fs::rename(temporary, path, error);
  if (!out || error) {
    fs::remove(temporary, error);
    log::detail("{}: cannot be written, so the next run makes the field again", path);
  }
}

} // namespace sheet::solid
