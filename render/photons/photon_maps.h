// The photon maps that a frame reads, each once.
#pragma once

#include "render/photons/photon_map.h"
#include "slvm/photon_map.h"

#include <atomic>
#include <functional>
#include <map>
#include <memory>
#include <mutex>

namespace render {

class PhotonMaps final : public slvm::PhotonMapServices {
public:
  /// `find` turns the name in a scene into the path of a file.
  explicit PhotonMaps(std::function<std::string(std::string_view)> find = {}) : find_(std::move(find)) {}

  std::string photon_map(const slvm::PhotonLookup&) override;

  /// A map, or (null) why there is none. It lives as long as this.
  struct Source {
    std::unique_ptr<const PhotonMap> map;
    std::string problem;
  };
  const Source& source(std::string_view name);
  /// For hits of rays: null where there is none, and problems() then tells.
  const PhotonMap* at_hits(const std::string& name);
  /// Why maps that hits asked for are not used.
  std::vector<std::string> problems() const;

private:
  slvm::Result<std::vector<Photon>> read(const std::string& name) const;

  std::function<std::string(std::string_view)> find_;
  mutable std::mutex mutex_;
  struct Reading {
    std::once_flag once;
    Source source;
    std::atomic<bool> by_hits{false};
  };
  Reading& reading(std::string_view name);
  std::map<std::string, Reading, std::less<>> sources_;
};

} // namespace render
