// Bytes from modules and back. The format is written down once: transfer() visits all parts of a module, with
// an archive that either writes what it is shown (Writer) or fills it in (Reader).
#include "slvm/ir/serialise.h"

#include "slvm/ir/passes/passes.h"
#include "slvm/ir/verify_ir.h"

#include <algorithm>
#include <bit>
#include <fmt/format.h>
#include <limits>

namespace slvm::ir {
namespace {

constexpr uint32_t kFormat = 1;

// ---- Archives.

class Writer {
public:
  static constexpr bool kReads = false;

  void number(uint64_t x) {
    for (; x >= 0x80; x >>= 7)
      bytes_.push_back(static_cast<uint8_t>(x | 0x80));
    bytes_.push_back(static_cast<uint8_t>(x));
  }
  void real(float x) {
    auto bits = std::bit_cast<uint32_t>(x);
    for (int i = 0; i < 4; ++i)
      bytes_.push_back(static_cast<uint8_t>(bits >> (8 * i)));
  }
  void text(const std::string& s) {
    number(s.size());
    bytes_.insert(bytes_.end(), s.begin(), s.end());
  }
  template <class T, class F> void list(std::vector<T>& items, F&& item) {
    number(items.size());
    for (T& x : items)
      item(x);
  }
  bool failed() const { return false; }
  std::vector<uint8_t> take() { return std::move(bytes_); }

private:
  std::vector<uint8_t> bytes_;
};

/// After the first failure every number is 0 and every list empty, so that reading comes to its end.
class Reader {
public:
  static constexpr bool kReads = true;
  explicit Reader(std::span<const uint8_t> bytes) : bytes_(bytes) {}

  template <class T> void number(T& x) {
    uint64_t value = 0;
    for (int shift = 0;; shift += 7) {
      if (bytes_.empty() || shift > 63) {
        fail("ends in the middle");
        break;
      }
      uint8_t byte = bytes_[0];
      bytes_ = bytes_.subspan(1);
      value |= static_cast<uint64_t>(byte & 0x7f) << shift;
      if (byte < 0x80) break;
    }
    if (value > std::numeric_limits<T>::max()) fail("a number is too large");
    x = failed() ? T{} : static_cast<T>(value);
  }
  void real(float& x) {
    if (bytes_.size() < 4) return fail("ends in the middle");
    uint32_t bits = 0;
    for (int i = 0; i < 4; ++i)
      bits |= static_cast<uint32_t>(bytes_[static_cast<size_t>(i)]) << (8 * i);
    x = std::bit_cast<float>(bits);
    bytes_ = bytes_.subspan(4);
  }
  void text(std::string& s) {
    size_t size = count();
    s.assign(reinterpret_cast<const char*>(bytes_.data()), size);
    bytes_ = bytes_.subspan(size);
  }
  template <class T, class F> void list(std::vector<T>& items, F&& item) {
    size_t size = count();
    for (size_t i = 0; i < size && !failed(); ++i) {
      T x{};
      item(x);
      items.push_back(std::move(x));
    }
  }
  bool failed() const { return !error_.empty(); }
  const std::string& error() const { return error_; }
  bool at_end() const { return bytes_.empty(); }
  void fail(std::string what) {
    if (error_.empty()) error_ = std::move(what);
    bytes_ = {};
  }

private:
  // Every item takes at least one byte, which bounds what a damaged count can ask for.
  size_t count() {
    uint64_t n = 0;
    number(n);
    if (n > bytes_.size()) fail("a list is longer than the data");
    return failed() ? 0 : static_cast<size_t>(n);
  }

  std::span<const uint8_t> bytes_;
  std::string error_;
};

// ---- The format.

template <class A> class Format {
public:
  Format(A& a, Module& m) : a_(a), m_(m) {}

  void transfer() {
    uint32_t format = kFormat;
    a_.number(format);
    if constexpr (A::kReads)
      if (format != kFormat) return a_.fail(fmt::format("format {} instead of {}", format, kFormat));
    enumeration(m_.kind, kShaderKindCount);
    a_.text(m_.name);
    a_.list(m_.files, [&](std::string& s) { a_.text(s); });
    a_.list(m_.slots, [&](Slot& s) { slot(s); });
    a_.list(m_.params, [&](Param& p) { param(p); });
    a_.list(m_.arrays, [&](Array& x) { array(x); });
    a_.list(m_.constants, [&](Constant& c) { constant(c); });
    imports();
    region(m_.body, 0);
    a_.list(m_.inits, [&](Region& r) { region(r, 0); });
  }

private:
  void flag(bool& b) {
    uint8_t x = b;
    a_.number(x);
    if constexpr (A::kReads) b = x != 0;
  }
  template <class E> void enumeration(E& e, int count) {
    auto x = static_cast<uint8_t>(e);
    a_.number(x);
    if constexpr (A::kReads) {
      if (x >= count) a_.fail("a number that names nothing");
      e = static_cast<E>(x < count ? x : 0);
    }
  }
  void type(Type& t) { enumeration(t, kTypeCount); }
  /// -1 and up, as 0 and up.
  void index(int32_t& i) {
    auto x = static_cast<uint32_t>(i + 1);
    a_.number(x);
    if constexpr (A::kReads) {
      if (x > (1u << 30)) a_.fail("an index out of bounds");
      i = a_.failed() ? -1 : static_cast<int32_t>(x) - 1;
    }
  }

  void slot(Slot& s) {
    a_.text(s.name);
    type(s.type);
    a_.number(s.elements);
    flag(s.parameter);
    flag(s.varying);
    flag(s.stored);
  }
  void param(Param& p) {
    a_.text(p.name);
    type(p.type);
    a_.number(p.elements);
    flag(p.varying);
    flag(p.output);
    flag(p.default_known);
    type(p.default_value.type);
    a_.number(p.default_value.elements);
    a_.list(p.default_value.numbers, [&](float& x) { a_.real(x); });
    a_.list(p.default_value.strings, [&](std::string& s) { a_.text(s); });
    a_.text(p.default_space);
    index(p.slot);
    index(p.init);
  }
  void array(Array& x) {
    type(x.type);
    a_.number(x.elements);
    index(x.slot);
  }
  void constant(Constant& c) {
    type(c.type);
    a_.list(c.numbers, [&](float& x) { a_.real(x); });
    a_.text(c.text);
  }

  /// The shadeops called; instructions name them by their place in this list. A function of a plug-in has an
  /// empty name in front.
  void imports() {
    if constexpr (!A::kReads)
      for (const Inst& inst : m_.insts)
        if (names_shadeop(inst.op) &&
            std::find(imports_.begin(), imports_.end(), inst.index) == imports_.end())
          imports_.push_back(inst.index);
    a_.list(imports_, [&](uint32_t& id) {
      std::string name, signature;
      if constexpr (!A::kReads) {
        if (const PluginShadeop* function = m_.plugins.find(static_cast<ShadeopId>(id))) {
          a_.text(name);
          return plugin(id, function->name());
        }
        name = shadeop(static_cast<ShadeopId>(id)).name;
        signature = shadeop(static_cast<ShadeopId>(id)).signature_text;
      }
      a_.text(name);
      if constexpr (A::kReads)
        if (name.empty() && !a_.failed()) return plugin(id, {});
      a_.text(signature);
      if constexpr (A::kReads) {
        int found = find_shadeop(name, signature);
        if (found < 0 && !a_.failed())
          a_.fail(
              fmt::format("the built-in '{}' with signature '{}' is not in this version", name, signature));
        id = static_cast<uint32_t>(std::max(found, 0));
      }
    });
  }

  void plugin(uint32_t& id, PluginFunctionName name) {
    a_.text(name.function);
    a_.text(name.signature);
    a_.text(name.library);
    enumeration(name.form, kPluginFormCount);
    if constexpr (A::kReads) {
      auto function = PluginShadeop::make(std::move(name));
      std::optional<ShadeopId> added;
      if (function) added = m_.plugins.add(std::move(function));
      if (!added && !a_.failed()) a_.fail("a function of a plug-in without a proper signature");
      id = added.value_or(ShadeopId{0});
    }
  }

  void region(Region& r, uint32_t depth) {
    if constexpr (A::kReads)
      if (depth > kMaxNesting) return a_.fail("regions nested too deeply");
    a_.list(r.params, [&](ValueId& v) { definition(v); });
    a_.list(r.body, [&](InstId& id) { instruction(id, depth); });
  }

  void instruction(InstId& id, uint32_t depth) {
    if constexpr (A::kReads) {
      id = static_cast<InstId>(m_.insts.size());
      m_.insts.emplace_back();
    }
    // By value while regions are read: they add instructions.
    Inst inst = std::move(m_.insts[id]);
    enumeration(inst.op, kOpCount);
    subject(inst);
    position(inst.where);
    a_.list(inst.args, [&](ValueId& v) { use(v); });
    a_.list(inst.results, [&](ValueId& v) { definition(v); });
    a_.list(inst.regions, [&](Region& r) { region(r, depth + 1); });
    m_.insts[id] = std::move(inst);
  }

  void subject(Inst& inst) {
    uint32_t x = inst.index;
    if constexpr (!A::kReads)
      if (names_shadeop(inst.op))
        x = static_cast<uint32_t>(std::find(imports_.begin(), imports_.end(), x) - imports_.begin());
    a_.number(x);
    if constexpr (A::kReads) {
      if (names_shadeop(inst.op) && x >= imports_.size()) return a_.fail("a call of no import");
      inst.index = names_shadeop(inst.op) ? imports_[x] : x;
    }
  }

  /// Lines as differences from the one before, zigzag.
  void position(SourceRange& where) {
    a_.number(where.file);
    uint32_t step = where.line - line_;
    uint32_t zigzag = step << 1 ^ (step >> 31 ? ~0u : 0u);
    a_.number(zigzag);
    if constexpr (A::kReads) where.line = line_ + (zigzag >> 1 ^ (zigzag & 1 ? ~0u : 0u));
    line_ = where.line;
    a_.number(where.column);
    a_.number(where.end);
  }

  /// Values are numbered in the order of their definitions, so that only their types are written.
  void definition(ValueId& v) {
    ValueInfo info;
    if constexpr (!A::kReads) info = m_.values[v];
    type(info.type);
    index(info.array);
    if constexpr (A::kReads) {
      v = static_cast<ValueId>(m_.values.size());
      m_.values.push_back(info);
    }
    ++defined_;
  }
  /// Uses as distances back from the last definition.
  void use(ValueId& v) {
    uint32_t distance = defined_ - v;
    a_.number(distance);
    if constexpr (A::kReads) {
      bool known = distance > 0 && distance <= defined_;
      if (!known) a_.fail("a use before any definition");
      v = known ? defined_ - distance : 0;
    }
  }

  A& a_;
  Module& m_;
  std::vector<uint32_t> imports_;
  uint32_t defined_ = 0, line_ = 0;
};

// ---- What is reachable, numbered in order.

class Compaction {
public:
  explicit Compaction(const Module& from) : from_(from), value_(from.values.size(), kNoValue) {}

  Module run() {
    to_.kind = from_.kind;
    to_.name = from_.name;
    to_.params = from_.params;
    to_.slots = from_.slots;
    to_.arrays = from_.arrays;
    to_.constants = from_.constants;
    to_.files = from_.files;
    to_.plugins = from_.plugins;
    to_.body = region(from_.body);
    for (const Region& r : from_.inits)
      to_.inits.push_back(region(r));
    return std::move(to_);
  }

private:
  Region region(const Region& r) {
    Region out;
    for (ValueId v : r.params)
      out.params.push_back(define(v));
    for (InstId id : r.body) {
      out.body.push_back(static_cast<InstId>(to_.insts.size()));
      to_.insts.emplace_back();
      Inst inst = from_.insts[id];
      for (ValueId& v : inst.args)
        v = value_[v];
      for (ValueId& v : inst.results)
        v = define(v);
      for (Region& nested : inst.regions)
        nested = region(nested);
      to_.insts[out.body.back()] = std::move(inst);
    }
    return out;
  }
  ValueId define(ValueId v) {
    to_.values.push_back(from_.values[v]);
    return value_[v] = static_cast<ValueId>(to_.values.size() - 1);
  }

  const Module& from_;
  Module to_;
  std::vector<ValueId> value_;
};

} // namespace

std::vector<uint8_t> serialise(const Module& m) {
  Module compact = Compaction(m).run();
  Writer writer;
  Format(writer, compact).transfer();
  return writer.take();
}

Result<Module> deserialise(std::span<const uint8_t> bytes) {
  Reader reader(bytes);
  Module m;
  Format(reader, m).transfer();
  if (!reader.failed() && !reader.at_end()) reader.fail("more data than there should be");
  if (reader.failed()) return Error{"intermediate code: " + reader.error()};
  if (std::string error = verify_module(m); !error.empty()) return Error{"intermediate code: " + error};
  infer_detail(m);
  return m;
}

} // namespace slvm::ir
