// Digests of requests.
#include "render/state/mesh_digest.h"

#include <bit>
#include <cstring>

namespace render {

namespace {

/// Corners of the faces of a mesh that is worth it.
constexpr size_t kFewest = 256;

/// Two sums of products, each with odd factors of its own (those of splitmix64 and of xxHash).
class Digester {
public:
  template <class T> void add(const std::vector<T>& values) {
    add_word(values.size());
    add_bytes(values.data(), values.size() * sizeof(T));
  }
  void add(std::string_view text) {
    add_word(text.size());
    add_bytes(text.data(), text.size());
  }
  void add(const std::vector<std::string>& texts) {
    add_word(texts.size());
    for (const std::string& s : texts)
      add(std::string_view(s));
  }
  void add_word(uint64_t w) {
    state_[0] = (std::rotl(state_[0], 29) ^ w) * 0xbf58476d1ce4e5b9u;
    state_[1] = std::rotl(state_[1] + w * 0xc2b2ae3d27d4eb4fu, 31) * 0x9e3779b185ebca87u;
  }
  MeshDigest result() const {
    MeshDigest out = state_;
    for (uint64_t& h : out) {
      h = (h ^ (h >> 30)) * 0x94d049bb133111ebu;
      h ^= h >> 31;
    }
    return out;
  }

private:
  void add_bytes(const void* at, size_t size) {
    const char* from = static_cast<const char*>(at);
    uint64_t word = 0;
    for (; size >= sizeof(word); size -= sizeof(word), from += sizeof(word)) {
      std::memcpy(&word, from, sizeof(word));
      add_word(word);
    }
    word = 0;
    if (size > 0) std::memcpy(&word, from, size);
    add_word(word);
  }

  MeshDigest state_{1, 2};
};

} // namespace

std::optional<MeshDigest> digest_of(const RequestCall& call, const Declarations& declarations) {
  size_t integers = 0;
  for (const Argument& a : call.arguments)
    integers += a.ints.size();
  if (integers < kFewest) return {};
  Digester d;
  d.add_word(static_cast<uint64_t>(call.id));
  for (const Argument& a : call.arguments) {
    d.add_word(a.present);
    d.add(a.numbers);
    d.add(a.ints);
    d.add(a.strings);
  }
  for (const Param& p : call.params) {
    d.add(std::string_view(p.token));
    d.add(p.numbers);
    d.add(p.strings);
    if (auto known = declarations.resolve(p.token)) {
      d.add_word(static_cast<uint64_t>(known->storage) << 32 | static_cast<uint64_t>(known->type) << 8 |
                 (known->hpoint ? 1u : 0u));
      d.add_word(known->elements);
    }
  }
  return d.result();
}

} // namespace render
