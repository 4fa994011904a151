// Files of irradiance caches and photon maps from anywhere: as they are, and with a checksum that fits, so
// that damage gets past it. What is accepted is looked up, and comes back when it is written.
#include "render/caches/irradiance_cache.h"
#include "render/photons/photon_map.h"

#include "slvm/format/slo.h"

#include <cstdlib>
#include <cstring>

namespace {

using namespace render;

// Of the header: 32 bytes, the checksum is the last eight.
constexpr size_t kHeader = 32, kChecksumAt = 24;

void seal(std::vector<std::byte>& bytes) {
  if (bytes.size() < kHeader) return;
  const uint64_t sum = slvm::hash_bytes(std::span(bytes).subspan(kHeader));
  std::memcpy(bytes.data() + kChecksumAt, &sum, sizeof sum);
}

void use(const PointTable& table) {
  if (!parse_point_table(format_point_table(table), "again")) std::abort();
  if (auto photons = photons_of(table, "fuzz.gpm")) {
    const PhotonMap map(*photons);
    static_cast<void>(map.irradiance({{0.5f, 0, 1}, {0, 0, 1}, 3, 2, 1}));
    static_cast<void>(map.irradiance({{0, 0, 0}, Vec3(0.0f), 1000, kInfinity, 0}));
    static_cast<void>(map.radiance({0, 1, 0}, {0, 1, 0}));
    if (!photons_of(table_of(map.photons()), "again")) std::abort();
  }
  auto records = records_of(table, "fuzz.icf");
  if (!records) return;
  const std::vector<IrradianceRecord> all = merged(*records);
  if (!records_of(table_of(all), "again")) std::abort();
  const IrradianceCache cache(all);
  for (uint32_t wanted = 0; wanted < 16; ++wanted)
    for (float error : {-1.0f, 0.0f, 0.5f})
      static_cast<void>(cache.find({{0.5f, 0, 1}, {0, 0, 1}, wanted, error}));
  if (!all.empty()) static_cast<void>(cache.find({all[0].P, all[0].N, 0, -1}));
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  if (size > 1 << 20) return 0;
  const auto raw = std::as_bytes(std::span(data, size));
  std::vector<std::byte> bytes(raw.begin(), raw.end());
  for (int k = 0; k < 2; ++k, seal(bytes))
    if (const auto table = parse_point_table(bytes, "fuzz.icf")) use(*table);
  return 0;
}
