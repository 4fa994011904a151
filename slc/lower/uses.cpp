// One walk over the code gathers calls, loops and variables; what the names among their arguments are is
// traced back through selections. Read UseCollector::run first.
#include "slc/lower/uses.h"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

namespace slc {

namespace ir = slvm::ir;

namespace {

using PlaceKey = std::tuple<uint32_t, uint32_t, uint32_t>;

PlaceKey key(const SourceRange& r) {
  return {r.file, r.line, r.column};
}

class UseCollector {
public:
  UseCollector(const ir::Module& m, const std::vector<slvm::SourceCall>& calls) : m_(m), calls_(calls) {}

  Uses run() {
    makers_.assign(m_.values.size(), nullptr);
    used_.assign(m_.values.size(), false);
    each([this](const ir::Inst& inst) { note(inst); });
    source_calls();
    each([this](const ir::Inst& inst) { visit(inst); });
    for (auto* list : {&uses_.messages, &uses_.sent, &uses_.textures, &uses_.rays, &uses_.derivatives,
                       &uses_.lights, &uses_.queries, &uses_.spaces})
      in_order(*list);
    uses_.read.assign(read_.begin(), read_.end());
    uses_.written.assign(written_.begin(), written_.end());
    return std::move(uses_);
  }

private:
  template <class F> void each(F&& f) const {
    auto visit = [&](ir::InstId id) { f(m_.insts[id]); };
    for (const ir::Region& r : m_.inits)
      ir::for_each_inst(m_, r, visit);
    ir::for_each_inst(m_, m_.body, visit);
  }

  void note(const ir::Inst& inst) {
    for (ir::ValueId v : inst.results)
      makers_[v] = &inst;
    // What lanes keep that a light does not reach, the source does not read.
    bool emits = inst.op == ir::Op::kIlluminate || inst.op == ir::Op::kSolar;
    for (size_t i = 0; i < (emits ? ir::fixed_args(inst) : inst.args.size()); ++i)
      used_[inst.args[i]] = true;
    if (inst.op == ir::Op::kCall) called_.insert({inst.index, key(inst.where)});
    if (computes(inst.op)) worked_.insert(key(inst.where));
  }

  // Whether the instruction is work that an inlined function left: constants and names of values are not.
  static bool computes(ir::Op op) {
    switch (op) {
    case ir::Op::kConstant:
    case ir::Op::kSlot:
    case ir::Op::kRetype:
    case ir::Op::kArray:
    case ir::Op::kYield:
    case ir::Op::kBreak:
    case ir::Op::kContinue: return false;
    default: return true;
    }
  }

  void add(std::vector<Use>& list, std::string_view by, const Naming& name, const SourceRange& place) {
    auto same =
        std::find_if(list.begin(), list.end(), [&](const Use& u) { return u.by == by && u.name == name; });
    if (same == list.end()) same = list.insert(list.end(), {std::string(by), name, {}});
    auto there = [&](const SourceRange& r) { return key(r) == key(place); };
    if (std::none_of(same->places.begin(), same->places.end(), there)) same->places.push_back(place);
  }

  // All that the string `v` may be.
  void trace(ir::ValueId v, std::vector<Naming>& out, int depth = 0) const {
    auto found = [&](Naming n) {
      if (std::find(out.begin(), out.end(), n) == out.end()) out.push_back(std::move(n));
    };
    const ir::Inst* maker = makers_[v];
    constexpr int kDeepest = 16;
    if (maker && maker->op == ir::Op::kConstant)
      return found({Naming::kConstant, m_.constants[maker->index].text});
    if (maker && maker->op == ir::Op::kSlot && m_.slots[maker->index].parameter)
      return found({Naming::kParameter, m_.slots[maker->index].name});
    if (maker && maker->op == ir::Op::kIf && depth < kDeepest) {
      auto result = std::find(maker->results.begin(), maker->results.end(), v) - maker->results.begin();
      for (const ir::Region& side : maker->regions)
        if (const ir::Inst& last = m_.insts[side.body.back()]; last.op == ir::Op::kYield)
          trace(last.args[static_cast<size_t>(result)], out, depth + 1);
      return;
    }
    if (maker && maker->op == ir::Op::kCall && depth < kDeepest && m_.called(*maker).name == "operator?:") {
      trace(maker->args[1], out, depth + 1);
      return trace(maker->args[2], out, depth + 1);
    }
    found({Naming::kComputed, ""});
  }

  void add_named(std::vector<Use>& list, std::string_view by, ir::ValueId name, const SourceRange& place) {
    std::vector<Naming> namings;
    trace(name, namings);
    for (const Naming& n : namings)
      add(list, by, n, place);
  }

  void visit(const ir::Inst& inst) {
    switch (inst.op) {
    case ir::Op::kCall: visit_call(inst); break;
    case ir::Op::kGather: visit_gather(inst); break;
    case ir::Op::kIlluminance: visit_light_loop(inst); break;
    case ir::Op::kIlluminate: add(uses_.lights, "illuminate", {}, inst.where); break;
    case ir::Op::kSolar: add(uses_.lights, "solar", {}, inst.where); break;
    case ir::Op::kSlot:
      if (!m_.slots[inst.index].parameter && used_[inst.results[0]]) read_.insert(m_.slots[inst.index].name);
      break;
    case ir::Op::kStore:
      if (!m_.slots[inst.index].parameter) written_.insert(m_.slots[inst.index].name);
      break;
    default: break;
    }
  }

  void visit_call(const ir::Inst& inst) {
    const slvm::ShadeopInfo& info = m_.called(inst);
    const slvm::Signature& s = info.signature;
    files(inst, info);
    if (info.name == "texture" && s.param_count == 2) read_.insert({"s", "t"}); // looked up there
    if (info.flags & slvm::kMessage) add_named(uses_.messages, info.name, inst.args[0], inst.where);
    if (info.name == "lightsend" && !inst.args.empty())
      add_named(uses_.sent, "illuminance", inst.args[0], inst.where);
    if (info.flags & slvm::kRays || asks_for_rays(inst)) add(uses_.rays, info.name, {}, inst.where);
    if (info.flags & slvm::kLights) add(uses_.lights, info.name, {}, inst.where);
    if (info.name == "attribute" || info.name == "option" || info.name == "rendererinfo" ||
        info.name == "rayinfo")
      add_named(uses_.queries, info.name, inst.args[0], inst.where);
    if (info.name == "spacematrix" || info.name == "projectvector")
      for (size_t i = 0; i < 2; ++i)
        space(inst.args[i], inst.where);
    if (info.flags & slvm::kDerivative && !differentiate_.contains(key(inst.where)))
      add(uses_.derivatives, info.name, {}, inst.where);
  }

  /// A lookup of the map "raytrace".
  bool asks_for_rays(const ir::Inst& inst) const {
    const slvm::ShadeopInfo& info = m_.called(inst);
    if (info.name != "environment" && info.name != "shadow") return false;
    std::vector<Naming> maps;
    trace(inst.args[0], maps);
    return std::any_of(maps.begin(), maps.end(), is_raytrace);
  }
  static bool is_raytrace(const Naming& n) { return n.kind == Naming::kConstant && n.text == "raytrace"; }

  // Files among the arguments: the map of a texture function, a parameter "file", and maps and point clouds
  // that optional arguments name.
  void files(const ir::Inst& inst, const slvm::ShadeopInfo& info) {
    const slvm::Signature& s = info.signature;
    auto add_file = [&](ir::ValueId v) {
      std::vector<Naming> namings;
      if (m_.type(v) == Type::kString) trace(v, namings);
      for (const Naming& n : namings)
        if (!is_raytrace(n)) add(uses_.textures, info.name, n, inst.where);
    };
    size_t next = 0; // outputs are no arguments
    for (int i = 0; i < s.param_count && next < inst.args.size(); ++i) {
      const slvm::SignatureParam& p = s.param(i);
      if (p.input && (p.name == "file" || (i == 0 && info.flags & slvm::kTexture))) add_file(inst.args[next]);
      next += p.input;
    }
    for (; !s.token_set.empty() && next + 1 < inst.args.size(); next += 2) {
      std::vector<Naming> tokens;
      trace(inst.args[next], tokens);
      bool names_file = std::any_of(tokens.begin(), tokens.end(), [](const Naming& t) {
        return t.kind == Naming::kConstant && (t.text == "environmentmap" || t.text == "filename");
      });
      if (names_file) add_file(inst.args[next + 1]);
    }
  }

  void visit_gather(const ir::Inst& inst) {
    const slvm::ShadeopInfo& info = m_.called(inst);
    add_named(uses_.rays, info.name, inst.args[0], inst.where);
    add(uses_.derivatives, info.name, {}, inst.where);
    gathered(inst, static_cast<size_t>(info.signature.param_count), ir::fixed_args(inst));
  }

  // The pairs behind the arguments of gather: what is asked of the surfaces that rays hit.
  void gathered(const ir::Inst& inst, size_t from, size_t to) {
    for (size_t i = from; i + 1 < to; i += 2) {
      std::vector<Naming> tokens;
      trace(inst.args[i], tokens);
      for (const Naming& t : tokens) {
        const slvm::TokenInfo* row = slvm::find_token("gather", t.text);
        if (t.kind == Naming::kConstant && row && row->any && row->output)
          add(uses_.messages, "gather", t, inst.where);
      }
    }
  }

  void space(ir::ValueId name, const SourceRange& place) {
    std::vector<Naming> namings;
    trace(name, namings);
    for (const Naming& n : namings)
      if (n.text != "current") add(uses_.spaces, "space", n, place);
  }

  // A loop of diffuse() and the like goes by that name. Loops that were made one have several.
  void visit_light_loop(const ir::Inst& inst) {
    std::set<std::pair<PlaceKey, ShadeopId>> inlined;
    auto look = [&](const SourceRange& where) {
      for (const slvm::SourceCall& c : calls_)
        if (PlaceKey{c.file, c.line, c.column} == key(where) &&
            m_.plugins.info(c.shadeop).flags & slvm::kLights)
          inlined.insert({key(where), c.shadeop});
    };
    look(inst.where);
    bool statement = inlined.empty();
    ir::for_each_inst(m_, inst.regions[0], [&](ir::InstId id) {
      if (computes(m_.insts[id].op)) look(m_.insts[id].where);
    });
    if (statement) add_named(uses_.lights, "illuminance", inst.args[0], inst.where);
    for (auto& [place, row] : inlined) {
      auto [file, line, column] = place;
      add_named(uses_.lights, m_.plugins.info(row).name, inst.args[0], {file, line, column, 0});
    }
  }

  // Calls of the source: code of theirs is a call of the row, or anything for inlined bodies.
  void source_calls() {
    std::map<std::pair<std::string_view, ShadeopId>, CallUse> rows;
    for (const slvm::SourceCall& c : calls_) {
      const slvm::ShadeopInfo& info = m_.plugins.info(c.shadeop);
      SourceRange place{c.file, c.line, c.column, 0};
      bool left = info.kind == slvm::ShadeopKind::kRsl ? worked_.contains(key(place))
                                                       : called_.contains({c.shadeop, key(place)});
      if (!left) continue;
      CallUse& use = rows[{info.name, c.shadeop}];
      use.shadeop = c.shadeop;
      if (m_.plugins.find(c.shadeop)) use.plugin = m_.plugins.list()[c.shadeop - slvm::kFirstPluginShadeop];
      use.places.push_back(place);
      if (!(info.flags & slvm::kDerivative)) continue;
      add(uses_.derivatives, info.name, {}, place);
      differentiate_.insert(key(place));
    }
    for (auto& [name, use] : rows) {
      sort(use.places);
      uses_.calls.push_back(std::move(use));
    }
  }

  static void sort(std::vector<SourceRange>& places) {
    std::sort(places.begin(), places.end(),
              [](const SourceRange& a, const SourceRange& b) { return key(a) < key(b); });
  }
  static void in_order(std::vector<Use>& list) {
    for (Use& use : list)
      sort(use.places);
    std::stable_sort(list.begin(), list.end(), [](const Use& a, const Use& b) {
      return key(a.places.front()) < key(b.places.front());
    });
  }

  const ir::Module& m_;
  const std::vector<slvm::SourceCall>& calls_;
  std::vector<const ir::Inst*> makers_; // by value; null: a region's parameter
  std::vector<bool> used_;              // by value
  std::set<std::pair<uint32_t, PlaceKey>> called_;
  std::set<PlaceKey> worked_;
  std::set<PlaceKey> differentiate_; // calls of the source that do
  std::set<std::string> read_, written_;
  Uses uses_;
};

} // namespace

Uses collect_uses(const ir::Module& m, const std::vector<slvm::SourceCall>& calls) {
  return UseCollector(m, calls).run();
}

} // namespace slc
